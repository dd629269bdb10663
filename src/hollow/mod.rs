//! hollow
#![allow(missing_docs)]

mod answer;
mod ascent;
mod cover;
mod heights;
mod mass;
mod problem;
mod programme;
mod reach;
mod set;
mod settings;
mod solution;
mod stand;
mod status;
mod top;
mod valley;
mod work;
mod yoyo;

use crate::goal::GoalKind;
use crate::progress::Progress;

pub use problem::Problem;
pub use settings::Settings;
pub use solution::{Certificate, Figure, LogRow, Solution, Stage};
pub use status::{Obstacle, Status};

use work::Work;

/// Solves from nothing.
pub fn solve(problem: &Problem, settings: &Settings, progress: &Progress) -> Solution {
    let work = Work::new(problem, settings, progress);
    let objective = problem.goal.objective;
    let answer = match problem.goal.kind {
        GoalKind::Top => top::solve(&work, objective),
        GoalKind::Yoyo => yoyo::solve(&work, objective, None),
        GoalKind::Stand => stand::solve(&work, objective, None),
    };
    answer.into_solution(work)
}

/// Solves from a known solution.
pub fn refine(problem: &Problem, settings: &Settings, known: &Solution, progress: &Progress) -> Solution {
    if !known.is_usable() {
        return solve(problem, settings, progress);
    }
    let work = Work::new(problem, settings, progress);
    let (objective, start) = (known.objective, Some(&known.warm.point));
    let answer = match problem.goal.kind {
        GoalKind::Top => top::refine(&work, objective, &known.warm),
        GoalKind::Yoyo => Some(yoyo::solve(&work, objective, start)),
        GoalKind::Stand => Some(stand::solve(&work, objective, start)),
    };
    match answer {
        Some(answer) => answer.into_solution(work),
        None => solve(problem, settings, progress),
    }
}
