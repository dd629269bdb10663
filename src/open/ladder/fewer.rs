//! Few parts: plans with fewer parts than the usual one, taken in its place or offered beside it.

use super::Ladder;
use super::joined::{Fewer, Joined, fault_of, fault_of_draft};
use crate::cut::PlanRequest;
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::tendency::{lean, with_fewer_parts};
use crate::open::way::Way;
use crate::run::{Remark, Rung, Tendency, Untried};

impl<'a> Ladder<'a> {
    /// Places the pins of a draft, or of one with fewer parts in its place.
    ///
    /// That is taken if it costs next to nothing of the goal's figure. It may cost more if all its
    /// joints have pins, and some of the other have neither pins nor jigs. Else both are compared
    /// with their bosses ([`Self::weigh_fewer_parts`]).
    pub(super) fn join_parts(&mut self, usual: Way<'a>) -> Result<Joined<'a>, Error> {
        let Some(fewer) = self.draft_fewer_parts(&usual)? else {
            return Ok(Joined::alone(self.finish(usual)?));
        };
        let is_as_good = self.is_as_good(&fewer, &usual)?;
        let loss_ratio = fewer.loss_ratio(&usual);
        if self.hides_more(&fewer, &usual)? {
            self.take_hidden(&fewer, &usual);
            return Ok(Joined::alone(self.finish(fewer)?));
        }
        if is_as_good && loss_ratio <= self.policy.part_loss_ratio {
            self.request = fewer.request.clone();
            return Ok(Joined::alone(self.finish(fewer)?));
        }
        let usual = self.finish(usual)?;
        let is_worth = is_as_good && loss_ratio <= self.policy.aligned_loss_ratio;
        let is_loose = if self.policy.jigs_first {
            usual.count_unaligned()? > 0
        } else {
            !usual.is_full()
        };
        if is_worth && is_loose {
            let fewer = self.finish(fewer.clone())?;
            if fewer.is_full() {
                self.request = fewer.request.clone();
                self.notes.push(fewer.price(&usual));
                return Ok(Joined::alone(fewer));
            }
        }
        Ok(Joined {
            walls: usual,
            fewer: Some(Fewer {
                draft: fewer,
                is_as_good,
            }),
        })
    }

    /// Returns whether the voids of a plan are as clean as those of another, its seams as well
    /// hidden, and its promise as well kept.
    pub(super) fn is_as_good(&self, fewer: &Way, usual: &Way) -> Result<bool, Error> {
        let is_faultless = fault_of_draft(fewer, usual, &self.policy)?.is_none();
        Ok(is_faultless && fewer.keeps_angle_of(usual))
    }

    /// Returns whether a plan with fewer parts hides a seam that is seen in the other, at a loss
    /// that a hidden seam may cost.
    fn hides_more(&self, fewer: &Way, usual: &Way) -> Result<bool, Error> {
        let (policy, usual_price) = (&self.policy, usual.seam_price()?);
        if !(self.is_free() && self.hides_seams) || usual_price <= policy.dear_seam_ratio {
            return Ok(false);
        }
        let cost = policy.hidden_cost(fewer.seam_price()?, fewer.loss_ratio(usual));
        Ok(fewer.hides_worth(usual, policy) && cost < usual_price)
    }

    /// Keeps to a plan whose seams are hidden, and says what it costs.
    fn take_hidden(&mut self, hidden: &Way<'a>, usual: &Way<'a>) {
        self.request = hidden.request.clone();
        self.notes
            .retain(|note| !matches!(note, Remark::Seams { .. }));
        self.notes.push(Remark::Seams {
            loss_ratio: Some(hidden.loss_ratio(usual)),
            is_taken: true,
        });
    }

    /// Places the pins of a plan with fewer parts, and compares both plans with their pins.
    ///
    /// It takes that one if it costs next to nothing of the goal's figure, or little and hides a
    /// seam. Else the sheet offers it.
    ///
    /// Returns the plan with bosses, and the one without.
    pub(super) fn weigh_fewer_parts(
        &mut self,
        (usual, walls): (Way<'a>, Way<'a>),
        fewer: Fewer<'a>,
    ) -> Result<(Way<'a>, Way<'a>), Error> {
        let placed = self
            .finish(fewer.draft)
            .and_then(|walls| Ok((self.add_bosses(walls.clone(), Rung::Bosses)?, walls)));
        let Some((few, few_walls)) = unless_refused(placed)? else {
            return Ok((usual, walls));
        };
        let is_cheap = fewer.is_as_good && few.loss_ratio(&usual) <= self.policy.part_loss_ratio;
        let hides_more = self.hides_more(&few, &usual)?;
        if (is_cheap || hides_more) && few.count_unaligned()? <= usual.count_unaligned()? {
            self.notes.retain(|note| !is_offer_of_fewer(note));
            if hides_more {
                self.take_hidden(&few, &usual);
            } else {
                self.request = few.request.clone();
            }
            return Ok((few, few_walls));
        }
        // A figure without cuts is solid: the sheet says what that does.
        let has_cuts = few.bossed.plan.count_parts() > 1;
        if has_cuts && few.loss_ratio(&usual) <= self.policy.offered_loss_ratio {
            self.notes.retain(|note| !is_offer_of_fewer(note));
            let certificate = |way: &Way| way.bossed.voids.solution.certificate;
            let fault = fault_of(&few, &usual, &self.policy)?;
            self.notes.push(Remark::FewerParts {
                parts: [&few, &usual].map(|way| way.bossed.plan.count_parts()),
                figure: certificate(&usual).figure,
                values: [&few, &usual].map(|way| certificate(way).value),
                fault,
            });
        }
        Ok((usual, walls))
    }

    /// Drafts a plan with fewer parts than one with more than two; `None` if there is none.
    pub(super) fn draft_fewer_parts(&self, usual: &Way<'a>) -> Result<Option<Way<'a>>, Error> {
        if !self.seeks_fewer_parts(usual) {
            return Ok(None);
        }
        self.draft_of_fewer(usual, with_fewer_parts(self.request.clone()))
    }

    /// Drafts a plan with the fewest parts, such as one cut at a neck, though it leaves more of a
    /// void solid; `None` if it has no fewer than the plan.
    pub(super) fn draft_fewest_parts(&self, usual: &Way<'a>) -> Result<Option<Way<'a>>, Error> {
        if !self.seeks_fewer_parts(usual) {
            return Ok(None);
        }
        let request = lean(self.request.clone(), Tendency::FewerParts);
        self.draft_of_fewer(usual, request)
    }

    /// Returns whether a plan with fewer parts is sought.
    fn seeks_fewer_parts(&self, usual: &Way<'a>) -> bool {
        let has_many = usual.bossed.plan.count_parts() > 2;
        let is_sought = self.joins_parts && self.is_free() && has_many;
        is_sought && self.budget().allows(Untried::FewerParts)
    }

    /// Drafts a plan by a request for fewer parts; `None` if it has no fewer.
    fn draft_of_fewer(
        &self,
        usual: &Way<'a>,
        request: PlanRequest,
    ) -> Result<Option<Way<'a>>, Error> {
        let parts = usual.bossed.plan.count_parts();
        let fewer = self.plan_in_walls(&self.ground, &request, Rung::FewerCuts, &|_| false);
        let is_better = |way: &Way| {
            way.bossed.plan.count_parts() < parts && way.bossed.voids.solution.is_usable()
        };
        Ok(unless_refused(fewer)?.filter(is_better))
    }
}

/// Returns whether a remark offers a plan with fewer parts.
fn is_offer_of_fewer(note: &Remark) -> bool {
    matches!(note, Remark::FewerParts { .. })
}
