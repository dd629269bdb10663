//! Bosses and the voids about them brought to terms: what bosses close, or hide from the openings,
//! is kept solid too.

use super::{
    Error,
    tuner::{Tuner, Voids},
};
use crate::cut::{
    CutError, CutOrder, CutPlan, PlanRequest, Unclean, closed, plan_around, plan_by, unclean,
};
use crate::hollow::Certificate;
use crate::mesh::TriMesh;

/// How often something is kept solid for the sake of the same bosses. One round takes nearly all.
pub const MAX_ROUNDS: usize = 4;
/// Bosses that make more than themselves solid may worsen the goal's figure by this share, where
/// other places for them are left to be tried.
pub const CHEAP_LOSS_RATIO: f64 = 0.1;
/// And by this where none is: a joint is to have its pins, and the price is told. More, and what
/// the kit was made for is gone.
pub const DEAR_LOSS_RATIO: f64 = 0.65;

/// Of the voids this share may be lost to bosses and what is kept solid for them: a figure such as
/// the angle at which something topples hardly tells (homer by filament, standing: 11 % of it for
/// all of its void).
pub const MAX_VOID_LOSS_RATIO: f64 = 0.5;

/// What is kept solid for the sake of bosses is kept so with so much around it, in minimum
/// openings. It is next to nothing of a void that was clean: on the elephant and on Homer with
/// filament, two openings cost 30 and 20 % of the critical speed.
const MARGIN_RATIO: f64 = 0.25;

/// Voids with bosses in them, and the plan that opens them.
pub struct Settled {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
}

/// What voids are to be settled with.
#[derive(Clone, Copy)]
pub struct Terms<'a> {
    /// The cuts and pins.
    pub order: &'a CutOrder,
    /// Whether a person ordered the pins, so that no joint gets others.
    pub is_ordered: bool,
    /// What plans are asked for.
    pub request: &'a PlanRequest,
    /// How often something more may be kept solid.
    pub rounds: usize,
    /// Whether every void must be clean in the end.
    pub must_be_clean: bool,
    /// What there was without the bosses.
    pub before: Reached,
    /// By which share of itself that may become worse once more than the bosses is kept solid.
    pub max_loss_ratio: f64,
}

/// What voids reach, and how much there is of them.
#[derive(Debug, Clone, Copy)]
pub struct Reached {
    certificate: Certificate,
    voids_mm3: f64,
}

impl Reached {
    /// What these voids reach.
    pub fn by(voids: &Voids) -> Self {
        let volumes = voids
            .hollowed
            .voids
            .iter()
            .map(|void| void.mesh().signed_volume_mm3());
        Self {
            certificate: voids.solution.certificate,
            voids_mm3: volumes.sum(),
        }
    }

    /// By which share of itself the goal's figure is worse after it.
    pub fn loss_ratio(&self, after: &Self) -> f64 {
        loss_ratio(&self.certificate, &after.certificate)
    }

    /// Which share of the voids is solid after it.
    pub fn filled_ratio(&self, after: &Self) -> f64 {
        1.0 - after.voids_mm3 / self.voids_mm3.max(f64::MIN_POSITIVE)
    }
}

/// Why bosses cannot be had.
pub struct Refusal {
    /// To be said after "bosses around pins would".
    pub why: String,
    /// By which share of itself they worsen the goal's figure, where only that is against them.
    pub loss_ratio: Option<f64>,
}

impl Refusal {
    fn because(why: &str) -> Self {
        Self {
            why: why.to_owned(),
            loss_ratio: None,
        }
    }
}

