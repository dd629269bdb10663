//! Boss rounds: where pins have no room, material around them is kept solid and everything is
//! solved again.

use super::{
    Error,
    settling::{self, Reached, Refusal, Settled, Terms, are_clean, settled},
    tuner::{Tuner, Voids},
};
use crate::cut::{
    Boss, BossOrder, CutOrder, CutPlan, JointName, PinSite, PlanRequest, bosses, plan_by,
};
use crate::hollow::Certificate;
use crate::mesh::TriMesh;

/// How often bosses are looked for: solving again moves the voids, which may take room from pins
/// that had it. The first round takes nearly all; one that needs more than three goes in circles.
const MAX_ROUNDS: usize = 3;
/// How many patterns are tried for a joint, each away from those that cost too much.
const MAX_PATTERNS: usize = 3;

/// A round in which bosses were kept solid.
#[derive(Debug, Clone, PartialEq)]
pub struct BossRound {
    /// The bosses that were added.
    pub bosses: Vec<KeptBoss>,
    /// What could have been emptied in all bosses so far, mm³.
    pub kept_mm3: f64,
    /// What the solver reached before they were kept solid.
    pub before: Certificate,
    /// What it reaches with them.
    pub after: Certificate,
}

/// A pin that got a boss.
#[derive(Debug, Clone, PartialEq)]
pub struct KeptBoss {
    /// The pin; its id is that of the plan.
    pub pin: PinSite,
    /// The parts it joins.
    pub parts: [String; 2],
    /// The volume of the whole boss, what was solid anyway included, mm³.
    pub volume_mm3: f64,
}

/// What the rounds end with.
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
    failed: Failed,
    /// What there was without any boss.
    first: Reached,
}

/// Keeps bosses solid until every joint has its pins, or no more can be had at a low price. Ordered
/// pins have theirs at any price that leaves the kit worth having.
pub fn bossed(
    tuner: &mut Tuner,
    mut state: Bossed,
    request: &PlanRequest,
) -> Result<Bossed, Error> {
    let ordered = ordered_pins(tuner);
    let mut failed = Failed::default();
    for _ in 0..MAX_ROUNDS + MAX_PATTERNS - 1 {
        let price = (
            state.voids.solution.quadric,
            tuner.setup().placement.goal.frame,
        );
        let (hollowed, plan) = (&state.voids.hollowed, &state.plan);
        let (given_up, refused) = (&failed.given_up[..], &failed.places[..]);
        let found = bosses(&BossOrder {
            hollowed,
            request,
            plan,
            ordered,
            given_up,
            refused,
            price,
        })?;
        if !found.iter().any(|boss| boss.is_new) {
            break;
        }
        let joints: Vec<&[Boss]> = match ordered {
            Some(_) => vec![&found[..]],
            None => found.chunk_by(|a, b| a.joint() == b.joint()).collect(),
        };
        // All at once, where nothing else need be kept solid for them; or joint by joint.
        if joints.len() > 1 && tried(tuner, &mut state, (&found, Effort::NONE), request)?.is_ok() {
            found.iter().for_each(|boss| failed.forget(&boss.joint()));
            continue;
        }
        for one in joints {
            match tried(tuner, &mut state, (one, Effort::CHEAP), request)? {
                Err(refusal) => failed.add(one, (refusal, ordered.is_some())),
                Ok(()) => failed.forget(&one[0].joint()),
            }
        }
        if ordered.is_some() && !failed.given_up.is_empty() {
            break;
        }
    }
    state.failed = failed;
    if ordered.is_some() {
        state = state.paid_dearly(tuner, request, settling::DEAR_LOSS_RATIO)?;
    }
    if let Some(pins) = ordered.filter(|pins| pins.len() > state.plan.pins.len()) {
        // Some pin has no place, and the error says which.
        let order = CutOrder {
            pins: Some(pins.to_vec()),
            ..CutOrder::of(&state.plan)
        };
        state.plan = plan_by(&state.voids.hollowed, request, &order)?;
    }
    Ok(state)
}

