//! Points of a surface with the greatest balls that touch it there from inside.

use rayon::prelude::*;

use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, NO_HINT, Point, Vector};
use crate::mesh::{TriMesh, area_mm2, spread_points};

/// The distance between points, in walls, and the most points: more would take seconds.
const SPACING_WALLS: f64 = 0.6;
const MOST_POINTS: f64 = 60_000.0;
/// The radius of the largest balls, in walls: wide enough to reach a corner's other side.
const MOST_RADIUS_WALLS: f64 = 2.0;
/// The number of times that a ball is shrunk at most. It takes 3 to 8.
const MOST_SHRINKS: usize = 24;
/// A ball whose nearest surface is within this share of its radius touches it.
const TOUCHES_RATIO: f64 = 1e-3;

/// A point of a surface with its ball.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch {
    pub at: Point,
    pub normal: Vector,
    /// The diameter of the ball, mm: the thickness of the model there, at most four walls.
    pub width_mm: f64,
    /// The point at which the ball touches the surface on the other side; this point if it is too
    /// far.
    pub other_side: Point,
}

impl Touch {
    /// Returns the distance of a place from the ball, mm; zero inside.
    pub fn distance_mm(&self, at: &Point) -> f64 {
        let radius_mm = 0.5 * self.width_mm;
        let center = self.at - self.normal * radius_mm;
        ((at - center).norm() - radius_mm).max(0.0)
    }
}

/// The points of a surface, spread evenly.
pub(super) struct Touched {
    pub points: Vec<Touch>,
    /// The distance between neighbours, mm.
    pub spacing_mm: f64,
}

impl Touched {
    pub fn of(mesh: &TriMesh, wall_mm: f64, watch: &Watch) -> Result<Self, Cancelled> {
        let corners: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let area: f64 = corners.iter().map(area_mm2).sum();
        let spacing_mm = (SPACING_WALLS * wall_mm).max((area / MOST_POINTS).sqrt());
        let count = (area / spacing_mm.powi(2)).ceil() as usize;
        let spread = spread_points(&corners, count);
        let bvh = Bvh::new(corners.iter().copied());
        let most_mm = MOST_RADIUS_WALLS * wall_mm;
        let points = spread.into_par_iter().filter_map(|point| {
            let [a, b, c] = corners[point.triangle];
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            Some(
                watch
                    .check()
                    .map(|()| touch(&bvh, &point.at, &normal, most_mm)),
            )
        });
        Ok(Self {
            points: points.collect::<Result<_, _>>()?,
            spacing_mm,
        })
    }
}

/// Returns the greatest ball that touches the surface at a point from inside, at most as large as
/// the start.
fn touch(bvh: &Bvh, at: &Point, normal: &Vector, most_mm: f64) -> Touch {
    let (mut radius_mm, mut other_side) = (most_mm, *at);
    let mut hint = NO_HINT;
    for _ in 0..MOST_SHRINKS {
        let center = at - normal * radius_mm;
        let Some(nearest) = bvh.closest(&center, radius_mm * (1.0 - TOUCHES_RATIO), &[hint]) else {
            break;
        };
        let back = at - nearest.point;
        let depth_mm = back.dot(normal);
        let smaller_mm = back.norm_squared() / (2.0 * depth_mm);
        if depth_mm <= 0.0 || smaller_mm >= radius_mm {
            break;
        }
        (radius_mm, other_side, hint) = (smaller_mm, nearest.point, nearest.triangle);
    }
    Touch {
        at: *at,
        normal: *normal,
        width_mm: 2.0 * radius_mm,
        other_side,
    }
}