/// The voids with what the ordered cuts leave closed or unclean kept solid and the rest solved for
/// again, until nothing is; or why that cannot be had. The tuner is left as the last round left it.
pub fn settled(
    tuner: &mut Tuner,
    mut voids: Voids,
    terms: &Terms,
) -> Result<Result<Settled, Refusal>, Error> {
    let replan = if terms.is_ordered {
        plan_by
    } else {
        plan_around
    };
    for round in 0..=terms.rounds {
        if !voids.solution.is_usable() {
            return Ok(Err(Refusal::because("make the goal impossible")));
        }
        let now = Reached::by(&voids);
        let filled = terms.before.filled_ratio(&now);
        if filled > MAX_VOID_LOSS_RATIO {
            return Ok(Err(Refusal::because(&format!(
                "make {:.0} % of the voids solid",
                100.0 * filled
            ))));
        }
        let loss = terms.before.loss_ratio(&now);
        if round > 0 && loss > terms.max_loss_ratio {
            let why = format!("cost {:.0} % of what the kit reaches", 100.0 * loss);
            return Ok(Err(Refusal {
                why,
                loss_ratio: Some(loss),
            }));
        }
        let dirty = match replan(&voids.hollowed, terms.request, terms.order) {
            Ok(plan) => {
                let dirty = left_unclean(&voids, &plan, terms)?;
                if dirty.is_empty() {
                    return Ok(Ok(Settled { voids, plan }));
                }
                dirty
            }
            Err(CutError::ClosedCavity { .. }) => {
                let closed = closed(&voids.hollowed, &terms.order.cuts, terms.request)?;
                if closed.is_empty() {
                    return Ok(Err(Refusal::because("close a void")));
                }
                closed
            }
            // What was kept solid has changed the faces that the bosses' pins stood in.
            Err(CutError::PinOffFace { .. }) if !terms.is_ordered => {
                return Ok(Err(Refusal::because("move the joint away from its pins")));
            }
            Err(error) => return Err(error.into()),
        };
        let bodies: Vec<TriMesh> = dirty
            .into_iter()
            .flat_map(|unclean| unclean.lumps)
            .collect();
        voids = tuner.without(&voids, (&bodies, MARGIN_RATIO))?;
    }
    Ok(Err(Refusal::because("leave a void that cannot be cleaned")))
}

fn left_unclean(voids: &Voids, plan: &CutPlan, terms: &Terms) -> Result<Vec<Unclean>, CutError> {
    if !terms.must_be_clean || are_clean(plan, terms.request) {
        return Ok(Vec::new());
    }
    let mut dirty = unclean(&voids.hollowed, plan, terms.request, false)?;
    dirty.retain(|unclean| {
        !plan.voids[unclean.void].is_clean_without_margin(terms.request, plan.voids.len())
    });
    Ok(dirty)
}

/// Whether every void of a plan is clean by the process's rule. The planner's margin is not asked:
/// keeping more of a void solid and solving again for three thousandths of its wall costs more than
/// any boss (cheburashka by filament: 15 % for two pins).
pub fn are_clean(plan: &CutPlan, request: &PlanRequest) -> bool {
    plan.voids
        .iter()
        .all(|void| void.is_clean_without_margin(request, plan.voids.len()))
}

/// By which share of itself the figure has become worse.
fn loss_ratio(before: &Certificate, after: &Certificate) -> f64 {
    let [was, is] = [before, after].map(|certificate| certificate.figure.cost(certificate.value));
    (is - was) / was.abs().max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hollow::Figure;

    #[test]
    fn a_loss_is_a_share_of_what_was_reached_whichever_way_is_better() {
        let reached = |figure, value| Certificate {
            figure,
            value,
            bound: value,
            gap_ratio: 0.0,
            residual: 0.0,
            bound_over_heights: None,
        };
        let rpm = |value| reached(Figure::CriticalSpeedRpm, value);
        assert!((loss_ratio(&rpm(400.0), &rpm(420.0)) - 0.05).abs() < 1e-12);
        let angle = |value| reached(Figure::TopplingAngleRad, value);
        assert!((loss_ratio(&angle(0.5), &angle(0.4)) - 0.2).abs() < 1e-12);
        assert!(loss_ratio(&angle(0.4), &angle(0.5)) < 0.0);
    }
}
