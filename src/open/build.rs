//! An ordered plan, tried out on a copy of the body and then built on the body itself.

use super::aligned::count_unaligned_of;
use super::ladder::Ladder;
use super::plan::are_clean;
use super::proxy::Bodies;
use super::refused::unless_refused;
use super::resolve::Kept;
use super::way::Candidate;
use crate::base::verdict::Verdict;
use crate::cut::{
    Cut, CutId, CutMove, CutOrder, CutPlan, Hollowed, draft_again, finish_draft, keeps_socket_walls,
};
use crate::error::Error;
use crate::geom::Point;
use crate::run::{Achieved, BossRound, Opened, Policy};

/// A plan on the copy of the body, with what it keeps solid there.
pub struct Planned {
    /// The voids, cuts and pins.
    pub opened: Opened,
    kept: Kept,
}

impl Planned {
    /// Returns the plan of a candidate.
    pub fn of(candidate: Candidate) -> Self {
        Self {
            kept: candidate.resolver.kept(),
            opened: candidate.opened,
        }
    }

    /// Returns whether another plan with the same cuts and pins is as good.
    fn is_matched_by(&self, other: &Self, policy: &Policy) -> bool {
        let achieved = |planned: &Self| Achieved::of(&planned.opened.voids);
        let loss_ratio = achieved(self).loss_ratio(&achieved(other));
        is_borne_out_by(&self.opened, &other.opened) && loss_ratio <= policy.replay_loss_ratio
    }

    /// Returns whether a plan is as good as this one.
    fn is_borne_out_by(&self, built: &Opened) -> bool {
        is_borne_out_by(&self.opened, built)
    }
}

/// Plans an order on the copy: finds what it must keep solid, in as many rounds as that takes.
/// `None` if the copy does not bear it.
pub fn plan_order(bodies: &Bodies, order: &CutOrder) -> Result<Option<Planned>, Error> {
    let copy = bodies.copy()?.by_order(order.clone());
    let planned = first_of(Ladder::new(copy).and_then(Ladder::climb))?;
    Ok(planned.map(Planned::of))
}

/// Builds a plan that was found on the copy. `None` if the body does not bear it out.
///
/// It goes the way of the same cuts and pins ordered by a person, if that leads as far. Then the
/// plan in the kit makes the same kit again.
pub fn build_found<'a>(
    bodies: &Bodies<'a>,
    found: &Planned,
) -> Result<Option<Candidate<'a>>, Error> {
    let (order, moves) = if bodies.whole.planner().is_free() {
        on_layers(bodies, &found.opened)?
    } else {
        (CutOrder::of(&found.opened.plan), Vec::new())
    };
    let policy = &bodies.whole.placed().policy;
    let again = plan_order(bodies, &order)?;
    let again = again.filter(|again| found.is_matched_by(again, policy));
    // A pin that the copy has room for may have none in the body.
    let bare = CutOrder {
        pins: None,
        ..order.clone()
    };
    let built = build(bodies, &[order, bare], again.as_ref().unwrap_or(found))?;
    Ok(built.map(|mut built| {
        built.opened.rung = found.opened.rung;
        built.opened.remarks.clone_from(&found.opened.remarks);
        built.opened.plan.moves = moves;
        built
    }))
}

/// Returns the order of a plan that was found on the copy, and the moves of its cuts. They moved to
/// whole layers of the body's own parts: the copy's parts stand a little higher or lower.
fn on_layers(bodies: &Bodies, found: &Opened) -> Result<(CutOrder, Vec<CutMove>), Error> {
    let order = CutOrder::of(&found.plan);
    let hollowed = Hollowed {
        voids: found.voids.hollowed.voids.clone(),
        ..bodies.whole.given().clone()
    };
    let draft = draft_again(&hollowed, &found.request, &found.plan)?;
    let Verdict::Found(draft) = draft else {
        return Ok((order, Vec::new()));
    };
    let moved = finish_draft(&hollowed, &found.request, draft).map_err(Error::from);
    let moved = unless_refused(moved)?;
    let names = |cuts: &[Cut]| -> Vec<CutId> { cuts.iter().map(|cut| cut.id.clone()).collect() };
    let is_same = |moved: &CutPlan| names(&moved.cuts) == names(&order.cuts);
    let Some(moved) = moved.filter(is_same) else {
        return Ok((order, Vec::new()));
    };
    let mut pins = found.plan.pins.clone();
    for pin in &mut pins {
        if let Some(cut) = moved.cuts.iter().find(|cut| cut.id == pin.cut) {
            let (center, plane) = (Point::from(pin.center_mm), cut.plane()?);
            pin.center_mm = (center - plane.normal * plane.distance(&center)).into();
        }
    }
    let order = CutOrder {
        cuts: moved.cuts,
        pins: Some(pins),
        ..order
    };
    Ok((order, moved.moves))
}

