//! Cleaning: what no cut lets be cleaned is kept solid, and the rest solved for again.

use super::budget::Work;
use super::plan::Planner;
use super::resolve::{Refused, Resolver};
use crate::base::verdict::Verdict;
use crate::cut::{
    CutError, CutPlan, Obstacle, PlanRequest, SolidEnd, Unclean, VoidId, draft_again, find_closed,
    find_unclean,
};
use crate::error::Error;
use crate::job::CutMode;
use crate::mass::Moments;
use crate::mesh::{MeshDistance, TriMesh};
use crate::run::{CleaningRound, KeptCause, KeptSolid, Placed, Voids};

/// Voids with a plan, and the rounds that led to them.
pub struct Cleaned {
    /// The voids.
    pub voids: Voids,
    /// The cuts, and no pins yet if the planner chose them.
    pub plan: CutPlan,
    /// The rounds in which something was kept solid.
    pub rounds: Vec<CleaningRound>,
}

/// Voids to be cleaned, and a draft whose cuts are held if there is one.
pub struct Start {
    /// The voids.
    pub voids: Voids,
    /// A draft for them.
    pub draft: Option<CutPlan>,
}

#[cfg(test)]
impl Start {
    /// Starts without a draft.
    pub fn of(voids: Voids) -> Self {
        Self { voids, draft: None }
    }
}

/// Bodies to be kept solid.
pub struct Keep {
    /// The bodies.
    pub bodies: Vec<TriMesh>,
    /// The voids that they lie in, and why.
    pub kept: Vec<KeptSolid>,
    /// Margin around them, in minimum openings.
    pub margin_openings: f64,
}

/// Drafts cuts with which every void can be cleaned by the printer's rule.
///
/// Ends of voids that a plan leaves uncleanable are kept solid, and the rest solved for again and
/// planned anew. The solid part only grows, so that this ends. A round after which the goal cannot
/// be met is undone, and the kit's checks say which void stays unclean.
///
/// Voids are corrected in the end alone: corrections move surfaces by micrometres, which changes
/// nothing of what is seen.
///
/// The cuts of a draft that it starts from are held. Chosen anew in each round, cuts that weigh
/// what they leave unclean would wander to where more and more stays solid.
///
/// It stops, with what is not clean yet, as soon as `is_lost` says that the voids have lost too
/// much: further rounds only lose more. The voids then have their last solution, and the surfaces
/// of the one before.
pub fn clean(
    resolver: &mut Resolver,
    start: Start,
    request: &PlanRequest,
    is_lost: &dyn Fn(&Voids) -> bool,
) -> Result<Cleaned, Error> {
    let placed = resolver.placed();
    let mut rounds = Vec::new();
    let mut request = request.clone();
    let Start {
        mut voids,
        draft: held,
    } = start;
    loop {
        resolver.watch().check()?;
        spend(resolver, &voids, held.is_none());
        let plan = match &held {
            Some(first) if rounds.is_empty() => Verdict::Found(first.clone()),
            Some(first) => draft_again(&voids.hollowed, &request, first)?,
            None => resolver.planner().draft(&voids, &request)?,
        };
        let round = Round {
            planner: resolver.planner(),
            placed,
            voids: &voids,
            request: &request,
            number: rounds.len(),
        };
        let dirty = find_uncleanable(&round, &plan)?;
        if dirty.bodies.is_empty() || rounds.len() == placed.policy.cleaning_rounds {
            let plan = plan.or_error::<CutError>()?;
            return Ok(Cleaned {
                voids: resolver.correct(voids, Moments::default())?,
                plan,
                rounds,
            });
        }
        let (round, less) = keep_solid(resolver, &voids, dirty, is_lost)?;
        match (less, plan) {
            (Some(less), plan) if is_lost(&less) => {
                rounds.push(round);
                let plan = plan.or_error::<CutError>()?;
                return Ok(Cleaned {
                    voids: less,
                    plan,
                    rounds,
                });
            }
            (Some(less), _) => {
                voids = less;
                rounds.push(round);
            }
            // Rather any further cut, however seen, than a goal that cannot be met.
            (None, Verdict::Found(_)) if held.is_none() && allow_more_cuts(&mut request) => {}
            (None, plan) => {
                rounds.push(round);
                let plan = plan.or_error::<CutError>()?;
                return Ok(Cleaned {
                    voids: resolver.correct(voids, Moments::default())?,
                    plan,
                    rounds,
                });
            }
        }
    }
}

/// Counts the work of a round on these voids.
fn spend(resolver: &Resolver, voids: &Voids, drafts: bool) {
    let bodies = voids.hollowed.voids.iter();
    let triangles = bodies.map(|void| void.mesh().triangles().len()).sum();
    if drafts {
        resolver.budget().spend(Work::Draft(triangles));
    }
    resolver.budget().spend(Work::Look(triangles));
}

/// Allows cuts that were too dear until now: first any number, then seams wherever they are seen.
/// Returns false if nothing was forbidden any more.
fn allow_more_cuts(request: &mut PlanRequest) -> bool {
    if request.worth_ratio > 0.0 {
        request.worth_ratio = 0.0;
    } else if request.seams.are_seen() {
        request.seams = request.seams.unseen();
    } else {
        return false;
    }
    true
}

/// A round of cleaning before it is done.
struct Round<'a> {
    planner: &'a Planner,
    placed: &'a Placed,
    voids: &'a Voids,
    request: &'a PlanRequest,
    /// Number of rounds before it.
    number: usize,
}

