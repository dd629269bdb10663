//! Gaps and contacts between parts that are moved.

use crate::geom::{Bvh, Frame, Point};
use crate::mesh::{MeshDistance, TriMesh};

/// The distance up to which two surfaces touch, mm: rounding of files.
const TOUCH_MM: f64 = 1e-4;

/// A shell with its cap, prepared for distances.
pub(super) struct Body {
    pub mesh: TriMesh,
    distance: MeshDistance,
}

impl Body {
    /// Takes a tube and its cap, in the shell's frame.
    pub fn new(mesh: TriMesh) -> Self {
        Self {
            distance: MeshDistance::new(&mesh),
            mesh,
        }
    }

    /// Returns the tree over its triangles.
    pub fn bvh(&self) -> &Bvh {
        self.distance.bvh()
    }

    /// Returns how far a point is outside, mm: negative inside.
    pub fn outside_mm(&self, p: &Point) -> f64 {
        -self.distance.signed(p)
    }

    /// Returns the middle of its box.
    pub fn centre(&self) -> Point {
        self.mesh.aabb().center()
    }

    /// Returns the greatest distance of a point from the middle of its box, mm.
    pub fn radius_mm(&self) -> f64 {
        let centre = self.centre();
        let far = self.mesh.vertices().iter().map(|p| (p - centre).norm());
        far.fold(0.0, f64::max)
    }

    /// Returns the least gap to another body that is placed in this one's frame, mm.
    pub fn gap_mm(&self, other: &Self, placed: &Frame) -> f64 {
        self.distance.min_distance_to(&moved(&other.mesh, placed))
    }

    /// Returns true if another body, placed in this one's frame, touches it or reaches into it.
    pub fn touches(&self, other: &Self, placed: &Frame) -> bool {
        self.is_nearer(other, placed, TOUCH_MM)
    }

    /// Returns true if another body, placed in this one's frame, comes nearer than a limit.
    pub fn is_nearer(&self, other: &Self, placed: &Frame, limit_mm: f64) -> bool {
        let bounds = self.mesh.aabb().inflated(limit_mm);
        let mesh = moved(&other.mesh, placed);
        let is_apart = (0..3).any(|axis| {
            let own = [bounds.min[axis], bounds.max[axis]];
            let their = mesh.aabb();
            their.max[axis] < own[0] || their.min[axis] > own[1]
        });
        if is_apart {
            return false;
        }
        let mut near = mesh.iter_corners().filter(|corners| {
            (0..3).all(|axis| {
                let values = corners.map(|p| p[axis]);
                let low = values.into_iter().fold(f64::INFINITY, f64::min);
                let high = values.into_iter().fold(f64::NEG_INFINITY, f64::max);
                high >= bounds.min[axis] && low <= bounds.max[axis]
            })
        });
        near.any(|corners| self.bvh().is_triangle_within(&corners, limit_mm))
    }
}

/// Returns a mesh moved from its own frame.
pub(super) fn moved(mesh: &TriMesh, frame: &Frame) -> TriMesh {
    mesh.map_vertices(|p| frame.to_model(p))
}

/// Returns a frame seen from another.
pub(super) fn seen_from(base: &Frame, frame: &Frame) -> Frame {
    base.inverse().frame_to_model(frame)
}