/// Builds an ordered plan on the body itself, with what it keeps solid on the copy. So the body is
/// solved and drawn a few times only. The orders are tried in turn. `None` if the body does not
/// bear out any.
pub fn build<'a>(
    bodies: &Bodies<'a>,
    orders: &[CutOrder],
    planned: &Planned,
) -> Result<Option<Candidate<'a>>, Error> {
    let ladder = Ladder::after(bodies.whole.clone(), &planned.opened, &planned.kept)?;
    let Some(ladder) = ladder else {
        return Ok(None);
    };
    for order in orders {
        let built = first_of(ladder.by_order(order.clone()).climb())?;
        let built = built.filter(|built| planned.is_borne_out_by(&built.opened));
        if let Some(mut built) = built {
            // A jig that holds on the copy may not hold on the body.
            if count_unaligned_of(&built.opened)? > count_unaligned_of(&planned.opened)? {
                continue;
            }
            // A pin that the copy has room for may lie too near the body's outside.
            let Opened { voids, plan, .. } = &built.opened;
            if !keeps_socket_walls(&voids.hollowed, plan, &built.opened.request) {
                continue;
            }
            built.opened.bosses = join(&planned.opened.bosses, built.opened.bosses);
            return Ok(Some(built));
        }
    }
    Ok(None)
}

/// Returns the best of the plans that a ladder found; `None` if it found none.
fn first_of<'a>(
    climbed: Result<Vec<Candidate<'a>>, Error>,
) -> Result<Option<Candidate<'a>>, Error> {
    Ok(unless_refused(climbed)?.and_then(|climbed| climbed.into_iter().next()))
}

/// Returns whether a plan is as good as planned. It meets the goal, is as clean, and has as many
/// joints with pins that fit one way only. Corrections of the body may bring voids that the copy
/// was too coarse for: the plan must know them all.
fn is_borne_out_by(planned: &Opened, built: &Opened) -> bool {
    let is_clean = |opened: &Opened| are_clean(&opened.plan, &opened.request);
    built.voids.solution.is_usable()
        && built.plan.voids.len() == built.voids.hollowed.voids.len()
        && (is_clean(built) || !is_clean(planned))
        && count_lacking(built) <= count_lacking(planned)
}

/// Counts the joints without pins that fit one way only.
fn count_lacking(opened: &Opened) -> usize {
    let joints = opened.plan.joints.iter();
    joints.filter(|joint| !joint.is_aligned()).count()
}

/// Returns the rounds of bosses on the copy and then those on the body, each pin's boss once.
fn join(copied: &[BossRound], built: Vec<BossRound>) -> Vec<BossRound> {
    let anew: Vec<[f64; 3]> = {
        let bosses = built.iter().flat_map(|round| &round.bosses);
        bosses.map(|boss| boss.pin.center_mm).collect()
    };
    let mut rounds = copied.to_vec();
    for round in &mut rounds {
        let bosses = &mut round.bosses;
        bosses.retain(|boss| !anew.contains(&boss.pin.center_mm));
    }
    rounds.retain(|round| !round.bosses.is_empty());
    rounds.extend(built);
    rounds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::open::scenes::{cuboid, lopsided, solve};

    #[test]
    fn a_plan_that_the_body_does_not_bear_out_is_not_built() {
        // Only a void in its tower brings this body to its goal.
        let placed = lopsided();
        let bodies = Bodies::new(&placed, solve(&placed), &Watch::silent()).unwrap();
        let copy = Ladder::new(bodies.copy().unwrap()).unwrap();
        for mut candidate in copy.climb().unwrap() {
            let orders = [CutOrder {
                pins: None,
                ..CutOrder::of(&candidate.opened.plan)
            }];
            let all = cuboid([-50.0; 3], [50.0; 3]);
            let voids = candidate.opened.voids.clone();
            let before = Planned {
                kept: candidate.resolver.kept(),
                opened: candidate.opened.clone(),
            };
            assert!(build(&bodies, &orders, &before).unwrap().is_some());
            let solved = candidate.resolver.solve_with_bosses(&voids, &[all]);
            assert!(!solved.unwrap().solution.is_usable());
            let after = Planned::of(candidate);
            assert!(build(&bodies, &orders, &after).unwrap().is_none());
        }
    }

    #[test]
    fn a_plan_that_loses_more_when_a_person_orders_it_keeps_what_the_search_found() {
        let mut placed = lopsided();
        let build_first = |placed: &crate::run::Placed| {
            let bodies = Bodies::new(placed, solve(placed), &Watch::silent()).unwrap();
            let copy = Ladder::new(bodies.copy().unwrap()).unwrap();
            let found = Planned::of(copy.climb().unwrap().remove(0));
            let again = plan_order(&bodies, &CutOrder::of(&found.opened.plan));
            let is_matched = found.is_matched_by(&again.unwrap().unwrap(), &placed.policy);
            let built = build_found(&bodies, &found).unwrap().unwrap();
            (is_matched, built.opened.voids.solution.is_usable())
        };
        assert_eq!(build_first(&placed), (true, true));
        placed.policy.replay_loss_ratio = -1.0;
        assert_eq!(build_first(&placed), (false, true));
    }
}
