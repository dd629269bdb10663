//! A promised angle: cuts that keep it, where those with the best seams do not.

use super::Ladder;
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::tendency::lean;
use crate::open::way::{Candidate, Way, toppling_rad};
use crate::run::{Rung, Tendency};

impl<'a> Ladder<'a> {
    /// Returns a draft that keeps the promised angle, if this one keeps too much solid for it, and
    /// this one beside it.
    ///
    /// The cuts of a draft are a choice between seams, parts and what cannot be cleaned. Without
    /// the seams the others weigh more. A draft stays if the other one misses the angle, too. It
    /// also stays where a person or a tendency asks for its seams or parts.
    pub(super) fn keep_angle(&self, drafted: Way<'a>) -> Result<(Way<'a>, Option<Way<'a>>), Error> {
        let possible_rad = toppling_rad(&self.ground.voids.solution.certificate);
        let is_possible = possible_rad.is_some_and(|angle| angle >= drafted.promised_angle_rad());
        let is_ours = self.is_free() && self.hides_seams && self.joins_parts;
        if !is_ours || drafted.keeps_angle() || !is_possible {
            return Ok((drafted, None));
        }
        let request = lean(self.request.clone(), Tendency::Short);
        let other = self.plan_in_walls(&self.ground, &request, Rung::Walls, &|_| false);
        let other = unless_refused(other)?.filter(Way::keeps_angle);
        let other = other.map(|other| Way {
            request: self.request.clone(),
            ..other
        });
        Ok(match other {
            Some(other) => (other, Some(drafted)),
            None => (drafted, None),
        })
    }

    /// Returns the plans of a draft that misses the promised angle. They are for a kit that breaks
    /// another promise with the plans that keep it: the angle that these keep can be promised.
    pub(super) fn climb_missed(&self, missed: Way<'a>) -> Result<Vec<Candidate<'a>>, Error> {
        let mut ladder = self.clone();
        let placed = unless_refused(ladder.place_pins(missed))?;
        let plans = placed.map(|(usual, walls)| ladder.candidates(None, usual, walls, Vec::new()));
        Ok(plans.unwrap_or_default())
    }
}
