//! The line from a job to a kit: load, place, solve, open, make, judge, kit.

mod advise;
mod densities;
mod drafts;
mod drawn;
mod failure;
mod fields;
mod fit;
mod given;
mod graded;
mod hardware;
mod hints;
mod inner_cells;
mod judge;
mod kept;
mod levels;
mod like;
mod load;
mod materials;
mod mean;
mod outcome;
mod papers;
mod place;
pub mod plans;
mod reason;
mod rotor;
mod rounds;
mod slice;
mod solve;
mod spread;
mod steps;
mod stock;
mod thresholds;
mod upright;
mod waterline;
mod weighed;

pub use kept::SlicedOutcome;
pub use outcome::{Failure, Impossible, Outcome, Prepared};
pub use rounds::prepare_sliced;
pub use slice::time_kit;

use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::Job;
use crate::run::Placed;
use drafts::Aims;

/// Prepares a job to its end: a kit with its checklist, or the proof that the goal cannot be met.
///
/// Nothing is written: [`Prepared::kit`] is in memory. The same job gives the same bytes on any
/// number of threads.
///
/// # Errors
/// An [`Error`] means that no answer was reached: the model cannot be read, the job contradicts
/// itself, the caller stopped the run. A goal that cannot be met is an answer.
pub fn prepare(job: &Job, watch: &Watch) -> Result<Outcome, Error> {
    let slicer = slice::find(job, watch)?;
    let placed = placed(job, watch)?;
    let planned = placed.as_planned();
    let solved = match solve::best(&planned, watch)? {
        Verdict::Found(solved) => solved,
        Verdict::No(impossible) => {
            let impossible = advise::remedies(&placed, impossible, watch)?;
            return Ok(Outcome::Impossible(Box::new(impossible)));
        }
    };
    let aims = Aims {
        planned: &planned,
        weighed: &placed,
    };
    let draft = drafts::draft(aims, solved, watch)?;
    let prepared = papers::finish(&placed, &draft, slicer.as_ref(), watch)?;
    let prepared = failure::on_failure(&placed, prepared, watch)?;
    Ok(Outcome::Prepared(Box::new(prepared)))
}

/// Places the goal of a job in its model.
fn placed(job: &Job, watch: &Watch) -> Result<Placed, Error> {
    let printer = load::printer(job, watch)?;
    let model = load::model(job, &printer, watch)?;
    let shop = load::shop(job, printer, &model)?;
    let placed = place::goal(job, model, shop, watch)?;
    graded::refuse_rounds(&placed)?;
    Ok(placed)
}
