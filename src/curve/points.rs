//! A curve given as points: checked once, then sampled by arc length.

use super::error::CurveError;
use super::heat::flow_heat;
use super::spline;
use crate::geom::{Point, Vector};

/// The most points of a curve that are taken. A printed curve needs some thousand.
pub const MOST_POINTS: usize = 2_000_000;

/// The least number of points: three make a plane.
const LEAST_POINTS: usize = 3;

/// The greatest turn within one spacing of samples that is no corner, rad: 60°.
const CORNER_RAD: f64 = std::f64::consts::FRAC_PI_3;

/// Edges of the samples on which corners are looked for.
const CORNER_EDGES: usize = 200;

/// Steps of heat flow over the samples before corners are looked for: noise of single points goes,
/// corners stay.
const CORNER_FLOW: f64 = 1.0;

/// A polyline of three points or more, all finite, none the same as the one before it.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    points: Vec<Point>,
    /// Arc length from the start to each point, mm.
    arc_mm: Vec<f64>,
}

/// A place where a curve turns by more than 60° within one spacing of its samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corner {
    /// Arc length from the start, mm.
    pub at_mm: f64,
    /// The turn, rad.
    pub turn_rad: f64,
    /// The place.
    pub point: Point,
}

impl Curve {
    /// Checks points (mm) and takes them as a polyline.
    pub fn of_polyline(points: Vec<Point>) -> Result<Self, CurveError> {
        check(&points)?;
        let mut arc_mm = vec![0.0];
        let mut total = 0.0;
        for pair in points.windows(2) {
            total += (pair[1] - pair[0]).norm();
            arc_mm.push(total);
        }
        Ok(Self { points, arc_mm })
    }

    /// Checks points (mm) and lays a centripetal Catmull–Rom spline through them. No loop or cusp
    /// arises within an edge (Yuksel, Schaefer and Keyser, "On the Parameterization of
    /// Catmull-Rom Curves", 2009).
    pub fn through(points: &[Point]) -> Result<Self, CurveError> {
        check(points)?;
        Self::of_polyline(spline::through(points))
    }

    /// Returns the points, mm.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Returns the length, mm.
    pub fn length_mm(&self) -> f64 {
        self.arc_mm.last().copied().unwrap_or_default()
    }

    /// Returns the point at an arc length from the start, mm; the ends beyond them.
    pub fn at(&self, arc_mm: f64) -> Point {
        let after = self.arc_mm.partition_point(|arc| *arc <= arc_mm);
        let edge = after.clamp(1, self.points.len() - 1) - 1;
        let span = self.arc_mm[edge + 1] - self.arc_mm[edge];
        let share = ((arc_mm - self.arc_mm[edge]) / span).clamp(0.0, 1.0);
        self.points[edge] + (self.points[edge + 1] - self.points[edge]) * share
    }

    /// Returns points at equal shares of the length, the ends among them: one more than `edges`.
    pub fn samples(&self, edges: usize) -> Vec<Point> {
        let step = self.length_mm() / edges.max(1) as f64;
        (0..=edges.max(1))
            .map(|i| self.at(step * i as f64))
            .collect()
    }

    /// Returns the curve with its length scaled to `length_mm`, about the model's origin.
    #[must_use]
    pub fn scaled_to(&self, length_mm: f64) -> Self {
        let factor = length_mm / self.length_mm();
        Self {
            points: self.points.iter().map(|p| p * factor).collect(),
            arc_mm: self.arc_mm.iter().map(|arc| arc * factor).collect(),
        }
    }

    /// Refuses a curve with a corner, and says where it is.
    pub fn refuse_corners(&self) -> Result<(), CurveError> {
        let Some(Corner {
            at_mm,
            turn_rad,
            point,
        }) = self.corner()
        else {
            return Ok(());
        };
        Err(CurveError::Corner {
            at_mm,
            turn_deg: turn_rad.to_degrees(),
            x: point.x,
            y: point.y,
            z: point.z,
        })
    }

    /// Returns the sharpest corner: a turn of more than 60° within 1/200 of the length, after the
    /// noise of single samples is smoothed. `None` if there is none.
    pub fn corner(&self) -> Option<Corner> {
        let samples = smooth(&self.samples(CORNER_EDGES), CORNER_FLOW);
        let step = self.length_mm() / CORNER_EDGES as f64;
        // A sharp turn is spread over the edges next to it by the smoothing.
        let turns = samples.windows(4).enumerate().map(|(i, p)| Corner {
            at_mm: step * (i as f64 + 1.5),
            turn_rad: turn(&(p[1] - p[0]), &(p[3] - p[2])),
            point: nalgebra::center(&p[1], &p[2]),
        });
        let sharp = turns.filter(|corner| corner.turn_rad > CORNER_RAD);
        sharp.max_by(|a, b| a.turn_rad.total_cmp(&b.turn_rad))
    }
}

