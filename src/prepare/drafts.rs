//! Drafts: the kits of a solution, plan after plan, until one keeps its promises.

use super::judge::{self, Draft};
use super::solve;
use crate::ballast::Order;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::make::make;
use crate::open::{Candidate, Candidates, climb, one_piece};
use crate::run::{Placed, Solved};

/// A goal as it is solved, and as it is weighed: with what a slicer lays on its parts.
#[derive(Clone, Copy)]
pub struct Aims<'a> {
    /// The goal as it was solved, and as its cuts are planned.
    pub planned: &'a Placed,
    /// The goal as its parts are weighed.
    pub weighed: &'a Placed,
}

/// Drafts the kit of a solution.
pub fn draft<'a>(aims: Aims<'a>, solved: Solved, watch: &Watch) -> Result<Draft, Error> {
    let draft = draft_once(aims, solved, watch)?;
    with_more_balls(aims, draft, watch)
}

fn draft_once<'a>(aims: Aims<'a>, solved: Solved, watch: &Watch) -> Result<Draft, Error> {
    if aims.planned.sparse.is_some() {
        let candidate = one_piece(aims.planned, solved, watch)?;
        return made(aims.weighed, candidate, watch);
    }
    let candidates = climb(aims.planned, solved, watch)?;
    first_that_passes(candidates, |candidate| made(aims.weighed, candidate, watch))
}

/// Makes the parts of a plan, and judges them.
fn made<'a>(weighed: &'a Placed, candidate: Candidate<'a>, watch: &Watch) -> Result<Draft, Error> {
    judge::draft(weighed, make(weighed, candidate, watch)?, watch)
}

/// Lays in more balls where a job leaves their number open and a kit breaks its promise because of
/// what cuts, cleaning and glue take. Returns the kit with more of them if it keeps its promise.
fn with_more_balls(aims: Aims, draft: Draft, watch: &Watch) -> Result<Draft, Error> {
    if aims.planned.job.ballast != Order::Auto || !draft.lacks_hollow() {
        return Ok(draft);
    }
    let more = solve::with_more_balls(aims.planned, draft.made.load.parts.len(), watch)?;
    let Some(more) = more else { return Ok(draft) };
    match draft_once(aims, more, watch) {
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

/// The plans of a solution. They are searched once, and drafted for every round of toolpaths.
pub struct Drafts<'a> {
    planned: &'a Placed,
    built: Vec<Candidate<'a>>,
    /// The plans that no round has asked for yet.
    rest: Candidates<'a>,
}

impl<'a> Drafts<'a> {
    /// Searches the plans of a solution.
    pub fn new(planned: &'a Placed, solved: Solved, watch: &Watch) -> Result<Self, Error> {
        Ok(Self {
            planned,
            built: Vec::new(),
            rest: climb(planned, solved, watch)?,
        })
    }

    /// Drafts the kit, weighed as in this goal: the same as [`draft`] does.
    pub fn draft(&mut self, weighed: &Placed, watch: &Watch) -> Result<Draft, Error> {
        let planned = self.planned;
        let candidates = (0..).map_while(|index| self.plan(index));
        let draft = first_that_passes(candidates, |candidate| made(weighed, candidate, watch))?;
        with_more_balls(Aims { planned, weighed }, draft, watch)
    }

    /// Returns the plan of a place in their order; `None` behind the last.
    fn plan(&mut self, index: usize) -> Option<Result<Candidate<'a>, Error>> {
        if let Some(built) = self.built.get(index) {
            return Some(Ok(built.clone()));
        }
        let next = self.rest.next()?;
        if let Ok(next) = &next {
            self.built.push(next.clone());
        }
        Some(next)
    }
}
