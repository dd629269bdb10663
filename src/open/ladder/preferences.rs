//! The preferences of a person among plans that open every void: hidden seams, and few parts.

use super::Ladder;
use crate::error::Error;
use crate::open::plan::are_clean;
use crate::open::refused::unless_refused;
use crate::open::tendency::lean;
use crate::open::way::Way;
use crate::run::{Achieved, Remark, Rung, Tendency, Voids};

impl<'a> Ladder<'a> {
    /// Returns a plan whose seams are seen less, if those of the usual plan are dear and the other
    /// costs little of the goal's figure. The rungs beyond then keep to it.
    pub(super) fn hide_seams(&mut self, usual: Way<'a>) -> Result<Way<'a>, Error> {
        let price = usual.seam_price()?;
        if !(self.is_free() && self.hides_seams) || price <= self.policy.dear_seam_ratio {
            return Ok(usual);
        }
        let before = Achieved::of(&usual.bossed.voids);
        let is_lost =
            |voids: &Voids| before.loss_ratio(&Achieved::of(voids)) > self.policy.seam_loss_ratio;
        let mut least_loss: Option<f64> = None;
        let mut weight = self.policy.lack_weight;
        for _ in 0..self.policy.hidden_rounds {
            let mut request = self.request.clone();
            request.seams.lack_weight = Some(weight);
            weight *= self.policy.lack_growth;
            let other = self.plan_in_walls(&self.ground, &request, Rung::Walls, &is_lost);
            let Some(other) = unless_refused(other)? else {
                continue;
            };
            let loss_ratio = other.loss_ratio(&usual);
            let is_dear = loss_ratio > self.policy.seam_loss_ratio;
            if other.bossed.plan.cuts.is_empty() || !is_dear && other.seam_price()? >= price {
                continue;
            }
            if other.hides_worth(&usual, &self.policy) {
                self.request = request;
                self.notes.push(Remark::Seams {
                    loss_ratio: Some(loss_ratio),
                    is_taken: true,
                });
                return Ok(other);
            }
            least_loss = Some(least_loss.map_or(loss_ratio, |least| least.min(loss_ratio)));
        }
        self.notes.push(Remark::Seams {
            loss_ratio: least_loss,
            is_taken: false,
        });
        Ok(usual)
    }

    /// Places the pins of a draft, or of one with fewer parts in its place.
    ///
    /// That is taken if it costs next to nothing of the goal's figure. It may cost a little if all
    /// its joints have pins and those of the other lack them. Else the sheet offers it.
    pub(super) fn join_parts(&mut self, usual: Way<'a>) -> Result<Way<'a>, Error> {
        let Some(fewer) = self.draft_fewer_parts(&usual)? else {
            return self.finish(usual);
        };
        let [many, few] = [&usual, &fewer].map(|way| way.bossed.plan.count_parts());
        let is_as_clean = are_clean(&fewer.bossed.plan, &fewer.request)
            || !are_clean(&usual.bossed.plan, &usual.request);
        let is_hidden = fewer.seam_price()? <= usual.seam_price()?.max(self.policy.dear_seam_ratio);
        let loss_ratio = fewer.loss_ratio(&usual);
        let is_as_good = is_as_clean && is_hidden;
        if is_as_good && loss_ratio <= self.policy.part_loss_ratio {
            self.request = fewer.request.clone();
            return self.finish(fewer);
        }
        let usual = self.finish(usual)?;
        if is_as_good && loss_ratio <= self.policy.aligned_loss_ratio && !usual.is_full() {
            let fewer = self.finish(fewer.clone())?;
            if fewer.is_full() {
                self.request = fewer.request.clone();
                self.notes.push(fewer.price(&usual));
                return Ok(fewer);
            }
        }
        let certificate = |way: &Way| way.bossed.voids.solution.certificate;
        self.notes.push(Remark::FewerParts {
            parts: [few, many],
            figure: certificate(&usual).figure,
            values: [certificate(&fewer).value, certificate(&usual).value],
        });
        Ok(usual)
    }

    /// Drafts a plan with fewer parts than one with more than two; `None` if there is none.
    fn draft_fewer_parts(&self, usual: &Way<'a>) -> Result<Option<Way<'a>>, Error> {
        let parts = usual.bossed.plan.count_parts();
        if !(self.joins_parts && self.is_free() && parts > 2) {
            return Ok(None);
        }
        let request = lean(self.request.clone(), Tendency::FewerParts);
        let fewer = self.plan_in_walls(&self.ground, &request, Rung::FewerCuts, &|_| false);
        let is_better = |way: &Way| {
            way.bossed.plan.count_parts() < parts && way.bossed.voids.solution.is_usable()
        };
        Ok(unless_refused(fewer)?.filter(is_better))
    }

    /// Returns a plan that minds no seam, if pins or jigs align all its joints and it costs little
    /// of the figure; `None` if there is none, or if nobody looks at seams anyway.
    pub(super) fn plan_seen_seams(&self, usual: &Way<'a>) -> Result<Option<Way<'a>>, Error> {
        if !(self.is_free() && self.hides_seams) {
            return Ok(None);
        }
        let request = lean(self.request.clone(), Tendency::Short);
        let is_lost = |voids: &Voids| {
            let before = Achieved::of(&usual.bossed.voids);
            before.loss_ratio(&Achieved::of(voids)) > self.policy.aligned_loss_ratio
        };
        let seen = self.plan_in_walls(&self.ground, &request, Rung::SeenSeams, &is_lost);
        let Some(seen) = unless_refused(seen)? else {
            return Ok(None);
        };
        let is_as_clean = are_clean(&seen.bossed.plan, &seen.request)
            || !are_clean(&usual.bossed.plan, &usual.request);
        let is_cheap = seen.loss_ratio(usual) <= self.policy.aligned_loss_ratio;
        if !(is_as_clean && is_cheap && seen.bossed.voids.solution.is_usable()) {
            return Ok(None);
        }
        let seen = self.add_bosses(self.finish(seen)?, Rung::SeenSeams)?;
        let is_aligned = seen.loss_ratio(usual) <= self.policy.aligned_loss_ratio
            && seen.count_unaligned()? == 0;
        Ok(is_aligned.then_some(seen))
    }
}
