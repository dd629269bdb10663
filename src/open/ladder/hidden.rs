//! Hidden seams: plans whose seams are seen less, where they cost little of the goal's figure.

use super::Ladder;
use super::trial::Trial;
use crate::base::verdict::Verdict;
use crate::cut::{Cut, CutError, CutPlan, Draft, Drafts, PlanRequest, SeamWeight, dearest_spot};
use crate::error::Error;
use crate::geom::Plane;
use crate::open::ground::Ground;
use crate::open::plan::are_clean;
use crate::open::refused::unless_refused;
use crate::open::tendency::lean;
use crate::open::way::{Way, bare_seam_price, seam_price};
use crate::run::{Achieved, Policy, Remark, Rung, Tendency, Untried, Voids};

/// A draft whose seams are to be seen less than those of the usual plan.
struct Hidden<'a> {
    way: Way<'a>,
    /// The share of the goal's figure that it loses against the usual plan.
    loss_ratio: f64,
    /// The price of its seams, in circles about the model of average weight.
    price: f64,
}

impl Hidden<'_> {
    /// Returns the price of its seams and of its loss.
    fn cost(&self, policy: &Policy) -> f64 {
        policy.hidden_cost(self.price, self.loss_ratio)
    }

    /// Returns whether every void can be cleaned.
    fn is_clean(&self) -> bool {
        are_clean(&self.way.bossed.plan, &self.way.request)
    }

    /// Returns whether it is better than another: clean, or with the lower cost.
    fn is_better(&self, than: &Self, policy: &Policy) -> bool {
        match (self.is_clean(), than.is_clean()) {
            (true, false) => true,
            (false, true) => false,
            _ => self.cost(policy) < than.cost(policy),
        }
    }

    /// Returns whether no void is closed.
    fn opens_all(&self) -> bool {
        let mut voids = self.way.bossed.plan.voids.iter();
        voids.all(|void| !void.opened_by.is_empty())
    }
}

/// The choice among drafts with hidden seams.
struct HiddenChoice<'a> {
    policy: Policy,
    usual: Way<'a>,
    /// The price of the usual plan's seams.
    usual_price: f64,
    /// The best draft that is worth taking.
    best: Option<Hidden<'a>>,
    /// The least loss of the drafts that are not.
    least_loss_ratio: Option<f64>,
    /// The best draft with walls out of sight, if walls printed without support need no sight.
    unseen: Option<Hidden<'a>>,
}

impl<'a> HiddenChoice<'a> {
    /// Keeps the draft if it is the best so far. Returns whether a better one need not be sought.
    fn take(&mut self, other: Hidden<'a>) -> bool {
        let policy = &self.policy;
        let cost = other.cost(policy);
        let is_dear = other.loss_ratio > policy.seam_loss_ratio;
        if other.way.bossed.plan.cuts.is_empty() || !is_dear && cost >= self.usual_price {
            return false;
        }
        if !(other.opens_all() && other.way.hides_worth(&self.usual, policy)) {
            let least = self.least_loss_ratio.unwrap_or(f64::INFINITY);
            self.least_loss_ratio = Some(least.min(other.loss_ratio));
            let known = self.unseen.as_ref();
            if self.is_unseen(&other) && known.is_none_or(|known| cost < known.cost(policy)) {
                self.unseen = Some(other);
            }
            return false;
        }
        let is_hidden = other.price <= policy.dear_seam_ratio && other.is_clean();
        let best = self.best.as_ref();
        if best.is_none_or(|best| other.is_better(best, policy)) {
            self.best = Some(other);
        }
        is_hidden
    }

    /// Returns whether a draft is worth taking but for walls out of sight. On this printer they may
    /// hold no support.
    fn is_unseen(&self, other: &Hidden) -> bool {
        other.way.request.cleaning.overhang_deg.is_some()
            && other.opens_all()
            && other.way.costs_little(&self.usual, &self.policy)
    }

