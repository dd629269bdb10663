//! The nearest step that makes a goal possible: along a ray to the border of the possible, then
//! along the border by its tangents.

use rayon::prelude::*;

use super::confirm::least_excess;
use super::directions::{round_direction, round_to};
use super::moves::{Moves, Part};
use super::sampled_model::{SampledModel, Trial};
use crate::geom::Vector;
use crate::goal::Request;

/// The places along a ray that are tried for the first possible one, as parts of the longest step.
const MARCH: [f64; 8] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0];
/// The relative precision of the border along a ray.
const PRECISION_RATIO: f64 = 0.01;
/// The absolute precision of the border, as a part of the longest step: 0.2° of tilt.
const PRECISION_OF_LIMIT: f64 = 1e-3;
/// The greatest number of tangents that are followed; two or three usually suffice.
const MOST_TANGENTS: usize = 5;
/// A tangent that shortens the step by less than this part ends the search.
const WORTHWHILE_RATIO: f64 = 0.99;
/// The step of the finite differences of the proof, as a part of the longest step. It is small
/// against any advised step and large against rounding.
const PROBE_OF_LIMIT: f64 = 1e-4;
/// The decimals of a printed point, in mm. With three, the rounding of its height already counts as
/// a gap to the model.
const POINT_DECIMALS: i32 = 4;

/// An interval of a ray that the border of the possible crosses.
#[derive(Debug, Clone, Copy)]
struct Border {
    towards: Vector,
    impossible: f64,
    possible: f64,
}

/// A step, the printed request it leads to, and the solve that confirm it.
#[derive(Debug, Clone)]
pub(super) struct Nearest {
    pub step: Vector,
    pub request: Request,
    pub trial: Trial,
}

/// Returns the shortest step found that makes the goal possible. `None` if no ray meets a possible
/// place.
///
/// Let φ(u) be the value of the proof of impossibility at a step u; the goal is possible where φ ≤
/// 0. The shortest such step points along −∇φ at its end (Karush, Kuhn and Tucker). The proof is
/// the minimum over interiors of the integral of a quadric. By the envelope theorem the minimising
/// interior may stay fixed while the frame moves. So ∇φ costs no solve: the same moments are seen
/// from slightly moved frames.
///
/// The border is bisected on the first rays. They lead down the slope, towards the places where the
/// solid itself is best, and towards the nearest possible one of many places. Then each tangent of
/// the border gives the ray to its foot, until the step no longer shortens. The result is a local
/// minimum, not proved to be the global one.
pub(super) fn find_nearest(model: &SampledModel, moves: &Moves) -> Option<Nearest> {
    let search = Search { model, moves };
    let near = search.nearest_border();
    let first = search
        .far_border(near.map_or(f64::INFINITY, |border| border.possible))
        .or(near)?;
    search.confirm(&search.follow_tangents(first))
}

struct Search<'a> {
    model: &'a SampledModel<'a>,
    moves: &'a Moves,
}

