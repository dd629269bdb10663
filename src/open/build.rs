//! A plan that was found on a copy of the body, built on the body itself.

use super::bosses::{Bossed, add_bosses};
use super::clean::Start;
use super::drain::clean_and_drain;
use super::plan::{are_clean, finish_once};
use super::refused::unless_refused;
use super::resolve::{Kept, Resolver};
use super::way::{Candidate, Way};
use crate::base::verdict::Verdict;
use crate::base::watch::Phase;
use crate::cut::{CutOrder, CutPlan, PinSite, PlanRequest, draft_again, plan_around};
use crate::error::Error;
use crate::geom::Point;
use crate::run::{BossRound, Opened, Voids};

/// A plan, and what it keeps solid.
pub struct Found {
    opened: Opened,
    kept: Kept,
}

impl Found {
    /// Returns the plan of a candidate.
    pub fn of(candidate: Candidate) -> Self {
        Self {
            kept: candidate.resolver.kept(),
            opened: candidate.opened,
        }
    }

    /// Counts its joints without pins that fit one way only.
    fn count_lacking(&self) -> usize {
        count_lacking(&self.opened.plan)
    }

    /// Returns whether every void can be cleaned.
    fn is_clean(&self) -> bool {
        are_clean(&self.opened.plan, &self.opened.request)
    }

    /// Returns the rounds of bosses with their pins in the cuts of `plan`; `None` if a cut is gone.
    /// The cuts may have moved by a part of a layer.
    fn bosses_in(&self, plan: &CutPlan) -> Result<Option<Vec<BossRound>>, Error> {
        let mut rounds = self.opened.bosses.clone();
        for boss in rounds.iter_mut().flat_map(|round| &mut round.bosses) {
            let Some(cut) = plan.cuts.iter().find(|cut| cut.id == boss.pin.cut) else {
                return Ok(None);
            };
            let center = Point::from(boss.pin.center_mm);
            let plane = cut.plane()?;
            boss.pin.center_mm = (center - plane.normal * plane.distance(&center)).into();
        }
        Ok(Some(rounds))
    }
}

fn count_lacking(plan: &CutPlan) -> usize {
    let joints = plan.joints.iter();
    joints.filter(|joint| !joint.is_aligned()).count()
}

/// Builds a plan on the body itself: keeps the same solid, solves, draws and makes the same cuts.
/// What is not clean yet there is kept solid too.
///
/// `None` if the body does not bear the plan out. It then misses the goal, is less clean than its
/// copy, or has fewer joints with pins.
pub fn build<'a>(whole: &Resolver<'a>, found: Found) -> Result<Option<Candidate<'a>>, Error> {
    let Some(way) = cut_and_clean(whole, &found)? else {
        return Ok(None);
    };
    let Some(way) = unless_refused(place_pins(way, &found))? else {
        return Ok(None);
    };
    if way.lacking()[0] > found.count_lacking() {
        return Ok(None);
    }
    let mut candidate = way.into_candidate(Vec::new());
    candidate.opened.remarks = found.opened.remarks;
    Ok(Some(candidate))
}

/// Draws the voids of a plan on the body itself and makes its cuts; `None` if the goal is missed,
/// or if the voids are less clean.
fn cut_and_clean<'a>(whole: &Resolver<'a>, found: &Found) -> Result<Option<Way<'a>>, Error> {
    let watch = whole.watch();
    watch.enter(Phase::Voids);
    let mut resolver = whole.clone();
    let voids = resolver.keep(&found.kept)?;
    if !voids.solution.is_usable() {
        return Ok(None);
    }
    watch.enter(Phase::Plan);
    let Opened { request, plan, .. } = &found.opened;
    let Verdict::Found(draft) = draft_again(&voids.hollowed, request, plan)? else {
        return Ok(None);
    };
    let start = Start {
        voids,
        draft: Some(draft),
    };
    let cleaned = clean_and_drain(&mut resolver, start, request, &|_| false);
    let Some(cleaned) = unless_refused(cleaned)? else {
        return Ok(None);
    };
    let is_as_clean = are_clean(&cleaned.plan, request) || !found.is_clean();
    if !is_as_clean || !cleaned.voids.solution.is_usable() {
        return Ok(None);
    }
    let cuts = CutPlan {
        solid: plan.solid.clone(),
        ..cleaned.plan
    };
    let rounds = found.opened.cleaning.iter().cloned();
    Ok(Some(Way {
        rung: found.opened.rung,
        cleaning: rounds.chain(cleaned.rounds).collect(),
        bossed: Bossed::without(cleaned.voids, cuts),
        resolver,
        request: request.clone(),
    }))
}

/// Places pins: those in bosses that were found, the others in the walls. If too few joints have
/// them, bosses are sought once more.
fn place_pins<'a>(mut way: Way<'a>, found: &Found) -> Result<Way<'a>, Error> {
    let Bossed { voids, plan, .. } = way.bossed;
    let walls = finish_once(way.resolver.placed(), &voids, &way.request, plan)?;
    let rounds = found.bosses_in(&walls)?.unwrap_or_default();
    let around = place_around(&voids, &walls, &way.request, &rounds)?;
    way.bossed = match around {
        Some(plan) => Bossed::with(voids, plan, rounds),
        None => Bossed::without(voids, walls),
    };
    if way.lacking()[0] > found.count_lacking() {
        way.resolver.watch().enter(Phase::Bosses);
        way.bossed = add_bosses(&mut way.resolver, way.bossed, &way.request)?;
    }
    Ok(way)
}

/// Returns the plan with pins in the bosses of these rounds; `None` if there are none, or if they
/// have no place.
fn place_around(
    voids: &Voids,
    plan: &CutPlan,
    request: &PlanRequest,
    rounds: &[BossRound],
) -> Result<Option<CutPlan>, Error> {
    let bosses = rounds.iter().flat_map(|round| &round.bosses);
    let pins: Vec<PinSite> = bosses.map(|boss| boss.pin.clone()).collect();
    if pins.is_empty() {
        return Ok(None);
    }
    let order = CutOrder {
        pins: Some(pins),
        ..CutOrder::of(plan)
    };
    let around = plan_around(&voids.hollowed, request, &order)?;
    let Verdict::Found(around) = around else {
        return Ok(None);
    };
    Ok(Some(CutPlan {
        notes: plan.notes.clone(),
        moves: plan.moves.clone(),
        ..around
    }))
}
