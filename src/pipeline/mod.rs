//! The line: load, check, place, wall, columns, solve, voids, cuts, pins, parts, measure, correct, kit.

mod advising;
mod assembly;
mod ballasting;
mod bosses;
mod cleaning;
mod faces;
mod finished_rows;
mod fitting;
mod grid_rows;
mod joinery_rows;
mod joining;
mod kit;
mod outcome;
mod packages;
mod printer_rows;
mod rows;
mod settling;
mod setup;
mod solving;
mod standing;
mod stopwatch;
mod support_rows;
mod tuner;
mod tuning;
mod void_rows;
mod waterline;
mod written;

pub use assembly::Assembly;
pub use bosses::{BossRound, KeptBoss};
pub use cleaning::CleaningRound;
pub use outcome::{Failure, Impossible, Outcome, Prepared};
pub use setup::{Model, Setup};
pub use solving::Solved;
pub use written::WrittenPart;

pub use crate::error::Error;
use crate::job::Job;
use crate::progress::Progress;
use stopwatch::Stopwatch;

/// The names of the phases that a run reports, in their order.
pub mod phase {
    /// Reading and checking the model, the profiles and the goal.
    pub const LOAD: &str = "load";
    /// The columns of what may be emptied, and the solve.
    pub const SOLVE: &str = "solve";
    /// What would make an impossible goal possible.
    pub const ADVISE: &str = "advise";
    /// The surface of what may be emptied.
    pub const SHELL: &str = "shell";
    /// The voids of a solution and the parts they are cut into.
    pub const PARTS: &str = "parts";
    /// The judgement of what is written.
    pub const VERIFY: &str = "verify";
    /// The job sheet and its pictures.
    pub const REPORT: &str = "report";
}

/// Runs a job to its end: a kit and its checklist, or the proof that the goal cannot be met.
///
/// Nothing is written; [`Prepared::kit`] is in memory. The same job gives the same bytes on any number of threads.
pub fn run(job: &Job, progress: &Progress) -> Result<Outcome, Error> {
    let mut watch = Stopwatch::start();
    let setup = Setup::of(job, progress)?;
    watch.lap(phase::LOAD);
    let setup = waterline::chosen(setup, &mut watch)?;
    let setup = fitting::equipped(setup, &mut watch)?;
    let (setup, solved) = ballasting::solved(setup, progress, &mut watch)?;
    let solved = match solved {
        Ok(solved) => solved,
        Err(impossible) => {
            let advised = advising::advised(&setup, impossible, progress);
            return Ok(Outcome::Impossible(Box::new(advised)));
        }
    };
    let prepared = bossed_or_plain(&setup, solved, progress, watch)?;
    Ok(Outcome::Prepared(Box::new(advising::after(&setup, prepared, progress))))
}

/// The judged kit, with bosses where joints need them; without any where it then breaks a promise, as where what a boss hides of a
/// void shows only in the written parts. Pins that a person ordered are kept, whatever they break: the kit's checks say it.
fn bossed_or_plain(
    setup: &Setup,
    solved: Solved,
    progress: &Progress,
    mut watch: Stopwatch,
) -> Result<Prepared, Error> {
    let assembly = Assembly::corrected(setup, solved.clone(), progress, &mut watch)?;
    let has_bosses = !assembly.bosses.is_empty();
    let assembly = packages::in_format(assembly, setup)?;
    let prepared = kit::prepared(setup, &assembly, progress, watch.clone())?;
    let is_ordered = setup.job.plan.as_ref().is_some_and(|order| order.pins.is_some());
    if prepared.passes() || !has_bosses || is_ordered {
        return Ok(prepared);
    }
    let assembly = Assembly::without_bosses(setup, solved, progress, &mut watch)?;
    let assembly = packages::in_format(assembly, setup)?;
    kit::prepared(setup, &assembly, progress, watch)
}
