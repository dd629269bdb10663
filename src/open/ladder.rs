//! The ladder: rungs are tried in order until one gives every joint its pins; the best are kept.

mod angle;
mod fewer;
mod hidden;
mod joined;
mod rungs;
mod trial;
mod unseen;
mod whole;

use joined::{Fewer, Joined};
use trial::Trial;

use super::aligned::count_unaligned_of;
use super::bosses::{Bossed, add_bosses};
use super::budget::Budget;
use super::clean::Start;
use super::drain::clean_and_drain;
use super::ground::Ground;
use super::plan::Planner;
use super::refused::unless_refused;
use super::request::request;
use super::resolve::{Kept, Resolver};
use super::tendency::lean;
use super::way::{Candidate, Way};
use crate::base::watch::{Phase, Watch};
use crate::cut::{CutError, CutOrder, CutPlan, PlanRequest, SolidEnd, find_ends_at_uncut_faces};
use crate::error::Error;
use crate::run::{KeptCause, Opened, Policy, Remark, Rung, Tendency, Untried, Voids};

/// Counts the joints of the best plan that neither pins nor a jig align.
fn count_unaligned_in_best(candidates: &[Candidate]) -> Result<usize, CutError> {
    let best = candidates.first().map(|candidate| &candidate.opened);
    best.map_or(Ok(0), count_unaligned_of)
}

/// Keeps solid what an order says: its own regions, and the ends of voids at faces that it leaves
/// whole. Returns a remark if the goal is lost with them; then they are not kept.
fn keep_ordered<'a>(
    ground: Ground<'a>,
    order: &CutOrder,
    request: &PlanRequest,
) -> Result<(Ground<'a>, Option<Remark>), Error> {
    let kept = keep_solid(ground, &order.solid)?;
    let (ground, None) = kept else {
        return Ok(kept);
    };
    let margin_mm = ground.resolver.placed().policy.ends_margin_openings * request.min_opening_mm;
    let hollowed = &ground.voids.hollowed;
    let ends = find_ends_at_uncut_faces(hollowed, order, margin_mm, &request.watch)?;
    keep_solid(ground, &ends)
}

/// Keeps regions solid by order; leaves the voids as they are, with a remark, if the goal is lost.
fn keep_solid<'a>(
    ground: Ground<'a>,
    solid: &[SolidEnd],
) -> Result<(Ground<'a>, Option<Remark>), Error> {
    if solid.is_empty() {
        return Ok((ground, None));
    }
    Ok(match ground.without(solid, &KeptCause::Ordered)? {
        Some(less) => (less, None),
        None => (ground, Some(Remark::OrderTooSolid)),
    })
}

/// The ladder from one set of voids.
#[derive(Clone)]
pub(super) struct Ladder<'a> {
    policy: Policy,
    watch: Watch,
    ground: Ground<'a>,
    pub(super) request: PlanRequest,
    /// The remarks on what a person ordered, and on the choice of seams.
    notes: Vec<Remark>,
    /// True if a plan with dear seams is given up for a hidden one.
    hides_seams: bool,
    /// True if a plan with fewer parts is sought.
    joins_parts: bool,
    /// A draft with hidden seams and walls out of sight that is worth making first.
    unseen: Option<Trial<'a>>,
}

impl<'a> Ladder<'a> {
    /// Draws the voids, without what the job's plan keeps solid.
    pub(super) fn new(mut resolver: Resolver<'a>) -> Result<Self, Error> {
        let (placed, watch) = (resolver.placed(), &resolver.watch().clone());
        watch.enter(Phase::Voids);
        let request = request(placed, watch)?;
        let voids = resolver.draw()?;
        let ground = Ground {
            resolver,
            voids,
            draft: None,
            solid: Vec::new(),
            rounds: Vec::new(),
        };
        let planner = ground.resolver.planner().clone();
        let (ground, note) = match planner.order() {
            Some(order) => keep_ordered(ground, order, &request)?,
            None => (ground, None),
        };
        Ok(Self::from(ground, request, note.into_iter().collect()))
    }

    /// Starts from what was kept solid on a copy of the body for this plan. `None` if the goal is
    /// missed with it.
    pub(super) fn after(
        mut resolver: Resolver<'a>,
        planned: &Opened,
        kept: &Kept,
    ) -> Result<Option<Self>, Error> {
        let (placed, watch) = (resolver.placed(), resolver.watch().clone());
        watch.enter(Phase::Voids);
        let request = request(placed, &watch)?;
        let voids = resolver.keep(kept)?;
        let ground = Ground {
            resolver,
            voids,
            draft: None,
            solid: planned.plan.solid.clone(),
            rounds: planned.cleaning.clone(),
        };
        let is_usable = ground.voids.solution.is_usable();
        let ladder = || Self::from(ground, request, Vec::new());
        Ok(is_usable.then(ladder))
    }

