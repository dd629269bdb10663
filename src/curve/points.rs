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

/// Edges over which a corner is spread by the smoothing: nine tenths of its turn lie within.
const CORNER_EDGES: usize = 6;

/// Least number of edges on which corners are looked for.
const LEAST_CORNER_EDGES: usize = 100;

/// Steps of heat flow over the samples before corners are looked for: noise of single points goes,
/// corners stay.
const CORNER_FLOW: f64 = 1.0;

/// Edges beyond which heat flow does not reach, for a step of one edge²: e⁻⁸ is left.
const FLOW_REACH: f64 = 8.0;

/// Step of heat flow that takes the noise of points away, edges²: some eight edges are averaged.
const NOISE_FLOW: f64 = 30.0;

/// Share of the length that smoothing takes of a curve without noise.
const CLEAN_RATIO: f64 = 1e-3;

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

    /// Returns the curve without the noise of its points, which makes it longer than it is.
    ///
    /// Noise over less than some of `edges` equal edges goes, bends over more of them stay. A curve
    /// that becomes shorter by less than 1e-3 has none, and comes back as it is.
    #[must_use]
    pub fn without_noise(&self, edges: usize) -> Self {
        let smoothed = smooth_twice(&self.samples(edges.max(1)), NOISE_FLOW);
        let smoothed = Self::of_polyline(smoothed).ok();
        let is_noisy = |s: &Self| s.length_mm() < (1.0 - CLEAN_RATIO) * self.length_mm();
        smoothed.filter(is_noisy).unwrap_or_else(|| self.clone())
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

    /// Refuses a curve with a corner on this many samples, and says where it is.
    pub fn refuse_corners(&self, edges: usize) -> Result<(), CurveError> {
        let Some(Corner {
            at_mm,
            turn_rad,
            point,
        }) = self.corner(edges)
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

    /// Returns the sharpest corner, or `None` if there is none.
    ///
    /// A corner turns by more than 60° within six of `edges` equal edges, after the noise of single
    /// samples is smoothed.
    pub fn corner(&self, edges: usize) -> Option<Corner> {
        let edges = edges.max(LEAST_CORNER_EDGES);
        let samples = smooth(&self.samples(edges), CORNER_FLOW);
        let step = self.length_mm() / edges as f64;
        let turns = samples
            .windows(CORNER_EDGES + 1)
            .enumerate()
            .map(|(i, p)| Corner {
                at_mm: step * (i + CORNER_EDGES / 2) as f64,
                turn_rad: turn(&(p[1] - p[0]), &(p[CORNER_EDGES] - p[CORNER_EDGES - 1])),
                point: p[CORNER_EDGES / 2],
            });
        let sharp = turns.filter(|corner| corner.turn_rad > CORNER_RAD);
        sharp.max_by(|a, b| a.turn_rad.total_cmp(&b.turn_rad))
    }
}

/// Returns points smoothed by heat flow: a step of `step` edges², with both ends where they were.
///
/// The curve goes on as its own image through each end, so a line stays a line.
pub(super) fn smooth(points: &[Point], step: f64) -> Vec<Point> {
    let reach = (FLOW_REACH * step.sqrt()).ceil() as usize;
    let margin = reach.min(points.len() - 1);
    let image = |end: &Point, p: &Point| end + (end - p);
    let (first, last) = (&points[0], &points[points.len() - 1]);
    let before = points[1..=margin].iter().rev().map(|p| image(first, p));
    let after = points
        .iter()
        .rev()
        .skip(1)
        .take(margin)
        .map(|p| image(last, p));
    let whole: Vec<Point> = before.chain(points.iter().copied()).chain(after).collect();
    let axis = |axis: usize| {
        let values: Vec<f64> = whole.iter().map(|p| p[axis]).collect();
        flow_heat(&values, step)
    };
    let [xs, ys, zs] = [axis(0), axis(1), axis(2)];
    let coordinates = xs.iter().zip(&ys).zip(&zs);
    let smoothed = coordinates.map(|((x, y), z)| Point::new(*x, *y, *z));
    smoothed.skip(margin).take(points.len()).collect()
}

/// Returns points smoothed without the shrinking of bends: what one step takes away is smoothed and
/// put back (Tukey's twicing).
fn smooth_twice(points: &[Point], step: f64) -> Vec<Point> {
    let once = smooth(points, step);
    let taken: Vec<Point> = points
        .iter()
        .zip(&once)
        .map(|(p, q)| Point::from(p - q))
        .collect();
    let back = smooth(&taken, step);
    once.iter()
        .zip(&back)
        .map(|(p, back)| p + back.coords)
        .collect()
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
        let corner = Curve::of_polyline(zigzag()).unwrap().corner(240).unwrap();
        assert!((corner.at_mm - 5.0).abs() < 0.1, "{corner:?}");
        assert!((corner.point - Point::new(3.0, 4.0, 0.0)).norm() < 0.2);
        let arc = (0..=90).map(|i| {
            let angle = f64::from(i).to_radians() * 4.0;
            Point::new(angle.cos(), angle.sin(), 0.0)
        });
        let arc = Curve::of_polyline(arc.collect()).unwrap();
        assert!(arc.refuse_corners(100).is_ok());
        let error = Curve::of_polyline(zigzag()).unwrap().refuse_corners(240);
        assert!(error.unwrap_err().to_string().contains("5.0 mm"));
    }
}
