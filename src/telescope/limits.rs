//! Proofs that no telescope of some size follows a curve.

use std::f64::consts::FRAC_PI_2;

use super::sizes::JointSizes;
use crate::geom::{Point, Vector};

/// Chords into which a stretch is cut for the bound of a ball.
const CHORDS: usize = 64;

/// Stretches that are tried for the bound of a ball begin at this many places.
const PLACES: usize = 128;

/// Ratio of the lengths of stretches that are tried one after the other.
const GROWTH: f64 = 1.25;

/// A reason why no telescope can be as asked, with its figures. Each is a theorem.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Limit {
    /// The shells and their walls are thicker than the root may be.
    #[error(
        "{shells} shells need a root of {needed_mm:.1} mm in radius, which may be {root_mm:.1} mm; \
         {most} shells fit"
    )]
    Budget {
        /// Number of shells.
        shells: usize,
        /// The radius that they need, mm.
        needed_mm: f64,
        /// The radius there is, mm.
        root_mm: f64,
        /// The most shells that fit.
        most: usize,
    },
    /// Two strands of the curve are nearer than the tubes about them are thick.
    #[error(
        "the curve passes itself at {distance_mm:.1} mm, at {first_mm:.1} and {second_mm:.1} mm of \
         its length, where the tubes need {needed_mm:.1} mm"
    )]
    Strands {
        /// Arc length of the first place, mm.
        first_mm: f64,
        /// Arc length of the second place, mm.
        second_mm: f64,
        /// Their distance, mm.
        distance_mm: f64,
        /// The distance that the tubes need, mm.
        needed_mm: f64,
    },
    /// A stretch of the curve is longer than any tube can be in a ball.
    #[error(
        "from {from_mm:.1} to {to_mm:.1} mm the curve winds within {ball_mm:.1} mm, where a tube of \
         radius {body_mm:.1} mm has at most {most_mm:.1} mm of the {needed_mm:.1} mm it needs"
    )]
    Ball {
        /// Arc length at which the stretch begins, mm.
        from_mm: f64,
        /// Arc length at which it ends, mm.
        to_mm: f64,
        /// Radius of the ball that holds it, mm.
        ball_mm: f64,
        /// Radius of the tube, mm.
        body_mm: f64,
        /// The greatest length of the tube in there, mm.
        most_mm: f64,
        /// The least length that follows the stretch, mm.
        needed_mm: f64,
    },
}

/// Returns the limit of a root that is too thin for so many shells, if it is.
///
/// Shells of one shape need b + (n − 1) p; unlike ones need more. So the bound holds for all.
pub fn budget_limit(sizes: &JointSizes, shells: usize, tip_mm: f64, root_mm: f64) -> Option<Limit> {
    let steps = shells.saturating_sub(1) as f64;
    let needed_mm = tip_mm + steps * sizes.pitch_mm();
    let room = ((root_mm - tip_mm) / sizes.pitch_mm()).floor();
    let most = if room < 0.0 {
        0
    } else {
        (room as usize).saturating_add(1)
    };
    (needed_mm > root_mm).then_some(Limit::Budget {
        shells,
        needed_mm,
        root_mm,
        most,
    })
}

/// Returns the worst place at which tubes within `within_mm` of a curve must overlap, if there is
/// one.
///
/// The curve is given as samples at equal arcs of `step_mm`, with the radius of the tube at each.
/// Places less than π/2 of both radii apart along the curve may belong to one bend.
pub fn strands_limit(
    points: &[Point],
    radius_mm: &[f64],
    step_mm: f64,
    within_mm: f64,
) -> Option<Limit> {
    let mut worst: Option<(f64, Limit)> = None;
    for (j, (q, s)) in points.iter().zip(radius_mm).enumerate() {
        for (i, (p, r)) in points.iter().zip(radius_mm).enumerate().take(j) {
            let radii = r + s;
            let apart_mm = step_mm * (j - i) as f64 - 2.0 * within_mm;
            let short_mm = radii - 2.0 * within_mm - (p - q).norm();
            let is_worse = worst.is_none_or(|(worst_mm, _)| short_mm > worst_mm);
            if apart_mm > FRAC_PI_2 * radii && short_mm > 0.0 && is_worse {
                let limit = Limit::Strands {
                    first_mm: step_mm * i as f64,
                    second_mm: step_mm * j as f64,
                    distance_mm: (p - q).norm(),
                    needed_mm: radii - 2.0 * within_mm,
                };
                worst = Some((short_mm, limit));
            }
        }
    }
    worst.map(|(_, limit)| limit)
}

