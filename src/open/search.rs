//! The search for cuts and pins: among plans on a coarse copy of the body, then once on the body
//! itself.

use std::vec::IntoIter;

use super::build::{Planned, build, build_found, plan_order};
use super::drained::drained;
use super::ladder::Ladder;
use super::proxy::Bodies;
use super::refused::unless_refused;
use super::way::Candidate;
use crate::base::watch::Watch;
use crate::cut::CutOrder;
use crate::error::Error;
use crate::run::{Placed, Rung, Solved};

/// Opens the voids of a solution, on the lowest rung that gives every joint its pins.
///
/// Returns the plans worth making, best first and never none. The later ones do less for the pins:
/// they are for a kit that breaks a promise with the first. Cuts that a person ordered stay.
pub fn climb<'a>(
    placed: &'a Placed,
    solved: Solved,
    watch: &Watch,
) -> Result<Candidates<'a>, Error> {
    if placed.is_drained() {
        return Ok(Candidates::of_one(drained(placed, solved, watch)?));
    }
    let bodies = Bodies::new(placed, solved, watch)?;
    let planner = bodies.whole.planner();
    let found = match planner.order().filter(|_| planner.pins().is_some()) {
        Some(order) => vec![Found::Ordered(order.clone())],
        None => find(&bodies)?,
    };
    if found.is_empty() {
        return Candidates::of_body(bodies);
    }
    Ok(Candidates {
        bodies: Some(bodies),
        found: found.into_iter(),
        ready: Vec::new().into_iter(),
    })
}

/// A plan to be built.
enum Found {
    /// A plan that was found on the copy.
    Searched(Box<Planned>),
    /// A plan that a person ordered, pins and all.
    Ordered(CutOrder),
}

impl Found {
    /// Returns whether another plan stands behind it that is known to be clean.
    fn is_trial(&self) -> bool {
        matches!(self, Self::Searched(found) if found.opened.rung == Rung::UnseenWalls)
    }

    /// Builds it on the body itself; `None` if the body does not bear it out.
    fn build<'a>(&self, bodies: &Bodies<'a>) -> Result<Option<Candidate<'a>>, Error> {
        let order = match self {
            Self::Searched(found) => return build_found(bodies, found),
            Self::Ordered(order) => order,
        };
        match plan_order(bodies, order)? {
            Some(planned) => build(bodies, std::slice::from_ref(order), &planned),
            None => Ok(None),
        }
    }
}

/// Climbs the ladder of the copy. Returns the plans worth building, best first; none if the
/// copy cannot be opened.
fn find(bodies: &Bodies) -> Result<Vec<Found>, Error> {
    let copy = bodies.copy()?;
    let budget = copy.budget().clone();
    let climbed = Ladder::new(copy).and_then(Ladder::climb);
    let climbed = unless_refused(climbed)?.into_iter().flatten();
    let found = climbed.map(|mut best| {
        best.opened.remarks.extend(budget.remark());
        Found::Searched(Box::new(Planned::of(best)))
    });
    Ok(found.collect())
}

/// The plans worth making, best first. Each is built when it is asked for.
pub struct Candidates<'a> {
    /// The body and its copy; `None` once the ladder of the body was climbed.
    bodies: Option<Bodies<'a>>,
    /// The plans that are not built yet.
    found: IntoIter<Found>,
    /// The plans that are built.
    ready: IntoIter<Candidate<'a>>,
}

impl<'a> Candidates<'a> {
    /// Returns the only plan of a piece that is not cut.
    fn of_one(candidate: Candidate<'a>) -> Self {
        Self {
            bodies: None,
            found: Vec::new().into_iter(),
            ready: vec![candidate].into_iter(),
        }
    }