impl Bossed {
    /// Voids and a plan as they are without any boss.
    pub fn without(voids: Voids, plan: CutPlan) -> Self {
        let first = Reached::by(&voids);
        Self {
            voids,
            plan,
            rounds: Vec::new(),
            held: Vec::new(),
            failed: Failed::default(),
            first,
        }
    }

    /// Whether joints lack bosses that only cost too much.
    pub fn has_dear(&self) -> bool {
        !self.failed.dear_ones().is_empty()
    }

    /// The same with those bosses that cost more, up to this share of what the kit reaches without
    /// any.
    pub fn paid_dearly(
        mut self,
        tuner: &mut Tuner,
        request: &PlanRequest,
        max_loss_ratio: f64,
    ) -> Result<Self, Error> {
        let effort = Effort {
            since: Some(self.first),
            max_loss_ratio,
            ..Effort::CHEAP
        };
        let all = self.failed.dear_ones();
        // Together they may cost less than one alone: a body with two arms stays balanced with both
        // of them solid.
        if all.len() > 1 && tried(tuner, &mut self, (&all.concat(), effort), request)?.is_ok() {
            all.iter()
                .for_each(|bosses| self.failed.forget(&bosses[0].joint()));
        }
        for dear in self.failed.dear_ones() {
            let name = dear[0].joint();
            match tried(tuner, &mut self, (&dear, effort), request)? {
                Err(refusal) => self.failed.explain(name, refusal.why),
                Ok(()) => self.failed.forget(&name),
            }
        }
        Ok(self)
    }

    /// The voids, the plan and the rounds, and why joints that lack pins have no bosses.
    pub fn told(mut self) -> (Voids, CutPlan, Vec<BossRound>, Vec<String>) {
        name_pins(&mut self);
        let notes = self.failed.notes().collect();
        (self.voids, self.plan, self.rounds, notes)
    }
}

/// What may be done for bosses.
#[derive(Clone, Copy)]
struct Effort {
    /// How often more may be kept solid for them.
    rounds: usize,
    /// By which share of itself the goal's figure may then become worse.
    max_loss_ratio: f64,
    /// Since when; since the last bosses where it is not said.
    since: Option<Reached>,
}

impl Effort {
    const NONE: Self = Self {
        rounds: 0,
        max_loss_ratio: settling::CHEAP_LOSS_RATIO,
        since: None,
    };
    const CHEAP: Self = Self {
        rounds: settling::MAX_ROUNDS,
        ..Self::NONE
    };
}

/// Bosses that could not be had.
#[derive(Clone, Default)]
struct Failed {
    /// The joints of those that failed, once for each pattern.
    joints: Vec<JointName>,
    /// Why the last pattern of each joint that has none failed.
    reasons: Vec<(JointName, String)>,
    /// The joints for which no more patterns are tried.
    given_up: Vec<JointName>,
    /// Where the bosses stood, mm.
    places: Vec<[f64; 3]>,
    /// Those that only cost too much, with how much.
    dear: Vec<(f64, Vec<Boss>)>,
}

impl Failed {
    /// Remembers a joint's pattern, and why it failed. An ordered one is the joint's only one.
    fn add(&mut self, bosses: &[Boss], (refusal, is_ordered): (Refusal, bool)) {
        let name = bosses[0].joint();
        self.joints.push(name.clone());
        self.places
            .extend(bosses.iter().map(|boss| boss.pin.center_mm));
        if is_ordered || self.joints.iter().filter(|joint| **joint == name).count() >= MAX_PATTERNS
        {
            self.given_up.push(name.clone());
        }
        self.dear
            .extend(refusal.loss_ratio.map(|loss| (loss, bosses.to_vec())));
        self.explain(name, refusal.why);
    }

    /// Why the last pattern of a joint failed.
    fn explain(&mut self, name: JointName, why: String) {
        self.reasons.retain(|(other, _)| *other != name);
        self.reasons.push((name, why));
    }

