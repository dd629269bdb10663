//! Whole parts: a void ends before a part below the least, so that no chip is cut off for it.

use super::Ladder;
use crate::cut::{SolidEnd, find_ends_in_small_parts};
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::way::Way;
use crate::run::KeptCause;

impl<'a> Ladder<'a> {
    /// Returns the plan that ends its voids before parts below the least, if that leaves fewer parts
    /// and costs next to nothing of the goal's figure. Else it returns the plan as it is.
    ///
    /// Takes and returns the way with bosses, and the one without.
    pub(super) fn join_small_parts(
        &mut self,
        (usual, walls): (Way<'a>, Way<'a>),
    ) -> Result<(Way<'a>, Way<'a>), Error> {
        if !(self.joins_parts && self.is_free()) {
            return Ok((usual, walls));
        }
        let count = |way: &Way| way.bossed.plan.count_parts();
        let (mut solid, mut last) = (Vec::new(), usual.clone());
        // Another void may reach into the part in place of the one that ends before it.
        for _ in 0..self.policy.max_ends {
            let joined = unless_refused(self.without_small_parts(&last, &mut solid))?.flatten();
            let Some((few, few_walls)) = joined else {
                break;
            };
            if count(&few) < count(&usual) {
                let is_better = count(&few) > 1
                    && few.loss_ratio(&usual) <= self.policy.part_loss_ratio
                    && self.is_as_good(&few, &usual)?
                    && few.count_unaligned()? <= usual.count_unaligned()?;
                return Ok(if is_better {
                    (few, few_walls)
                } else {
                    (usual, walls)
                });
            }
            last = few;
        }
        Ok((usual, walls))
    }

    /// Plans again with the ends of voids in small parts kept solid too; `None` if there are none,
    /// or if the goal is lost with them.
    fn without_small_parts(
        &self,
        last: &Way<'a>,
        solid: &mut Vec<SolidEnd>,
    ) -> Result<Option<(Way<'a>, Way<'a>)>, Error> {
        let margin_mm = self.policy.ends_margin_openings * self.request.min_opening_mm;
        let (voids, plan) = (&last.bossed.voids, &last.bossed.plan);
        let ends = find_ends_in_small_parts(&voids.hollowed, plan, &last.request, margin_mm)?;
        if ends.is_empty() {
            return Ok(None);
        }
        solid.extend(ends);
        let Some(ground) = self.ground.without(solid, &KeptCause::SmallPart)? else {
            return Ok(None);
        };
        let drafted = self.plan_in_walls(&ground, &last.request, last.rung, &|_| false)?;
        let walls = self.finish(drafted)?;
        let with_bosses = self.add_bosses(walls.clone(), last.rung)?;
        Ok(Some((with_bosses, walls)))
    }
}
