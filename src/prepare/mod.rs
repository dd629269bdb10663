//! The line from a job to a kit: load, place, solve, open, make, judge, kit.

mod advise;
mod densities;
mod failure;
mod graded;
mod hardware;
mod hints;
mod judge;
mod levels;
mod load;
mod outcome;
mod papers;
mod place;
pub mod plans;
mod reason;
mod rotor;
mod rounds;
mod slice;
mod solve;
mod thresholds;
mod upright;
mod waterline;

pub use outcome::{Failure, Impossible, Outcome, Prepared};
pub use rounds::{SlicedOutcome, prepare_sliced};
pub use slice::time_kit;

use crate::ballast::Order;
use crate::base::verdict::Verdict;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::Job;
use crate::make::make;
use crate::open::{Candidate, climb, one_piece};
use crate::run::{Placed, Solved};
use judge::Draft;

/// Prepares a job to its end: a kit with its checklist, or the proof that the goal cannot be met.
///
/// Nothing is written: [`Prepared::kit`] is in memory. The same job gives the same bytes on any
/// number of threads.
///
/// # Errors
/// An [`Error`] means that no answer was reached: the model cannot be read, the job contradicts
/// itself, the caller stopped the run. A goal that cannot be met is an answer.
pub fn prepare(job: &Job, watch: &Watch) -> Result<Outcome, Error> {
    let printer = load::printer(job, watch)?;
    let slicer = slice::find(job, &printer)?;
    let model = load::model(job, &printer, watch)?;
    let shop = load::shop(job, printer, &model)?;
    let placed = place::goal(job, model, shop, watch)?;
    graded::refuse_rounds(&placed)?;
    let solved = match solve::best(&placed, watch)? {
        Verdict::Found(solved) => solved,
        Verdict::No(impossible) => {
            let impossible = advise::remedies(&placed, impossible, watch)?;
            return Ok(Outcome::Impossible(Box::new(impossible)));
        }
    };
    let draft = draft_of(&placed, solved, watch)?;
    let draft = with_more_balls(&placed, draft, watch)?;
    let prepared = papers::finish(&placed, draft, slicer.as_ref(), watch)?;
    let prepared = failure::on_failure(&placed, prepared, watch)?;
    Ok(Outcome::Prepared(Box::new(prepared)))
}

/// Drafts the kit of a solution.
fn draft_of(placed: &Placed, solved: Solved, watch: &Watch) -> Result<Draft, Error> {
    if placed.sparse.is_some() {
        let candidate = one_piece(placed, solved, watch)?;
        return judge::draft(placed, make(placed, candidate, watch)?, watch);
    }
    let candidates = climb(placed, solved, watch)?;
    first_that_passes(candidates, |candidate| {
        let made = make(placed, candidate, watch)?;
        judge::draft(placed, made, watch)
    })
}

/// Lays in more balls where a job leaves their number open and a kit breaks its promise because of
/// what cuts, cleaning and glue take. Returns the kit with more of them if it keeps its promise.
fn with_more_balls(placed: &Placed, draft: Draft, watch: &Watch) -> Result<Draft, Error> {
    if placed.job.ballast != Order::Auto || !draft.lacks_hollow() {
        return Ok(draft);
    }
    let more = solve::with_more_balls(placed, draft.made.load.parts.len(), watch)?;
    let Some(more) = more else { return Ok(draft) };
    match draft_of(placed, more, watch) {
        Ok(heavier) if heavier.passes() => Ok(heavier),
        Err(Error::Cancelled) => Err(Error::Cancelled),
        // The kit with fewer balls is an answer, whatever keeps the other from being made.
        _ => Ok(draft),
    }
}

/// Drafts kits in order until one keeps every promise; else returns the last.
fn first_that_passes<'a>(
    candidates: impl Iterator<Item = Result<Candidate<'a>, Error>>,
    mut draft: impl FnMut(Candidate<'a>) -> Result<Draft, Error>,
) -> Result<Draft, Error> {
    let mut last = Err(Error::Cancelled);
    for candidate in candidates {
        last = Ok(draft(candidate?)?);
        if last.as_ref().is_ok_and(Draft::passes) {
            break;
        }
    }
    last
}