/// Returns a stretch of a curve that no tube of a radius follows within `within_mm`.
///
/// It is the one found that exceeds its bound most; `None` if none is found.
///
/// A curve of curvature at most K within a ball of radius r is at most 2r/(1 − Kr) long if Kr < 1.
/// For (x·T)' = 1 + κ x·N ≥ 1 − Kr. A tube of radius b has K = 1/b, turns about its tangent too.
/// It needs Σ max(0, |Δ| − 2ε) over the chords Δ of the stretch.
pub fn ball_limit(points: &[Point], step_mm: f64, body_mm: f64, within_mm: f64) -> Option<Limit> {
    let last = points.len().saturating_sub(1);
    let starts = (0..PLACES).map(|i| i * last / PLACES);
    let limits = starts.flat_map(|from| {
        let lengths = std::iter::successors(Some(4.0), |length| Some(length * GROWTH));
        let ends = lengths.map(move |length| from + length as usize);
        let ends = ends.take_while(move |to| *to < last).chain([last]);
        ends.filter_map(move |to| {
            let stretch = points.get(from..=to)?;
            excess_in_ball(
                stretch,
                step_mm * from as f64,
                step_mm,
                [body_mm, within_mm],
            )
        })
    });
    let worst = limits.max_by(|a, b| a.0.total_cmp(&b.0));
    worst.map(|(_, limit)| limit)
}

/// Returns by which factor a stretch exceeds the bound of the ball about it, with the limit.
fn excess_in_ball(
    stretch: &[Point],
    from_mm: f64,
    step_mm: f64,
    [body_mm, within_mm]: [f64; 2],
) -> Option<(f64, Limit)> {
    let sum: Vector = stretch.iter().map(|p| p.coords).sum();
    let centre = Point::from(sum / stretch.len() as f64);
    let reach = |p: &Point| (p - centre).norm();
    let ball_mm = stretch.iter().map(reach).fold(0.0, f64::max) + within_mm;
    if ball_mm >= body_mm {
        return None;
    }
    let most_mm = 2.0 * ball_mm / (1.0 - ball_mm / body_mm);
    let last = stretch.len() - 1;
    let corners: Vec<Point> = (0..=CHORDS).map(|i| stretch[i * last / CHORDS]).collect();
    let chord = |pair: &[Point]| ((pair[1] - pair[0]).norm() - 2.0 * within_mm).max(0.0);
    let needed_mm: f64 = corners.windows(2).map(chord).sum();
    let limit = Limit::Ball {
        from_mm,
        to_mm: from_mm + step_mm * last as f64,
        ball_mm,
        body_mm,
        most_mm,
        needed_mm,
    };
    (needed_mm > most_mm).then_some((needed_mm / most_mm, limit))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::curve::{Helix, NamedCurve};
    use std::f64::consts::{PI, TAU};

    fn circle(radius_mm: f64) -> Vec<Point> {
        let helix = Helix {
            curvature: 1.0 / radius_mm,
            torsion: 0.0,
        };
        let at = |i: u32| {
            helix
                .frame_at(TAU * radius_mm * f64::from(i) / 2000.0)
                .origin
        };
        (0..=2000).map(at).collect()
    }

    #[test]
    fn a_full_circle_is_impossible_below_the_share_of_the_theorem() {
        let (body, step) = (10.0, |radius: f64| TAU * radius / 2000.0);
        let limit = (1.0 - 1.0 / PI) * body;
        for radius in [0.5 * limit, 0.99 * limit] {
            let found = ball_limit(&circle(radius), step(radius), body, 0.0);
            assert!(matches!(found, Some(Limit::Ball { .. })), "{radius}");
        }
        for radius in [1.01 * limit, 2.0 * body] {
            assert_eq!(ball_limit(&circle(radius), step(radius), body, 0.0), None);
        }
    }

    #[test]
    fn an_arc_that_its_own_tube_follows_is_never_refused() {
        for text in ["arc:12,300", "helix:15,40,3", "helix:11,100,2"] {
            let curve: NamedCurve = text.parse().unwrap();
            let points = curve.points();
            let step = curve.length_mm() / (points.len() - 1) as f64;
            let body = 1.0 / curve.helix().curvature;
            assert_eq!(ball_limit(&points, step, body, 0.0), None, "{text}");
        }
    }

    #[test]
    fn strands_that_pass_too_near_are_found_with_their_places() {
        let curve: NamedCurve = "helix:30,12,2".parse().unwrap();
        let points: Vec<Point> = curve.points().into_iter().step_by(16).collect();
        let step = curve.length_mm() / (points.len() - 1) as f64;
        let radii = vec![7.0; points.len()];
        let Some(Limit::Strands {
            first_mm,
            second_mm,
            distance_mm,
            needed_mm,
        }) = strands_limit(&points, &radii, step, 0.5)
        else {
            panic!("the turns are 12 mm apart, the tubes 14 mm thick");
        };
        assert!((second_mm - first_mm - 0.5 * curve.length_mm()).abs() < 2.0 * step);
        assert!((distance_mm - 12.0).abs() < 0.1 && needed_mm == 13.0);
        assert_eq!(strands_limit(&points, &radii, step, 1.1), None);
    }

    #[test]
    fn a_root_too_thin_is_told_how_many_shells_fit() {
        let sizes = crate::telescope::tests::sizes();
        // A pitch of 2 mm about a tip of 4 mm.
        assert_eq!(budget_limit(&sizes, 6, 4.0, 14.1), None);
        let found = budget_limit(&sizes, 7, 4.0, 14.1);
        assert!(
            matches!(found, Some(Limit::Budget { most: 6, .. })),
            "{found:?}"
        );
        assert!(found.unwrap().to_string().contains("6 shells fit"));
    }
}
