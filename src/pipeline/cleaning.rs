//! Cuts with which every void can be cleaned; where none do, what cannot be cleaned is kept solid
//! and the rest solved for again.

use super::{
    Error, Setup,
    tuner::{REFUSED_MARGIN_RATIO, Tuner, Voids},
};
use crate::cut::{
    self, CutError, CutOrder, CutPlan, PlanRequest, SolidEnd, Unclean, plan_by, unclean,
};
use crate::job::CutMode;
use crate::mesh::{MeshDistance, TriMesh};

/// Rounds in which a void is made smaller: each keeps the ends solid that cannot be cleaned. What
/// is left usually can be after one or two; each costs a solve and a plan.
const SHRINKING_ROUNDS: usize = 4;
/// Rounds in all; in the last ones what cannot be cleaned goes altogether, so that the sequence
/// ends.
const MAX_ROUNDS: usize = 8;

/// Hidden ends of voids are kept solid with so much around them, in minimum openings. More costs
/// solid that could be cleaned, less takes more rounds.
const END_MARGIN_RATIO: f64 = 0.5;

/// One round: what was kept solid, and what that costs.
#[derive(Debug, Clone, PartialEq)]
pub struct CleaningRound {
    /// Which voids, counted from 0 as they were before the round; and why.
    pub kept: Vec<(usize, String)>,
    /// The volume of what was kept solid, without the room about it, mm³.
    pub volume_mm3: f64,
    /// The figure of the certificate before the round.
    pub value_before: f64,
    /// And after it; none where nothing would have met the goal any more, so that the round was
    /// taken back.
    pub value_after: Option<f64>,
    /// Whether the plan keeps it solid, and not cleaning.
    pub by_plan: bool,
}

/// Voids with a plan, and the rounds that led to them.
pub struct Cleaned {
    /// The voids.
    pub voids: Voids,
    /// The cuts and pins.
    pub plan: CutPlan,
    /// What was kept solid on the way.
    pub rounds: Vec<CleaningRound>,
}

/// The voids that the printer's cleaning rule leaves, and the plan that opens them.
///
/// A plan is made; what of the voids it does not let be cleaned is kept solid, and the rest solved
/// for again, at most [`MAX_ROUNDS`] times: what is kept solid only grows, so that it cannot go
/// round in circles. A round after which the goal could no longer be met is taken back, and the
/// checks of the kit say which void stays unclean.
pub fn cleaned<'a>(
    setup: &'a Setup,
    tuner: &mut Tuner<'a>,
    mut voids: Voids,
    request: &PlanRequest,
) -> Result<Cleaned, Error> {
    let mut rounds = Vec::new();
    let mut request = request.clone();
    loop {
        let planned = planned_once(setup, &voids, &request);
        let whole = rounds.len() >= SHRINKING_ROUNDS;
        let ends = if whole {
            REFUSED_MARGIN_RATIO
        } else {
            END_MARGIN_RATIO
        };
        let (dirty, openings) = match &planned {
            Ok(plan) if setup.job.cut != CutMode::Never => {
                (unclean(&voids.hollowed, plan, &request, whole)?, ends)
            }
            Err(CutError::Unopenable { voids: closed, .. }) if are_plain(setup, &voids, closed) => {
                (unopened(&voids, closed), REFUSED_MARGIN_RATIO)
            }
            _ => (Vec::new(), ends),
        };
        let is_last = dirty.is_empty() || rounds.len() == MAX_ROUNDS;
        if is_last {
            return Ok(Cleaned {
                voids,
                plan: planned?,
                rounds,
            });
        }
        let bodies: Vec<TriMesh> = dirty
            .iter()
            .flat_map(|unclean| unclean.lumps.clone())
            .collect();
        let kept = dirty
            .iter()
            .map(|unclean| (unclean.void, unclean.why.clone()))
            .collect();
        let (round, less) = kept_solid(tuner, &voids, (kept, &bodies, openings))?;
        match (less, planned) {
            (Some(less), _) => {
                voids = less;
                rounds.push(round);
            }
            // Rather any further cut than a goal that cannot be met.
            (None, Ok(_)) if request.worth_ratio > 0.0 => request.worth_ratio = 0.0,
            (None, planned) => {
                rounds.push(round);
                return Ok(Cleaned {
                    voids,
                    plan: planned?,
                    rounds,
                });
            }
        }
    }
}

