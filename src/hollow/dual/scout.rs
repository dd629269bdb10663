//! A look ahead on a few of the columns, so that few passes over all of them do.
//!
//! Every `step`-th column of every `step`-th row shows the reachable set to a per cent or so, at
//! 1/step² of the cost. Two uses are made of that, and neither rests on it:
//!
//! * **The search.** An ascent on the thinned columns ends near the answer. A look at all columns
//!   there gives an extreme point and its derivative; the affine map that gives the thinned set the
//!   same two ([`Mend`](super::mend::Mend)) makes it osculate the true one. What an ascent on the
//!   set so mended errs by is of the second order in the distance from the look, as after a step of
//!   Newton's method, but with a factor that is smaller by as much as the two sets are alike, and
//!   it finds its way through heights and levers too. One to three looks, and Newton's method on
//!   all columns ends it. Correcting a coarse model by a linear map is the "manifold mapping" of
//!   Echeverría and Hemker ("Space mapping and defect correction", Computational Methods in Applied
//!   Mathematics 5, 2005).
//! * **The proof over all heights.** A dual bound holds at any multipliers. Which are wanted is
//!   found out on the mended set; each is then held against all columns in one pass that needs no
//!   derivative, all of them side by side.

use super::ascent::{Climb, End};
use super::programme::{DualPoint, Programme};
use super::work::Work;

/// About how many columns a scout sees at least. Fewer, and their mended dual is no better than a
/// Newton step; more cost as much as the passes they save.
const FEW_COLUMNS: usize = 300;
/// The distance of a scout's columns, in columns, from which one programme alone is worth it: where
/// a pass over its columns costs a fifth of a pass over all. A search over heights is from two on.
const WORTH_A_CLIMB: usize = 3;
/// The greatest distance of the columns a scout sees, in columns. Beyond, they cost nothing any
/// more beside a pass over all.
const GREATEST_STEP: usize = 16;
impl<'a> Work<'a> {
    /// A bench with a few of the columns; none where a pass over all is cheap, or a heavy material
    /// is to be had.
    pub fn scout(&self) -> Option<Self> {
        self.scout_from(2)
    }

    /// The same where the columns it sees are at least so far apart.
    fn scout_from(&self, least_step: usize) -> Option<Self> {
        let step = ((self.reach.columns() / FEW_COLUMNS) as f64).sqrt() as usize;
        (step >= least_step && !self.reach.has_heavy())
            .then(|| self.thinned(self.reach.thinned(step.min(GREATEST_STEP))))
    }

    /// Climbs to the settings' tolerance from a known dual point, or from nothing; by way of a
    /// scout where one helps.
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
            End::Infeasible(_) => self.refusal(programme, best.point).unwrap_or_else(straight),
            End::Cancelled => straight(),
            _ => self.ascend_with(scout, programme, best.point),
        }
    }

    /// Climbs from near the answer: one look, an ascent on what is mended by it, and Newton's
    /// method to the end.
    fn ascend_with(&self, scout: Self, programme: &Programme, near: DualPoint) -> Climb {
        let here = self.look(programme, near);
        let ahead = scout
            .mended(&here)
            .climb_near(programme, Some(&here.point), 0.0);
        let Some(ahead) = ahead else {
            return self.climb_from(programme, here);
        };
        self.climb_from(programme, self.look(programme, ahead.best.point))
            .after(&[here.pass()])
    }
}
