//! Rest: the polygon that carries a model in a pose, and the tilt from which it rights itself.

use super::super::support;
use super::shape::Shape;
use crate::geom::hull::convex_hull;
use crate::geom::{Vector, orthonormal_basis};

/// The number of directions in which a model is tilted.
const WAYS: usize = 24;
/// Tilts by which a model may rock before it counts as moved, degrees: no cast foot is flat.
const ROCK_DEG: [f64; 3] = [0.0, 1.0, 2.0];
/// The tilts beyond, degrees.
const TILTS_DEG: [f64; 9] = [3.0, 4.0, 5.0, 7.0, 10.0, 14.0, 20.0, 28.0, 40.0];
/// Heights that differ by less than this part are equal up to rounding.
const ROUNDING_RATIO: f64 = 1e-9;

/// The polygon that carries a model.
#[derive(Debug, Clone, Copy)]
pub(super) struct Support {
    /// The angle at which the centre of mass stands over the nearest edge, degrees; negative if it
    /// lies outside.
    pub topples_at_deg: f64,
    /// The area of the polygon, mm².
    pub area_mm2: f64,
}

impl Support {
    /// Returns the support of a pose by the corners within `slack_mm` of the floor.
    pub fn of(shape: &Shape, up: &Vector, slack_mm: f64) -> Self {
        let floor_mm = floor_mm(shape, up);
        let (u, v) = orthonormal_basis(up);
        let low = shape.hull.iter().map(|corner| corner.coords);
        let low = low.filter(|corner| corner.dot(up) <= floor_mm + slack_mm);
        let hull = convex_hull(low.map(|corner| [corner.dot(&u), corner.dot(&v)]).collect());
        let center = shape.center.coords;
        let at = [center.dot(&u), center.dot(&v)];
        let inside =
            |(normal, offset): ([f64; 2], f64)| normal[0] * at[0] + normal[1] * at[1] - offset;
        let margin_mm = if hull.len() < 3 {
            let [x, y] = support::middle(&hull);
            -(x - at[0]).hypot(y - at[1])
        } else {
            let margins = support::edges(&hull).into_iter().map(inside);
            margins.fold(f64::INFINITY, f64::min)
        };
        Self {
            topples_at_deg: margin_mm.atan2(center.dot(up) - floor_mm).to_degrees(),
            area_mm2: support::area(&hull),
        }
    }
}

/// Returns the height of the lowest point in a pose, mm.
pub(super) fn floor_mm(shape: &Shape, up: &Vector) -> f64 {
    let heights = shape.hull.iter().map(|corner| corner.coords.dot(up));
    heights.fold(f64::INFINITY, f64::min)
}

/// Returns the tilt up to which a model rights itself in a pose, degrees; 0 if it falls over.
///
/// A body at rest is at a local minimum of the height of its centre of mass over the floor. The
/// source is Várkonyi and Domokos, "Static equilibria of rigid bodies", J. Nonlinear Sci. 16, 2006.
/// So it rights itself as long as that height grows with the tilt, whichever way it is tilted. The
/// answer is one of a few steps.
pub(super) fn rights_to_deg(shape: &Shape, up: &Vector) -> f64 {
    let (u, v) = orthonormal_basis(up);
    let mut climber = Climber { shape, at: 0 };
    let mut least_mm = |tilt_deg: f64| {
        let (sin, cos) = tilt_deg.to_radians().sin_cos();
        let ways = (0..WAYS).map(|way| {
            let (y, x) = (std::f64::consts::TAU * way as f64 / WAYS as f64).sin_cos();
            climber.height_mm(&((u * x + v * y) * sin - up * cos))
        });
        ways.fold(f64::INFINITY, f64::min)
    };
    let rocked = ROCK_DEG.into_iter().map(&mut least_mm);
    let mut last_mm = rocked.fold(f64::INFINITY, f64::min);
    let mut rights_to_deg = 0.0;
    for tilt_deg in TILTS_DEG {
        let here_mm = least_mm(tilt_deg);
        if here_mm <= last_mm * (1.0 + ROUNDING_RATIO) {
            break;
        }
        (last_mm, rights_to_deg) = (here_mm, tilt_deg);
    }
    rights_to_deg
}

/// A walk over the convex hull, from one lowest corner to the next.
struct Climber<'a> {
    shape: &'a Shape,
    at: usize,
}

impl Climber<'_> {
    /// Returns the height of the centre of mass over a floor below in this direction, mm.
    ///
    /// A corner of a convex body with no lower neighbour is the lowest. A walk that starts near it
    /// takes few steps.
    fn height_mm(&mut self, down: &Vector) -> f64 {
        let depth = |corner: usize| (self.shape.hull[corner] - self.shape.center).dot(down);
        let (mut at, mut here) = (self.at, depth(self.at));
        loop {
            let beside = self.shape.hull_beside[at].iter();
            let depths = beside.map(|&corner| [f64::from(corner), depth(corner as usize)]);
            let Some([next, there]) = depths.max_by(|a, b| a[1].total_cmp(&b[1])) else {
                break;
            };
            if there <= here {
                break;
            }
            (at, here) = (next as usize, there);
        }
        self.at = at;
        here
    }
}
