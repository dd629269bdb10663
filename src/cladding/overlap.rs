//! Surfaces that lie over each other: bodies that touch, and bodies that bar the way.

use crate::geom::{Plane, Point, Vector, hull, orthonormal_basis};
use crate::mesh::TriMesh;

/// Distance of a corner from a plane up to which it lies on it, mm. Caps are flat to 1e-13 mm.
const ON_PLANE_MM: f64 = 1e-7;
/// Cosine up to which a triangle is upright: rounding tilts those along a cut by far less.
const UPRIGHT_COSINE: f64 = 1e-9;
/// Depth up to which surfaces that touch count as in contact, mm.
const TOUCH_MM: f64 = 1e-6;
/// Width of a shadow above which it is wide, as a share of all.
const WIDE_RATIO: f64 = 0.03;

/// A triangle seen along a direction: its corners in the plane across, and its height over it.
struct Shadow {
    ring: [[f64; 2]; 3],
    /// Height, and its growth along both coordinates.
    height: [f64; 3],
    low: [f64; 2],
    high: [f64; 2],
}

impl Shadow {
    /// Returns the shadow of a triangle, counterclockwise; `None` if it is upright.
    fn new([u, w, axis]: &[Vector; 3], corners: &[Point; 3]) -> Option<Self> {
        let flat = |p: &Point| [u.dot(&p.coords), w.dot(&p.coords)];
        let mut ring = [0, 1, 2].map(|k| flat(&corners[k]));
        if hull::turn(ring[0], ring[1], ring[2]) < 0.0 {
            ring.swap(1, 2);
        }
        let area = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
        let up = axis.dot(&area);
        if up.abs() <= UPRIGHT_COSINE * area.norm() {
            return None;
        }
        let slope = [u, w].map(|side| -side.dot(&area) / up);
        let base = axis.dot(&corners[0].coords);
        let [x, y] = flat(&corners[0]);
        let bound = |pick: fn(f64, f64) -> f64| {
            [0, 1].map(|k| pick(ring[0][k], pick(ring[1][k], ring[2][k])))
        };
        Some(Self {
            ring,
            height: [base - slope[0] * x - slope[1] * y, slope[0], slope[1]],
            low: bound(f64::min),
            high: bound(f64::max),
        })
    }

    fn height_at(&self, [x, y]: [f64; 2]) -> f64 {
        self.height[0] + self.height[1] * x + self.height[2] * y
    }

    /// Returns what two shadows share, a convex ring.
    fn shared(&self, other: &Self) -> Vec<[f64; 2]> {
        let is_apart = (0..2).any(|k| self.low[k] >= other.high[k] || other.low[k] >= self.high[k]);
        if is_apart {
            return Vec::new();
        }
        (0..3).fold(self.ring.to_vec(), |ring, k| {
            let side = [other.ring[k], other.ring[(k + 1) % 3]];
            left_of(&ring, side)
        })
    }
}

/// Returns the part of a convex ring to the left of the line from one point to another.
///
/// Source: Sutherland and Hodgman, "Reentrant polygon clipping", CACM 17, 1974.
pub(super) fn left_of(ring: &[[f64; 2]], [from, to]: [[f64; 2]; 2]) -> Vec<[f64; 2]> {
    let mut kept = Vec::with_capacity(ring.len() + 1);
    for (k, &here) in ring.iter().enumerate() {
        let next = ring[(k + 1) % ring.len()];
        let [a, b] = [here, next].map(|at| hull::turn(from, to, at));
        if a >= 0.0 {
            kept.push(here);
        }
        if (a >= 0.0) != (b >= 0.0) {
            let share = a / (a - b);
            kept.push([0, 1].map(|k| here[k] + share * (next[k] - here[k])));
        }
    }
    kept
}

/// Returns the area of a convex ring, mm².
pub(super) fn convex_mm2(ring: &[[f64; 2]]) -> f64 {
    let fans = ring.windows(2).skip(1);
    0.5 * fans
        .map(|side| hull::turn(ring[0], side[0], side[1]))
        .sum::<f64>()
}