impl Search<'_> {
    fn trial(&self, step: &Vector) -> Option<Trial> {
        self.model
            .trial(&self.moves.request(step), self.model.case.wall_mm)
    }

    fn allows(&self, step: &Vector) -> bool {
        self.trial(step)
            .is_some_and(|trial| trial.is_possible() && trial.meets_the_model())
    }

    /// Returns the nearest border on the rays to the seeds.
    fn nearest_border(&self) -> Option<Border> {
        let mut best: Option<Border> = None;
        for seed in self.seeds() {
            let limit = best.map_or(self.moves.limit, |border| border.possible);
            best = self.first_border(&seed, limit).or(best);
        }
        best
    }

    /// Returns the border on the ray to the first far place that is possible and nearer than
    /// `limit`.
    fn far_border(&self, limit: f64) -> Option<Border> {
        let nearer: Vec<&Vector> = self
            .moves
            .far
            .iter()
            .filter(|step| step.norm() < limit)
            .collect();
        let place = nearer
            .into_par_iter()
            .find_first(|step| self.allows(step))?;
        let (towards, possible) = (place.try_normalize(0.0)?, place.norm());
        Some(self.bisect(Border {
            towards,
            impossible: 0.0,
            possible,
        }))
    }

    /// Returns the seeds of the search: the known places, then a step down the slope of the proof.
    fn seeds(&self) -> Vec<Vector> {
        let down = self
            .descent_direction(&Vector::zeros())
            .map(|direction| direction * self.moves.limit);
        let known = self
            .moves
            .seeds
            .iter()
            .copied()
            .filter(|seed| seed.norm() > 0.0);
        known.chain(down).collect()
    }

    /// Returns the direction in which the proof of impossibility at a step decreases fastest.
    /// `None` if there is no proof.
    fn descent_direction(&self, step: &Vector) -> Option<Vector> {
        let trial = self
            .trial(step)
            .filter(|trial| trial.solution.status.is_impossible())?;
        let here = trial.placement.goal.frame;
        let moments = trial.solution.moments.from_frame(&here);
        let proof = |step: &Vector| {
            let moved = self
                .model
                .place(&self.moves.request(step), self.model.case.wall_mm)?;
            let seen = moments.in_frame(&moved.goal.frame);
            Some(
                trial
                    .solution
                    .quadric
                    .0
                    .iter()
                    .zip(seen.0)
                    .map(|(g, s)| g * s)
                    .sum::<f64>(),
            )
        };
        let probe = PROBE_OF_LIMIT * self.moves.limit;
        let mut slope = Vector::zeros();
        for axis in 0..self.moves.dimension() {
            let aside = Vector::ith(axis, probe);
            slope[axis] = proof(&(step + aside))? - proof(&(step - aside))?;
        }
        (slope.norm() > 0.0).then(|| -slope.normalize())
    }

    /// Returns the first border along the ray to a seed, no further than `limit`.
    fn first_border(&self, seed: &Vector, limit: f64) -> Option<Border> {
        let (towards, distance) = (seed.normalize(), seed.norm());
        let mut places: Vec<f64> = MARCH.iter().map(|part| part * self.moves.limit).collect();
        places.push(distance);
        places.sort_by(f64::total_cmp);
        let mut impossible = 0.0;
        for possible in places.into_iter().filter(|&place| place <= limit) {
            if self.allows(&(towards * possible)) {
                return Some(self.bisect(Border {
                    towards,
                    impossible,
                    possible,
                }));
            }
            impossible = possible;
        }
        None
    }

    fn bisect(&self, mut border: Border) -> Border {
        let precision = |border: &Border| {
            (PRECISION_RATIO * border.possible).max(PRECISION_OF_LIMIT * self.moves.limit)
        };
        while border.possible - border.impossible > precision(&border) {
            let middle = 0.5 * (border.possible + border.impossible);
            if self.allows(&(border.towards * middle)) {
                border.possible = middle;
            } else {
                border.impossible = middle;
            }
        }
        border
    }

    /// Follows the border from tangent to tangent, as long as the step shortens.
    fn follow_tangents(&self, mut border: Border) -> Border {
        for _ in 0..MOST_TANGENTS {
            let Some(down) = self.descent_direction(&(border.towards * border.impossible)) else {
                break;
            };
            let halfway = (down + border.towards).try_normalize(PROBE_OF_LIMIT);
            let ways = std::iter::once(down).chain(halfway);
            let shorter = ways
                .into_iter()
                .find_map(|towards| self.shorter(border, &towards));
            let Some(shorter) = shorter else { break };
            border = shorter;
        }
        border
    }

    /// Returns the border along another direction, if it is nearer by enough.
    fn shorter(&self, border: Border, towards: &Vector) -> Option<Border> {
        let possible = WORTHWHILE_RATIO * border.possible;
        let turned = Border {
            towards: *towards,
            impossible: 0.0,
            possible,
        };
        self.allows(&(towards * possible))
            .then(|| self.bisect(turned))
    }

    /// Confirms the step as it is printed, longer if the exact columns ask for it.
    fn confirm(&self, border: &Border) -> Option<Nearest> {
        least_excess(|excess| {
            let length = (border.possible * (1.0 + excess)).min(self.moves.limit);
            let step = border.towards * length;
            let request = round_as_printed(self.moves.part, self.moves.request(&step));
            let trial = self.model.confirm(&request, self.model.case.wall_mm)?;
            trial.meets_the_model().then_some(Nearest {
                step,
                request,
                trial,
            })
        })
    }
}

/// Rounds the moved point or direction of a request to the decimals it is printed with.
fn round_as_printed(part: Part, request: Request) -> Request {
    use crate::goal::{Contact, SpinPoint, Up};
    match (part, request) {
        (
            Part::Contact,
            Request {
                contact: Some(Contact::At(at)),
                ..
            },
        ) => Request {
            contact: Some(Contact::At(round_to(at, POINT_DECIMALS))),
            ..request
        },
        (
            Part::SpinPoint,
            Request {
                spin_point: Some(SpinPoint::At(at)),
                ..
            },
        ) => Request {
            spin_point: Some(SpinPoint::At(round_to(at, POINT_DECIMALS))),
            ..request
        },
        (
            _,
            Request {
                up: Up::Along(along),
                ..
            },
        ) => Request {
            up: Up::Along(round_direction(&along.into()).into()),
            ..request
        },
        _ => request,
    }
}
