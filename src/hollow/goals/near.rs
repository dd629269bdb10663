//! A wished density, changed as little as the goal allows: nested levels instead of the best void.
//!
//! The goal counts with its equations and with what it promises of its stand, each a linear row.
//! Tops and yo-yos keep a share of their best figure too, and the others where that is ordered.

use super::found::{Found, solution};
use super::kept::{Kept, KeptChange, keeps_figure};
use super::matching;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::field::Clamped;
use crate::geom::Quadric;
use crate::goal::{Goal, GoalKind, Objective};
use crate::hollow::change::least_change;
use crate::hollow::dual::units::index::{X, XZ, Y, YZ, Z};
use crate::hollow::graded::{Graded, Row, Sense, Separation};
use crate::hollow::levels::{PrintLevels, least_level_change};
use crate::hollow::solution::{Certificate, Figure, Solution};
use crate::hollow::status::{Obstacle, Status};
use crate::hollow::{Fill, Problem};
use crate::interior::moments_where_positive;
use crate::mass::Moments;

/// Tilt that is solved for beyond the promised one, rad: a hundredth of a degree, for the rounding
/// of files.
pub const TILT_MARGIN_RAD: f64 = 1.745e-4;

/// Residual of the rows, in units of the body, up to which they count as met.
const MET: f64 = 1e-7;
/// The same for a solution whose last digits are not proved.
const NEARLY_MET: f64 = 1e-3;

/// A wished density, and the densities that can be had.
#[derive(Debug, Clone, PartialEq)]
pub struct NearWished {
    /// The density that is wished everywhere, over that of solid print.
    pub wished: f64,
    /// The densities.
    pub levels: PrintLevels,
    /// Stand: the tilt that it must bear, rad.
    pub least_angle_rad: f64,
    /// The share of the best figure that is kept; `None` for the usual one of the goal.
    pub keep: Option<f64>,
}

impl NearWished {
    /// Finds the least change of the wished density that meets the goal and keeps its figure.
    ///
    /// A density is at most a level where the solution's quadric is above minus the next value of
    /// [`cuts`](Self::cuts). The certificate measures the root mean square of the change. For a top
    /// whose speed would not be kept otherwise, it holds for the height of the solution's centre.
    /// If no density meets the rows, the status has the proof. A `known` solution of coarser
    /// columns says what is kept.
    #[must_use]
    pub fn solve(&self, problem: &Problem, known: Option<&Solution>, watch: &Watch) -> Solution {
        let kept = match self.kept(problem, known, watch) {
            Verdict::Found(kept) => kept,
            Verdict::No(impossible) => return *impossible,
        };
        self.keeping(problem, kept, watch)
    }

    /// Finds the least change of the wished density that meets the goal and keeps this.
    pub(super) fn keeping(&self, problem: &Problem, kept: Option<Kept>, watch: &Watch) -> Solution {
        let angle_rad = kept.as_ref().map_or(0.0, Kept::angle_rad);
        let rows = rows(problem.goal, self.least_angle_rad.max(angle_rad));
        let graded = Graded {
            shell: problem.fixed - problem.columns.moments(),
            columns: problem.columns,
            rows: &rows,
        };
        let least = |rows: &[Row]| {
            let graded = Graded { rows, ..graded };
            // A stopped run has no answer: the caller asks the watch.
            match watch.check() {
                Ok(()) => least_level_change(&graded, &self.levels, self.wished),
                Err(_) => Verdict::No(Separation {
                    weights: Vec::new(),
                    quadric: Quadric([0.0; 10]),
                }),
            }
        };
        let found = match kept {
            Some(kept) => kept.least_change(&rows, least),
            None => least(&rows).map(|change| Some(KeptChange { change, kept: None })),
        };
        match found {
            Verdict::Found(Some(found)) => {
                let unmet = Some(found.change.residual).filter(|residual| *residual > NEARLY_MET);
                let proof = unmet.and_then(|_| matching::proof(&graded, self.levels.range()));
                proof.map_or_else(
                    || solved(problem, found),
                    |proof| self.refused(problem, &graded, &proof),
                )
            }
            Verdict::Found(None) => unsettled(problem),
            Verdict::No(proof) => self.refused(problem, &graded, &proof),
        }
    }