    /// Starts from a ground, with remarks on what a person ordered.
    fn from(ground: Ground<'a>, request: PlanRequest, notes: Vec<Remark>) -> Self {
        let placed = ground.resolver.placed();
        Self {
            policy: placed.policy,
            watch: ground.resolver.watch().clone(),
            hides_seams: placed.job.seam.is_hidden(),
            joins_parts: true,
            unseen: None,
            ground,
            request,
            notes,
        }
    }

    /// Climbs it. Returns the plans worth making, best first and never none.
    ///
    /// The search ends with the first plan of which pins or jigs align every joint. Hidden seams
    /// that nothing aligns give way to others, and are not followed beyond the usual rungs.
    ///
    /// A plan with walls out of sight stands first: its kit says whether they hold support.
    pub(super) fn climb(mut self) -> Result<Vec<Candidate<'a>>, Error> {
        let drafted = self.plan_in_walls(&self.ground, &self.request, Rung::Walls, &|_| false)?;
        let (drafted, missed) = self.keep_angle(drafted)?;
        let missed = missed.map(|missed| self.climb_missed(missed)).transpose()?;
        let shown = Self {
            hides_seams: false,
            ..self.clone()
        };
        let walls = self.hide_seams(drafted.clone())?;
        let first = self.finish_unseen()?;
        let rest = self.climb_from(walls, shown, drafted)?;
        let last = missed.into_iter().flatten();
        Ok(first.into_iter().chain(rest).chain(last).collect())
    }

    /// Climbs on from the walls of a draft. Takes also the ladder and draft with seams that are
    /// not hidden.
    fn climb_from(
        mut self,
        walls: Way<'a>,
        shown: Self,
        drafted: Way<'a>,
    ) -> Result<Vec<Candidate<'a>>, Error> {
        let (usual, walls) = self.place_pins(walls)?;
        if self.planner().pins().is_some() {
            return Ok(self.candidates(None, usual, walls, Vec::new()));
        }
        if !self.policy.jigs_first {
            return self.climb_beyond(usual, walls);
        }
        let left = usual.count_unaligned()?;
        if left == 0 {
            return Ok(self.candidates(None, usual, walls, Vec::new()));
        }
        let seen = self.plan_seen_seams(&usual)?;
        if seen.is_some() {
            self.notes
                .retain(|note| !note.is_offer() && !note.hides_seams());
            return Ok(self.candidates(seen, usual, walls, Vec::new()));
        }
        if !self.notes.iter().any(Remark::hides_seams) {
            return self.climb_beyond(usual, walls);
        }
        match unless_refused(shown.climb_shown(drafted))? {
            Some(mut aligned) if count_unaligned_in_best(&aligned)? < left => {
                aligned[0].opened.remarks.push(Remark::SeamsAligned);
                Ok(aligned)
            }
            _ => Ok(self.candidates(None, usual, walls, Vec::new())),
        }
    }

    /// Climbs all rungs from a draft without hidden seams.
    fn climb_shown(mut self, drafted: Way<'a>) -> Result<Vec<Candidate<'a>>, Error> {
        let (usual, walls) = self.place_pins(drafted)?;
        self.climb_beyond(usual, walls)
    }

    /// Places the pins of a draft, in its walls and in bosses that cost little. Returns the way
    /// with bosses, and the one without.
    fn place_pins(&mut self, drafted: Way<'a>) -> Result<(Way<'a>, Way<'a>), Error> {
        let Joined { walls, fewer } = self.join_parts(drafted)?;
        let usual = self.add_bosses(walls.clone(), Rung::Bosses)?;
        let (usual, walls) = match fewer {
            Some(fewer) => self.weigh_fewer_parts((usual, walls), fewer)?,
            None => (usual, walls),
        };
        let (usual, walls) = self.join_small_parts((usual, walls))?;
        match self.draft_fewest_parts(&usual)? {
            Some(draft) => {
                let is_as_good = self.is_as_good(&draft, &usual)?;
                self.weigh_fewer_parts((usual, walls), Fewer { draft, is_as_good })
            }
            None => Ok((usual, walls)),
        }
    }

    /// Climbs the rungs beyond the usual plan.
    fn climb_beyond(self, usual: Way<'a>, walls: Way<'a>) -> Result<Vec<Candidate<'a>>, Error> {
        let mut ways: Vec<Way> = Vec::new();
        let mut faults: Vec<Remark> = Vec::new();
        for rung in Rung::BEYOND_USUAL {
            self.watch.check()?;
            let is_needed = self.needs(rung, &usual, &ways);
            if !(is_needed && self.budget().allows(Untried::MorePins)) {
                continue;
            }
            match self.try_rung(rung, &usual, &ways) {
                Ok(found) => ways.extend(found),
                Err(Error::Cancelled) => return Err(Error::Cancelled),
                Err(fault) => faults.push(Remark::RungFailed {
                    rung,
                    why: fault.to_string(),
                }),
            }
        }
        // What a rung costs is counted from the walls, as the usual plan costs something too.
        ways.retain(|way| way.loss_ratio(&walls) <= self.policy.dear_loss_ratio);
        let best = self.best(&usual, ways);
        Ok(self.candidates(best, usual, walls, faults))
    }

    /// Returns the ladder with another tendency.
    pub(super) fn leaning(&self, tendency: Tendency) -> Self {
        let keeps_seams = matches!(tendency, Tendency::Usual | Tendency::FewerParts);
        Self {
            request: lean(self.request.clone(), tendency),
            hides_seams: self.hides_seams && keeps_seams,
            joins_parts: tendency == Tendency::Usual,
            ..self.clone()
        }
    }

    /// Returns the ladder with these cuts ordered.
    pub(super) fn by_order(&self, order: CutOrder) -> Self {
        let mut ladder = self.clone();
        ladder.ground.resolver = self.ground.resolver.by_order(order);
        ladder
    }

    /// Returns what is left of the search's work.
    fn budget(&self) -> &Budget {
        self.ground.resolver.budget()
    }

    /// Returns what decides on the cuts.
    fn planner(&self) -> &Planner {
        self.ground.resolver.planner()
    }

    /// Returns whether the planner may choose other cuts.
    fn is_free(&self) -> bool {
        self.planner().is_free()
    }

    /// Drafts cuts. Stops at voids that are lost: such a way is not worth taking.
    fn plan_in_walls(
        &self,
        ground: &Ground<'a>,
        request: &PlanRequest,
        rung: Rung,
        is_lost: &dyn Fn(&Voids) -> bool,
    ) -> Result<Way<'a>, Error> {
        self.watch.enter(Phase::Plan);
        let Ground {
            mut resolver,
            voids,
            draft,
            solid,
            mut rounds,
        } = ground.clone();
        let start = Start { voids, draft };
        let cleaned = clean_and_drain(&mut resolver, start, request, is_lost)?;
        rounds.extend(cleaned.rounds);
        let plan = CutPlan {
            solid,
            ..cleaned.plan
        };
        Ok(Way {
            rung,
            resolver,
            request: request.clone(),
            cleaning: rounds,
            bossed: Bossed::without(cleaned.voids, plan),
        })
    }

    /// Places pins in a draft, where the walls have room for them.
    fn finish(&self, mut way: Way<'a>) -> Result<Way<'a>, Error> {
        let Bossed { voids, plan, .. } = way.bossed;
        let plan = self.planner().finish(&voids, &way.request, plan)?;
        way.bossed = Bossed::without(voids, plan);
        Ok(way)
    }

    /// Adds bosses around pins, where they cost little.
    pub(super) fn add_bosses(&self, mut way: Way<'a>, rung: Rung) -> Result<Way<'a>, Error> {
        self.watch.enter(Phase::Bosses);
        way.bossed = add_bosses(&mut way.resolver, way.bossed, &way.request)?;
        Ok(Way { rung, ..way })
    }

    /// Returns the way that leaves the fewest joints without pins, of several the cheapest; `None`
    /// if none is better than the usual one.
    fn best(&self, usual: &Way<'a>, ways: Vec<Way<'a>>) -> Option<Way<'a>> {
        let is_better =
            |way: &Way| way.is_worth(usual, &self.policy) && way.lacking() < usual.lacking();
        let better = ways.into_iter().filter(is_better);
        better.min_by(|a, b| {
            let by_loss = a.loss_ratio(usual).total_cmp(&b.loss_ratio(usual));
            a.lacking().cmp(&b.lacking()).then(by_loss)
        })
    }

    /// Returns the plans worth making, the best first. Ordered pins stay whatever they break: the
    /// kit's checks say it.
    fn candidates(
        &self,
        best: Option<Way<'a>>,
        usual: Way<'a>,
        walls: Way<'a>,
        faults: Vec<Remark>,
    ) -> Vec<Candidate<'a>> {
        let notes = || self.notes.iter().cloned();
        let is_second = best.is_some();
        let has_bosses = !usual.bossed.rounds.is_empty();
        let price = best.as_ref().map(|best| best.price(&usual));
        let best = best.map(|way| way.into_candidate(price.into_iter().chain(notes())));
        let stepped = is_second.then_some(Remark::SteppedDown(Rung::Bosses));
        let usual = usual.into_candidate(notes().chain(stepped));
        let stepped = [Remark::SteppedDown(Rung::Walls)];
        let walls = has_bosses.then(|| walls.into_candidate(notes().chain(stepped)));
        let mut all: Vec<Candidate> = best.into_iter().chain([usual]).chain(walls).collect();
        if self.planner().pins().is_some() {
            all.truncate(1);
        }
        for candidate in &mut all {
            candidate.opened.remarks.extend(faults.iter().cloned());
        }
        all
    }
}

#[cfg(test)]
mod tests;
