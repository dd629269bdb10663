//! The free waterline: the depth at which what floats is most stable.

use super::{Error, Setup, solving::COARSE_COLUMNS, stopwatch::Stopwatch};
use crate::base::watch::Watch;
use crate::goal::{Afloat, Hydrostatics, Waterline};
use crate::hollow::{Problem, Status, golden_section};
use crate::interior::Columns;
use crate::shell::Shell;

/// Waterlines of the coarse look. With fewer than 12 a narrow range in which it can be trimmed may
/// be missed.
const LOOKS: usize = 40;
/// Rounds of the golden section about the best of them: each leaves 0.618 of the range, so 14 leave
/// a thousandth of a look.
const ROUNDS: usize = 14;

/// The setup with the waterline at which the metacentric height is greatest, where the job leaves
/// it free: the heights are looked over evenly on coarse columns, then refined about the best one.
/// Where no height will do, the one that misses least.
pub fn chosen(mut setup: Setup, watch: &mut Stopwatch) -> Result<Setup, Error> {
    let Some(water) = setup
        .job
        .goal
        .water
        .filter(|water| water.waterline == Waterline::Auto)
    else {
        return Ok(setup);
    };
    let goal = &setup.placement.goal;
    let density = setup.material.density_g_cm3.value;
    let shell = Shell::new(
        &setup.model.solid,
        &goal.frame,
        setup.wall.wall_mm,
        &setup.placement.keeps,
    )?;
    let search = Search {
        setup: &setup,
        hydrostatics: Hydrostatics::new(
            &setup.model.solid,
            &goal.frame,
            water.liquid.density_g_cm3() / density,
        ),
        columns: Columns::of_shell(&shell, shell.coarse_pitch(COARSE_COLUMNS), &Watch::silent())?,
    };
    let best = search.best();
    setup.placement.goal.afloat = Some(best);
    watch.lap("waterline");
    Ok(setup)
}

/// The search's ground: the outside level by level, and the interior on coarse columns.
struct Search<'a> {
    setup: &'a Setup,
    hydrostatics: Hydrostatics,
    columns: Columns,
}

/// A waterline and how good it is: whether it can be had, then how high the metacentre stands above
/// the centre, or how little it misses.
type Rated = (Afloat, (bool, f64));

impl Search<'_> {
    fn best(&self) -> Afloat {
        let step = self.hydrostatics.height_mm() / (LOOKS + 1) as f64;
        let looks = (1..=LOOKS).map(|i| self.rated(step * i as f64));
        let best = looks.fold(self.rated(0.5 * step), better);
        // What is written weighs a hair more or less than what is solved for: at the very top it
        // would sink, at the very bottom not trim.
        let [lowest, highest] = [0.5 * step, self.hydrostatics.height_mm() - 0.5 * step];
        let at = best.0.waterline_mm;
        let range = [(at - step).max(lowest), (at + step).min(highest)];
        let look = |waterline_mm| self.rated(waterline_mm);
        let inner = golden_section(
            range,
            ROUNDS,
            look,
            (|rated: &Rated| rated.0.waterline_mm, is_better),
        );
        inner.into_iter().fold(best, better).0
    }

    fn rated(&self, waterline_mm: f64) -> Rated {
        let afloat = self.hydrostatics.at(waterline_mm);
        let goal = crate::goal::Goal {
            afloat: Some(afloat),
            ..self.setup.placement.goal.clone()
        };
        let problem = Problem {
            goal: &goal,
            fixed: goal.solid,
            columns: &self.columns,
        };
        let solution = self.setup.fill.solve(&problem, None, &Watch::silent());
        let rate = match solution.status {
            Status::Capsizes { greatest_gm_mm } => (false, greatest_gm_mm),
            Status::CannotTrim {
                least_offset_mm, ..
            } => (false, -self.hydrostatics.height_mm() - least_offset_mm),
            Status::Sinks { least_ratio } => (false, -UNTRIMMED_MM * least_ratio),
            Status::RidesHigh { greatest_ratio } => (false, -UNTRIMMED_MM / greatest_ratio),
            _ if solution.is_usable() => (true, solution.certificate.value),
            _ => (false, -UNTRIMMED_MM),
        };
        (afloat, rate)
    }
}

/// What a waterline at which it weighs too much or too little counts below all that only lean or
/// turn over, mm: more than any offset of a model a printer takes.
const UNTRIMMED_MM: f64 = 1e6;

fn is_better(a: &Rated, b: &Rated) -> bool {
    let ((can_a, rate_a), (can_b, rate_b)) = (a.1, b.1);
    can_a.cmp(&can_b).then(rate_a.total_cmp(&rate_b)).is_gt()
}

fn better(best: Rated, other: Rated) -> Rated {
    if is_better(&other, &best) {
        other
    } else {
        best
    }
}
