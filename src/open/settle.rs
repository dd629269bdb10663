//! Settling: what bosses close or hide is kept solid too, and solved for again, until nothing is.

use super::plan::are_clean;
use super::resolve::{Refused, Resolver};
use crate::base::verdict::Verdict;
use crate::cut::{
    CutError, CutOrder, CutPlan, Obstacle, PlanRequest, Unclean, find_closed, find_unclean,
    plan_around, plan_by,
};
use crate::error::Error;
use crate::mass::Moments;
use crate::mesh::TriMesh;
use crate::run::{Achieved, Policy, Refusal, Voids};

/// The terms on which bosses are taken.
#[derive(Clone, Copy)]
pub struct Terms<'a> {
    /// The cuts and pins.
    pub order: &'a CutOrder,
    /// True if a person ordered the pins: then no joint gets others.
    pub is_ordered: bool,
    /// The request for plans.
    pub request: &'a PlanRequest,
    /// Times that something more may be kept solid.
    pub rounds: usize,
    /// True if every void must be clean in the end.
    pub must_be_clean: bool,
    /// The figure and the voids without the bosses.
    pub before: Achieved,
    /// Greatest loss of the figure once more than the bosses is kept solid.
    pub max_loss_ratio: f64,
    /// The figure and the voids before any boss.
    pub start: Achieved,
    /// Greatest loss of the figure from that.
    pub max_price_ratio: f64,
}

impl Terms<'_> {
    /// Returns why voids with bosses are refused by their figures; `None` if they are not.
    pub fn refuse(&self, voids: &Voids, kept_more: bool, policy: &Policy) -> Option<Refusal> {
        if !voids.solution.is_usable() {
            return Some(Refusal::MakeGoalImpossible);
        }
        let now = Achieved::of(voids);
        let ratio = self.before.filled_ratio(&now);
        if ratio > policy.max_void_loss_ratio {
            return Some(Refusal::FillVoids { ratio });
        }
        let price_ratio = self.start.loss_ratio(&now);
        let loss_ratio = self.before.loss_ratio(&now);
        let too_much = if price_ratio > self.max_price_ratio {
            Some(price_ratio)
        } else {
            (kept_more && loss_ratio > self.max_loss_ratio).then_some(loss_ratio)
        };
        too_much.map(|loss_ratio| Refusal::CostTooMuch { loss_ratio })
    }
}

/// Voids with bosses in them, and the plan that opens them.
pub struct Settled {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
}

/// Bodies that must be kept solid too, or the settled plan.
enum Step {
    Done(Box<CutPlan>),
    Keep(Vec<Unclean>),
}

/// Plans around the bosses and keeps solid what the cuts leave closed or unclean, until nothing is
/// left. The resolver stays as the last round left it.
pub fn settle(
    resolver: &mut Resolver,
    mut voids: Voids,
    terms: &Terms,
) -> Result<Verdict<Settled, Refusal>, Error> {
    let policy = resolver.placed().policy;
    for round in 0..=terms.rounds {
        resolver.watch().check()?;
        let kept_more = round > 0;
        if let Some(refusal) = terms.refuse(&voids, kept_more, &policy) {
            return Ok(Verdict::No(refusal));
        }
        let unclean = match replan(&voids, terms)? {
            Verdict::Found(Step::Done(plan)) => {
                let voids = resolver.correct(voids, Moments::default())?;
                let plan = *plan;
                return Ok(Verdict::Found(Settled { voids, plan }));
            }
            Verdict::Found(Step::Keep(unclean)) => unclean,
            Verdict::No(refusal) => return Ok(Verdict::No(refusal)),
        };
        let bodies = unclean.into_iter().flat_map(|unclean| unclean.bodies);
        let bodies: Vec<TriMesh> = bodies.collect();
        let refused = Refused {
            bodies: &bodies,
            margin_openings: policy.settle_margin_openings,
            is_lost: &|voids| terms.refuse(voids, true, &policy).is_some(),
        };
        voids = resolver.without(&voids, &refused)?;
    }
    Ok(Verdict::No(Refusal::LeaveUncleanVoid))
}

/// Plans the ordered cuts for the voids as they are now.
fn replan(voids: &Voids, terms: &Terms) -> Result<Verdict<Step, Refusal>, Error> {
    let plan_for = if terms.is_ordered {
        plan_by
    } else {
        plan_around
    };
    match plan_for(&voids.hollowed, terms.request, terms.order)? {
        Verdict::Found(plan) => {
            let unclean = list_unclean(voids, &plan, terms)?;
            Ok(Verdict::Found(if unclean.is_empty() {
                Step::Done(Box::new(plan))
            } else {
                Step::Keep(unclean)
            }))
        }
        Verdict::No(Obstacle::ClosedCavity { .. }) => {
            let closed = find_closed(&voids.hollowed, &terms.order.cuts)?;
            Ok(if closed.is_empty() {
                Verdict::No(Refusal::CloseVoid)
            } else {
                Verdict::Found(Step::Keep(closed))
            })
        }
        // What was kept solid has changed the faces that the bosses' pins stood in.
        Verdict::No(Obstacle::PinOffFace { .. }) if !terms.is_ordered => {
            Ok(Verdict::No(Refusal::MoveJoint))
        }
        Verdict::No(obstacle) => Err(CutError::from(obstacle).into()),
    }
}

/// Finds the voids that a plan leaves unclean, if they must be clean.
fn list_unclean(voids: &Voids, plan: &CutPlan, terms: &Terms) -> Result<Vec<Unclean>, CutError> {
    if !terms.must_be_clean || are_clean(plan, terms.request) {
        return Ok(Vec::new());
    }
    let mut unclean = find_unclean(&voids.hollowed, plan, terms.request, false)?;
    unclean.retain(|found| {
        let void = &plan.voids[found.void.index()];
        !void.is_clean_without_margin(terms.request)
    });
    Ok(unclean)
}

#[cfg(test)]
mod tests;