    /// Climbs the ladder of the body itself.
    fn of_body(bodies: Bodies<'a>) -> Result<Self, Error> {
        let budget = bodies.whole.budget().clone();
        let mut climbed = Ladder::new(bodies.whole)?.climb()?;
        for candidate in &mut climbed {
            candidate.opened.remarks.extend(budget.remark());
        }
        Ok(Self {
            bodies: None,
            found: Vec::new().into_iter(),
            ready: climbed.into_iter(),
        })
    }

    /// Builds the next plan. If the body does not bear it out, the ladder of the body is climbed.
    fn build_next(&mut self) -> Result<Option<Candidate<'a>>, Error> {
        let (Some(found), Some(bodies)) = (self.found.next(), self.bodies.take()) else {
            return Ok(None);
        };
        if let Some(candidate) = found.build(&bodies)? {
            self.bodies = Some(bodies);
            return Ok(Some(candidate));
        }
        if found.is_trial() {
            self.bodies = Some(bodies);
            return self.build_next();
        }
        *self = Self::of_body(bodies)?;
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
    use crate::open::resolve::Resolver;
    use crate::open::scenes::{LEAN, cuboid, lopsided, solve, standing};
    use crate::run::Opened;

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

    fn bodies_of(placed: &Placed) -> Bodies<'_> {
        Bodies::new(placed, solve(placed), &Watch::silent()).unwrap()
    }

    #[test]
    fn the_copy_has_less_to_cut_than_the_body() {
        let placed = ball_on_a_foot();
        let bodies = bodies_of(&placed);
        let count = |resolver: &Resolver| {
            let voids = resolver.clone().draw().unwrap();
            voids.hollowed.to_mesh().triangles().len()
        };
        let [few, many] = [&bodies.copy().unwrap(), &bodies.whole].map(count);
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
    fn a_plan_that_was_found_makes_the_same_kit_when_a_person_orders_it() {
        let first = |placed: &Placed| {
            let mut candidates = climb(placed, solve(placed), &Watch::silent()).unwrap();
            candidates.next().unwrap().unwrap().opened
        };
        let mut placed = ball_on_a_foot();
        let found = first(&placed);
        placed.job.plan = Some(CutOrder::of(&found.plan));
        let again = first(&placed);
        assert_eq!(found.plan.pins, again.plan.pins);
        let drawn = |opened: &Opened| opened.voids.hollowed.to_mesh();
        assert_eq!(drawn(&found).vertices(), drawn(&again).vertices());
    }

    #[test]
    fn a_trial_that_the_body_does_not_bear_out_gives_way_to_the_next_plan() {
        let placed = lopsided();
        let bodies = || Bodies::new(&placed, solve(&placed), &Watch::silent()).unwrap();
        let of_both = |rung: Rung| {
            let bodies = bodies();
            let copy = Ladder::new(bodies.copy().unwrap()).unwrap();
            let mut usual = copy.climb().unwrap().remove(0);
            let good = Planned::of(usual.clone());
            // Nothing opens its void.
            usual.opened.plan.cuts.clear();
            usual.opened.rung = rung;
            let found = [Planned::of(usual), good].map(|plan| Found::Searched(Box::new(plan)));
            let mut candidates = Candidates {
                bodies: Some(bodies),
                found: Vec::from(found).into_iter(),
                ready: Vec::new().into_iter(),
            };
            let built = candidates.next().unwrap().unwrap().opened;
            (
                built.voids.solution.is_usable(),
                candidates.bodies.is_some(),
            )
        };
        assert_eq!(of_both(Rung::UnseenWalls), (true, true));
        assert_eq!(of_both(Rung::Walls), (true, false), "the body is searched");
    }

    #[test]
    fn a_body_whose_copy_cannot_be_opened_is_planned_itself() {
        let mut placed = ball_on_a_foot();
        placed.job.plan = Some(CutOrder::default());
        // Neither of them has a plan without cuts, and the body's own error says so.
        let refused = climb(&placed, solve(&placed), &Watch::silent());
        assert!(matches!(refused, Err(Error::Cut(_))));
    }
}
