//! The search for cuts and pins: among plans on a coarse copy of the body, then once on the body
//! itself.

use std::vec::IntoIter;

use super::build::{Found, build};
use super::ladder::Ladder;
use super::plan::is_planned;
use super::proxy::Proxy;
use super::resolve::Resolver;
use super::way::Candidate;
use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::run::{Placed, Solved};

/// Opens the voids of a solution, on the lowest rung that gives every joint its pins.
///
/// Returns the plans worth making, best first and never none. The later ones do less for the pins:
/// they are for a kit that breaks a promise with the first. Cuts that a person ordered stay.
pub fn climb<'a>(
    placed: &'a Placed,
    solved: Solved,
    watch: &Watch,
) -> Result<Candidates<'a>, Error> {
    let search = Search::new(placed, solved, watch)?;
    let found = search.find(|ladder| Ok(ladder.climb()?.into_iter().map(Found::of).collect()))?;
    Ok(match found {
        Some(found) => Candidates {
            whole: Some(search.whole),
            found: found.into_iter(),
            ready: Vec::new().into_iter(),
        },
        None => Candidates {
            ready: Ladder::new(search.whole)?.climb()?.into_iter(),
            whole: None,
            found: Vec::new().into_iter(),
        },
    })
}

/// The body, and a coarse copy of it if the planner may choose the cuts.
pub struct Search<'a> {
    /// The resolver of the body itself.
    pub whole: Resolver<'a>,
    proxy: Option<Proxy>,
}

impl<'a> Search<'a> {
    /// Draws the region that may be emptied, and copies the body.
    pub fn new(placed: &'a Placed, mut solved: Solved, watch: &Watch) -> Result<Self, Error> {
        watch.enter(Phase::Shell);
        let coarse = solved.coarse.take();
        let whole = Resolver::new(placed, solved, watch)?;
        let coarse = || coarse.map_or_else(|| whole.solved().clone(), |coarse| *coarse);
        let copy = || Proxy::new(placed, coarse(), watch);
        let proxy = is_planned(placed).then(copy).transpose()?;
        Ok(Self { whole, proxy })
    }

    /// Climbs the ladder of the copy in some way; `None` if there is no copy.
    pub fn find<T>(
        &self,
        climb: impl FnOnce(Ladder) -> Result<Vec<T>, Error>,
    ) -> Result<Option<Vec<T>>, Error> {
        let on = |proxy: &Proxy| climb(Ladder::new(proxy.resolver(&self.whole)?)?);
        self.proxy.as_ref().map(on).transpose()
    }
}

/// The plans worth making, best first. Each is built when it is asked for.
pub struct Candidates<'a> {
    /// The resolver of the body itself; `None` once it was climbed.
    whole: Option<Resolver<'a>>,
    /// The plans found on its copy that are not built yet.
    found: IntoIter<Found>,
    /// The plans that are built.
    ready: IntoIter<Candidate<'a>>,
}

impl<'a> Candidates<'a> {
    /// Builds the next plan. If the body does not bear it out, the ladder of the body is climbed.
    fn build_next(&mut self) -> Result<Option<Candidate<'a>>, Error> {
        let Some(found) = self.found.next() else {
            return Ok(None);
        };
        let Some(whole) = self.whole.take() else {
            return Ok(None);
        };
        if let Some(candidate) = build(&whole, found)? {
            self.whole = Some(whole);
            return Ok(Some(candidate));
        }
        self.ready = Ladder::new(whole)?.climb()?.into_iter();
        Ok(self.ready.next())
    }
}

impl<'a> Iterator for Candidates<'a> {
    type Item = Result<Candidate<'a>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        let ready = self.ready.next().map(Ok);
        ready.or_else(|| self.build_next().transpose())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives;
    use crate::open::scenes::{LEAN, cuboid, lopsided, solve, standing};

    /// Returns a ball on a foot: a round body, whose copy has far fewer triangles.
    fn ball_on_a_foot() -> Placed {
        let foot = cuboid([-8.0, -8.0, -16.0], [8.0, 8.0, -10.0]);
        let mut placed = standing(
            &[primitives::ball(&Point::origin(), 15.0, 4), foot],
            1.5,
            LEAN,
        );
        placed.policy.jigs_first = true;
        placed
    }

    fn search_of(placed: &Placed) -> Search<'_> {
        Search::new(placed, solve(placed), &Watch::silent()).unwrap()
    }

    fn find_all(search: &Search) -> Vec<Found> {
        let all = |ladder: Ladder| Ok(ladder.climb()?.into_iter().map(Found::of).collect());
        search.find(all).unwrap().unwrap()
    }

    #[test]
    fn the_copy_has_less_to_cut_than_the_body() {
        let placed = ball_on_a_foot();
        let search = search_of(&placed);
        let copy = search
            .proxy
            .as_ref()
            .unwrap()
            .resolver(&search.whole)
            .unwrap();
        let count = |resolver: &Resolver| {
            let voids = resolver.clone().draw().unwrap();
            voids.hollowed.to_mesh().triangles().len()
        };
        let [few, many] = [&copy, &search.whole].map(count);
        assert!(2 * few < many, "{few} of {many}");
    }

    #[test]
    fn plans_found_on_the_copy_are_built_of_the_bodys_own_surfaces() {
        let placed = ball_on_a_foot();
        let candidates = climb(&placed, solve(&placed), &Watch::silent()).unwrap();
        assert!(candidates.ready.len() == 0 && candidates.found.len() > 0);
        for candidate in candidates {
            let opened = candidate.unwrap().opened;
            let outer = opened.voids.hollowed.outer.mesh();
            assert_eq!(outer.vertices(), placed.solid().mesh().vertices());
            assert!(opened.plan.joints.iter().all(|joint| joint.is_aligned()));
            assert!(opened.voids.solution.is_usable());
        }
    }

    #[test]
    fn a_plan_that_the_body_does_not_bear_out_is_not_built() {
        // Only a void in its tower brings this body to its goal.
        let placed = lopsided();
        let search = search_of(&placed);
        for found in find_all(&search) {
            assert!(build(&search.whole, found).unwrap().is_some());
        }
        let candidates = Ladder::new(search.whole.clone()).unwrap().climb().unwrap();
        for mut candidate in candidates {
            let all = cuboid([-50.0; 3], [50.0; 3]);
            let voids = candidate.opened.voids.clone();
            let solved = candidate.resolver.solve_with_bosses(&voids, &[all]);
            assert!(!solved.unwrap().solution.is_usable());
            let found = Found::of(candidate);
            assert!(build(&search.whole, found).unwrap().is_none());
        }
    }
}
