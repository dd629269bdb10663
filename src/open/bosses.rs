//! Boss rounds: where pins have no room, material around them is kept solid and everything is
//! solved again.

use super::failed::Failed;
use super::plan::are_clean;
use super::resolve::Resolver;
use super::settle::{Settled, Terms, settle};
use crate::base::verdict::Verdict;
use crate::cut::{
    Boss, BossRequest, CutError, CutOrder, CutPlan, MaterialPrice, PinSite, PlanRequest, bosses,
    plan_by,
};
use crate::error::Error;
use crate::mesh::TriMesh;
use crate::run::{Achieved, BossRound, KeptBoss, Policy, Refusal, Remark, Voids};

/// Voids and a plan, with the bosses that they hold so far.
#[derive(Clone)]
pub struct Bossed {
    /// The voids that leave the bosses solid.
    pub voids: Voids,
    /// The plan with the pins in them.
    pub plan: CutPlan,
    /// The rounds, in their order.
    pub rounds: Vec<BossRound>,
    /// The bosses of the plan's pins.
    held: Vec<Boss>,
    /// The joints that got none.
    failed: Failed,
    /// Baseline: the result without bosses.
    baseline: Achieved,
}

/// The price that may be paid for bosses.
#[derive(Clone, Copy)]
struct Price {
    /// Times that more than the bosses may be kept solid.
    rounds: usize,
    /// Greatest loss of the goal's figure.
    max_loss_ratio: f64,
    /// The result that the loss is measured from; the last bosses if it is not given.
    baseline: Option<Achieved>,
}

impl Price {
    /// Returns the price of bosses beside which nothing more is kept solid.
    fn of_bosses_alone(policy: &Policy) -> Self {
        Self {
            rounds: 0,
            max_loss_ratio: policy.cheap_loss_ratio,
            baseline: None,
        }
    }

    /// Returns the price while other places for bosses are left to try.
    fn cheap(policy: &Policy) -> Self {
        Self {
            rounds: policy.settle_rounds,
            ..Self::of_bosses_alone(policy)
        }
    }
}

impl Bossed {
    /// Returns voids and a plan without any boss.
    pub fn without(voids: Voids, plan: CutPlan) -> Self {
        Self {
            baseline: Achieved::of(&voids),
            voids,
            plan,
            rounds: Vec::new(),
            held: Vec::new(),
            failed: Failed::default(),
        }
    }

    /// Returns whether joints lack only bosses that cost too much.
    pub fn has_dear(&self) -> bool {
        !self.failed.dear_ones().is_empty()
    }

    /// Returns why joints that lack pins have no bosses.
    pub fn remarks(&self) -> Vec<Remark> {
        self.failed.remarks()
    }

    /// Names the bosses' pins as the plan does in the end.
    pub fn name_pins(&mut self) {
        let pins = &self.plan.pins;
        for boss in self.rounds.iter_mut().flat_map(|round| &mut round.bosses) {
            let is_same = |pin: &&PinSite| pin.center_mm == boss.pin.center_mm;
            if let Some(pin) = pins.iter().find(is_same) {
                boss.pin.id.clone_from(&pin.id);
            }
        }
    }
}

/// Keeps bosses solid until every joint has its pins, or no more can be had cheaply.
///
/// Ordered pins get theirs at any price that leaves the kit worth having.
pub fn add_bosses(
    resolver: &mut Resolver,
    state: Bossed,
    request: &PlanRequest,
) -> Result<Bossed, Error> {
    let mut search = Search::new(resolver, state, request);
    search.run()?;
    if search.ordered.is_some() {
        let ordered_loss_ratio = search.policy.ordered_loss_ratio;
        search.pay(ordered_loss_ratio)?;
    }
    let mut state = search.state;
    let ordered = resolver.planner().pins();
    if let Some(pins) = ordered.filter(|pins| pins.len() > state.plan.pins.len()) {
        // Some pin has no place, and the error says which.
        let order = CutOrder {
            pins: Some(pins.to_vec()),
            ..CutOrder::of(&state.plan)
        };
        let plan = plan_by(&state.voids.hollowed, request, &order)?;
        state.plan = plan.or_error::<CutError>()?;
    }
    Ok(state)
}

