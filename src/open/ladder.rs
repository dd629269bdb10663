//! The ladder: rungs are tried in order until one gives every joint its pins; the best are kept.

use super::aligned::count_unaligned;
use super::bosses::{Bossed, add_bosses, pay_for_bosses};
use super::clean::Start;
use super::drain::clean_and_drain;
use super::ground::Ground;
use super::plan::finish_once;
use super::refused::unless_refused;
use super::request::request;
use super::resolve::Resolver;
use super::tendency::lean;
use super::way::{Candidate, Way};
use crate::base::watch::{Phase, Watch};
use crate::cut::{CutError, CutPlan, PlanRequest, find_ends_beyond_unpinned_joints};
use crate::error::Error;
use crate::job::CutMode;
use crate::run::{KeptCause, Placed, Policy, Remark, Rung, Solved, Tendency, Voids};

/// Opens the voids of a solution, on the lowest rung that gives every joint its pins.
///
/// Returns the plans worth making, best first and never none. The later ones do less for the pins:
/// they are for a kit that breaks a promise with the first. Cuts that a person ordered stay.
pub fn climb<'a>(
    placed: &'a Placed,
    solved: Solved,
    watch: &Watch,
) -> Result<Vec<Candidate<'a>>, Error> {
    Ladder::new(placed, solved, watch)?.climb()
}

/// Counts the joints of the best plan that neither pins nor a jig align.
fn count_unaligned_in_best(candidates: &[Candidate]) -> Result<usize, CutError> {
    let best = candidates.first().map(|candidate| &candidate.opened);
    best.map_or(Ok(0), |best| {
        count_unaligned(&best.voids, &best.plan, &best.request)
    })
}

/// The ladder from one set of voids.
#[derive(Clone)]
pub(super) struct Ladder<'a> {
    placed: &'a Placed,
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
}

impl<'a> Ladder<'a> {
    /// Draws the voids, without what the job's plan keeps solid.
    pub(super) fn new(placed: &'a Placed, solved: Solved, watch: &Watch) -> Result<Self, Error> {
        watch.enter(Phase::Shell);
        let request = request(placed, watch)?;
        let mut resolver = Resolver::new(placed, solved, watch)?;
        watch.enter(Phase::Voids);
        let voids = resolver.draw()?;
        let ground = Ground {
            resolver,
            voids,
            draft: None,
            solid: Vec::new(),
            rounds: Vec::new(),
        };
        let ordered = placed.job.plan.as_ref().map(|plan| &plan.solid[..]);
        let (ground, note) = match ordered.filter(|solid| !solid.is_empty()) {
            Some(solid) => match ground.without(solid, &KeptCause::Ordered)? {
                Some(less) => (less, None),
                None => (ground, Some(Remark::OrderTooSolid)),
            },
            None => (ground, None),
        };
        Ok(Self {
            placed,
            policy: placed.policy,
            watch: watch.clone(),
            ground,
            request,
            notes: note.into_iter().collect(),
            hides_seams: placed.job.seam.is_hidden(),
            joins_parts: true,
        })
    }

    /// Climbs it. Returns the plans worth making, best first and never none.
    ///
    /// The search ends with the first plan of which pins or jigs align every joint. Hidden seams
    /// that nothing aligns give way to others, and are not followed beyond the usual rungs.
    pub(super) fn climb(mut self) -> Result<Vec<Candidate<'a>>, Error> {
        let drafted = self.plan_in_walls(&self.ground, &self.request, Rung::Walls, &|_| false)?;
        let shown = Self {
            hides_seams: false,
            ..self.clone()
        };
        let walls = self.hide_seams(drafted.clone())?;
        let (usual, walls) = self.place_pins(walls)?;
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
            Some(mut aligned) if count_unaligned_in_best(&aligned)? <= left => {
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
        let walls = self.join_parts(drafted)?;
        let usual = self.add_bosses(walls.clone(), Rung::Bosses)?;
        Ok((usual, walls))
    }

