//! Whole parts: a void ends before a part below the least, so that no chip is cut off for it.

use super::Ladder;
use crate::cut::{PlanRequest, SolidEnd, find_ends_in_small_parts};
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::way::Way;
use crate::run::{KeptCause, Rung};

impl<'a> Ladder<'a> {
    /// Returns a plan whose voids end before parts below the least. It then has none of them and no
    /// more parts, and costs next to nothing of the figure. Without one the plan stays as it is.
    ///
    /// Takes and returns the way with bosses, and the one without.
    pub(super) fn join_small_parts(
        &mut self,
        (usual, walls): (Way<'a>, Way<'a>),
    ) -> Result<(Way<'a>, Way<'a>), Error> {
        if !(self.joins_parts && self.is_free()) {
            return Ok((usual, walls));
        }
        let mut solid = Vec::new();
        let mut found: Option<(Way<'a>, Way<'a>)> = None;
        // Another void may reach into a small part in place of the one that ends before it.
        for _ in 0..=self.policy.max_ends {
            let last = found.as_ref().map_or(&usual, |(few, _)| few);
            let ends = self.ends_in_small_parts(last)?;
            if ends.is_empty() {
                return match found {
                    Some(found) => self.better_of((usual, walls), found),
                    None => Ok((usual, walls)),
                };
            }
            solid.extend(ends);
            let request = last.request.clone();
            let joined = unless_refused(self.plan_without(&solid, request))?.flatten();
            let Some(joined) = joined else { break };
            found = Some(joined);
        }
        Ok((usual, walls))
    }

    /// Returns a plan without small parts if it is as good as the usual one, else that one.
    fn better_of(
        &self,
        usual: (Way<'a>, Way<'a>),
        whole: (Way<'a>, Way<'a>),
    ) -> Result<(Way<'a>, Way<'a>), Error> {
        let (few, many) = (&whole.0, &usual.0);
        let count = |way: &Way| way.bossed.plan.count_parts();
        let is_better = (2..=count(many)).contains(&count(few))
            && few.loss_ratio(many) <= self.policy.part_loss_ratio
            && self.is_as_good(few, many)?
            && few.count_unaligned()? <= many.count_unaligned()?;
        Ok(if is_better { whole } else { usual })
    }

    /// Returns the ends of a plan's voids that lie in parts below the least.
    fn ends_in_small_parts(&self, way: &Way<'a>) -> Result<Vec<SolidEnd>, Error> {
        let margin_mm = self.policy.ends_margin_openings * self.request.min_opening_mm;
        let (voids, plan) = (&way.bossed.voids, &way.bossed.plan);
        let ends = find_ends_in_small_parts(&voids.hollowed, plan, &way.request, margin_mm);
        Ok(unless_refused(ends.map_err(Error::from))?.unwrap_or_default())
    }

    /// Plans with these ends of voids kept solid; `None` if the goal is lost with them.
    fn plan_without(
        &self,
        solid: &[SolidEnd],
        request: PlanRequest,
    ) -> Result<Option<(Way<'a>, Way<'a>)>, Error> {
        let Some(ground) = self.ground.without(solid, &KeptCause::SmallPart)? else {
            return Ok(None);
        };
        let drafted = self.plan_in_walls(&ground, &request, Rung::Bosses, &|_| false)?;
        let walls = self.finish(drafted)?;
        let with_bosses = self.add_bosses(walls.clone(), Rung::Bosses)?;
        Ok(Some((with_bosses, walls)))
    }
}
