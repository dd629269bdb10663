//! Surfaces that lie over each other: bodies that touch, and bodies that bar the way.

use crate::geom::{Plane, Point, Vector, hull, orthonormal_basis};
use crate::mesh::TriMesh;

/// Distance of a corner from a plane up to which it lies on it, mm. Caps are flat to 1e-13 mm.
const ON_PLANE_MM: f64 = 1e-7;
/// Cosine up to which a triangle is upright: rounding tilts those along a cut by far less.
const UPRIGHT_COSINE: f64 = 1e-9;
/// Depth up to which surfaces that touch count as in contact, mm.
const TOUCH_MM: f64 = 1e-6;

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

/// Calls `see` with every pair of shadows whose ranges along the first coordinate meet.
fn visit_pairs(first: &mut [Shadow], second: &mut [Shadow], mut see: impl FnMut(&Shadow, &Shadow)) {
    for shadows in [&mut *first, &mut *second] {
        shadows.sort_by(|a, b| a.low[0].total_cmp(&b.low[0]));
    }
    let widest = |shadows: &[Shadow]| {
        let widths = shadows.iter().map(|shadow| shadow.high[0] - shadow.low[0]);
        widths.fold(0.0, f64::max)
    };
    let reach = widest(second);
    for shadow in &*first {
        let start = second.partition_point(|other| other.low[0] < shadow.low[0] - reach);
        let near = second[start..].iter();
        let near = near.take_while(|other| other.low[0] <= shadow.high[0]);
        near.for_each(|other| see(shadow, other));
    }
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
    visit_pairs(
        &mut facing(moving, 1.0),
        &mut facing(fixed, -1.0),
        |ahead, back| {
            let ring = ahead.shared(back);
            if ring.len() > 2 {
                let middle =
                    [0, 1].map(|k| ring.iter().map(|at| at[k]).sum::<f64>() / ring.len() as f64);
                if back.height_at(middle) >= ahead.height_at(middle) - TOUCH_MM {
                    barred_mm2 += convex_mm2(&ring);
                }
            }
        },
    );
    barred_mm2
}

/// Returns the area in which two bodies touch in a plane, mm²: the first one below it, the second
/// one above.
pub fn contact_mm2(below: &TriMesh, above: &TriMesh, plane: &Plane) -> f64 {
    let mut shadows = [(below, 1.0), (above, -1.0)].map(|(mesh, sign)| {
        let flat = flat_triangles(mesh, plane, sign);
        let (u, w) = plane.basis();
        let frame = [u, w, plane.normal];
        let shadows = flat
            .iter()
            .filter_map(|corners| Shadow::new(&frame, corners));
        shadows.collect::<Vec<_>>()
    });
    let mut contact_mm2 = 0.0;
    let [first, second] = &mut shadows;
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn block(low: [f64; 3], high: [f64; 3]) -> TriMesh {
        cuboid(&low.into(), &high.into())
    }

    #[test]
    fn a_block_is_barred_by_what_hangs_over_it_and_not_by_what_lies_below_or_beside() {
        let moving = block([0.0; 3], [4.0, 4.0, 1.0]);
        let over = block([3.0, 1.0, 5.0], [9.0, 3.0, 6.0]);
        let up = Vector::z();
        assert!((barred_mm2(&moving, &over, &up) - 2.0).abs() < 1e-12);
        assert_eq!(barred_mm2(&over, &moving, &up), 0.0);
        assert!((barred_mm2(&over, &moving, &-up) - 2.0).abs() < 1e-12);
        let beside = block([4.0, 0.0, -3.0], [6.0, 4.0, 9.0]);
        assert_eq!(barred_mm2(&moving, &beside, &up), 0.0);
        // Face on face: it cannot move at all.
        let on_it = block([0.0, 0.0, 1.0], [4.0, 4.0, 2.0]);
        assert!((barred_mm2(&moving, &on_it, &up) - 16.0).abs() < 1e-12);
    }

    #[test]
    fn a_round_body_is_barred_by_its_whole_shadow() {
        let round = ball(&Point::origin(), 2.0, 3);
        let roof = block([-9.0, -9.0, 7.0], [9.0, 9.0, 8.0]);
        let way = Vector::new(0.1, -0.2, 1.0).normalize();
        let barred = barred_mm2(&round, &roof, &way);
        let disc = std::f64::consts::PI * 4.0;
        assert!(barred < disc && barred > 0.97 * disc, "{barred}");
    }

    #[test]
    fn bodies_touch_in_what_their_faces_share() {
        let lower = block([0.0; 3], [4.0, 4.0, 1.0]);
        let upper = block([1.0, 2.0, 1.0], [6.0, 6.0, 2.0]);
        let plane = Plane {
            normal: Vector::z(),
            offset_mm: 1.0,
        };
        assert!((contact_mm2(&lower, &upper, &plane) - 6.0).abs() < 1e-12);
        assert_eq!(contact_mm2(&upper, &lower, &plane), 0.0);
        assert!((face_mm2(&lower, &plane) - 16.0).abs() < 1e-12);
    }
}
