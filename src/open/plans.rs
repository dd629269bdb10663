//! Several plans for one solution, each by another tendency.

use super::build::{Planned, build_found};
use super::ladder::Ladder;
use super::proxy::Bodies;
use super::refused::unless_refused;
use super::resolve::Resolver;
use super::tendency::have_same_cuts;
use super::way::Candidate;
use crate::base::watch::Watch;
use crate::cut::{self, PlanRequest, SeamNote};
use crate::error::Error;
use crate::run::{Opened, Placed, Rung, Solved, Tendency};

/// Opens the voids of a solution in several ways, each by another tendency; at most `count` of
/// them, the usual one first. Of plans with the same cuts only the first is kept.
pub fn climb_by_tendency<'a>(
    placed: &'a Placed,
    solved: Solved,
    count: usize,
    watch: &Watch,
) -> Result<Vec<Leaning<'a>>, Error> {
    let bodies = Bodies::new(placed, solved, watch)?;
    let copied = Ladder::new(bodies.copy()?)?;
    let mut built = Vec::new();
    for (tendency, found) in lean_each(&copied, count)? {
        if let Some(best) = build_found(&bodies, &Planned::of(found))? {
            built.push(Leaning::new(tendency, best, &copied.request)?);
        }
    }
    if !built.is_empty() {
        return Ok(built);
    }
    drop(copied);
    let ladder = Ladder::new(bodies.whole)?;
    let leanings = lean_each(&ladder, count)?.into_iter();
    let leanings = leanings.map(|(tendency, best)| Leaning::new(tendency, best, &ladder.request));
    leanings.collect()
}

/// Climbs a ladder by each tendency until `count` plans with different cuts are found.
fn lean_each<'a>(
    ladder: &Ladder<'a>,
    count: usize,
) -> Result<Vec<(Tendency, Candidate<'a>)>, Error> {
    let mut found: Vec<(Tendency, Candidate)> = Vec::new();
    for tendency in Tendency::TRIED {
        if found.len() >= count {
            break;
        }
        let candidates = unless_refused(ladder.leaning(tendency).climb())?;
        let candidates = candidates.into_iter().flatten();
        let (unseen, seen): (Vec<_>, Vec<_>) = candidates.partition(has_unseen_walls);
        let is_usual = tendency == Tendency::Usual;
        let unseen = unseen.into_iter().take(usize::from(is_usual));
        let best = seen.into_iter().take(1).map(|best| (tendency, best));
        for (tendency, best) in best.chain(unseen.map(|best| (Tendency::UnseenWalls, best))) {
            let plan = &best.opened.plan;
            let is_known = |(_, known): &(_, Candidate)| have_same_cuts(&known.opened.plan, plan);
            if !found.iter().any(is_known) {
                found.push((tendency, best));
            }
        }
    }
    found.truncate(count);
    Ok(found)
}

/// Returns whether a plan has walls out of sight, of which only a kit says whether they hold
/// support.
fn has_unseen_walls(candidate: &Candidate) -> bool {
    candidate.opened.rung == Rung::UnseenWalls
}

/// A plan found by a tendency.
pub struct Leaning<'a> {
    /// The tendency.
    pub tendency: Tendency,
    /// The voids, cuts and pins.
    pub opened: Opened,
    /// The seams, as the usual plan looks at them.
    pub seams: Vec<SeamNote>,
    /// The resolver as the search left it.
    pub resolver: Resolver<'a>,
}

impl<'a> Leaning<'a> {
    /// Looks at the seams of a plan by the usual plan's request.
    fn new(tendency: Tendency, best: Candidate<'a>, request: &PlanRequest) -> Result<Self, Error> {
        let outer = best.opened.voids.hollowed.outer.mesh();
        Ok(Self {
            tendency,
            seams: cut::seams(outer, &best.opened.plan, request)?,
            opened: best.opened,
            resolver: best.resolver,
        })
    }
}
