//! The open telescope against the curve that was asked for.

use super::motion::TelescopeMotion;
use crate::geom::Point;

/// Steps for each shell at which the centre line is compared.
const STEPS: usize = 20;

/// The distance at equal shares of the length: the greatest, and the root of the mean square, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Deviated {
    /// The greatest, mm.
    pub max_mm: f64,
    /// The root of the mean square, mm.
    pub rms_mm: f64,
}

/// Compares the centre line of the last key with the points of the curve, joined by lines.
pub(super) fn deviation(motion: &TelescopeMotion, asked: &[Point]) -> Option<Deviated> {
    let open = motion.keys.last()?;
    if asked.len() < 2 {
        return None;
    }
    let made = motion.centre_line(&open.states, STEPS);
    let count = made.len().checked_sub(1)?;
    let lengths = lengths(asked);
    let whole = *lengths.last()?;
    let squares = made.iter().enumerate().map(|(i, point)| {
        let on_curve = at(asked, &lengths, whole * i as f64 / count as f64);
        (point - on_curve).norm_squared()
    });
    let squares: Vec<f64> = squares.collect();
    let sum: f64 = squares.iter().sum();
    Some(Deviated {
        max_mm: squares.iter().copied().fold(0.0, f64::max).sqrt(),
        rms_mm: (sum / squares.len() as f64).sqrt(),
    })
}

fn lengths(points: &[Point]) -> Vec<f64> {
    let mut sum = 0.0;
    let steps = points.windows(2).map(|pair| {
        sum += (pair[1] - pair[0]).norm();
        sum
    });
    let mut lengths = vec![0.0];
    lengths.extend(steps);
    lengths
}

/// Returns the point at an arc length of a polyline.
fn at(points: &[Point], lengths: &[f64], arc_mm: f64) -> Point {
    let after = lengths.partition_point(|length| *length < arc_mm);
    let edge = after.clamp(1, points.len().max(2) - 1) - 1;
    let span = lengths[edge + 1] - lengths[edge];
    let share = if span > 0.0 {
        ((arc_mm - lengths[edge]) / span).clamp(0.0, 1.0)
    } else {
        0.0
    };
    points[edge] + (points[edge + 1] - points[edge]) * share
}

#[cfg(test)]
mod tests {
    use super::super::motion::{MotionKey, ShellMotion};
    use super::*;
    use crate::verify::Pose;

    #[test]
    fn a_straight_shell_beside_a_line_is_off_by_their_distance() {
        let motion = TelescopeMotion {
            schema: 1,
            root: Pose::identity(),
            shells: vec![ShellMotion {
                id: "S01".to_owned(),
                curvature: 0.0,
                torsion: 0.0,
                length_mm: 30.0,
                ends_mm: [-3.0, 33.0],
            }],
            joints: Vec::new(),
            order: Vec::new(),
            poses: Vec::new(),
            keys: vec![MotionKey {
                states: Vec::new(),
                placements: Vec::new(),
            }],
        };
        let line = [0.0, 10.0, 30.0].map(|x| Point::new(x, 0.25, 0.0));
        let found = deviation(&motion, &line).unwrap();
        assert!((found.max_mm - 0.25).abs() < 1e-12 && (found.rms_mm - 0.25).abs() < 1e-12);
        assert_eq!(deviation(&motion, &[]), None);
    }
}
