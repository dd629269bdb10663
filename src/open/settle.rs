//! Settling: what bosses close or hide is kept solid too, and solved for again, until nothing is.

use super::plan::are_clean;
use super::resolve::Resolver;
use crate::base::verdict::Verdict;
use crate::cut::{
    CutError, CutOrder, CutPlan, Obstacle, PlanRequest, Unclean, find_closed, find_unclean,
    plan_around, plan_by,
};
use crate::error::Error;
use crate::mesh::TriMesh;
use crate::run::{Achieved, Refusal, Voids};

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

/// Voids with bosses in them, and the plan that opens them.
pub struct Settled {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
}

/// Bodies that must be kept solid too, or the settled plan.
enum Step {
    Done(CutPlan),
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
        if !voids.solution.is_usable() {
            return Ok(Verdict::No(Refusal::MakeGoalImpossible));
        }
        let now = Achieved::of(&voids);
        let ratio = terms.before.filled_ratio(&now);
        if ratio > policy.max_void_loss_ratio {
            return Ok(Verdict::No(Refusal::FillVoids { ratio }));
        }
        let price_ratio = terms.start.loss_ratio(&now);
        if price_ratio > terms.max_price_ratio {
            let loss_ratio = price_ratio;
            return Ok(Verdict::No(Refusal::CostTooMuch { loss_ratio }));
        }
        let loss_ratio = terms.before.loss_ratio(&now);
        if round > 0 && loss_ratio > terms.max_loss_ratio {
            return Ok(Verdict::No(Refusal::CostTooMuch { loss_ratio }));
        }
        let unclean = match replan(&voids, terms)? {
            Verdict::Found(Step::Done(plan)) => {
                return Ok(Verdict::Found(Settled { voids, plan }));
            }
            Verdict::Found(Step::Keep(unclean)) => unclean,
            Verdict::No(refusal) => return Ok(Verdict::No(refusal)),
        };
        let bodies = unclean.into_iter().flat_map(|unclean| unclean.bodies);
        let bodies: Vec<TriMesh> = bodies.collect();
        voids = resolver.without(&voids, &bodies, policy.settle_margin_openings)?;
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
                Step::Done(plan)
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
