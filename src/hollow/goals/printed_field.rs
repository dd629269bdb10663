//! A field that is printed in nested regions: given, or fitted to a goal, beside the least change.

use super::asked::{Asked, End};
use super::near::NearWished;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::field::DensityRange;
use crate::geom::Frame;
use crate::hollow::Problem;
use crate::hollow::family::{
    Family, Region, Shape, Task, compare, cost, fit_steps, is_cut, regions, stepped,
};
use crate::hollow::levels::PrintLevels;
use crate::hollow::solution::Solution;

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
        let found = asked.with_case(problem, |case| {
            fit_steps(&case.task(near, family), &near.levels)
        });
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
        asked.judge(problem, near, |case, least| {
            let task = case.task(near, family);
            // A ramp may be the least change itself.
            let beside = task.shape_near(least);
            let starts = std::iter::once(start).chain(beside.filter(|_| !self.is_given));
            let ends = starts.map(|start| self.end(&task, start));
            let best = ends.min_by(|a, b| compare([a.miss, a.cost], [b.miss, b.cost]));
            best.unwrap_or_else(|| self.end(&task, start))
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
            quadric: shape.quadric(),
            miss: task.rows().greatest_miss(task.units, &moments),
            cost: cost(task, &shape, &self.regions),
            moments: task.units.to_mm(&moments),
            fitted: (!self.is_given).then_some(self.shape.family()),
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