/// Adds the bosses that only cost too much, up to a loss of the figure reached without any.
pub fn pay_for_bosses(
    resolver: &mut Resolver,
    state: Bossed,
    request: &PlanRequest,
    max_loss_ratio: f64,
) -> Result<Bossed, Error> {
    let mut search = Search::new(resolver, state, request);
    search.pay(max_loss_ratio)?;
    Ok(search.state)
}

/// The search for bosses from one state.
struct Search<'r, 'a> {
    resolver: &'r mut Resolver<'a>,
    request: &'r PlanRequest,
    /// The pins that are ordered.
    ordered: Option<Vec<PinSite>>,
    policy: Policy,
    state: Bossed,
}

impl<'r, 'a> Search<'r, 'a> {
    fn new(resolver: &'r mut Resolver<'a>, state: Bossed, request: &'r PlanRequest) -> Self {
        Self {
            ordered: resolver.planner().pins().map(<[_]>::to_vec),
            policy: resolver.placed().policy,
            resolver,
            request,
            state,
        }
    }

    /// Looks for bosses and tries them, until none is left to try.
    fn run(&mut self) -> Result<(), Error> {
        for _ in 0..self.policy.boss_rounds + self.policy.boss_patterns - 1 {
            self.resolver.watch().check()?;
            let found = self.find()?;
            if !found.iter().any(|boss| boss.is_new) {
                break;
            }
            self.try_found(&found)?;
            if self.ordered.is_some() && !self.state.failed.given_up.is_empty() {
                break;
            }
        }
        Ok(())
    }

    fn find(&self) -> Result<Vec<Boss>, Error> {
        let Bossed {
            voids,
            plan,
            failed,
            ..
        } = &self.state;
        let frame = self.resolver.placed().goal().frame;
        let found = bosses(&BossRequest {
            hollowed: &voids.hollowed,
            request: self.request,
            plan,
            ordered: self.ordered.as_deref(),
            given_up: &failed.given_up,
            refused: &failed.places,
            price: MaterialPrice {
                quadric: voids.solution.quadric,
                frame,
            },
        })?;
        // A plan that was made for these voids has its pins on their cut faces.
        Ok(found.or_error::<CutError>()?)
    }

    /// Tries bosses all at once with nothing else kept solid, else joint by joint.
    fn try_found(&mut self, found: &[Boss]) -> Result<(), Error> {
        let joints: Vec<&[Boss]> = match &self.ordered {
            Some(_) => vec![found],
            None => found.chunk_by(|a, b| a.joint() == b.joint()).collect(),
        };
        let alone = Price::of_bosses_alone(&self.policy);
        if joints.len() > 1 && matches!(self.attempt(found, alone)?, Verdict::Found(())) {
            found
                .iter()
                .for_each(|boss| self.state.failed.forget(&boss.joint()));
            return Ok(());
        }
        let cheap = Price::cheap(&self.policy);
        // An ordered pattern is the joint's only one.
        let patterns = match &self.ordered {
            Some(_) => 1,
            None => self.policy.boss_patterns,
        };
        for bosses in joints {
            match self.attempt(bosses, cheap)? {
                Verdict::Found(()) => self.state.failed.forget(&bosses[0].joint()),
                Verdict::No(refusal) => self.state.failed.add(bosses, refusal, patterns),
            }
        }
        Ok(())
    }

