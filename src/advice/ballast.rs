//! The least steel inside that makes a goal possible.

use super::confirm::least_excess;
use super::directions::rounded;
use super::ground::{CONFIRMING_COLUMNS, Ground, Trial, problem};
use super::remedy::{Kind, Remedy};
use crate::base::units::{MM3_PER_CM3, show_mm};
use crate::base::watch::Watch;
use crate::geom::{Point, Quadric};
use crate::goal::Placement;
use crate::hollow::{Problem, Settings, least_ballast, solve};
use crate::interior::{Columns, moments_where_positive};

/// Carbon and bearing steel, as balls, nuts and rods are made of, g/cm³; kinds of it lie between
/// 7.7 and 7.9.
const STEEL_G_CM3: f64 = 7.85;
/// Columns a side of the search, which takes thousands of passes; the steel found on them is
/// weighed on finer ones.
const SEARCHING_COLUMNS: usize = 60;
/// Passes an ascent may take: with a price to pay it bends more sharply than without.
const PASSES: usize = 150;
/// Halvings of the level at which a region has a given volume; what is left is far below what can
/// be weighed.
const LEVEL_ROUNDS: usize = 40;

/// Steel in the interior, and the solve with it.
struct Bought {
    volume_mm3: f64,
    /// Model coordinates.
    center: Point,
    trial: Trial,
}

/// How much steel would do, and where; or that no amount of it inside does.
pub(super) fn remedy(ground: &Ground) -> Remedy {
    let Some(bought) = bought(ground) else {
        let words = "no amount of steel inside was found that helps";
        return Remedy::nothing(Kind::LeastBallast, words.to_owned());
    };
    let mass_g = bought.volume_mm3 / MM3_PER_CM3 * STEEL_G_CM3;
    let ball_mm = (6.0 * bought.volume_mm3 / std::f64::consts::PI).cbrt();
    let [x, y, z] = rounded(bought.center.into(), 0);
    let words = format!(
        "put {mass_g:.1} g of steel or more (as much as a ball of {}) inside, about ({}, {}, {}) mm; --ballast=auto lays it in as \
         balls where they fit",
        show_mm(ball_mm),
        x,
        y,
        z
    );
    Remedy::found(
        Kind::LeastBallast,
        mass_g,
        [String::new(), words],
        &bought.trial,
    )
}

/// The least steel, confirmed with as little more as it takes.
fn bought(ground: &Ground) -> Option<Bought> {
    let excess_ratio = STEEL_G_CM3 / ground.case.density_g_cm3 - 1.0;
    if excess_ratio <= 0.0 {
        return None;
    }
    let exact = |columns| ground.exact(&ground.case.request, ground.case.wall_mm, columns);
    let (placement, coarse) = exact(SEARCHING_COLUMNS)?;
    let least = |placement: Placement| {
        let question = problem(&placement, &coarse);
        let settings = Settings {
            passes_per_ascent: PASSES,
            ..Settings::default()
        };
        let ballast = least_ballast(&question, 1.0 + excess_ratio, &settings, &Watch::silent())?;
        Some((placement, ballast))
    };
    let found = ground
        .at_its_lines(&placement)
        .into_iter()
        .filter_map(least);
    let (placement, ballast) = found.min_by(|a, b| a.1.volume_mm3.total_cmp(&b.1.volume_mm3))?;
    let (_, columns) = exact(CONFIRMING_COLUMNS)?;
    least_excess(|excess| {
        let filled = grown(
            &columns,
            ballast.filled,
            (1.0 + excess) * ballast.volume_mm3,
        )?;
        confirmed(&placement, &columns, &filled, excess_ratio)
    })
}

/// The plain question with the steel as a part of what is fixed, where nothing may be emptied any
/// more.
fn confirmed(
    placement: &Placement,
    columns: &Columns,
    filled: &Quadric,
    excess_ratio: f64,
) -> Option<Bought> {
    let steel = moments_where_positive(columns, filled);
    let rest = columns.outside(filled);
    let question = problem(placement, &rest);
    let weighted = Problem {
        fixed: question.fixed + steel * excess_ratio,
        ..question
    };
    let solution = solve(&weighted, &Settings::default(), &Watch::silent());
    let trial = Trial {
        placement: placement.clone(),
        solution,
        columns: rest.len(),
    };
    let center = placement.goal.frame.to_model(&steel.centroid());
    trial.is_possible().then_some(Bought {
        volume_mm3: steel.volume(),
        center,
        trial,
    })
}

/// The region of a quadric at the level at which it has this volume in the columns, mm³; none if
/// all of them have less.
fn grown(columns: &Columns, quadric: Quadric, volume_mm3: f64) -> Option<Quadric> {
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
