//! A search on a few of the columns, which saves most passes over all of them.
//!
//! Every `step`-th column of every `step`-th row gives the reachable set to about a per cent, at
//! 1/step² of the cost. It has two uses, and no result depends on it:
//!
//! * **The search.** An ascent on the thinned columns ends near the answer. One pass over all
//!   columns there gives an extreme point and its derivative. An affine map gives the thinned set
//!   the same two, so that it osculates the true set ([`Mend`](super::mend::Mend)). The error of an
//!   ascent on the mended set is of second order in the distance from that point, as after a Newton
//!   step. Its factor is smaller, the more alike the two sets are, and it covers heights and levers
//!   as well. After one to three such rounds, Newton's method on all columns finishes.
//! * **The proof over all heights.** A dual bound holds at any multipliers. Good multipliers are
//!   found on the mended set. Each bound is then checked on all columns, in one pass without
//!   derivative, all of them in parallel.
//!
//! Correcting a coarse model by a linear map is known as manifold mapping.
//!
//! Source: Echeverría and Hemker, "Space mapping and defect correction", Computational Methods in
//! Applied Mathematics 5, 2005.

use super::ascent::{Climb, End};
use super::programme::{DualPoint, Programme};
use super::work::Work;

/// Least number of columns of a scout, approximately. With fewer, their mended dual is no better
/// than a Newton step. More cost as much as the passes they save.
const FEW_COLUMNS: usize = 300;
/// Least spacing of a scout's columns, in columns, that pays for a single programme. A pass over
/// them then costs a fifth of one over all. For a search over heights two is enough.
const WORTH_A_CLIMB: usize = 3;
/// Greatest spacing of a scout's columns, in columns. Beyond, their cost beside a pass over all is
/// nil.
const GREATEST_STEP: usize = 16;
impl<'a> Work<'a> {
    /// Returns a workspace with a few of the columns. `None` if a pass over all is cheap, or if
    /// there is a heavy material.
    pub fn scout(&self) -> Option<Self> {
        self.scout_from(2)
    }

    /// Returns a scout with at least this spacing of the columns.
    fn scout_from(&self, least_step: usize) -> Option<Self> {
        let step = ((self.reach.columns() / FEW_COLUMNS) as f64).sqrt() as usize;
        (step >= least_step && !self.reach.has_heavy())
            .then(|| self.on_thinned(self.reach.thin(step.min(GREATEST_STEP))))
    }

    /// Climbs to the settings' tolerance from a known dual point or a cold start, with a scout if
    /// that helps.
    pub fn ascend(&self, programme: &Programme, known: Option<&DualPoint>) -> Climb {
        let start = programme.start_near(&self.reach, known);
        let straight = || self.climb(programme, start.clone(), 0.0);
        let Some(scout) = self.scout_from(WORTH_A_CLIMB) else {
            return straight();
        };
        if known.is_some() {
            return self.ascend_with(scout, programme, start);
        }
        let Climb { best, end, .. } = scout.climb(programme, start.clone(), 0.0);
        match end {
            End::Infeasible(_) => self
                .prove_infeasible(programme, best.point)
                .unwrap_or_else(straight),
            End::Cancelled => straight(),
            _ => self.ascend_with(scout, programme, best.point),
        }
    }

    /// Climbs from near the answer: one pass, an ascent on the columns mended there, then Newton's
    /// method.
    fn ascend_with(&self, scout: Self, programme: &Programme, near: DualPoint) -> Climb {
        let here = self.evaluate(programme, near);
        let ahead = scout
            .mend_at(&here)
            .climb_near(programme, Some(&here.point), 0.0);
        let Some(ahead) = ahead else {
            return self.climb_from(programme, here);
        };
        self.climb_from(programme, self.evaluate(programme, ahead.best.point))
            .after(&[here.pass()])
    }
}
