//! Whole parts: a void ends before a part below the least, so that no chip is cut off for it.

use super::Ladder;
use crate::cut::{self, SolidEnd, find_ends_in_small_parts};
use crate::error::Error;
use crate::open::ground::Ground;
use crate::open::refused::unless_refused;
use crate::open::way::Way;
use crate::run::{Achieved, KeptCause, Rung, Untried, Voids};

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
        let Some((ground, draft)) = self.draft_whole_parts(&usual)? else {
            return Ok((usual, walls));
        };
        let placed = self
            .finish(draft)
            .and_then(|walls| Ok((self.add_bosses(walls.clone(), Rung::Bosses)?, walls)));
        let Some((whole, whole_walls)) = unless_refused(placed)? else {
            return Ok((usual, walls));
        };
        let is_better = self.is_worth_joining(&whole, &usual)?
            && whole.count_unaligned()? <= usual.count_unaligned()?;
        if !is_better {
            return Ok((usual, walls));
        }
        // The rungs beyond keep these ends solid, too.
        self.ground = ground;
        Ok((whole, whole_walls))
    }

    /// Drafts a plan without parts below the least, with its ground. `None` if there is none that
    /// is worth it.
    fn draft_whole_parts(&self, usual: &Way<'a>) -> Result<Option<(Ground<'a>, Way<'a>)>, Error> {
        let mut solid = Vec::new();
        let mut found: Option<(Ground<'a>, Way<'a>)> = None;
        // Another void may reach into a small part in place of the one that ends before it.
        for _ in 0..=self.policy.max_ends {
            let last = found.as_ref().map_or(usual, |(_, draft)| draft);
            let ends = self.ends_in_small_parts(last)?;
            if ends.is_empty() {
                break;
            }
            if !self.budget().allows(Untried::FewerParts) {
                return Ok(None);
            }
            solid.extend(ends);
            let draft = unless_refused(self.draft_without(&solid, usual))?.flatten();
            let Some((ground, draft)) = draft else {
                return Ok(None);
            };
            if !self.is_worth_joining(&draft, usual)? {
                return Ok(None);
            }
            found = Some((ground, draft));
        }
        Ok(found.filter(|(_, draft)| !has_small_parts(draft)))
    }

    /// Returns whether a plan has no more parts than another, is as good, and costs next to nothing
    /// of its figure.
    fn is_worth_joining(&self, whole: &Way<'a>, usual: &Way<'a>) -> Result<bool, Error> {
        let count = |way: &Way| way.bossed.plan.count_parts();
        Ok((2..=count(usual)).contains(&count(whole))
            && whole.loss_ratio(usual) <= self.policy.part_loss_ratio
            && self.is_as_good(whole, usual)?)
    }

    /// Returns the ends of a plan's voids that lie in parts below the least.
    fn ends_in_small_parts(&self, way: &Way<'a>) -> Result<Vec<SolidEnd>, Error> {
        let margin_mm = self.policy.ends_margin_openings * self.request.min_opening_mm;
        let (voids, plan) = (&way.bossed.voids, &way.bossed.plan);
        let ends = find_ends_in_small_parts(&voids.hollowed, plan, &way.request, margin_mm);
        Ok(unless_refused(ends.map_err(Error::from))?.unwrap_or_default())
    }

    /// Drafts a plan like another one with these ends of voids kept solid; `None` if the goal is
    /// lost with them. Stops at voids that lose too much.
    fn draft_without(
        &self,
        solid: &[SolidEnd],
        usual: &Way<'a>,
    ) -> Result<Option<(Ground<'a>, Way<'a>)>, Error> {
        let Some(ground) = self.ground.without(solid, &KeptCause::SmallPart)? else {
            return Ok(None);
        };
        let before = usual.achieved();
        let is_lost =
            |voids: &Voids| before.loss_ratio(&Achieved::of(voids)) > self.policy.part_loss_ratio;
        let draft = self.plan_in_walls(&ground, &usual.request, Rung::Bosses, &is_lost)?;
        Ok(Some((ground, draft)))
    }
}

/// Returns whether a plan has parts below the least.
fn has_small_parts(way: &Way) -> bool {
    let is_small = |note: &cut::Remark| matches!(note, cut::Remark::SmallPart { .. });
    way.bossed.plan.notes.iter().any(is_small)
}
