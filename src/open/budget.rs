//! The budget of a search, in units of work. They are counted alike on any machine and with any
//! number of threads, so that the same search ends at the same place everywhere.

use std::sync::{Arc, Mutex, PoisonError};

use crate::job::Effort;
use crate::run::{Remark, Untried};

/// Units for a draft of cuts, for each triangle of the voids. A unit takes about a microsecond on
/// one core.
const DRAFT_UNITS: u64 = 60;
/// Units to find what cannot be cleaned, for each triangle of the voids.
const LOOK_UNITS: u64 = 20;
/// Units to draw voids, for each triangle of what may be emptied.
const DRAW_UNITS: u64 = 20;
/// Columns that are solved for in a unit.
const COLUMNS_IN_UNIT: u64 = 10;

/// A step of a search, by the sizes that decide how long it takes.
#[derive(Debug, Clone, Copy)]
pub enum Work {
    /// Drafts cuts through voids of so many triangles.
    Draft(usize),
    /// Looks for what cannot be cleaned in voids of so many triangles.
    Look(usize),
    /// Draws voids in a region of so many triangles.
    Draw(usize),
    /// Solves on so many columns.
    Solve(usize),
}

impl Work {
    fn units(self) -> u64 {
        match self {
            Self::Draft(triangles) => DRAFT_UNITS * triangles as u64,
            Self::Look(triangles) => LOOK_UNITS * triangles as u64,
            Self::Draw(triangles) => DRAW_UNITS * triangles as u64,
            Self::Solve(columns) => columns as u64 / COLUMNS_IN_UNIT,
        }
    }
}

/// What is left of a search's work, and what was not tried for want of it. Clones share it.
///
/// Only serial steps of a search spend it. It never stops a step that a kit needs; it is asked
/// before those that may make a kit better.
#[derive(Debug, Clone)]
pub struct Budget {
    effort: Effort,
    spent: Arc<Mutex<Spent>>,
}

#[derive(Debug, Default)]
struct Spent {
    units: u64,
    untried: Vec<Untried>,
}

impl Budget {
    /// Returns the budget of a search with this effort.
    pub fn of(effort: Effort) -> Self {
        Self {
            effort,
            spent: Arc::default(),
        }
    }

    /// Counts a step.
    pub fn spend(&self, work: Work) {
        self.with(|spent| spent.units += work.units());
    }

    /// Returns whether work is left for a step that may make a kit better. Notes the step if not.
    pub fn allows(&self, step: Untried) -> bool {
        self.with(|spent| {
            let is_left = spent.units < self.effort.most_units();
            if !is_left && !spent.untried.contains(&step) {
                spent.untried.push(step);
            }
            is_left
        })
    }

    /// Returns the remark on what was not tried; `None` if everything was.
    pub fn remark(&self) -> Option<Remark> {
        let untried = self.with(|spent| spent.untried.clone());
        let next = self.effort.next()?;
        (!untried.is_empty()).then_some(Remark::Untried { untried, next })
    }

    fn with<T>(&self, then: impl FnOnce(&mut Spent) -> T) -> T {
        then(&mut self.spent.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spent_budget_refuses_steps_and_says_which_once_each() {
        let budget = Budget::of(Effort::Quick);
        assert!(budget.allows(Untried::HiddenSeams) && budget.remark().is_none());
        let triangles = usize::try_from(Effort::Quick.most_units()).unwrap();
        budget.clone().spend(Work::Draft(triangles));
        for step in [Untried::FewerParts, Untried::MorePins, Untried::FewerParts] {
            assert!(!budget.allows(step));
        }
        let expected = Remark::Untried {
            untried: vec![Untried::FewerParts, Untried::MorePins],
            next: Effort::Normal,
        };
        assert_eq!(budget.remark(), Some(expected));
    }

    #[test]
    fn a_thorough_search_tries_everything() {
        let budget = Budget::of(Effort::Thorough);
        budget.spend(Work::Solve(usize::MAX / 2));
        assert!(budget.allows(Untried::MorePins) && budget.remark().is_none());
    }

    #[test]
    fn larger_bodies_take_more_of_it() {
        for work in [Work::Draft, Work::Look, Work::Draw, Work::Solve] {
            assert!(work(20_000).units() > work(1000).units());
        }
    }
}
