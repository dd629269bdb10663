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
/// The first step of a ball that moves inward, in walls, and the number of steps. Together they
/// reach the middle of a bar that is four walls thick.
const STEP_WALLS: f64 = 0.25;
const MOST_STEPS: usize = 12;
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
    /// The index of the triangle that the point lies on.
    pub triangle: usize,
    /// The distance from a ball as wide as the wall that lies inside nearby, mm; infinite if none
    /// was found. Zero if the point's own ball is as wide.
    pub bare_mm: f64,
}

impl Touch {
    /// Returns the middle of the ball.
    pub fn center(&self) -> Point {
        self.at - self.normal * (0.5 * self.width_mm)
    }

    /// Returns the distance of a place from the ball, mm; zero inside.
    pub fn distance_mm(&self, at: &Point) -> f64 {
        ((at - self.center()).norm() - 0.5 * self.width_mm).max(0.0)
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
        let bvh = Bvh::new(corners.iter().copied());
        Self::of_triangles(&corners, &bvh, [SPACING_WALLS * wall_mm, wall_mm], watch)
    }

    /// Spreads points over some triangles of a surface, this spacing apart for this wall, mm.
    pub fn of_triangles(
        corners: &[[Point; 3]],
        surface: &Bvh,
        [spacing_mm, wall_mm]: [f64; 2],
        watch: &Watch,
    ) -> Result<Self, Cancelled> {
        let area: f64 = corners.iter().map(area_mm2).sum();
        let spacing_mm = spacing_mm.max((area / MOST_POINTS).sqrt());
        let count = (area / spacing_mm.powi(2)).ceil() as usize;
        let most_mm = MOST_RADIUS_WALLS * wall_mm;
        let points = spread_points(corners, count);
        let points = points.into_par_iter().filter_map(|point| {
            let [a, b, c] = corners[point.triangle];
            let normal = (b - a).cross(&(c - a)).try_normalize(0.0)?;
            let touch = || Touch {
                triangle: point.triangle,
                ..touch(surface, &point.at, &normal, most_mm)
            };
            let touch = || cover(surface, touch(), wall_mm);
            Some(watch.check().map(|()| touch()))
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
        triangle: 0,
        bare_mm: 0.0,
    }
}

/// Finds a ball as wide as the wall near a narrow one, by moving its middle away from the surface.
///
/// Balls that touch a facet are narrow near its edges, though the body is not.
fn cover(bvh: &Bvh, touch: Touch, wall_mm: f64) -> Touch {
    if touch.width_mm >= wall_mm {
        return touch;
    }
    let mut center = touch.center();
    let mut step_mm = STEP_WALLS * wall_mm;
    let nearest = |center: &Point| bvh.closest(center, wall_mm, &[NO_HINT]);
    let mut near = nearest(&center);
    for _ in 0..MOST_STEPS {
        let Some(known) = near else { break };
        let away = center - known.point;
        let radius_mm = away.norm();
        let next = center + away * (step_mm / radius_mm.max(f64::MIN_POSITIVE));
        let found = nearest(&next);
        if found.is_none_or(|found| (found.point - next).norm() > radius_mm) {
            (center, near) = (next, found);
        } else {
            step_mm *= 0.5;
        }
    }
    let radius_mm = near.map_or(wall_mm, |near| (near.point - center).norm());
    let bare_mm = if 2.0 * radius_mm < wall_mm {
        f64::INFINITY
    } else {
        ((touch.at - center).norm() - radius_mm).max(0.0)
    };
    Touch { bare_mm, ..touch }
}