    /// Climbs the rungs beyond the usual plan.
    fn climb_beyond(self, usual: Way<'a>, walls: Way<'a>) -> Result<Vec<Candidate<'a>>, Error> {
        let mut ways: Vec<Way> = Vec::new();
        let mut faults: Vec<Remark> = Vec::new();
        for rung in Rung::BEYOND_USUAL {
            self.watch.check()?;
            if !self.needs(rung, &usual, &ways) {
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

    /// Returns whether the planner may choose other cuts.
    fn is_free(&self) -> bool {
        self.placed.job.plan.is_none() && self.placed.job.cut == CutMode::Auto
    }

    /// Returns whether a rung beyond the usual plan is worth trying after those before it.
    fn needs(&self, rung: Rung, usual: &Way, ways: &[Way]) -> bool {
        let is_solved = ways.iter().any(|way| way.solves(usual, &self.policy));
        let is_cheap = |way: &Way| way.loss_ratio(usual) <= self.policy.cheap_loss_ratio;
        let mut solving = ways.iter().filter(|way| way.solves(usual, &self.policy));
        if usual.is_full() {
            return false;
        }
        match rung {
            Rung::Walls | Rung::Bosses | Rung::SeenSeams => false,
            Rung::FewerCuts => self.is_free() && usual.bossed.plan.cuts.len() > 1,
            Rung::WideJoints | Rung::SolidEnds => self.is_free() && !is_solved,
            Rung::DearBosses => usual.bossed.has_dear() && !solving.any(is_cheap),
            // What is too dear for all joints may leave some of them their pins.
            Rung::SomeBosses => ways
                .iter()
                .any(|way| way.rung == Rung::DearBosses && !way.is_worth(usual, &self.policy)),
        }
    }

    /// Tries a rung beyond the usual plan; none if the planner finds no plan on it.
    fn try_rung(
        &self,
        rung: Rung,
        usual: &Way<'a>,
        ways: &[Way<'a>],
    ) -> Result<Vec<Way<'a>>, Error> {
        let spare = PlanRequest {
            min_opening_mm: self.policy.spare_opening_ratio * self.request.min_opening_mm,
            ..self.request.clone()
        };
        let way = match rung {
            Rung::Walls | Rung::Bosses | Rung::SeenSeams => None,
            Rung::FewerCuts => {
                let fewer = PlanRequest {
                    worth_ratio: 1.0,
                    ..spare
                };
                self.plan_with_bosses(&self.ground, &fewer, rung)?
            }
            Rung::WideJoints => {
                let wide = PlanRequest {
                    wants_wide_joints: true,
                    ..spare
                };
                self.plan_with_bosses(&self.ground, &wide, rung)?
            }
            Rung::DearBosses => self.pay(usual, rung, self.policy.dear_loss_ratio)?,
            Rung::SomeBosses => self.pay(usual, rung, self.policy.partial_loss_ratio)?,
            Rung::SolidEnds => return self.end_voids_before_joints(usual, ways),
        };
        Ok(way.into_iter().collect())
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
        let plan = finish_once(self.placed, &voids, &way.request, plan)?;
        way.bossed = Bossed::without(voids, plan);
        Ok(way)
    }

    /// Adds bosses around pins, where they cost little.
    pub(super) fn add_bosses(&self, mut way: Way<'a>, rung: Rung) -> Result<Way<'a>, Error> {
        self.watch.enter(Phase::Bosses);
        way.bossed = add_bosses(&mut way.resolver, way.bossed, &way.request)?;
        Ok(Way { rung, ..way })
    }

    /// Plans cuts and pins, with bosses; `None` if the planner finds no such plan.
    fn plan_with_bosses(
        &self,
        ground: &Ground<'a>,
        request: &PlanRequest,
        rung: Rung,
    ) -> Result<Option<Way<'a>>, Error> {
        let way = self.plan_in_walls(ground, request, rung, &|_| false);
        let finished = way.and_then(|way| self.finish(way));
        unless_refused(finished.and_then(|way| self.add_bosses(way, rung)))
    }

    /// Adds the bosses that are too dear for the usual plan.
    fn pay(&self, usual: &Way<'a>, rung: Rung, max: f64) -> Result<Option<Way<'a>>, Error> {
        self.watch.enter(Phase::Bosses);
        let mut way = usual.clone();
        let paid = pay_for_bosses(&mut way.resolver, way.bossed, &self.request, max);
        let paid = unless_refused(paid)?;
        Ok(paid.map(|bossed| Way {
            rung,
            bossed,
            resolver: way.resolver,
            request: way.request,
            cleaning: way.cleaning,
        }))
    }

    /// Ends the voids before joints without pins, starting from each way so far, until one does.
    fn end_voids_before_joints(
        &self,
        usual: &Way<'a>,
        ways: &[Way<'a>],
    ) -> Result<Vec<Way<'a>>, Error> {
        let mut ended: Vec<Way> = Vec::new();
        for base in std::iter::once(usual).chain(ways) {
            if !ended.iter().any(|way| way.solves(usual, &self.policy)) {
                ended.extend(self.end_voids_of(base)?);
            }
        }
        Ok(ended)
    }

    /// Ends the voids before the joints of a way that lack pins, and before those that then do.
    fn end_voids_of(&self, base: &Way<'a>) -> Result<Vec<Way<'a>>, Error> {
        let mut ended: Vec<Way> = Vec::new();
        let mut solid = Vec::new();
        for _ in 0..self.policy.max_ends {
            let last = ended.last().unwrap_or(base);
            let margin_mm = self.policy.ends_margin_openings * self.request.min_opening_mm;
            let ends = find_ends_beyond_unpinned_joints(
                &last.bossed.voids.hollowed,
                &last.bossed.plan,
                margin_mm,
                &self.watch,
            );
            let ends = unless_refused(ends.map_err(Error::from))?.unwrap_or_default();
            if ends.is_empty() {
                break;
            }
            solid.extend(ends);
            let ground = unless_refused(self.ground.without(&solid, &KeptCause::BeyondJoint))?;
            let Some(ground) = ground.flatten() else {
                break;
            };
            let way = self.plan_with_bosses(&ground, &base.request, Rung::SolidEnds)?;
            let Some(way) = way else { break };
            let is_full = way.is_full();
            ended.push(way);
            if is_full {
                break;
            }
        }
        Ok(ended)
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
        if self.placed.has_ordered_pins() {
            all.truncate(1);
        }
        for candidate in &mut all {
            candidate.opened.remarks.extend(faults.iter().cloned());
        }
        all
    }
}

mod preferences;
#[cfg(test)]
mod tests;