/// Returns points smoothed by heat flow: a step of `step` edges², with the two ends where they
/// were.
pub(super) fn smooth(points: &[Point], step: f64) -> Vec<Point> {
    let axis = |axis: usize| {
        let values: Vec<f64> = points.iter().map(|p| p[axis]).collect();
        flow_heat(&values, step)
    };
    let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
    let coordinates = xs.iter().zip(&ys).zip(&zs);
    let mut smoothed: Vec<Point> = coordinates
        .map(|((x, y), z)| Point::new(*x, *y, *z))
        .collect();
    if let [.., last] = points {
        smoothed[0] = points[0];
        smoothed[points.len() - 1] = *last;
    }
    smoothed
}

/// Returns the angle between two directions, rad.
fn turn(a: &Vector, b: &Vector) -> f64 {
    a.cross(b).norm().atan2(a.dot(b))
}

/// Refuses points that are no curve.
fn check(points: &[Point]) -> Result<(), CurveError> {
    let count = points.len();
    if count < LEAST_POINTS {
        return Err(CurveError::TooFewPoints { points: count });
    }
    if count > MOST_POINTS {
        return Err(CurveError::TooManyPoints {
            points: count,
            most: MOST_POINTS,
        });
    }
    let is_finite = |p: &Point| p.iter().all(|x| x.is_finite());
    if let Some(at) = points.iter().position(|p| !is_finite(p)) {
        return Err(CurveError::NotFinite { point: at + 1 });
    }
    let is_repeated = |pair: &[Point]| (pair[1] - pair[0]).norm() <= f64::MIN_POSITIVE;
    match points.windows(2).position(is_repeated) {
        Some(at) => Err(CurveError::Repeated { point: at + 2 }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn zigzag() -> Vec<Point> {
        vec![
            Point::new(0.0, 0.0, 0.0),
            Point::new(3.0, 4.0, 0.0),
            Point::new(3.0, 4.0, 5.0),
        ]
    }

    #[test]
    fn samples_lie_at_equal_shares_of_the_length() {
        let curve = Curve::of_polyline(zigzag()).unwrap();
        assert_eq!(curve.length_mm(), 10.0);
        assert_eq!(curve.at(-1.0), Point::origin());
        assert_eq!(curve.at(99.0), Point::new(3.0, 4.0, 5.0));
        let samples = curve.samples(4);
        assert_eq!(samples.len(), 5);
        assert!((samples[1] - Point::new(1.5, 2.0, 0.0)).norm() < 1e-15);
        assert!((samples[3] - Point::new(3.0, 4.0, 2.5)).norm() < 1e-15);
        assert!((curve.scaled_to(5.0).at(2.5) - Point::new(1.5, 2.0, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn points_that_are_no_curve_are_refused_with_their_place() {
        let refused = |points: Vec<Point>| Curve::of_polyline(points).unwrap_err();
        assert_eq!(refused(vec![]), CurveError::TooFewPoints { points: 0 });
        assert_eq!(
            refused(zigzag()[..2].to_vec()),
            CurveError::TooFewPoints { points: 2 }
        );
        let mut bad = zigzag();
        bad[2].y = f64::NAN;
        assert_eq!(refused(bad), CurveError::NotFinite { point: 3 });
        let mut twice = zigzag();
        twice[2] = twice[1];
        assert_eq!(refused(twice.clone()), CurveError::Repeated { point: 3 });
        assert!(Curve::through(&twice).is_err());
    }

    #[test]
    fn a_corner_is_found_where_it_is_and_an_arc_has_none() {
        let corner = Curve::of_polyline(zigzag()).unwrap().corner().unwrap();
        assert!((corner.at_mm - 5.0).abs() < 0.1, "{corner:?}");
        assert!((corner.point - Point::new(3.0, 4.0, 0.0)).norm() < 0.2);
        let arc = (0..=90).map(|i| {
            let angle = f64::from(i).to_radians() * 4.0;
            Point::new(angle.cos(), angle.sin(), 0.0)
        });
        let arc = Curve::of_polyline(arc.collect()).unwrap();
        assert!(arc.refuse_corners().is_ok());
        let error = Curve::of_polyline(zigzag()).unwrap().refuse_corners();
        assert!(error.unwrap_err().to_string().contains("5.0 mm"));
    }
}
