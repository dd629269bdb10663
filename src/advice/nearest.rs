//! The nearest step that makes a goal possible: along a ray to the border, then round it by its
//! tangents.

use rayon::prelude::*;

use super::confirm::least_excess;
use super::directions::{rounded, rounded_direction};
use super::ground::{Ground, Trial};
use super::moves::{Moves, Part};
use crate::geom::Vector;
use crate::goal::Request;

/// How far along a ray, as parts of the longest step, it is looked for the first possible place.
const MARCH: [f64; 8] = [0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.75, 1.0];
/// How nearly the border is found along a ray.
const PRECISION_RATIO: f64 = 0.01;
/// A border this near, as a part of the longest step, need not be found more nearly: 0.2° of tilt.
const PRECISION_OF_LIMIT: f64 = 1e-3;
/// Tangents that are followed at most; two or three settle it.
const MOST_TANGENTS: usize = 5;
/// A tangent that shortens the step by less than this part ends the search.
const WORTHWHILE_RATIO: f64 = 0.99;
/// The part of the longest step by which a place is moved to see how the proof changes: small
/// against any step that is advised, large against rounding.
const PROBE_OF_LIMIT: f64 = 1e-4;
/// Decimals of a printed point, in mm: at 1e-3 the rounding of its height already counts as a gap
/// to the model.
const POINT_DECIMALS: i32 = 4;

/// The two ends of a stretch of a ray that the border of the possible crosses.
#[derive(Debug, Clone, Copy)]
struct Border {
    towards: Vector,
    impossible: f64,
    possible: f64,
}

/// A step, the request it leads to as it is printed, and the solve that confirmed it.
#[derive(Debug, Clone)]
pub(super) struct Nearest {
    pub step: Vector,
    pub request: Request,
    pub trial: Trial,
}

/// The shortest step found that makes the goal possible; none where no ray that was followed meets
/// such a place.
///
/// The shortest step |u| with φ(u) ≤ 0, where φ is what the proof of impossibility amounts to,
/// points along −∇φ at its end (Karush, Kuhn and Tucker). The proof is the integral of a quadric
/// over the interior it is least for; by the envelope theorem that interior may be held fast while
/// the frame moves, so ∇φ costs no solve: the same moments are seen from frames moved a little. On
/// the first rays (down the slope, towards where the solid itself is best, towards the nearest
/// possible one of many places) the border is bisected; then each tangent of the border gives the
/// ray to its foot, until the step no longer shortens. What is found is shortest among its
/// neighbours, not proved so among all.
pub(super) fn nearest(ground: &Ground, moves: &Moves) -> Option<Nearest> {
    let search = Search { ground, moves };
    let near = search.nearest_border();
    let first = search
        .far_border(near.map_or(f64::INFINITY, |border| border.possible))
        .or(near)?;
    search.confirmed(&search.rounded_by_tangents(first))
}

struct Search<'a> {
    ground: &'a Ground<'a>,
    moves: &'a Moves,
}

impl Search<'_> {
    fn trial(&self, step: &Vector) -> Option<Trial> {
        self.ground
            .trial(&self.moves.request(step), self.ground.case.wall_mm)
    }

    fn allows(&self, step: &Vector) -> bool {
        self.trial(step)
            .is_some_and(|trial| trial.is_possible() && trial.meets_the_model())
    }

    /// The nearest border on the rays to the seeds.
    fn nearest_border(&self) -> Option<Border> {
        let mut best: Option<Border> = None;
        for seed in self.seeds() {
            let limit = best.map_or(self.moves.limit, |border| border.possible);
            best = self.first_border(&seed, limit).or(best);
        }
        best
    }

    /// The border on the ray to the first of the far places that is possible, if it is nearer than
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
        Some(self.bisected(Border {
            towards,
            impossible: 0.0,
            possible,
        }))
    }

    /// Where to look first: down the slope of the proof, then towards the known places.
    fn seeds(&self) -> Vec<Vector> {
        let down = self
            .down(&Vector::zeros())
            .map(|direction| direction * self.moves.limit);
        let known = self
            .moves
            .seeds
            .iter()
            .copied()
            .filter(|seed| seed.norm() > 0.0);
        known.chain(down).collect()
    }

    /// The direction in which the proof of impossibility at a step loses most; none where there is
    /// no proof.
    fn down(&self, step: &Vector) -> Option<Vector> {
        let trial = self
            .trial(step)
            .filter(|trial| trial.solution.status.is_impossible())?;
        let here = trial.placement.goal.frame;
        let moments = trial.solution.moments.from_frame(&here);
        let proof = |step: &Vector| {
            let moved = self
                .ground
                .placed(&self.moves.request(step), self.ground.case.wall_mm)?;
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

    /// The first border along the ray to a seed, no further than `limit`.
    fn first_border(&self, seed: &Vector, limit: f64) -> Option<Border> {
        let (towards, distance) = (seed.normalize(), seed.norm());
        let mut places: Vec<f64> = MARCH.iter().map(|part| part * self.moves.limit).collect();
        places.push(distance);
        places.sort_by(f64::total_cmp);
        let mut impossible = 0.0;
        for possible in places.into_iter().filter(|&place| place <= limit) {
            if self.allows(&(towards * possible)) {
                return Some(self.bisected(Border {
                    towards,
                    impossible,
                    possible,
                }));
            }
            impossible = possible;
        }
        None
    }

    fn bisected(&self, mut border: Border) -> Border {
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

    /// The border from tangent to tangent, as long as the step shortens.
    fn rounded_by_tangents(&self, mut border: Border) -> Border {
        for _ in 0..MOST_TANGENTS {
            let Some(down) = self.down(&(border.towards * border.impossible)) else {
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

    /// The border along another direction, if it is worthwhile.
    fn shorter(&self, border: Border, towards: &Vector) -> Option<Border> {
        let possible = WORTHWHILE_RATIO * border.possible;
        let turned = Border {
            towards: *towards,
            impossible: 0.0,
            possible,
        };
        self.allows(&(towards * possible))
            .then(|| self.bisected(turned))
    }

    /// The step as it is printed, a little longer where the exact columns ask for it.
    fn confirmed(&self, border: &Border) -> Option<Nearest> {
        least_excess(|excess| {
            let length = (border.possible * (1.0 + excess)).min(self.moves.limit);
            let step = border.towards * length;
            let request = printed(self.moves.part, self.moves.request(&step));
            let trial = self.ground.confirmed(&request, self.ground.case.wall_mm)?;
            trial.meets_the_model().then_some(Nearest {
                step,
                request,
                trial,
            })
        })
    }
}

/// The request with its numbers as short as they are printed: points and directions to the
/// decimals they are told with.
fn printed(part: Part, request: Request) -> Request {
    use crate::goal::{Contact, SpinPoint, Up};
    match (part, request) {
        (
            Part::Contact,
            Request {
                contact: Some(Contact::At(at)),
                ..
            },
        ) => Request {
            contact: Some(Contact::At(rounded(at, POINT_DECIMALS))),
            ..request
        },
        (
            Part::SpinPoint,
            Request {
                spin_point: Some(SpinPoint::At(at)),
                ..
            },
        ) => Request {
            spin_point: Some(SpinPoint::At(rounded(at, POINT_DECIMALS))),
            ..request
        },
        (
            _,
            Request {
                up: Up::Along(along),
                ..
            },
        ) => Request {
            up: Up::Along(rounded_direction(&along.into()).into()),
            ..request
        },
        _ => request,
    }
}
