//! Figures and their units as the sheet names them.

use crate::goal::{GoalKind, Objective};
use crate::hollow;
use crate::run::Placed;
use crate::verify::FigureName;

/// Returns the figure by which a goal is judged.
pub fn promised_figure(kind: GoalKind, objective: Objective) -> FigureName {
    match (kind, objective) {
        (GoalKind::Top, _) => FigureName::CriticalSpeedRpm,
        (_, Objective::Dominance) => FigureName::DominanceRatio,
        (GoalKind::Yoyo, _) => FigureName::SpinItRatio,
        (GoalKind::Stand, Objective::LowestCenter) => FigureName::CenterHeightMm,
        (GoalKind::Stand, _) => FigureName::TopplesDeg,
        (GoalKind::Float, _) => FigureName::MetacentricHeightMm,
        (GoalKind::Balance, _) => FigureName::BalanceGradeMmS,
        (GoalKind::Match, _) => FigureName::InfillChangeRatio,
    }
}

/// Returns a value of a certificate's figure in the unit of the sheet.
pub fn in_sheet_unit(placed: &Placed, figure: hollow::Figure, value: f64) -> f64 {
    match figure {
        hollow::Figure::TopplingAngleRad => value.to_degrees(),
        hollow::Figure::VolumeMm3 => value * placed.shop.material.density_g_mm3(),
        _ => value,
    }
}

/// Returns the judge's name of a certificate's figure.
pub fn figure_name(figure: hollow::Figure) -> FigureName {
    use hollow::Figure;
    match figure {
        Figure::CriticalSpeedRpm => FigureName::CriticalSpeedRpm,
        Figure::SpinIt => FigureName::SpinItRatio,
        Figure::DominanceRatio => FigureName::DominanceRatio,
        Figure::TopplingAngleRad => FigureName::TopplesDeg,
        Figure::CenterHeightMm => FigureName::CenterHeightMm,
        Figure::MetacentricHeightMm => FigureName::MetacentricHeightMm,
        Figure::VolumeMm3 => FigureName::MassG,
        Figure::BalanceGradeMmS => FigureName::BalanceGradeMmS,
        Figure::InfillChange => FigureName::InfillChangeRatio,
    }
}
