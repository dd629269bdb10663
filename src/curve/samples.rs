//! The curves on which fits are tried.

use std::f64::consts::{PI, TAU};

use super::points::Curve;
use super::{DiscreteFrames, Helix};
use crate::geom::{Frame, Point};

/// Edges of each curve.
const EDGES: u32 = 3000;

fn sampled(from: f64, to: f64, at: impl Fn(f64) -> [f64; 3]) -> Curve {
    let share = |i: u32| f64::from(i) / f64::from(EDGES);
    let point = |i: u32| Point::from(at(from + (to - from) * share(i)));
    Curve::of_polyline((0..=EDGES).map(point).collect()).unwrap()
}

/// A trefoil knot with a gap.
pub fn trefoil() -> Curve {
    sampled(0.25, TAU - 0.25, |t| {
        [
            t.sin() + 2.0 * (2.0 * t).sin(),
            t.cos() - 2.0 * (2.0 * t).cos(),
            -(3.0 * t).sin(),
        ]
    })
}

/// Viviani's curve, on a sphere and a cylinder.
pub fn viviani() -> Curve {
    sampled(-0.95 * PI, 0.95 * PI, |t| {
        [1.0 + t.cos(), t.sin(), 2.0 * (0.5 * t).sin()]
    })
}

/// A period of the sine.
pub fn sine() -> Curve {
    sampled(0.0, TAU, |t| [t, t.sin(), 0.0])
}

/// A clothoid of 300 mm whose curvature rises from 0 to 0.03/mm.
pub fn clothoid() -> Curve {
    of_measures(|share| Helix {
        curvature: 0.03 * share,
        torsion: 0.0,
    })
}

/// A curve of 300 mm of one curvature, whose torsion swings.
pub fn constant_curvature() -> Curve {
    of_measures(|share| Helix {
        curvature: 0.02,
        torsion: 0.03 * (4.0 * PI * share).sin(),
    })
}

/// Returns the curve of 300 mm with this curvature and torsion at shares of its length.
fn of_measures(helix: impl Fn(f64) -> Helix) -> Curve {
    let step_mm = 300.0 / f64::from(EDGES);
    let mut frame = Frame::identity();
    let mut points = vec![frame.origin];
    for i in 0..EDGES {
        let piece = helix((f64::from(i) + 0.5) / f64::from(EDGES));
        frame = frame.frame_to_model(&piece.frame_at(step_mm));
        points.push(frame.origin);
    }
    Curve::of_polyline(points).unwrap()
}

#[test]
fn the_measures_of_a_sample_are_those_it_was_made_of() {
    let frames = DiscreteFrames::of(constant_curvature().points());
    assert!(frames.curvature().iter().all(|k| (k - 0.02).abs() < 1e-5));
}
