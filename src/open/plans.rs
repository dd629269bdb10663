//! Several plans for one solution, each by another tendency.

use super::ladder::Ladder;
use super::refused::unless_refused;
use super::resolve::Resolver;
use super::tendency::have_same_cuts;
use crate::base::watch::Watch;
use crate::cut::{self, SeamNote};
use crate::error::Error;
use crate::run::{Opened, Placed, Solved, Tendency};

/// Opens the voids of a solution in several ways, each by another tendency; at most `count` of
/// them, the usual one first. Of plans with the same cuts only the first is kept.
pub fn climb_by_tendency<'a>(
    placed: &'a Placed,
    solved: Solved,
    count: usize,
    watch: &Watch,
) -> Result<Vec<Leaning<'a>>, Error> {
    let ladder = Ladder::new(placed, solved, watch)?;
    let mut found: Vec<Leaning> = Vec::new();
    for tendency in Tendency::ALL {
        if found.len() >= count {
            break;
        }
        let candidates = unless_refused(ladder.leaning(tendency).climb())?;
        let Some(best) = candidates.and_then(|candidates| candidates.into_iter().next()) else {
            continue;
        };
        let is_known = |known: &Leaning| have_same_cuts(&known.opened.plan, &best.opened.plan);
        if !found.iter().any(is_known) {
            let request = &ladder.request;
            let outer = best.opened.voids.hollowed.outer.mesh();
            found.push(Leaning {
                tendency,
                seams: cut::seams(outer, &best.opened.plan, request).map_err(Error::from)?,
                opened: best.opened,
                resolver: best.resolver,
            });
        }
    }
    Ok(found)
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
