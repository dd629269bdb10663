//! Balls that no seam may enter, and the test of it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::{
    base::words::{ChoiceError, parse_numbers},
    geom::{Parting, Plane, Point},
    mesh::TriMesh,
};

/// A ball that no seam on the outside may enter, such as a face.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct KeepClear {
    /// The centre in the model frame, mm.
    pub center_mm: [f64; 3],
    /// The radius, mm.
    pub radius_mm: f64,
}

impl KeepClear {
    /// Returns whether its numbers are finite and its radius is positive.
    pub fn is_sound(&self) -> bool {
        let is_finite = self.center_mm.iter().all(|number| number.is_finite());
        is_finite && self.radius_mm.is_finite() && self.radius_mm > 0.0
    }
}

impl fmt::Display for KeepClear {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let [x, y, z] = self.center_mm;
        write!(f, "{x},{y},{z},{}", self.radius_mm)
    }
}

impl FromStr for KeepClear {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        let read = |[x, y, z, radius_mm]: [f64; 4]| Self {
            center_mm: [x, y, z],
            radius_mm,
        };
        let ball = parse_numbers(text).map(read).filter(Self::is_sound);
        ball.ok_or_else(|| {
            let form = "X,Y,Z,R: a centre and a radius above zero, in mm";
            ChoiceError::unknown("ball to keep clear", text, &[form])
        })
    }
}

/// The balls of a request, each with the triangles of the outside that come near it.
#[derive(Debug)]
pub(crate) struct ClearBalls {
    balls: Vec<NearBall>,
}

#[derive(Debug)]
struct NearBall {
    ball: KeepClear,
    center: Point,
    radius_mm: f64,
    triangles: Vec<[Point; 3]>,
}

impl ClearBalls {
    /// Finds the triangles near each ball, whose radius is made larger by `margin_mm`.
    pub(crate) fn new(balls: &[KeepClear], outer: &TriMesh, margin_mm: f64) -> Self {
        let near = |ball: &KeepClear| {
            let (center, radius_mm) = (Point::from(ball.center_mm), ball.radius_mm + margin_mm);
            let is_near = |corners: &[Point; 3]| {
                (0..3).all(|i| {
                    let side = corners.map(|corner| corner[i] - center[i]);
                    let low = side.iter().copied().fold(f64::INFINITY, f64::min);
                    let high = side.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                    low < radius_mm && high > -radius_mm
                })
            };
            NearBall {
                ball: *ball,
                center,
                radius_mm,
                triangles: outer.iter_corners().filter(is_near).collect(),
            }
        };
        Self {
            balls: balls.iter().map(near).collect(),
        }
    }

    /// Returns the first ball that the seam of a plane enters; `None` if it keeps clear.
    pub(crate) fn entered(&self, plane: &Plane) -> Option<KeepClear> {
        let parting = Parting {
            plane: *plane,
            within: Vec::new(),
        };
        self.entered_within(&parting)
    }

    /// Returns the first ball that the seam of a cut enters within its limits. A stretch of seam
    /// that is cut by a limit counts if its middle lies within.
    pub(crate) fn entered_within(&self, parting: &Parting) -> Option<KeepClear> {
        let enters = |near: &&NearBall| near.is_entered(parting);
        self.balls.iter().find(enters).map(|near| near.ball)
    }
}

impl NearBall {
    fn is_entered(&self, parting: &Parting) -> bool {
        let plane = &parting.plane;
        if plane.distance(&self.center).abs() >= self.radius_mm {
            return false;
        }
        let stretches = self.triangles.iter();
        let stretches = stretches.filter_map(|corners| stretch(corners, plane));
        let holds = |at: &Point| {
            let mut sides = parting.within.iter();
            sides.all(|(limit, is_above)| (limit.distance(at) >= 0.0) == *is_above)
        };
        stretches
            .map(|[a, b]| nearest_on_segment(&self.center, &a, &b))
            .any(|near| (near - self.center).norm() < self.radius_mm && holds(&near))
    }
}

/// Returns the segment in which a plane meets a triangle; `None` if it misses it.
fn stretch(corners: &[Point; 3], plane: &Plane) -> Option<[Point; 2]> {
    let heights = corners.map(|corner| plane.distance(&corner));
    let meet = |i: usize| {
        let j = (i + 1) % 3;
        let crosses = (heights[i] >= 0.0) != (heights[j] >= 0.0);
        let along = heights[i] / (heights[i] - heights[j]);
        crosses.then(|| corners[i] + (corners[j] - corners[i]) * along)
    };
    let mut ends = (0..3).filter_map(meet);
    Some([ends.next()?, ends.next()?])
}

fn nearest_on_segment(to: &Point, a: &Point, b: &Point) -> Point {
    let along = b - a;
    let share = (to - a).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
    a + along * share.clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Vector;
    use crate::mesh::primitives::ball;

    fn level(z: f64) -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: z,
        }
    }

    #[test]
    fn a_seam_enters_a_ball_only_where_the_section_does() {
        let outer = ball(&Point::origin(), 10.0, 4);
        let nose = KeepClear {
            center_mm: [10.0, 0.0, 0.0],
            radius_mm: 3.0,
        };
        let middle = KeepClear {
            center_mm: [0.0; 3],
            radius_mm: 3.0,
        };
        let balls = ClearBalls::new(&[nose, middle], &outer, 0.0);
        assert_eq!(balls.entered(&level(1.0)), Some(nose));
        assert_eq!(balls.entered(&level(4.0)), None);
        // Its endless plane passes through the middle, but its seam lies 10 mm away from there.
        let upright = Plane {
            normal: Vector::x(),
            offset_mm: 0.5,
        };
        assert_eq!(balls.entered(&upright), None);
    }

    #[test]
    fn a_cut_limited_to_the_other_side_enters_no_ball() {
        let outer = ball(&Point::origin(), 10.0, 4);
        let nose = KeepClear {
            center_mm: [10.0, 0.0, 0.0],
            radius_mm: 3.0,
        };
        let balls = ClearBalls::new(&[nose], &outer, 0.0);
        let across = Plane {
            normal: Vector::x(),
            offset_mm: 0.0,
        };
        let parting = |is_above| Parting {
            plane: level(1.0),
            within: vec![(across, is_above)],
        };
        assert_eq!(balls.entered_within(&parting(true)), Some(nose));
        assert_eq!(balls.entered_within(&parting(false)), None);
    }

    #[test]
    fn a_ball_reads_as_it_prints_and_refuses_other_text() {
        let ball: KeepClear = "1, -2.5,3e1,4".parse().unwrap();
        assert_eq!(ball.to_string(), "1,-2.5,30,4");
        assert_eq!(ball.to_string().parse::<KeepClear>(), Ok(ball));
        for text in ["1,2,3", "1,2,3,0", "1,2,3,-4", "1,2,nan,4", "face"] {
            let error = text.parse::<KeepClear>().unwrap_err().to_string();
            assert!(error.contains("a centre and a radius"), "{error}");
        }
    }
}
