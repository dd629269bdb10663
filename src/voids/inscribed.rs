//! Tests whether a ball of a given radius fits into a body.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::octree::CIRCUMRADIUS;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, NO_HINT, Point, Vector};
use crate::mesh::TriMesh;

/// Half side of a cell, as a share of the radius, below which the search gives the cell up. A
/// smaller share costs time with its square, on sheets that are just too thin.
const GIVE_UP_RATIO: f64 = 0.1;

/// A cube that may hold the centre of the ball.
struct Candidate {
    center: Point,
    half_mm: f64,
    /// Upper bound of the depth inside the body over the cube, mm.
    bound_mm: f64,
    hint: u32,
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound_mm.total_cmp(&other.bound_mm)
    }
}

/// Returns whether a ball of `radius_mm` fits into the body bounded by a closed mesh.
///
/// Branch and bound over the distance to the surface. A ball that fits with less than a sixth of
/// its radius to spare may be missed.
pub(super) fn ball_fits(mesh: &TriMesh, radius_mm: f64, watch: &Watch) -> Result<bool, Cancelled> {
    let size = mesh.aabb().size();
    if size.min() < 2.0 * radius_mm {
        return Ok(false);
    }
    let bvh = Bvh::new(mesh.iter_corners());
    let mut heap = BinaryHeap::new();
    let (root, depth_mm) = measure_cell(&bvh, mesh.aabb().center(), size.max() / 2.0, NO_HINT);
    if depth_mm >= radius_mm {
        return Ok(true);
    }
    heap.extend(root);
    while let Some(cell) = heap.pop() {
        watch.check()?;
        if cell.bound_mm < radius_mm {
            return Ok(false);
        }
        if cell.half_mm < GIVE_UP_RATIO * radius_mm {
            continue;
        }
        for i in 0..8 {
            let sign = |axis: i32| if i >> axis & 1 == 1 { 0.5 } else { -0.5 };
            let center = cell.center + Vector::new(sign(0), sign(1), sign(2)) * cell.half_mm;
            let (child, depth_mm) = measure_cell(&bvh, center, cell.half_mm / 2.0, cell.hint);
            if depth_mm >= radius_mm {
                return Ok(true);
            }
            heap.extend(child.filter(|child| child.bound_mm >= radius_mm));
        }
    }
    Ok(false)
}

/// Returns a cell with its bound, and the depth of its centre inside the body, mm.
fn measure_cell(bvh: &Bvh, center: Point, half_mm: f64, hint: u32) -> (Option<Candidate>, f64) {
    let Some(nearest) = bvh.closest(&center, f64::INFINITY, &[hint]) else {
        return (None, f64::NEG_INFINITY);
    };
    let side = if bvh.winding(&center) > 0 { 1.0 } else { -1.0 };
    let depth_mm = side * nearest.distance_squared.sqrt();
    let bound_mm = depth_mm + 2.0 * half_mm * CIRCUMRADIUS;
    (
        Some(Candidate {
            center,
            half_mm,
            bound_mm,
            hint: nearest.hint,
        }),
        depth_mm,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voids::shapes::{ball, block};

    fn ball_fits(mesh: &TriMesh, radius_mm: f64) -> bool {
        super::ball_fits(mesh, radius_mm, &Watch::silent()).unwrap()
    }

    #[test]
    fn a_ball_fits_into_a_plate_thicker_than_itself_only() {
        let plate = block([0.0; 3], [20.0, 15.0, 2.0]);
        assert!(ball_fits(&plate, 0.85));
        assert!(!ball_fits(&plate, 1.01));
    }

    #[test]
    fn a_ball_fits_into_a_larger_ball_only() {
        let body = ball(Point::new(1.0, 2.0, 3.0), 5.0, 5);
        assert!(ball_fits(&body, 4.5));
        assert!(!ball_fits(&body, 5.01));
    }

    #[test]
    fn nothing_fits_into_nothing() {
        assert!(!ball_fits(&TriMesh::default(), 1.0));
    }
}
