//! The least steel inside that makes a goal possible.

use super::confirm::least_excess;
use super::directions::round_to;
use super::remedy::{Change, Kind, Remedy};
use super::sampled_model::{CONFIRMING_COLUMNS, SampledModel, Trial, problem};
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::base::watch::Watch;
use crate::geom::{Point, Quadric};
use crate::goal::Placement;
use crate::hollow::{Problem, Settings, least_ballast, solve};
use crate::interior::{Columns, moments_where_positive};

/// The density of carbon and bearing steel, of which balls, nuts and rods are made, g/cm³. The
/// kinds lie between 7.7 and 7.9.
const STEEL_G_CM3: f64 = 7.85;
/// The columns a side of the search, which takes thousands of passes. The steel is weighed on finer
/// ones.
const SEARCHING_COLUMNS: usize = 60;
/// The greatest number of passes of an ascent. With the ballast's price the dual bends more
/// sharply.
const PASSES: usize = 150;
/// The number of halvings in the search for the level at which a region has a given volume. The
/// remainder is far too light to weigh.
const LEVEL_ROUNDS: usize = 40;

/// A region of steel in the interior, and the solve with it.
struct Steel {
    volume_mm3: f64,
    /// Model coordinates.
    center: Point,
    trial: Trial,
}

/// Returns the mass and the place of the steel that helps, or a remedy that says that none inside
/// does.
pub(super) fn remedy(model: &SampledModel) -> Remedy {
    let Some(steel) = find_least_steel(model) else {
        let words = "steel inside";
        return Remedy::dead_end(Kind::LeastBallast, words.to_owned());
    };
    let mass_g = steel.volume_mm3 / MM3_PER_CM3 * STEEL_G_CM3;
    let ball_mm = (6.0 * steel.volume_mm3 / std::f64::consts::PI).cbrt();
    let [x, y, z] = round_to(steel.center.into(), 0);
    let words = format!(
        "put {mass_g:.1} g of steel or more (as much as a ball of {}) inside, about ({x}, {y}, \
         {z}) mm",
        show_mm(ball_mm),
    );
    let change = Change {
        amount: mass_g,
        settings: Vec::new(),
        words,
    };
    Remedy::helping(Kind::LeastBallast, change, &steel.trial)
}

/// Returns the least steel, with the least excess that the confirming solve asks for.
fn find_least_steel(model: &SampledModel) -> Option<Steel> {
    let excess_ratio = STEEL_G_CM3 / model.case.density_g_cm3 - 1.0;
    if excess_ratio <= 0.0 {
        return None;
    }
    let exact = |columns| model.exact_columns(&model.case.request, model.case.wall_mm, columns);
    let (placement, coarse) = exact(SEARCHING_COLUMNS)?;
    let least = |placement: Placement| {
        let question = problem(&placement, &coarse);
        let settings = Settings {
            passes_per_ascent: PASSES,
            ..Settings::default()
        };
        let ballast = least_ballast(&question, 1.0 + excess_ratio, &settings, &model.watch)?;
        Some((placement, ballast))
    };
    let found = model
        .at_waterlines(&placement)
        .into_iter()
        .filter_map(least);
    let (placement, ballast) = found.min_by(|a, b| a.1.volume_mm3.total_cmp(&b.1.volume_mm3))?;
    let (_, columns) = exact(CONFIRMING_COLUMNS)?;
    least_excess(|excess| {
        let filled = raise_to_volume(
            &columns,
            ballast.filled,
            (1.0 + excess) * ballast.volume_mm3,
        )?;
        let heavy = Heavy {
            filled,
            excess_ratio,
        };
        model.watch.check().ok()?;
        confirm(&placement, &columns, &heavy, &model.watch)
    })
}

/// The region of the steel, and the ratio by which its density exceeds that of the print.
struct Heavy {
    filled: Quadric,
    excess_ratio: f64,
}

/// Solves with the steel as part of the fixed mass; its region may not be emptied.
fn confirm(
    placement: &Placement,
    columns: &Columns,
    heavy: &Heavy,
    watch: &Watch,
) -> Option<Steel> {
    let steel = moments_where_positive(columns, &heavy.filled);
    let rest = columns.outside(&heavy.filled);
    let question = problem(placement, &rest);
    let weighted = Problem {
        fixed: question.fixed + steel * heavy.excess_ratio,
        ..question
    };
    let solution = solve(&weighted, &Settings::default(), watch);
    let trial = Trial {
        placement: placement.clone(),
        solution,
        columns: rest.len(),
    };
    let center = placement.goal.frame.to_model(&steel.centroid());
    trial.is_possible().then_some(Steel {
        volume_mm3: steel.volume(),
        center,
        trial,
    })
}

/// Returns a quadric raised to the level at which its region has this volume in the columns, mm³.
/// `None` if all the columns hold less.
fn raise_to_volume(columns: &Columns, quadric: Quadric, volume_mm3: f64) -> Option<Quadric> {
    let raised = |level: f64| {
        let mut raised = quadric;
        raised.0[0] += level;
        raised
    };
    let volume = |level: f64| moments_where_positive(columns, &raised(level)).volume();
    let scale = quadric.0[0].abs();
    let high = (0..LEVEL_ROUNDS)
        .map(|i| scale * 2f64.powi(i as i32 - 10))
        .find(|&level| volume(level) >= volume_mm3)?;
    let mut ends = [0.0, high];
    for _ in 0..LEVEL_ROUNDS {
        let middle = 0.5 * (ends[0] + ends[1]);
        ends[usize::from(volume(middle) >= volume_mm3)] = middle;
    }
    Some(raised(ends[1]))
}
