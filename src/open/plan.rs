//! One plan for voids as they are: the planner's, or the one that a person ordered.

use std::sync::Arc;

use crate::base::verdict::Verdict;
use crate::cut::{self, CutError, CutOrder, CutPlan, Obstacle, PinSite, PlanRequest, plan_by};
use crate::job::CutMode;
use crate::run::{Placed, Voids};

/// What decides on the cuts.
#[derive(Clone)]
pub enum Planner {
    /// The planner chooses them.
    Free,
    /// They are ordered by a person, or by a search that found them on a copy of the body.
    Ordered(Arc<CutOrder>),
}

impl Planner {
    /// Returns what decides in this job.
    pub fn of(placed: &Placed) -> Self {
        match (&placed.job.plan, placed.job.cut) {
            (Some(order), _) => Self::Ordered(Arc::new(order.clone())),
            (None, CutMode::Never) => Self::Ordered(Arc::default()),
            (None, CutMode::Auto) => Self::Free,
        }
    }

    /// Returns whether other cuts may be chosen.
    pub fn is_free(&self) -> bool {
        matches!(self, Self::Free)
    }

    /// Returns the order; `None` if there is none.
    pub fn order(&self) -> Option<&CutOrder> {
        match self {
            Self::Free => None,
            Self::Ordered(order) => Some(order),
        }
    }

    /// Returns the pins that are ordered; `None` if they are to be placed.
    pub fn pins(&self) -> Option<&[PinSite]> {
        self.order().and_then(|order| order.pins.as_deref())
    }

    /// Plans cuts and pins for the voids as they are.
    pub fn plan(
        &self,
        voids: &Voids,
        request: &PlanRequest,
    ) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
        let hollowed = &voids.hollowed;
        let Some(order) = self.order() else {
            return cut::plan(hollowed, request);
        };
        match plan_by(hollowed, request, order)? {
            // The pin may stand in a boss that is still to be kept solid.
            Verdict::No(Obstacle::PinOffFace { .. }) => {
                let without_pins = CutOrder {
                    pins: Some(Vec::new()),
                    ..order.clone()
                };
                plan_by(hollowed, request, &without_pins)
            }
            plan => Ok(plan),
        }
    }

    /// Drafts cuts for the voids as they are: a plan without pins, if the cuts are chosen.
    pub fn draft(
        &self,
        voids: &Voids,
        request: &PlanRequest,
    ) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
        if self.is_free() {
            cut::draft(&voids.hollowed, request)
        } else {
            self.plan(voids, request)
        }
    }

    /// Returns the plan of a [`draft`](Self::draft) for the same voids.
    pub fn finish(
        &self,
        voids: &Voids,
        request: &PlanRequest,
        draft: CutPlan,
    ) -> Result<CutPlan, CutError> {
        if self.is_free() {
            cut::finish_draft(&voids.hollowed, request, draft)
        } else {
            Ok(draft)
        }
    }
}

/// Returns whether every void of a plan is clean by the printer's rule.
///
/// The planner's own margin is not asked: to solve again for it costs more than any boss.
pub fn are_clean(plan: &CutPlan, request: &PlanRequest) -> bool {
    let mut voids = plan.voids.iter();
    voids.all(|void| void.is_clean_without_margin(request))
}
