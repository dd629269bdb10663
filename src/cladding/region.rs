//! A convex region of space, and where each plane that bounds it comes from.

use crate::geom::{Aabb, Plane, Point};
use crate::mesh::TriMesh;
use crate::polyhedra::Convex;

/// The origin of a plane that bounds a region.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundKind {
    /// The plane on which the panel bears, a gap above it.
    Floor,
    /// The bisector between two faces: the seam to the cell of the other one.
    Seam {
        /// The index of the other face.
        face: usize,
    },
    /// A cut for the printer's room.
    Cut,
    /// A plane between two polyhedra of the base.
    Split,
}

/// A plane that bounds a region.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// The plane; its normal points out of the region.
    pub plane: Plane,
    /// Its origin.
    pub kind: BoundKind,
}

/// A convex region: the points below all its bounds. The first bound is its floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    bounds: Vec<Bound>,
}

impl Region {
    pub(super) fn new(bounds: Vec<Bound>) -> Self {
        Self { bounds }
    }

    /// Returns the bounds, the floor first.
    pub fn bounds(&self) -> &[Bound] {
        &self.bounds
    }

    /// Returns the height of a point above the highest bound, mm; less than zero inside.
    pub fn height_mm(&self, point: &Point) -> f64 {
        let heights = self.bounds.iter().map(|bound| bound.plane.distance(point));
        heights.fold(f64::NEG_INFINITY, f64::max)
    }

    /// Returns the part of the region below one more bound.
    #[must_use]
    pub fn with(&self, bound: Bound) -> Self {
        let bounds = self.bounds.iter().copied();
        Self::new(bounds.chain([bound]).collect())
    }

    /// Returns the region with one bound moved outward, mm.
    #[must_use]
    pub fn widened(&self, bound: usize, by_mm: f64) -> Self {
        let mut wider = self.clone();
        if let Some(bound) = wider.bounds.get_mut(bound) {
            bound.plane.offset_mm += by_mm;
        }
        wider
    }

    /// Returns the region with the indices of faces raised by a number.
    pub(super) fn renumbered(&self, by: usize) -> Self {
        let bounds = self.bounds.iter().map(|bound| Bound {
            kind: match bound.kind {
                BoundKind::Seam { face } => BoundKind::Seam { face: face + by },
                other => other,
            },
            ..*bound
        });
        Self::new(bounds.collect())
    }

    /// Returns the region within a box as a closed body; `None` if nothing of it is there.
    pub fn body(&self, within: &Aabb) -> Option<TriMesh> {
        self.convex(within).map(|body| body.mesh())
    }

    /// Returns the corners of the face on a bound within a box, counterclockwise from outside;
    /// empty if there is no such face.
    pub fn outline(&self, bound: usize, within: &Aabb) -> Vec<Point> {
        let Some(body) = self.convex(within) else {
            return Vec::new();
        };
        let outlines = body.outlines(self.bounds.len());
        let corners = outlines.get(bound).into_iter().flatten();
        corners.map(|&corner| body.at(corner)).collect()
    }

    fn convex(&self, within: &Aabb) -> Option<Convex> {
        let planes: Vec<Plane> = self.bounds.iter().map(|bound| bound.plane).collect();
        Convex::of_planes(&planes, within)
    }
}
