//! A promised angle: cuts that keep it, where those with the best seams do not.

use super::Ladder;
use crate::error::Error;
use crate::open::refused::unless_refused;
use crate::open::tendency::lean;
use crate::open::way::{Way, toppling_rad};
use crate::run::{Rung, Tendency};

impl<'a> Ladder<'a> {
    /// Returns a draft that keeps the promised angle, if this one keeps too much solid for it.
    ///
    /// The cuts of a draft are a choice between seams, parts and what cannot be cleaned. Without
    /// the seams the others weigh more. A draft stays if the other one misses the angle, too.
    pub(super) fn keep_angle(&self, drafted: Way<'a>) -> Result<Way<'a>, Error> {
        let possible_rad = toppling_rad(&self.ground.voids.solution.certificate);
        let is_possible = possible_rad.is_some_and(|angle| angle >= drafted.promised_angle_rad());
        if !self.is_free() || drafted.keeps_angle() || !is_possible {
            return Ok(drafted);
        }
        let request = lean(self.request.clone(), Tendency::Short);
        let other = self.plan_in_walls(&self.ground, &request, Rung::Walls, &|_| false);
        let other = unless_refused(other)?.filter(Way::keeps_angle);
        let other = other.map(|other| Way {
            request: self.request.clone(),
            ..other
        });
        Ok(other.unwrap_or(drafted))
    }
}