    /// A joint that got its bosses after all.
    fn forget(&mut self, name: &JointName) {
        self.reasons.retain(|(other, _)| other != name);
        self.dear.retain(|(_, bosses)| bosses[0].joint() != *name);
    }

    /// Of every joint that has none the bosses that cost least.
    fn dear_ones(&self) -> Vec<Vec<Boss>> {
        let of_joint = |(name, _): &(JointName, String)| {
            let own = self
                .dear
                .iter()
                .filter(|(_, bosses)| bosses[0].joint() == *name);
            own.min_by(|a, b| a.0.total_cmp(&b.0))
                .map(|(_, bosses)| bosses.clone())
        };
        self.reasons.iter().filter_map(of_joint).collect()
    }

    /// What is said of the joints that got none.
    fn notes(&self) -> impl Iterator<Item = String> {
        let note = |(name, why): &(JointName, String)| {
            let [below, above] = &name.parts;
            format!("joint {below}–{above}: bosses around pins would {why}: it has none")
        };
        self.reasons.iter().map(note)
    }
}

/// The pins that the job orders.
fn ordered_pins<'a>(tuner: &Tuner<'a>) -> Option<&'a [PinSite]> {
    tuner
        .setup()
        .job
        .plan
        .as_ref()
        .and_then(|order| order.pins.as_deref())
}

/// One round: the state and the tuner with these bosses, or as they were, and why.
fn tried(
    tuner: &mut Tuner,
    state: &mut Bossed,
    (found, effort): (&[Boss], Effort),
    request: &PlanRequest,
) -> Result<Result<(), Refusal>, Error> {
    let stays = |boss: &&Boss| !found.iter().any(|new| new.joint() == boss.joint());
    let held: Vec<Boss> = state
        .held
        .iter()
        .filter(stays)
        .chain(found)
        .cloned()
        .collect();
    let ordered = ordered_pins(tuner);
    let pins = Some(ordered.map_or_else(
        || held.iter().map(|boss| boss.pin.clone()).collect(),
        <[PinSite]>::to_vec,
    ));
    let terms = Terms {
        order: &CutOrder {
            pins,
            ..CutOrder::of(&state.plan)
        },
        is_ordered: ordered.is_some(),
        request,
        rounds: effort.rounds,
        max_loss_ratio: effort.max_loss_ratio,
        must_be_clean: are_clean(&state.plan, request),
        before: effort.since.unwrap_or(Reached::by(&state.voids)),
    };
    let mut trial = tuner.clone();
    let bodies: Vec<TriMesh> = found.iter().map(|boss| boss.body.clone()).collect();
    let (voids, kept_mm3) = trial.keeping(&state.voids, &bodies)?;
    let Settled { voids, plan } = match settled(&mut trial, voids, &terms)? {
        Ok(settled) => settled,
        Err(why) => return Ok(Err(why)),
    };
    let kept = found
        .iter()
        .filter(|boss| boss.is_new)
        .map(|boss| KeptBoss {
            pin: boss.pin.clone(),
            parts: boss.parts.clone(),
            volume_mm3: boss.body.signed_volume_mm3(),
        });
    state.rounds.push(BossRound {
        bosses: kept.collect(),
        kept_mm3,
        before: state.voids.solution.certificate,
        after: voids.solution.certificate,
    });
    let CutPlan { proofs, moves, .. } = state.plan.clone();
    state.plan = CutPlan {
        notes: [proofs.clone(), plan.notes].concat(),
        proofs,
        moves,
        ..plan
    };
    (state.voids, state.held, *tuner) = (voids, held, trial);
    Ok(Ok(()))
}

/// Calls the bosses' pins as the plan does in the end.
fn name_pins(state: &mut Bossed) {
    for boss in state.rounds.iter_mut().flat_map(|round| &mut round.bosses) {
        if let Some(pin) = state
            .plan
            .pins
            .iter()
            .find(|pin| pin.center_mm == boss.pin.center_mm)
        {
            boss.pin.id.clone_from(&pin.id);
        }
    }
}
