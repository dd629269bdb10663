//! The asked: rows of a goal and limits of its figure, against which a printed field is held.

use super::found::{Found, solution};
use super::kept::Kept;
use super::near::{NearWished, rows};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::geom::Quadric;
use crate::goal::compute_figures;
use crate::hollow::Problem;
use crate::hollow::family::{Family, Rows, Task};
use crate::hollow::field_miss::FieldMiss;
use crate::hollow::graded::{Graded, InUnits, Row};
use crate::hollow::levels::least_level_change;
use crate::hollow::solution::{Certificate, Figure, Solution};
use crate::hollow::status::Status;
use crate::mass::Moments;

/// Residual of the rows, in units of the body, up to which they count as met.
const MET: f64 = 1e-7;
/// The same for a fitted field that the columns cannot meet better.
const NEARLY_MET: f64 = 1e-5;
/// The same for a given field: the judge of the written parts decides about the rest.
const GIVEN_MET: f64 = 1e-3;

/// The rows of a goal, and the limits that its figure keeps.
pub(super) struct Asked {
    pub rows: Vec<Row>,
    pub kept: Option<Kept>,
}

/// A field of printed steps: its moments, its miss of the rows, and its change.
pub(super) struct End {
    /// The quadric whose level sets bound its regions.
    pub quadric: Quadric,
    pub moments: Moments,
    pub miss: f64,
    /// Mean of ½(d − wished)² over the interior.
    pub cost: f64,
    /// The family that was fitted; `None` for a given field.
    pub fitted: Option<Family>,
}

/// A print's columns, in mm and in units, and the rows that are asked of it.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub graded: &'a Graded<'a>,
    pub units: &'a InUnits<'a>,
    touching: &'a (dyn Fn(&Moments) -> Vec<Row> + Sync),
}

impl<'a> Case<'a> {
    /// Returns the rows.
    pub fn rows(&self) -> Rows<'a> {
        Rows {
            fixed: self.graded.rows,
            touching: self.touching,
        }
    }

    /// Returns the task of fitting a field of a family to the rows.
    pub fn task(&self, near: &NearWished, family: Family) -> Task<'a> {
        Task {
            graded: self.graded,
            units: self.units,
            touching: self.touching,
            family,
            range: near.levels.range(),
            wished: near.wished,
        }
    }
}

impl Asked {
    /// Returns what a goal asks; or the best print, if it does not do either.
    pub fn of(
        near: &NearWished,
        problem: &Problem,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Verdict<Self, Box<Solution>> {
        near.kept(problem, known, watch).map(|kept| {
            let angle_rad = kept.as_ref().map_or(0.0, Kept::angle_rad);
            Self {
                rows: rows(problem.goal, near.least_angle_rad.max(angle_rad)),
                kept,
            }
        })
    }

    /// Returns what a goal asks without any limit of its figure.
    pub fn without_limits(near: &NearWished, problem: &Problem) -> Self {
        Self {
            rows: rows(problem.goal, near.least_angle_rad),
            kept: None,
        }
    }

    /// Runs something on the print and its rows.
    pub fn with_case<T>(&self, problem: &Problem, run: impl FnOnce(&Case) -> T) -> T {
        let graded = Graded {
            shell: problem.fixed - problem.columns.moments(),
            columns: problem.columns,
            rows: &self.rows,
        };
        let units = InUnits::new(&graded);
        let touching = |moments: &Moments| {
            let kept = self.kept.as_ref();
            kept.map_or_else(Vec::new, |kept| kept.touching(moments))
        };
        run(&Case {
            graded: &graded,
            units: &units,
            touching: &touching,
        })
    }

    /// Returns the solution of the field that `end` finds beside the least change of all densities.
    ///
    /// The certificate bounds its change by that. If it does not meet the goal, the status says by
    /// how much. What no density does, no field does.
    pub fn judge(
        &self,
        problem: &Problem,
        near: &NearWished,
        end: impl FnOnce(&Case, &Quadric) -> End,
    ) -> Solution {
        self.with_case(problem, |case| {
            let least = match least_level_change(case.graded, &near.levels, near.wished) {
                Verdict::Found(least) => least,
                Verdict::No(proof) => return near.refused(problem, case.graded, &proof),
            };
            let end = end(case, &least.quadric);
            let found = Found {
                status: status(problem, near, &end),
                quadric: end.quadric,
                certificate: certificate([end.cost, least.bound], end.miss),
                moments: end.moments,
                passes: 0,
                kept: self.kept.clone(),
            };
            solution(problem, found)
        })
    }
}

fn status(problem: &Problem, near: &NearWished, end: &End) -> Status {
    let enough = match end.fitted {
        Some(_) => NEARLY_MET,
        None => GIVEN_MET,
    };
    match end.miss {
        residual if residual <= MET => Status::Solved,
        residual if residual <= enough => Status::AlmostSolved,
        _ => {
            let figures = compute_figures(problem.goal, &end.moments);
            Status::FieldMisses {
                miss: FieldMiss {
                    fitted: end.fitted,
                    off_axis_mm: figures.off_axis_mm,
                    tilt_rad: figures.axis_tilt_rad,
                    toppling_rad: figures.toppling_angle_rad,
                    wanted_rad: near.least_angle_rad,
                },
            }
        }
    }
}

/// Returns the certificate of a field's change, with the bound of the least of all densities.
fn certificate([change, bound]: [f64; 2], residual: f64) -> Certificate {
    // The mean of half the square, as the root of the mean square.
    let [value, bound] = [change, bound].map(|cost| (2.0 * cost.max(0.0)).sqrt());
    Certificate {
        figure: Figure::InfillChange,
        value,
        bound,
        gap_ratio: (value - bound) / value.max(f64::MIN_POSITIVE),
        residual,
        bound_over_heights: None,
    }
}
