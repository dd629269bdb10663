//! A field that is printed in nested regions: given, or fitted to a goal, beside the least change.

use super::found::{Found, solution};
use super::kept::Kept;
use super::near::{NearWished, rows};
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::field::DensityRange;
use crate::geom::Frame;
use crate::goal::compute_figures;
use crate::hollow::Problem;
use crate::hollow::family::{
    Family, Region, Shape, Task, compare, cost, fit_steps, is_cut, regions, stepped,
};
use crate::hollow::field_miss::FieldMiss;
use crate::hollow::graded::{Graded, InUnits, Row};
use crate::hollow::levels::{PrintLevels, least_level_change};
use crate::hollow::solution::{Certificate, Figure, Solution};
use crate::hollow::status::Status;
use crate::mass::Moments;

/// Residual of the rows, in units of the body, up to which they count as met.
const MET: f64 = 1e-7;
/// The same for a fitted field that the columns cannot meet better.
const NEARLY_MET: f64 = 1e-5;
/// The same for a given field: the judge of the written parts decides about the rest.
const GIVEN_MET: f64 = 1e-3;

/// A field that is printed in nested regions of one density each.
#[derive(Debug, Clone, PartialEq)]
pub struct PrintField {
    /// The field, in the goal's frame.
    pub shape: Shape,
    /// Its regions, the outermost first.
    pub regions: Vec<Region>,
    /// The densities between which it lies.
    pub range: DensityRange,
    /// True if it was given by its numbers, which stay.
    pub is_given: bool,
}

/// The rows of a goal, and the limits that its figure keeps.
struct Asked {
    rows: Vec<Row>,
    kept: Option<Kept>,
}

/// A field of printed steps: its moments, its miss of the rows, and its change.
struct End {
    shape: Shape,
    moments: Moments,
    miss: f64,
    cost: f64,
}

impl PrintField {
    /// Returns a given field in steps of these densities; `None` if it has more regions than are
    /// printed.
    pub fn given(shape: Shape, levels: &PrintLevels, problem: &Problem) -> Option<Self> {
        let is_whole = !is_cut(&shape, levels.densities(), problem.columns);
        is_whole.then(|| Self {
            shape,
            regions: regions(&shape, levels.densities(), problem.columns),
            range: levels.range(),
            is_given: true,
        })
    }

    /// Returns a density that is the same everywhere.
    pub fn uniform(density: f64, range: DensityRange) -> Self {
        let everywhere = Region {
            above: None,
            density,
        };
        Self {
            shape: Shape::uniform(density),
            regions: vec![everywhere],
            range,
            is_given: true,
        }
    }

    /// Fits a field of a family to a goal, in the steps of levels near a wished density.
    ///
    /// Of the fields that meet the goal it is the one with the least change that was found. If none
    /// meets it, it is the nearest.
    pub fn fit(family: Family, near: &NearWished, problem: &Problem, watch: &Watch) -> Self {
        let range = near.levels.range();
        let asked = match Asked::of(near, problem, None, watch) {
            Verdict::Found(asked) => asked,
            Verdict::No(_) => Asked::without_limits(near, problem),
        };
        let found = asked.with_task(problem, near, family, |task| fit_steps(task, &near.levels));
        Self {
            shape: found.shape,
            regions: found.regions,
            range,
            is_given: false,
        }
    }

    /// Fits the field again on some columns, or takes it as it is given. The certificate bounds
    /// the change from the wished density by the least of all densities.
    ///
    /// If it does not meet the goal, the status says by how much.
    #[must_use]
    pub fn solve(
        &self,
        near: &NearWished,
        problem: &Problem,
        known: Option<&Solution>,
        watch: &Watch,
    ) -> Solution {
        let asked = match Asked::of(near, problem, known, watch) {
            Verdict::Found(asked) => asked,
            Verdict::No(impossible) => return *impossible,
        };
        let family = self.shape.family();
        let usable = known.filter(|known| known.is_usable() && !self.is_given);
        let start = usable.map_or(self.shape, |known| {
            Shape::of_quadric(family, &known.quadric)
        });
        asked.with_task(problem, near, family, |task| {
            let least = match least_level_change(task.graded, &near.levels, near.wished) {
                Verdict::Found(least) => least,
                // No density does it, so no field does.
                Verdict::No(proof) => return near.refused(problem, task.graded, &proof),
            };
            // A ramp may be the least change itself.
            let beside = task.shape_near(&least.quadric);
            let starts = std::iter::once(start).chain(beside.filter(|_| !self.is_given));
            let ends = starts.map(|start| self.end(task, start));
            let best = ends.min_by(|a, b| compare([a.miss, a.cost], [b.miss, b.cost]));
            let End {
                shape,
                moments,
                miss: residual,
                cost: change,
            } = best.unwrap_or_else(|| self.end(task, start));
            let found = Found {
                status: self.status(problem, near, residual, &moments),
                quadric: shape.quadric(),
                certificate: certificate([change, least.bound], residual),
                moments,
                passes: 0,
                kept: asked.kept.clone(),
            };
            solution(problem, found)
        })
    }

    /// Returns where a field ends from a start: a given one stays.
    fn end(&self, task: &Task, start: Shape) -> End {
        let shape = match self.is_given {
            true => self.shape,
            false => task.refine(&start, &self.regions),
        };
        let moments = stepped(task.units, &shape, &self.regions).moments;
        End {
            shape,
            miss: task.rows().greatest_miss(task.units, &moments),
            cost: cost(task, &shape, &self.regions),
            moments: task.units.to_mm(&moments),
        }
    }

    fn status(
        &self,
        problem: &Problem,
        near: &NearWished,
        residual: f64,
        moments: &Moments,
    ) -> Status {
        let enough = if self.is_given { GIVEN_MET } else { NEARLY_MET };
        match residual {
            residual if residual <= MET => Status::Solved,
            residual if residual <= enough => Status::AlmostSolved,
            _ => {
                let figures = compute_figures(problem.goal, moments);
                Status::FieldMisses {
                    miss: FieldMiss {
                        fitted: (!self.is_given).then_some(self.shape.family()),
                        off_axis_mm: figures.off_axis_mm,
                        tilt_rad: figures.axis_tilt_rad,
                        toppling_rad: figures.toppling_angle_rad,
                        wanted_rad: near.least_angle_rad,
                    },
                }
            }
        }
    }

    /// Returns the words for the field of a solution, in the model's coordinates, as they can be
    /// typed. `frame` is the goal's.
    pub fn words(&self, solution: &Solution, frame: &Frame) -> String {
        let shape = match self.is_given {
            true => self.shape,
            false => Shape::of_quadric(self.shape.family(), &solution.quadric),
        };
        shape.in_frame(&frame.inverse()).words(self.range)
    }
}

impl Asked {
    /// Returns what a goal asks; or the best print, if it does not do either.
    fn of(
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

    fn without_limits(near: &NearWished, problem: &Problem) -> Self {
        Self {
            rows: rows(problem.goal, near.least_angle_rad),
            kept: None,
        }
    }

    /// Runs something on the task of fitting a field to what is asked.
    fn with_task<T>(
        &self,
        problem: &Problem,
        near: &NearWished,
        family: Family,
        run: impl FnOnce(&Task) -> T,
    ) -> T {
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
        run(&Task {
            graded: &graded,
            units: &units,
            touching: &touching,
            family,
            range: near.levels.range(),
            wished: near.wished,
        })
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