    /// Takes the best draft with walls out of sight, if its seams are seen much less than those of
    /// what was chosen.
    fn take_unseen(&mut self) -> Option<Hidden<'a>> {
        let chosen = self.best.as_ref().map(|best| best.cost(&self.policy));
        let chosen = chosen.unwrap_or(self.usual_price);
        let unseen = self.unseen.take();
        unseen.filter(|unseen| unseen.cost(&self.policy) + self.policy.unseen_gain <= chosen)
    }

    /// Returns the remark on what was chosen.
    fn remark(&self) -> Remark {
        let taken = self.best.as_ref().map(|best| best.loss_ratio);
        Remark::Seams {
            loss_ratio: taken.or(self.least_loss_ratio),
            is_taken: taken.is_some(),
        }
    }
}

impl<'a> Ladder<'a> {
    /// Returns a plan whose seams are seen less, if those of the usual plan are dear and the other
    /// costs little of the goal's figure. The rungs beyond then keep to it.
    ///
    /// Plans are sought from those that hide most, and lose most of the figure, to those that lose
    /// next to nothing. Of those worth taking it takes the one with the least price of its seams
    /// and of its loss together.
    pub(super) fn hide_seams(&mut self, usual: Way<'a>) -> Result<Way<'a>, Error> {
        let usual_price = usual.seam_price()?;
        let is_hidden = usual_price <= self.policy.dear_seam_ratio;
        if !(self.is_free() && self.hides_seams) || is_hidden {
            return Ok(usual);
        }
        let mut choice = HiddenChoice {
            policy: self.policy,
            usual,
            usual_price,
            best: None,
            least_loss_ratio: None,
            unseen: None,
        };
        self.try_hidden(&mut choice, &self.request)?;
        self.try_clear(&mut choice)?;
        self.unseen = choice.take_unseen().map(|unseen| Trial {
            loss_ratio: unseen.loss_ratio,
            draft: self.without_search(unseen.way),
        });
        self.notes.push(choice.remark());
        let Some(Hidden { way, .. }) = choice.best else {
            return Ok(choice.usual);
        };
        let way = self.without_search(way);
        self.request = way.request.clone();
        Ok(way)
    }

    /// Returns a way whose request is rid of what only the search for hidden seams asked for.
    fn without_search(&self, mut way: Way<'a>) -> Way<'a> {
        let seams = &mut way.request.seams;
        seams.tried.clear();
        seams.dearest_ratio = None;
        // Only the search kept clear of what it found to be seen; nobody ordered it.
        seams.keep_clear.clone_from(&self.request.seams.keep_clear);
        way
    }

    /// Tries drafts that weigh what they leave unclean against their seams, each unlike the others.
    fn try_hidden(
        &self,
        choice: &mut HiddenChoice<'a>,
        request: &PlanRequest,
    ) -> Result<(), Error> {
        let mut tried = vec![planes(&choice.usual.bossed.plan)?];
        let mut lack_weight = self.policy.lack_weight;
        let (voids, plan) = (&choice.usual.bossed.voids, &choice.usual.bossed.plan);
        let dearest_ratio = bare_seam_price(voids, plan, request)?;
        let weight = |lack_weight: f64, tried: &[Vec<Plane>]| {
            let tried = tried.to_vec();
            SeamWeight {
                lack_weight,
                tried,
                dearest_ratio,
            }
        };
        let first = weight(lack_weight, &tried).weigh(request);
        let Verdict::Found(drafts) = Drafts::new(&self.ground.voids.hollowed, &first)? else {
            return Ok(());
        };
        // One of them may be clean where the usual plan is not.
        let is_needed = !are_clean(&choice.usual.bossed.plan, &choice.usual.request);
        for _ in 0..self.policy.hidden_rounds {
            if !(is_needed || self.budget().allows(Untried::HiddenSeams)) {
                break;
            }
            let weight = weight(lack_weight, &tried);
            lack_weight *= self.policy.lack_growth;
            let Verdict::Found(Draft { plan, sought }) = drafts.draft(&weight)? else {
                continue;
            };
            tried.push(sought);
            let other = self.clean_hidden(choice, plan, &weight.weigh(request))?;
            if other.is_some_and(|other| choice.take(other)) {
                break;
            }
        }
        Ok(())
    }

    /// Tries drafts that keep clear of the spot where the best plan so far shows most: a face, if
    /// its seam crosses one. Such plans may be far down the list of those that the others head.
    fn try_clear(&self, choice: &mut HiddenChoice<'a>) -> Result<(), Error> {
        let mut request = self.request.clone();
        for _ in 0..self.policy.clear_rounds {
            let shown = match &choice.best {
                Some(best) if best.price <= self.policy.dear_seam_ratio => break,
                Some(best) => &best.way,
                None => &choice.usual,
            };
            if !self.budget().allows(Untried::HiddenSeams) {
                break;
            }
            let outer = self.ground.voids.hollowed.outer.mesh();
            let sparing = PlanRequest {
                seams: shown.request.seams.sparing_feet(),
                ..shown.request.clone()
            };
            let Some(spot) = dearest_spot(outer, &shown.bossed.plan, &sparing)? else {
                break;
            };
            request.seams.keep_clear.push(spot);
            self.try_hidden(choice, &request)?;
        }
        Ok(())
    }

    /// Cleans a draft with hidden seams. `None` if its seams cost no less than the usual plan's, or
    /// if it fails.
    ///
    /// It stops at voids that lose too much.
    fn clean_hidden(
        &self,
        choice: &HiddenChoice<'a>,
        draft: CutPlan,
        request: &PlanRequest,
    ) -> Result<Option<Hidden<'a>>, Error> {
        let HiddenChoice { usual, policy, .. } = choice;
        let is_seen = seam_price(&self.ground.voids, &draft, request)? >= choice.usual_price;
        if is_seen || draft.cuts.is_empty() {
            return Ok(None);
        }
        let ground = Ground {
            draft: Some(draft),
            ..self.ground.clone()
        };
        let before = Achieved::of(&usual.bossed.voids);
        let is_lost =
            |voids: &Voids| before.loss_ratio(&Achieved::of(voids)) > policy.seam_loss_ratio;
        let way = self.plan_in_walls(&ground, request, Rung::Walls, &is_lost);
        let Some(way) = unless_refused(way)? else {
            return Ok(None);
        };
        Ok(Some(Hidden {
            loss_ratio: way.loss_ratio(usual),
            price: way.seam_price()?,
            way,
        }))
    }

    /// Returns a plan that minds no seam, if pins or jigs align all its joints and it costs little
    /// of the figure; `None` if there is none, or if nobody looks at seams anyway.
    pub(super) fn plan_seen_seams(&self, usual: &Way<'a>) -> Result<Option<Way<'a>>, Error> {
        let is_sought = self.is_free() && self.hides_seams;
        if !(is_sought && self.budget().allows(Untried::SeenSeams)) {
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
        let is_worth = is_as_clean && is_cheap && seen.keeps_angle_of(usual);
        if !(is_worth && seen.bossed.voids.solution.is_usable()) {
            return Ok(None);
        }
        let seen = self.add_bosses(self.finish(seen)?, Rung::SeenSeams)?;
        let is_aligned = seen.loss_ratio(usual) <= self.policy.aligned_loss_ratio
            && seen.count_unaligned()? == 0;
        Ok(is_aligned.then_some(seen))
    }
}

/// Returns the planes of a plan's cuts.
fn planes(plan: &CutPlan) -> Result<Vec<Plane>, CutError> {
    plan.cuts.iter().map(Cut::plane).collect()
}

#[cfg(test)]
mod tests;
