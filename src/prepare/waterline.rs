//! The free waterline: the depth at which what floats is most stable.

use crate::base::watch::{Phase, Watch};
use crate::error::Error;
use crate::goal::{FloatConditions, Goal, Hydrostatics, Waterline};
use crate::hollow::{Problem, Solution, Status, golden_section};
use crate::interior::Columns;
use crate::run::Placed;
use crate::shell::Shell;

/// Waterlines of the first pass. With fewer than 12 a narrow range in which the object can be
/// trimmed may be missed.
const PASSES: usize = 40;
/// Rounds of the golden section about the best of them. Each leaves 0.618 of the range: 14 leave a
/// thousandth of a step.
const ROUNDS: usize = 14;
/// Columns a side of the search.
const COLUMNS: usize = super::levels::COARSE_COLUMNS;
/// Penalty of a waterline at which the object weighs too much or too little, mm. It is more than
/// the offset of any model that a printer takes: such waterlines rank below all that only lean.
const UNTRIMMED_MM: f64 = 1e6;

/// Sets the waterline of the greatest metacentric height, if the job leaves it free.
///
/// Evenly spaced waterlines are solved on coarse columns and refined about the best. If none will
/// do, the one that misses least is set.
pub fn choose(mut placed: Placed, watch: &Watch) -> Result<Placed, Error> {
    let is_free = |waterline| waterline == Waterline::Auto;
    let water = placed
        .job
        .goal
        .water
        .filter(|water| is_free(water.waterline));
    let Some(water) = water else {
        return Ok(placed);
    };
    watch.enter(Phase::Waterline);
    let frame = &placed.goal().frame;
    let shell = Shell::new(
        &placed.model.solid,
        frame,
        placed.shop.wall.wall_mm,
        &placed.placement.keeps,
    )?;
    let liquid_ratio = water.liquid.density_g_cm3() / placed.density_g_cm3();
    let search = Search {
        placed: &placed,
        hydrostatics: Hydrostatics::new(&placed.model.solid, frame, liquid_ratio),
        columns: Columns::of_shell(&shell, shell.coarse_pitch(COLUMNS), &watch.muted())?,
        watch: watch.muted(),
    };
    let best = search.best();
    watch.check()?;
    placed.placement.goal.afloat = Some(best);
    Ok(placed)
}

/// The outside level by level, and the interior on coarse columns.
struct Search<'a> {
    placed: &'a Placed,
    hydrostatics: Hydrostatics,
    columns: Columns,
    watch: Watch,
}

/// A waterline and its rank.
struct Rated {
    afloat: FloatConditions,
    /// True if the object floats upright at it.
    is_possible: bool,
    /// Metacentric height, or minus the miss, mm.
    height_mm: f64,
}

impl Search<'_> {
    fn best(&self) -> FloatConditions {
        let height_mm = self.hydrostatics.height_mm();
        let step_mm = height_mm / (PASSES + 1) as f64;
        let coarse = (1..=PASSES).map(|i| self.rate(step_mm * i as f64));
        let best = coarse.fold(self.rate(0.5 * step_mm), better);
        // Written parts weigh a little more or less than solved. At the very top the object would
        // sink; at the very bottom it could not be trimmed.
        let [lowest_mm, highest_mm] = [0.5 * step_mm, height_mm - 0.5 * step_mm];
        let at_mm = best.afloat.waterline_mm;
        let range_mm = [
            (at_mm - step_mm).max(lowest_mm),
            (at_mm + step_mm).min(highest_mm),
        ];
        let fine = golden_section(
            range_mm,
            ROUNDS,
            |waterline_mm| self.rate(waterline_mm),
            Rated::is_better,
        );
        fine.into_iter().fold(best, better).afloat
    }

    fn rate(&self, waterline_mm: f64) -> Rated {
        let afloat = self.hydrostatics.at(waterline_mm);
        let goal = Goal {
            afloat: Some(afloat),
            ..self.placed.goal().clone()
        };
        let problem = Problem {
            goal: &goal,
            fixed: goal.solid,
            columns: &self.columns,
        };
        let solution = self.placed.fill.solve(&problem, None, &self.watch);
        let (is_possible, height_mm) = self.height_mm(&solution);
        Rated {
            afloat,
            is_possible,
            height_mm,
        }
    }

    /// Returns whether a solution floats upright, and its metacentric height or minus its miss, mm.
    fn height_mm(&self, solution: &Solution) -> (bool, f64) {
        match solution.status {
            Status::Capsizes { greatest_gm_mm } => (false, greatest_gm_mm),
            Status::CannotTrim {
                least_offset_mm, ..
            } => (false, -self.hydrostatics.height_mm() - least_offset_mm),
            Status::Sinks { least_ratio } => (false, -UNTRIMMED_MM * least_ratio),
            Status::RidesHigh { greatest_ratio } => (false, -UNTRIMMED_MM / greatest_ratio),
            _ if solution.is_usable() => (true, solution.certificate.value),
            _ => (false, -UNTRIMMED_MM),
        }
    }
}

impl Rated {
    fn is_better(&self, other: &Self) -> bool {
        let by_height = self.height_mm.total_cmp(&other.height_mm);
        let by_possible = self.is_possible.cmp(&other.is_possible);
        by_possible.then(by_height).is_gt()
    }
}

fn better(best: Rated, other: Rated) -> Rated {
    if other.is_better(&best) { other } else { best }
}
