//! The trade between a wished density and the goal's figure: how much must change to keep how much.

use rayon::prelude::*;

use super::kept::Kept;
use super::near::NearWished;
use crate::base::watch::Watch;
use crate::goal::{Figures, Goal, GoalKind, Objective, compute_figures};
use crate::hollow::solution::Figure;
use crate::hollow::{Fill, Problem};

/// Shares of the best figure that are traded. The first keeps as good as nothing.
const SHARES: [f64; 8] = [0.01, 0.4, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99];

/// The least change of a wished density for each of some figures.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trade {
    /// The figure; `None` if the goal has none to be traded.
    pub figure: Option<Figure>,
    /// The root mean square of the change, as a share of solid print, and the figure, by ascending
    /// change.
    pub points: Vec<[f64; 2]>,
    /// The figure of the best print.
    pub best: f64,
}

impl NearWished {
    /// Computes the trade of a goal on these columns; empty for a goal without a figure to keep.
    ///
    /// Costs a search for the best print and one for each of eight shares of it, so coarse columns
    /// are advisable. If `watch` is stopped, points are missing.
    #[must_use]
    pub fn trade(&self, problem: &Problem, watch: &Watch) -> Trade {
        let goal = problem.goal;
        if matches!(
            goal.kind,
            GoalKind::Float | GoalKind::Balance | GoalKind::Match
        ) {
            return Trade::default();
        }
        let best = Fill::between(self.levels.range()).solve(problem, None, &watch.muted());
        let reached = figure_of(goal, &compute_figures(goal, &best.moments));
        let Some((figure, of_best)) = reached.filter(|_| best.is_usable()) else {
            return Trade::default();
        };
        let keeping = |share: &f64| {
            watch.check().ok()?;
            let kept = Kept::of(goal, &best.moments, Some(*share));
            let found = self.keeping(problem, Some(kept), &watch.muted());
            let (_, value) = figure_of(goal, &compute_figures(goal, &found.moments))?;
            found
                .is_usable()
                .then_some([found.certificate.value, value])
        };
        let kept: Vec<Option<[f64; 2]>> = SHARES.par_iter().map(keeping).collect();
        let most = self.change_of(problem, best.moments.volume());
        let mut points: Vec<[f64; 2]> = kept.into_iter().flatten().collect();
        points.extend(most.map(|change| [change, of_best]));
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points.dedup();
        Trade {
            figure: Some(figure),
            points,
            best: of_best,
        }
    }

    /// Returns the change of a print of two densities with so much solid print, mm³, as the root of
    /// its mean square; `None` without an interior.
    fn change_of(&self, problem: &Problem, volume_mm3: f64) -> Option<f64> {
        let (range, inside_mm3) = (self.levels.range(), problem.columns.moments().volume());
        let shell_mm3 = problem.fixed.volume() - inside_mm3;
        let mean = (volume_mm3 - shell_mm3) / inside_mm3;
        let share = ((mean - range.low()) / range.span()).clamp(0.0, 1.0);
        let square = |density: f64| (density - self.wished).powi(2);
        let change = (share * square(range.high()) + (1.0 - share) * square(range.low())).sqrt();
        change.is_finite().then_some(change)
    }
}

/// Returns the figure that a goal keeps, with its value; `None` for goals that keep none.
fn figure_of(goal: &Goal, figures: &Figures) -> Option<(Figure, f64)> {
    let value = match (goal.kind, goal.objective) {
        (GoalKind::Stand, Objective::LowestCenter) => {
            (Figure::CenterHeightMm, Some(figures.center_height_mm))
        }
        (GoalKind::Stand, _) => (Figure::TopplingAngleRad, figures.toppling_angle_rad),
        (GoalKind::Top | GoalKind::Yoyo, Objective::SpinIt { .. }) => {
            (Figure::SpinIt, figures.spin_it)
        }
        (GoalKind::Top, Objective::CriticalSpeed) => {
            (Figure::CriticalSpeedRpm, figures.critical_speed_rpm)
        }
        (GoalKind::Top | GoalKind::Yoyo, _) => {
            (Figure::DominanceRatio, Some(figures.dominance_ratio))
        }
        (GoalKind::Float | GoalKind::Balance | GoalKind::Match, _) => return None,
    };
    Some((value.0, value.1?))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::DensityRange;
    use crate::hollow::levels::PrintLevels;
    use crate::hollow::worlds;

    #[test]
    fn more_of_the_angle_costs_more_change_and_no_more_is_had_than_the_best() {
        let world = worlds::blocks_on_a_slope();
        let range = DensityRange::new(0.1, 1.0).unwrap();
        let near = NearWished {
            wished: 0.7,
            levels: PrintLevels::even(range, 6).unwrap(),
            least_angle_rad: 0.0,
            keep: None,
        };
        let trade = near.trade(&world.problem(), &Watch::silent());
        assert_eq!(trade.figure, Some(Figure::TopplingAngleRad));
        assert!(trade.points.len() >= 4, "{trade:?}");
        let rises = trade
            .points
            .windows(2)
            .all(|pair| pair[1][1] >= pair[0][1] - 1e-9);
        assert!(rises, "{trade:?}");
        let best = Fill::between(range).solve(&world.problem(), None, &Watch::silent());
        let last = trade.points.last().unwrap();
        assert!((last[1] - best.certificate.value).abs() < 1e-6, "{trade:?}");
        assert!(
            last[0] <= 0.6 + 1e-12,
            "no density is farther from the wished one"
        );
    }
}
