//! The line: load, check, place, wall, columns, solve, voids, cuts, pins, parts, measure, correct,
//! kit.

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
mod planning;
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
pub use planning::Lengths;
pub use setup::{Model, Setup};
pub use solving::Solved;
pub use written::WrittenPart;

use crate::base::watch::Watch;
pub use crate::error::Error;
use crate::job::Job;
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

/// What is said where the pins of every joint had to be given up in the end.
const USUAL_WAY: &str =
    "what would give every joint its pins breaks a promise of the kit: some are left without";
/// What is said where bosses had to be given up in the end.
const NO_BOSSES: &str = "bosses around pins would break a promise of the kit: no joint has them";

/// Runs a job to its end: a kit and its checklist, or the proof that the goal cannot be met.
///
/// Nothing is written; [`Prepared::kit`] is in memory. The same job gives the same bytes on any
/// number of threads.
pub fn run(job: &Job, progress: &Watch) -> Result<Outcome, Error> {
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
    Ok(Outcome::Prepared(Box::new(advising::after(
        &setup, prepared, progress,
    ))))
}

/// The judged kit, with every joint's pins as far as can be; where it then breaks a promise, as
/// where what a boss hides of a void shows only in the written parts, less is done for the pins,
/// and in the end no boss. Pins that a person ordered are kept, whatever they break: the kit's
/// checks say it.
fn bossed_or_plain(
    setup: &Setup,
    solved: Solved,
    progress: &Watch,
    mut watch: Stopwatch,
) -> Result<Prepared, Error> {
    let is_ordered = setup
        .job
        .plan
        .as_ref()
        .is_some_and(|order| order.pins.is_some());
    let (mut lengths, mut note) = (Lengths::All, None);
    loop {
        let mut assembly =
            Assembly::corrected(setup, solved.clone(), lengths, (progress, &mut watch))?;
        assembly.plan.notes.extend(note.map(str::to_owned));
        let gone = assembly.lengths;
        let assembly = packages::in_format(assembly, setup)?;
        let prepared = kit::prepared(setup, &assembly, progress, watch.clone())?;
        (lengths, note) = match gone {
            _ if is_ordered || prepared.passes() => return Ok(prepared),
            Lengths::All => (Lengths::Bosses, Some(USUAL_WAY)),
            Lengths::Bosses => (Lengths::Walls, Some(NO_BOSSES)),
            Lengths::Walls => return Ok(prepared),
        };
    }
}