    /// Returns what must be kept, `None` for nothing; or the best print, if it does not do either.
    pub(super) fn kept(
        &self,
        problem: &Problem,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Verdict<Option<Kept>, Box<Solution>> {
        if !keeps_figure(problem.goal, self.keep) {
            return Verdict::Found(None);
        }
        // The best stand is found at once, and on these columns it is the better measure.
        let is_quick = problem.goal.kind == GoalKind::Stand;
        let usable = known.filter(|known| known.is_usable() && !is_quick);
        if let Some(kept) = usable.and_then(|known| known.warm.kept.clone()) {
            return Verdict::Found(Some(kept));
        }
        let best = Fill::between(self.levels.range()).solve(problem, None, &watch.muted());
        if !best.is_usable() {
            return Verdict::No(Box::new(best));
        }
        Verdict::Found(Some(Kept::of(problem.goal, &best.moments, self.keep)))
    }

    /// Returns the density that meets what a solution of levels meets, with the least change of all
    /// densities; in the goal's frame. `None` if the rows leave no density.
    ///
    /// Figures that are kept count by the rows that touch their limits at the solution.
    pub fn smooth(&self, problem: &Problem, known: &Solution) -> Option<Clamped> {
        let kept = known.warm.kept.as_ref();
        let angle_rad = kept.map_or(0.0, Kept::angle_rad);
        let mut rows = rows(problem.goal, self.least_angle_rad.max(angle_rad));
        rows.extend(kept.map_or_else(Vec::new, |kept| kept.touching(&known.moments)));
        let graded = Graded {
            shell: problem.fixed - problem.columns.moments(),
            columns: problem.columns,
            rows: &rows,
        };
        let least = least_change(&graded, self.levels.range(), self.wished).found();
        least.map(|change| change.field())
    }

    /// Returns the values of minus the quadric between the levels, ascending.
    pub fn cuts(&self) -> Vec<f64> {
        let middle = |pair: &[f64]| 0.5 * (pair[0] + pair[1]) - self.wished;
        self.levels.densities().windows(2).map(middle).collect()
    }

    pub(super) fn refused(
        &self,
        problem: &Problem,
        graded: &Graded,
        proof: &Separation,
    ) -> Solution {
        let range = self.levels.range();
        let columns = problem.columns;
        let sum = |moments: &Moments| dot(&proof.quadric, moments);
        let densest = sum(&graded.shell) + range.high() * sum(&columns.moments());
        let most = range.span() * sum(&moments_where_positive(columns, &proof.quadric));
        let unmet = || Status::ConstraintsInfeasible {
            obstacle: match (problem.goal.kind, problem.goal.objective) {
                (GoalKind::Stand, Objective::LowestCenter) => Obstacle::Center,
                (GoalKind::Stand, _) => Obstacle::Tilt,
                _ => Obstacle::Both,
            },
            // The rows are of unit length for a body of unit volume.
            least_miss: (densest - most) / problem.fixed.volume(),
            separator: proof.quadric,
        };
        let status = match problem.goal.kind {
            GoalKind::Match => matching::refused(graded, range, proof.quadric),
            _ => unmet(),
        };
        let certificate = Certificate {
            figure: Figure::InfillChange,
            value: f64::NAN,
            bound: f64::NAN,
            gap_ratio: f64::INFINITY,
            residual: f64::INFINITY,
            bound_over_heights: None,
        };
        let moments = graded.shell + columns.moments() * range.high();
        solution(
            problem,
            Found {
                status,
                quadric: proof.quadric,
                certificate,
                moments,
                passes: 0,
                kept: None,
            },
        )
    }
}

/// Returns the answer of a search that found no densities, and no proof that there are none.
fn unsettled(problem: &Problem) -> Solution {
    let status = Status::IterationLimit {
        gap_ratio: f64::INFINITY,
        residual: f64::INFINITY,
    };
    let certificate = Certificate {
        figure: Figure::InfillChange,
        value: f64::NAN,
        bound: f64::NAN,
        gap_ratio: f64::INFINITY,
        residual: f64::INFINITY,
        bound_over_heights: None,
    };
    solution(
        problem,
        Found {
            status,
            quadric: Quadric([0.0; 10]),
            certificate,
            moments: problem.fixed,
            passes: 0,
            kept: None,
        },
    )
}

fn solved(problem: &Problem, found: KeptChange) -> Solution {
    let KeptChange { change, kept } = found;
    let status = match change.residual {
        residual if residual <= MET => Status::Solved,
        residual if residual <= NEARLY_MET => Status::AlmostSolved,
        residual => Status::IterationLimit {
            gap_ratio: 0.0,
            residual,
        },
    };
    // The mean of half the square, as the root of the mean square.
    let rms = |cost: f64| (2.0 * cost.max(0.0)).sqrt();
    let (value, bound) = (rms(change.cost), rms(change.bound));
    let certificate = Certificate {
        figure: Figure::InfillChange,
        value,
        bound,
        gap_ratio: (value - bound) / value.max(f64::MIN_POSITIVE),
        residual: change.residual,
        bound_over_heights: None,
    };
    let (quadric, moments, passes) = (change.quadric, change.moments, change.steps);
    solution(
        problem,
        Found {
            status,
            quadric,
            certificate,
            moments,
            passes,
            kept,
        },
    )
}

fn dot(quadric: &Quadric, moments: &Moments) -> f64 {
    let pairs = quadric.0.iter().zip(moments.0);
    pairs
        .map(|(coefficient, moment)| coefficient * moment)
        .sum()
}

/// Returns the rows of a goal: its equations, and for what stands the tilt that it must bear.
///
/// A tilt about an edge of the support is borne while the centre is far enough inside of it for its
/// height. Floating objects have no rows, a match has one for each moment.
pub fn rows(goal: &Goal, least_angle_rad: f64) -> Vec<Row> {
    let zero = |index: usize| {
        Row::zero(Quadric(std::array::from_fn(|i| {
            f64::from(u8::from(i == index))
        })))
    };
    match goal.kind {
        GoalKind::Top | GoalKind::Balance => [X, Y, YZ, XZ].map(zero).to_vec(),
        GoalKind::Yoyo => [X, Y, Z, YZ, XZ].map(zero).to_vec(),
        GoalKind::Stand if goal.objective == Objective::LowestCenter => [X, Y].map(zero).to_vec(),
        GoalKind::Stand => edge_rows(&goal.support, least_angle_rad),
        GoalKind::Float => Vec::new(),
        GoalKind::Match => matching::rows(goal),
    }
}

/// Returns a row for each edge of a support polygon.
fn edge_rows(support: &[[f64; 2]], least_angle_rad: f64) -> Vec<Row> {
    let next = support.iter().cycle().skip(1);
    let edges = support
        .iter()
        .zip(next)
        .filter_map(|(&[x, y], &[to_x, to_y])| {
            let (along_x, along_y) = (to_x - x, to_y - y);
            let length = along_x.hypot(along_y);
            // Counterclockwise: the inside is on the left.
            let inward = [-along_y / length, along_x / length];
            (length > 0.0).then_some((inward, inward[0] * x + inward[1] * y))
        });
    let row = |([inward_x, inward_y], edge): ([f64; 2], f64)| {
        let mut quadric = Quadric([0.0; 10]);
        quadric.0[0] = edge;
        (quadric.0[X], quadric.0[Y]) = (-inward_x, -inward_y);
        quadric.0[Z] = least_angle_rad.tan();
        Row {
            quadric,
            wanted: 0.0,
            sense: Sense::AtMost,
        }
    };
    edges.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::DensityRange;
    use crate::goal::compute_figures;
    use crate::hollow::worlds;

    fn near(wished: f64, least_deg: f64) -> NearWished {
        let range = DensityRange::new(0.1, 1.0).unwrap();
        NearWished {
            wished,
            levels: PrintLevels::even(range, 4).unwrap(),
            least_angle_rad: f64::to_radians(least_deg),
            keep: None,
        }
    }

    #[test]
    fn what_stands_as_wished_is_not_changed() {
        let world = worlds::blocks_on_a_slope();
        let lost = world.columns.moments() * 0.3;
        let as_wished = compute_figures(&world.goal, &(world.fixed - lost));
        let stands_deg = as_wished.toppling_angle_rad.unwrap().to_degrees();
        let solution = near(0.7, stands_deg - 0.5).solve(&world.problem(), None, &Watch::silent());
        assert_eq!(solution.status, Status::Solved);
        // The change is the root of a square, in which only rounding is left.
        let squared = solution.certificate.value.powi(2);
        assert!(squared < 1e-15, "{:?}", solution.certificate);
    }

    #[test]
    fn what_must_bear_more_tilt_bears_just_that_and_its_change_has_a_bound() {
        let world = worlds::blocks_on_a_slope();
        let lost = world.columns.moments() * 0.3;
        let as_wished = compute_figures(&world.goal, &(world.fixed - lost));
        let wanted_deg = as_wished.toppling_angle_rad.unwrap().to_degrees() + 1.0;
        let solution = near(0.7, wanted_deg).solve(&world.problem(), None, &Watch::silent());
        assert!(solution.is_usable(), "{:?}", solution.status);
        let reached = compute_figures(&world.goal, &solution.moments);
        let reached_deg = reached.toppling_angle_rad.unwrap().to_degrees();
        assert!(
            (reached_deg - wanted_deg).abs() < 1e-4,
            "{reached_deg} {wanted_deg}"
        );
        let proof = solution.certificate;
        assert!(
            proof.value > 1e-3 && proof.gap_ratio.abs() < 1e-5,
            "{proof:?}"
        );
    }

    #[test]
    fn a_tilt_that_no_density_bears_is_refused_with_its_proof() {
        let world = worlds::blocks_on_a_slope();
        let solution = near(0.7, 60.0).solve(&world.problem(), None, &Watch::silent());
        let Status::ConstraintsInfeasible {
            least_miss,
            separator,
            ..
        } = solution.status
        else {
            unreachable!("{:?}", solution.status)
        };
        assert!(least_miss > 0.0);
        // The proof holds for uniform densities, as for all others.
        let shell = world.fixed - world.columns.moments();
        for density in [0.1, 0.4, 1.0] {
            let moments = shell + world.columns.moments() * density;
            let miss = dot(&separator, &moments) / world.fixed.volume();
            assert!(miss >= least_miss * (1.0 - 1e-9), "{density}");
        }
    }
}
