//! Boss rounds: where pins have no room, material around them is kept solid and everything is solved again.

use super::{Error, tuner::Tuner, tuner::Voids};
use crate::cut::{
    Boss, BossOrder, CutError, CutOrder, CutPlan, PinSite, PlanRequest, bosses, plan_around, plan_by,
};
use crate::hollow::Certificate;
use crate::mesh::TriMesh;

/// How often bosses are looked for: solving again moves the voids, which may take room from pins that had it. The first round
/// takes nearly all; one that needs more than three goes in circles.
const MAX_ROUNDS: usize = 3;

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
pub struct Bossed {
    /// The voids that leave the bosses solid.
    pub voids: Voids,
    /// The plan with the pins in them.
    pub plan: CutPlan,
    /// The rounds, in their order.
    pub rounds: Vec<BossRound>,
    /// Why no more bosses were made though pins lack room.
    pub note: Option<String>,
}

/// Keeps bosses solid until every joint has its pins, or no more can be had.
pub fn bossed(
    tuner: &mut Tuner,
    (voids, plan): (Voids, CutPlan),
    request: &PlanRequest,
) -> Result<Bossed, Error> {
    let ordered = ordered_pins(tuner);
    let mut state = Bossed { voids, plan, rounds: Vec::new(), note: None };
    let mut held: Vec<PinSite> = Vec::new();
    for _ in 0..MAX_ROUNDS {
        let price = (state.voids.solution.quadric, tuner.setup().placement.goal.frame);
        let (hollowed, plan) = (&state.voids.hollowed, &state.plan);
        let found = bosses(&BossOrder { hollowed, request, plan, ordered, price })?;
        if found.iter().all(|boss| boss.body.is_none()) {
            break;
        }
        held.extend(found.iter().map(|boss| boss.pin.clone()));
        let pins = Some(ordered.map_or(held.clone(), <[PinSite]>::to_vec));
        let order = CutOrder { pins, ..CutOrder::of(&state.plan) };
        let mut trial = tuner.clone();
        match round(&mut trial, &state, (&found, &order, request))? {
            Ok((voids, plan, round)) => {
                (state.voids, state.plan) = (voids, plan);
                state.rounds.push(round);
                *tuner = trial;
            }
            Err(note) => {
                state.note = Some(note);
                break;
            }
        }
    }
    if let Some(pins) = ordered.filter(|pins| pins.len() > state.plan.pins.len()) {
        // Some pin has no place, and the error says which.
        let order = CutOrder { pins: Some(pins.to_vec()), ..CutOrder::of(&state.plan) };
        state.plan = plan_by(&state.voids.hollowed, request, &order)?;
    }
    name_pins(&mut state);
    Ok(state)
}

/// The pins that the job orders.
fn ordered_pins<'a>(tuner: &Tuner<'a>) -> Option<&'a [PinSite]> {
    tuner.setup().job.plan.as_ref().and_then(|order| order.pins.as_deref())
}

/// One round: the voids and the plan with these bosses, or why they cannot be.
fn round(
    tuner: &mut Tuner,
    state: &Bossed,
    (found, order, request): (&[Boss], &CutOrder, &PlanRequest),
) -> Result<Result<(Voids, CutPlan, BossRound), String>, Error> {
    let bodies: Vec<TriMesh> = found.iter().filter_map(|boss| boss.body.clone()).collect();
    let (voids, kept_mm3) = tuner.keeping(&state.voids, &bodies)?;
    if !voids.solution.is_usable() {
        return Ok(Err("bosses around pins would make the goal impossible: there are none".to_owned()));
    }
    let is_ordered = ordered_pins(tuner).is_some();
    let replan = if is_ordered { plan_by } else { plan_around };
    let plan = match replan(&voids.hollowed, request, order) {
        Ok(plan) => plan,
        Err(CutError::ClosedCavity { .. }) => {
            return Ok(Err("bosses around pins would close a void: there are none".to_owned()));
        }
        Err(error) => return Err(error.into()),
    };
    if are_clean(&state.plan) && !are_clean(&plan) {
        let note = "bosses around pins would leave a void that cannot be cleaned: there are none more";
        return Ok(Err(note.to_owned()));
    }
    let CutPlan { proofs, moves, .. } = state.plan.clone();
    let plan = CutPlan { notes: [proofs.clone(), plan.notes].concat(), proofs, moves, ..plan };
    let kept = found.iter().filter_map(|boss| {
        let volume_mm3 = boss.body.as_ref()?.signed_volume_mm3();
        Some(KeptBoss { pin: boss.pin.clone(), parts: boss.parts.clone(), volume_mm3 })
    });
    let round = BossRound {
        bosses: kept.collect(),
        kept_mm3,
        before: state.voids.solution.certificate,
        after: voids.solution.certificate,
    };
    Ok(Ok((voids, plan, round)))
}

/// Whether every void of a plan is clean by the process's rule.
fn are_clean(plan: &CutPlan) -> bool {
    plan.voids.iter().all(|void| void.is_clean)
}

/// Calls the bosses' pins as the plan does in the end.
fn name_pins(state: &mut Bossed) {
    for boss in state.rounds.iter_mut().flat_map(|round| &mut round.bosses) {
        if let Some(pin) = state.plan.pins.iter().find(|pin| pin.center_mm == boss.pin.center_mm) {
            boss.pin.id.clone_from(&pin.id);
        }
    }
}