/// Calls `see` with every pair of shadows whose boxes meet.
fn visit_pairs(first: Vec<Shadow>, second: Vec<Shadow>, mut see: impl FnMut(&Shadow, &Shadow)) {
    let second = near(second, &first);
    let first = near(first, &second);
    let [low, high] = range(&second, 0);
    let width = |shadow: &Shadow| shadow.high[0] - shadow.low[0];
    // A few wide shadows would make every search wide.
    let is_wide = |shadow: &Shadow| width(shadow) > WIDE_RATIO * (high - low);
    let (wide, narrow): (Vec<_>, Vec<_>) = second.into_iter().partition(is_wide);
    for mut others in [wide, narrow] {
        others.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
        let reach = others.iter().map(width).fold(0.0, f64::max);
        for shadow in &first {
            let start = others.partition_point(|other| other.low[0] < shadow.low[0] - reach);
            let near = others[start..].iter();
            let near = near.take_while(|other| other.low[0] <= shadow.high[0]);
            near.for_each(|other| see(shadow, other));
        }
    }
}

/// Returns the least and the greatest place of shadows along a coordinate.
fn range(shadows: &[Shadow], along: usize) -> [f64; 2] {
    let ends = shadows
        .iter()
        .map(|shadow| [shadow.low[along], shadow.high[along]]);
    ends.fold([f64::INFINITY, f64::NEG_INFINITY], |all, [low, high]| {
        [all[0].min(low), all[1].max(high)]
    })
}

/// Returns the shadows that meet the box around all others.
fn near(mut shadows: Vec<Shadow>, others: &[Shadow]) -> Vec<Shadow> {
    let bounds = [0, 1].map(|k| range(others, k));
    shadows.retain(|shadow| {
        (0..2).all(|k| shadow.low[k] < bounds[k][1] && shadow.high[k] > bounds[k][0])
    });
    shadows
}

/// Returns the area in which a body on its way along a unit direction meets another one, mm²; 0 if
/// it passes. It is seen along that way. The bodies must not overlap at the start.
///
/// It meets the other where a face that looks ahead lies below one that looks back.
pub fn barred_mm2(moving: &TriMesh, fixed: &TriMesh, way: &Vector) -> f64 {
    let (u, w) = orthonormal_basis(way);
    let facing = |mesh: &TriMesh, sign: f64| -> Vec<Shadow> {
        let corners = mesh.iter_corners().filter(|[a, b, c]| {
            let area = (b - a).cross(&(c - a));
            sign * way.dot(&area) > 0.0
        });
        corners
            .filter_map(|corners| Shadow::new(&[u, w, *way], &corners))
            .collect()
    };
    let mut barred_mm2 = 0.0;
    visit_pairs(facing(moving, 1.0), facing(fixed, -1.0), |ahead, back| {
        let ring = ahead.shared(back);
        if ring.len() > 2 {
            let middle =
                [0, 1].map(|k| ring.iter().map(|at| at[k]).sum::<f64>() / ring.len() as f64);
            if back.height_at(middle) >= ahead.height_at(middle) - TOUCH_MM {
                barred_mm2 += convex_mm2(&ring);
            }
        }
    });
    barred_mm2
}

/// Returns the area in which two bodies touch in a plane, mm²: the first one below it, the second
/// one above.
pub fn contact_mm2(below: &TriMesh, above: &TriMesh, plane: &Plane) -> f64 {
    let [first, second] = [(below, 1.0), (above, -1.0)].map(|(mesh, sign)| {
        let flat = flat_triangles(mesh, plane, sign);
        let (u, w) = plane.basis();
        let frame = [u, w, plane.normal];
        let shadows = flat
            .iter()
            .filter_map(|corners| Shadow::new(&frame, corners));
        shadows.collect::<Vec<_>>()
    });
    let mut contact_mm2 = 0.0;
    visit_pairs(first, second, |a, b| {
        contact_mm2 += convex_mm2(&a.shared(b))
    });
    contact_mm2
}

/// Returns the area of a body's faces in a plane that look along its normal, mm².
pub fn face_mm2(mesh: &TriMesh, plane: &Plane) -> f64 {
    let flat = flat_triangles(mesh, plane, 1.0);
    flat.iter().map(crate::mesh::area_mm2).sum()
}

/// Returns the triangles in a plane whose normals point along its own, or against it.
fn flat_triangles(mesh: &TriMesh, plane: &Plane, sign: f64) -> Vec<[Point; 3]> {
    let is_flat = |corners: &[Point; 3]| {
        let [a, b, c] = corners;
        let is_near = corners
            .iter()
            .all(|p| plane.distance(p).abs() <= ON_PLANE_MM);
        is_near && sign * plane.normal.dot(&(b - a).cross(&(c - a))) > 0.0
    };
    mesh.iter_corners().filter(is_flat).collect()
}