    /// Tries the bosses that only cost too much: all of them, and each joint's alone.
    fn pay(&mut self, max_loss_ratio: f64) -> Result<(), Error> {
        let price = Price {
            max_loss_ratio,
            baseline: Some(self.state.baseline),
            ..Price::cheap(&self.policy)
        };
        let all = self.state.failed.dear_ones();
        // Together they may cost less than one alone: a body with two arms stays balanced if both
        // of them are solid.
        if all.len() > 1 && matches!(self.attempt(&all.concat(), price)?, Verdict::Found(())) {
            for bosses in &all {
                self.state.failed.forget(&bosses[0].joint());
            }
        }
        for dear in self.state.failed.dear_ones() {
            self.resolver.watch().check()?;
            let name = dear[0].joint();
            match self.attempt(&dear, price)? {
                Verdict::Found(()) => self.state.failed.forget(&name),
                Verdict::No(refusal) => self.state.failed.explain(name, refusal),
            }
        }
        Ok(())
    }

    /// Keeps bosses solid and settles; if that is refused, state and resolver stay as they were.
    fn attempt(&mut self, found: &[Boss], price: Price) -> Result<Verdict<(), Refusal>, Error> {
        let held = self.held_with(found);
        let pins = match &self.ordered {
            Some(pins) => pins.clone(),
            None => held.iter().map(|boss| boss.pin.clone()).collect(),
        };
        let state = &self.state;
        let terms = Terms {
            order: &CutOrder {
                pins: Some(pins),
                ..CutOrder::of(&state.plan)
            },
            is_ordered: self.ordered.is_some(),
            request: self.request,
            rounds: price.rounds,
            max_loss_ratio: price.max_loss_ratio,
            start: state.baseline,
            max_price_ratio: self.max_price_ratio(price),
            must_be_clean: are_clean(&state.plan, self.request),
            before: price.baseline.unwrap_or(Achieved::of(&state.voids)),
        };
        let mut trial = self.resolver.clone();
        let bodies: Vec<TriMesh> = found.iter().map(|boss| boss.body.clone()).collect();
        let solved = trial.solve_with_bosses(&state.voids, &bodies)?;
        if let Some(refusal) = terms.refuse(&solved, false, &self.policy) {
            return Ok(Verdict::No(refusal));
        }
        let voids = trial.draw_solved(solved)?;
        let kept_mm3 = trial.bosses_mm3();
        let settled = match settle(&mut trial, voids, &terms)? {
            Verdict::Found(settled) => settled,
            Verdict::No(refusal) => return Ok(Verdict::No(refusal)),
        };
        self.take(found, held, settled, kept_mm3);
        *self.resolver = trial;
        Ok(Verdict::Found(()))
    }

    /// Returns the greatest loss that all bosses together may cost.
    fn max_price_ratio(&self, price: Price) -> f64 {
        let most = match &self.ordered {
            Some(_) => self.policy.ordered_loss_ratio,
            None => self.policy.dear_loss_ratio,
        };
        most.max(price.max_loss_ratio)
    }

    /// Returns the bosses held so far, with new ones in place of those of their joints.
    fn held_with(&self, found: &[Boss]) -> Vec<Boss> {
        let stays = |boss: &&Boss| !found.iter().any(|new| new.joint() == boss.joint());
        let held = self.state.held.iter().filter(stays);
        held.chain(found).cloned().collect()
    }

    /// Makes settled bosses the state, and records the round.
    fn take(&mut self, found: &[Boss], held: Vec<Boss>, settled: Settled, kept_mm3: f64) {
        let kept = |boss: &Boss| KeptBoss {
            pin: boss.pin.clone(),
            parts: boss.parts,
            volume_mm3: boss.body.signed_volume_mm3(),
        };
        let state = &mut self.state;
        let new = found.iter().filter(|boss| boss.is_new);
        state.rounds.push(BossRound {
            bosses: new.map(kept).collect(),
            kept_mm3,
            before: state.voids.solution.certificate,
            after: settled.voids.solution.certificate,
        });
        let plan = settled.plan;
        state.plan = CutPlan {
            notes: state
                .plan
                .lasting_notes()
                .cloned()
                .chain(plan.notes)
                .collect(),
            moves: std::mem::take(&mut state.plan.moves),
            ..plan
        };
        (state.voids, state.held) = (settled.voids, held);
    }
}

#[cfg(test)]
mod tests;