/// The voids without these parts of the interior, solved for again; none where they hold nothing,
/// or the goal cannot be met without them.
pub fn without_ends(
    tuner: &mut Tuner,
    voids: &Voids,
    (ends, why): (&[SolidEnd], &str),
) -> Result<Option<(CleaningRound, Voids)>, Error> {
    let bodies = tuner.parts_about(ends)?;
    if bodies.is_empty() {
        return Ok(None);
    }
    let walls: Vec<MeshDistance> = voids
        .hollowed
        .voids
        .iter()
        .map(|void| MeshDistance::new(void.mesh()))
        .collect();
    let nearest = |end: &SolidEnd| {
        let rated = walls
            .iter()
            .enumerate()
            .map(|(void, wall)| (void, wall.signed(&end.at_mm.into())));
        rated
            .max_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(void, _)| (void, why.to_owned()))
    };
    let kept = ends.iter().filter_map(nearest).collect();
    let (round, less) = kept_solid(tuner, voids, (kept, &bodies, END_MARGIN_RATIO))?;
    Ok(less.map(|less| {
        (
            CleaningRound {
                by_plan: true,
                ..round
            },
            less,
        )
    }))
}

/// One round: the voids without these bodies, solved for again; none where that meets the goal no
/// more, and the tuner is as it was.
fn kept_solid(
    tuner: &mut Tuner,
    voids: &Voids,
    (kept, bodies, openings): (Vec<(usize, String)>, &[TriMesh], f64),
) -> Result<(CleaningRound, Option<Voids>), Error> {
    let before = tuner.clone();
    let less = tuner.without(voids, (bodies, openings))?;
    let less = less.solution.is_usable().then_some(less);
    if less.is_none() {
        *tuner = before;
    }
    let round = CleaningRound {
        kept,
        volume_mm3: bodies.iter().map(TriMesh::signed_volume_mm3).sum(),
        value_before: voids.solution.certificate.value,
        value_after: less.as_ref().map(|less| less.solution.certificate.value),
        by_plan: false,
    };
    Ok((round, less))
}

/// Voids that no cut opens, all of which must go.
fn unopened(voids: &Voids, closed: &[usize]) -> Vec<Unclean> {
    let known = closed
        .iter()
        .filter_map(|&void| Some((void, voids.hollowed.voids.get(void)?)));
    let gone = |(void, solid): (usize, &crate::mesh::Solid)| Unclean {
        void,
        why: "no cut opens it wide enough".to_owned(),
        lumps: vec![solid.mesh().clone()],
    };
    known.map(gone).collect()
}

/// Whether none of these voids is a pocket of ballast, which cannot be left solid.
fn are_plain(setup: &Setup, voids: &Voids, refused: &[usize]) -> bool {
    let plain = voids.hollowed.voids.len() - setup.load.parts.len();
    refused.iter().all(|&void| void < plain)
}

/// The cuts and pins for the voids as they are.
pub fn planned_once(
    setup: &Setup,
    voids: &Voids,
    request: &PlanRequest,
) -> Result<CutPlan, CutError> {
    match (&setup.job.plan, setup.job.cut) {
        (Some(order), _) => match plan_by(&voids.hollowed, request, order) {
            // The pin may stand in a boss that is still to be kept solid.
            Err(CutError::PinOffFace { .. }) => plan_by(
                &voids.hollowed,
                request,
                &CutOrder {
                    pins: Some(Vec::new()),
                    ..order.clone()
                },
            ),
            plan => plan,
        },
        (None, CutMode::Auto) => cut::plan(&voids.hollowed, request),
        (None, CutMode::Never) => plan_by(&voids.hollowed, request, &CutOrder::default()),
    }
}
