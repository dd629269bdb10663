//! Draining in a vat: ends of voids that would catch resin are kept solid, and the rest solved for
//! again.

use super::clean::{Cleaned, Keep, Start, clean, keep_solid};
use super::refused::unless_refused;
use super::resolve::Resolver;
use crate::cut::{
    CutError, CutPlan, HollowCup, PlanRequest, Unclean, draft_again, find_closed, find_hollow_cups,
};
use crate::error::Error;
use crate::run::{CleaningRound, KeptCause, KeptSolid, Voids};

/// Drafts cuts as [`clean`] does, of which no part is a suction cup in the printer.
///
/// Ends of voids that would catch resin in the best pose of their part are kept solid. Shops fill
/// such ends rather than drill a hole through the outside, which must be plugged. A round is undone
/// if the goal cannot be met any more, or if no plan opens the rest. The kit's checks then say
/// which part is a cup.
pub fn clean_and_drain(
    resolver: &mut Resolver,
    start: Start,
    request: &PlanRequest,
    is_lost: &dyn Fn(&Voids) -> bool,
) -> Result<Cleaned, Error> {
    let is_held = start.draft.is_some();
    let mut cleaned = clean(resolver, start, request, is_lost)?;
    for _ in 0..resolver.placed().policy.shrinking_rounds {
        if is_lost(&cleaned.voids) {
            break;
        }
        let cups = find_hollow_cups(&cleaned.voids.hollowed, &cleaned.plan, request)?;
        if cups.is_empty() {
            break;
        }
        let before = resolver.clone();
        let Some((mut rounds, less)) = fill(resolver, &cleaned, cups)? else {
            break;
        };
        let next = start_again(less, is_held.then_some(&cleaned.plan), request)
            .and_then(|start| clean(resolver, start, request, is_lost));
        let Some(next) = unless_refused(next)? else {
            *resolver = before;
            break;
        };
        rounds.splice(0..0, cleaned.rounds);
        rounds.extend(next.rounds);
        cleaned = Cleaned { rounds, ..next };
    }
    Ok(cleaned)
}

/// Starts again with smaller voids, from the same cuts if they are held.
fn start_again(
    voids: Voids,
    held: Option<&CutPlan>,
    request: &PlanRequest,
) -> Result<Start, Error> {
    let draft = held
        .map(|plan| draft_again(&voids.hollowed, request, plan)?.or_error::<CutError>())
        .transpose()?;
    Ok(Start { voids, draft })
}

/// Keeps cups solid, and what the cuts then leave closed. Returns the rounds, and the voids; `None`
/// if the goal cannot be met any more, or if something stays closed.
fn fill(
    resolver: &mut Resolver,
    cleaned: &Cleaned,
    cups: Vec<HollowCup>,
) -> Result<Option<(Vec<CleaningRound>, Voids)>, Error> {
    let policy = resolver.placed().policy;
    let before = resolver.clone();
    let mut voids = cleaned.voids.clone();
    let mut rounds = Vec::new();
    let mut solid = keep(cups, policy.cleaning_margin_openings);
    for _ in 0..policy.cleaning_rounds {
        let (round, less) = keep_solid(resolver, &voids, solid, &|_| false)?;
        let Some(less) = less else { break };
        rounds.push(round);
        voids = less;
        let closed = find_closed(&voids.hollowed, &cleaned.plan.cuts)?;
        if closed.is_empty() {
            return Ok(Some((rounds, voids)));
        }
        solid = keep_closed(closed, policy.cleaning_margin_openings);
    }
    *resolver = before;
    Ok(None)
}

fn keep(cups: Vec<HollowCup>, margin_openings: f64) -> Keep {
    let kept = |cup: &HollowCup| KeptSolid {
        void: cup.void,
        cause: KeptCause::Cup {
            volume_mm3: cup.volume_mm3,
        },
    };
    Keep {
        kept: cups.iter().map(kept).collect(),
        bodies: cups.into_iter().map(|cup| cup.body).collect(),
        margin_openings,
    }
}

fn keep_closed(closed: Vec<Unclean>, margin_openings: f64) -> Keep {
    let kept = |unclean: &Unclean| KeptSolid {
        void: unclean.void,
        cause: KeptCause::Uncleanable(unclean.cause),
    };
    Keep {
        kept: closed.iter().map(kept).collect(),
        bodies: closed.into_iter().flat_map(|end| end.bodies).collect(),
        margin_openings,
    }
}

#[cfg(test)]
mod tests;
