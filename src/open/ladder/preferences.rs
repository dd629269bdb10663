//! What a person prefers in a plan that opens every void: seams that are not seen, and few parts.

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

    /// Returns a plan with fewer parts in place of one with more than two, if it costs next to
    /// nothing of the goal's figure. Else the sheet offers it with its price.
    pub(super) fn join_parts(&mut self, usual: Way<'a>) -> Result<Way<'a>, Error> {
        let parts = usual.bossed.plan.count_parts();
        if !(self.joins_parts && self.is_free() && parts > 2) {
            return Ok(usual);
        }
        let request = lean(self.request.clone(), Tendency::FewerParts);
        let other = self.plan_in_walls(&self.ground, &request, Rung::Walls, &|_| false);
        let Some(other) = unless_refused(other)? else {
            return Ok(usual);
        };
        let count = other.bossed.plan.count_parts();
        if count >= parts || !other.bossed.voids.solution.is_usable() {
            return Ok(usual);
        }
        let is_as_clean = are_clean(&other.bossed.plan, &other.request)
            || !are_clean(&usual.bossed.plan, &usual.request);
        let is_cheap = other.loss_ratio(&usual) <= self.policy.part_loss_ratio;
        let is_hidden = other.seam_price()? <= usual.seam_price()?.max(self.policy.dear_seam_ratio);
        if is_as_clean && is_cheap && is_hidden {
            self.request = request;
            return Ok(other);
        }
        let certificate = |way: &Way| way.bossed.voids.solution.certificate;
        self.notes.push(Remark::FewerParts {
            parts: [count, parts],
            figure: certificate(&usual).figure,
            values: [certificate(&other).value, certificate(&usual).value],
        });
        Ok(usual)
    }
}