/// Finds what must be kept solid because a plan does not let it be cleaned.
fn find_uncleanable(round: &Round, plan: &Verdict<CutPlan, Obstacle>) -> Result<Keep, Error> {
    let Round {
        planner,
        placed,
        voids,
        request,
        number,
    } = *round;
    let policy = &placed.policy;
    let whole = number >= policy.shrinking_rounds;
    let (unclean, margin_openings) = match plan {
        Verdict::Found(plan) if placed.job.cut != CutMode::Never => (
            find_unclean(&voids.hollowed, plan, request, whole)?,
            if whole {
                policy.refused_margin_openings
            } else {
                policy.cleaning_margin_openings
            },
        ),
        Verdict::No(Obstacle::Unopenable { voids: closed, .. }) if are_empty(voids, closed) => {
            let keep = keep_unopenable(voids, closed, policy.refused_margin_openings);
            return Ok(keep);
        }
        Verdict::No(Obstacle::ClosedCavity { .. }) => (
            find_little_closed(voids, planner, policy.max_void_loss_ratio)?,
            policy.cleaning_margin_openings,
        ),
        _ => (Vec::new(), policy.cleaning_margin_openings),
    };
    let kept = |unclean: &Unclean| KeptSolid {
        void: unclean.void,
        cause: KeptCause::Uncleanable(unclean.cause),
    };
    Ok(Keep {
        kept: unclean.iter().map(kept).collect(),
        bodies: unclean
            .into_iter()
            .flat_map(|unclean| unclean.bodies)
            .collect(),
        margin_openings,
    })
}

/// Returns the voids that no ordered cut meets, or none if no cut is ordered at all. If they are
/// more than this share of all voids, it returns none either, and the order is refused.
fn find_little_closed(
    voids: &Voids,
    planner: &Planner,
    max_ratio: f64,
) -> Result<Vec<Unclean>, CutError> {
    let cuts = planner.order().map(|order| &order.cuts[..]);
    let Some(cuts) = cuts.filter(|cuts| !cuts.is_empty()) else {
        return Ok(Vec::new());
    };
    let closed = find_closed(&voids.hollowed, cuts)?;
    let bodies = closed.iter().flat_map(|unclean| &unclean.bodies);
    let closed_mm3: f64 = bodies.map(TriMesh::signed_volume_mm3).sum();
    let all = voids.hollowed.voids.iter();
    let all_mm3: f64 = all.map(|void| void.mesh().signed_volume_mm3()).sum();
    Ok(if closed_mm3 <= max_ratio * all_mm3 {
        closed
    } else {
        Vec::new()
    })
}

/// Keeps voids solid that no cut opens.
fn keep_unopenable(voids: &Voids, closed: &[VoidId], margin_openings: f64) -> Keep {
    let body = |&void: &VoidId| {
        let body = voids.hollowed.voids.get(void.index())?;
        Some((void, body.mesh().clone()))
    };
    let (ids, bodies): (Vec<VoidId>, Vec<TriMesh>) = closed.iter().filter_map(body).unzip();
    let kept = |void| KeptSolid {
        void,
        cause: KeptCause::Unopenable,
    };
    Keep {
        kept: ids.into_iter().map(kept).collect(),
        bodies,
        margin_openings,
    }
}

/// Returns whether none of these voids holds ballast, which cannot stay solid.
fn are_empty(voids: &Voids, ids: &[VoidId]) -> bool {
    let is_empty = |void: &VoidId| voids.hollowed.voids[void.index()].holds.is_none();
    ids.iter().all(is_empty)
}

/// Keeps parts of the interior solid and solves again; `None` if nothing can be emptied there, or
/// if the goal cannot be met any more.
pub fn without_ends(
    resolver: &mut Resolver,
    voids: &Voids,
    ends: &[SolidEnd],
    cause: &KeptCause,
) -> Result<Option<(CleaningRound, Voids)>, Error> {
    let bodies = resolver.parts_about(ends)?;
    if bodies.is_empty() {
        return Ok(None);
    }
    let walls = voids.hollowed.voids.iter();
    let walls: Vec<MeshDistance> = walls.map(|void| MeshDistance::new(void.mesh())).collect();
    let nearest = |end: &SolidEnd| {
        let depth = |wall: &MeshDistance| wall.signed(&end.at_mm.into());
        let depths = walls.iter().map(depth).enumerate();
        let (index, _) = depths.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let cause = *cause;
        Some(KeptSolid {
            void: VoidId::of(index),
            cause,
        })
    };
    let keep = Keep {
        kept: ends.iter().filter_map(nearest).collect(),
        bodies,
        margin_openings: resolver.placed().policy.cleaning_margin_openings,
    };
    let (mut round, less) = keep_solid(resolver, voids, keep, &|_| false)?;
    round.by_plan = true;
    Ok(less.map(|less| (round, less)))
}

/// Keeps bodies solid, solves again and draws once. If the goal cannot be met any more there are no
/// voids, and the resolver is as it was. Voids that `is_lost` refuses keep their old surfaces.
pub fn keep_solid(
    resolver: &mut Resolver,
    voids: &Voids,
    keep: Keep,
    is_lost: &dyn Fn(&Voids) -> bool,
) -> Result<(CleaningRound, Option<Voids>), Error> {
    let before = resolver.clone();
    let refused = Refused {
        bodies: &keep.bodies,
        margin_openings: keep.margin_openings,
        is_lost,
    };
    let less = resolver.without(voids, &refused)?;
    let less = less.solution.is_usable().then_some(less);
    if less.is_none() {
        *resolver = before;
    }
    let volumes = keep.bodies.iter().map(TriMesh::signed_volume_mm3);
    let value = |voids: &Voids| voids.solution.certificate.value;
    let round = CleaningRound {
        kept: keep.kept,
        volume_mm3: volumes.sum(),
        value_before: value(voids),
        value_after: less.as_ref().map(value),
        by_plan: false,
    };
    Ok((round, less))
}

#[cfg(test)]
mod tests;
