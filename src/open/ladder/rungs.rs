//! The rungs beyond the usual plan: other cuts, dearer bosses, and voids that end before joints.

use super::Ladder;
use crate::base::watch::Phase;
use crate::cut::{PlanRequest, find_ends_beyond_unpinned_joints};
use crate::error::Error;
use crate::open::bosses::pay_for_bosses;
use crate::open::ground::Ground;
use crate::open::refused::unless_refused;
use crate::open::way::Way;
use crate::run::{KeptCause, Rung};

impl<'a> Ladder<'a> {
    /// Returns whether a rung beyond the usual plan is worth trying after those before it.
    pub(super) fn needs(&self, rung: Rung, usual: &Way, ways: &[Way]) -> bool {
        let is_solved = ways.iter().any(|way| way.solves(usual, &self.policy));
        let is_cheap = |way: &Way| way.loss_ratio(usual) <= self.policy.cheap_loss_ratio;
        let mut solving = ways.iter().filter(|way| way.solves(usual, &self.policy));
        if usual.is_full() {
            return false;
        }
        match rung {
            Rung::Walls | Rung::Bosses | Rung::SeenSeams | Rung::UnseenWalls => false,
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
    pub(super) fn try_rung(
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
            Rung::Walls | Rung::Bosses | Rung::SeenSeams | Rung::UnseenWalls => None,
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
    pub(super) fn end_voids_of(&self, base: &Way<'a>) -> Result<Vec<Way<'a>>, Error> {
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
}
