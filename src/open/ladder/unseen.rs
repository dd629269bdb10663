//! Hidden seams with walls out of sight: a plan that is made first, and kept if they print well.

use super::Ladder;
use super::trial::Trial;
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::way::Candidate;
use crate::run::{Remark, Rung};

impl<'a> Ladder<'a> {
    /// Returns the plan with walls out of sight, with its pins; `None` if there is none worth
    /// making, or if nothing aligns one of its joints.
    pub(super) fn finish_unseen(&mut self) -> Result<Option<Candidate<'a>>, Error> {
        let Some(Trial { draft, loss_ratio }) = self.unseen.take() else {
            return Ok(None);
        };
        let placed = self.finish(draft);
        let placed = placed.and_then(|way| self.add_bosses(way, Rung::UnseenWalls));
        let Some(way) = unless_refused(placed)? else {
            return Ok(None);
        };
        if way.count_unaligned()? > 0 {
            return Ok(None);
        }
        let hidden = Remark::Seams {
            loss_ratio: Some(loss_ratio),
            is_taken: true,
        };
        let is_ordered = |note: &&Remark| !matches!(note, Remark::Seams { .. });
        let notes = self.notes.iter().filter(is_ordered).cloned();
        Ok(Some(way.into_candidate(notes.chain([hidden]))))
    }
}
