//! The figure that a print near a wished infill keeps.
//!
//! With the height ℓ of the centre fixed, what tops and yo-yos keep is convex in the moments:
//!
//! ```text
//! speed       g s_z + ω² (λ_max(I') − I_zz) ≤ 0
//! dominance   λ_max(I') − r I_zz            ≤ 0
//! Spin-It     ‖(I'_xx, √2 I_xy, I'_yy)‖ − f I_zz ≤ 0
//! ```
//!
//! Each is the greatest of linear functions, one for each direction. A few of them are rows of the
//! least change: those that the answer before broke. A bound of the few holds for all. Source:
//! Kelley, "The cutting-plane method for solving convex programs", J. SIAM 8, 1960.

use super::cone::{Cone, at_most, excess, quadric};
use crate::base::units::STANDARD_GRAVITY_MM_S2;
use crate::base::verdict::Verdict;
use crate::goal::{Goal, GoalKind, Objective, compute_figures};
use crate::hollow::dual::units::index::{ONE, Z};
use crate::hollow::golden::golden_section;
use crate::hollow::graded::{Row, Separation};
use crate::hollow::levels::LevelChange;
use crate::mass::Moments;

/// Share of the best figure that tops and yo-yos keep if nothing is ordered. Without it a top near
/// its wished infill may spin at no speed that fingers reach.
const USUAL_SHARE: f64 = 0.8;
/// Share of the best margin of dominance that is kept where another figure is the objective.
const LEAST_MARGIN: f64 = 0.2;
/// Excess of a row, in units of the body, up to which it counts as met.
const MET: f64 = 1e-7;
/// Most rounds of rows at a height.
const MOST_ROUNDS: usize = 16;
/// Rounds of the search for a height: they leave a hundredth of the range.
const HEIGHT_ROUNDS: usize = 9;

/// The figure that is kept, and the height of the centre at which it is.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::hollow) struct Kept {
    limit: Limit,
    /// Tops whose least change breaks the limit: the height of the centre, mm.
    height_mm: Option<f64>,
    /// The rows that held it last. They hold for all moments at that height.
    cuts: Vec<Row>,
}

/// The limit of a figure.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Limit {
    /// The least tilt at which it topples, rad.
    Angle(f64),
    /// The greatest height of the centre, mm.
    Height(f64),
    /// Those of tops and yo-yos.
    Spin(Spin),
}

/// Limits of what spins.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Spin {
    /// The greatest critical speed, squared, rad²/s²; `None` without one.
    speed: Option<f64>,
    /// The greatest moment across the axis over that about it.
    dominance: f64,
    /// The greatest root of Spin-It's ratio of inertias; `None` without one.
    flatness: Option<f64>,
    /// The greatest lever s_z, mm⁴; `None` if Spin-It's functional does not weigh it.
    lever: Option<f64>,
    /// Height of the centre of the best print, mm; `None` for yo-yos.
    best_mm: Option<f64>,
    /// Moments of the best print. The rows that touch the limits there are the first to be tried.
    best: Moments,
}

/// A least change, and the rows that hold its limits.
struct Held {
    change: LevelChange,
    cuts: Vec<Row>,
}

/// A least change, and what it keeps.
pub(in crate::hollow) struct KeptChange {
    pub change: LevelChange,
    /// What is kept; `None` for nothing.
    pub kept: Option<Kept>,
}

/// Returns whether the least change for a goal must keep a figure.
pub(in crate::hollow) fn keeps_figure(goal: &Goal, share: Option<f64>) -> bool {
    match goal.kind {
        GoalKind::Top | GoalKind::Yoyo => true,
        GoalKind::Stand => share.is_some(),
        GoalKind::Float | GoalKind::Balance | GoalKind::Match => false,
    }
}

impl Kept {
    /// Returns what keeps a share of the best figure, reached with these moments.
    pub fn of(goal: &Goal, best: &Moments, share: Option<f64>) -> Self {
        let share = share.unwrap_or(USUAL_SHARE);
        let figures = compute_figures(goal, best);
        let limit = match (goal.kind, goal.objective) {
            (GoalKind::Stand, Objective::LowestCenter) => {
                Limit::Height(figures.center_height_mm / share)
            }
            (GoalKind::Stand, _) => Limit::Angle(figures.toppling_angle_rad.unwrap_or(0.0) * share),
            _ => Limit::Spin(Spin::of(goal, best, share)),
        };
        Self {
            limit,
            height_mm: None,
            cuts: Vec::new(),
        }
    }

    /// Returns the least tilt that is kept, rad; 0 if none is.
    pub fn angle_rad(&self) -> f64 {
        match self.limit {
            Limit::Angle(angle_rad) => angle_rad,
            _ => 0.0,
        }
    }

    /// Returns the rows that touch the limits at some moments, with the centre as high as there.
    pub fn touching(&self, moments: &Moments) -> Vec<Row> {
        match self.limit {
            Limit::Angle(_) => Vec::new(),
            Limit::Height(height_mm) => vec![at_most(quadric(&[(Z, 1.0), (ONE, -height_mm)]))],
            Limit::Spin(spin) => {
                let height_mm = spin.best_mm.map_or(0.0, |_| moments.0[Z] / moments.0[ONE]);
                let cones = spin.cones().into_iter();
                cones.map(|cone| cone.row_at(moments, height_mm)).collect()
            }
        }
    }

    /// Finds the least change that keeps the figure; `least` finds the one of some rows.
    ///
    /// If a top's least change does not keep it, other heights of the centre are tried. They lie
    /// between that of the least change and that of the best print. `None` if no height keeps it.
    pub fn least_change(
        self,
        rows: &[Row],
        least: impl Fn(&[Row]) -> Verdict<LevelChange, Separation>,
    ) -> Verdict<Option<KeptChange>, Separation> {
        let spin = match self.limit {
            Limit::Spin(spin) => spin,
            Limit::Angle(_) => return least(rows).map(|change| Some(self.with(change))),
            Limit::Height(height_mm) => {
                let row = at_most(quadric(&[(Z, 1.0), (ONE, -height_mm)]));
                let all = [rows, &[row]].concat();
                return least(&all).map(|change| Some(self.with(change)));
            }
        };
        let search = Search {
            rows,
            spin,
            least: &least,
        };
        if let Some(height_mm) = self.height_mm {
            let cuts = self.cuts.clone();
            let held = search.at(height_mm, cuts);
            return Verdict::Found(held.map(|held| self.holding(Some(height_mm), held)));
        }
        let free = match least(rows) {
            Verdict::Found(free) => free,
            Verdict::No(proof) => return Verdict::No(proof),
        };
        let free_mm = free.moments.0[Z] / free.moments.0[ONE];
        let Some(best_mm) = spin.best_mm else {
            let start = Held {
                change: free,
                cuts: self.cuts.clone(),
            };
            let held = search.held(start, 0.0);
            return Verdict::Found(held.map(|held| self.holding(None, held)));
        };
        if spin.broken_by(&free.moments, free_mm).is_empty() {
            return Verdict::Found(Some(self.with(free)));
        }
        let found = search.between(free_mm, best_mm);
        Verdict::Found(found.map(|(height_mm, held)| self.holding(Some(height_mm), held)))
    }

    fn holding(&self, height_mm: Option<f64>, held: Held) -> KeptChange {
        let kept = Self {
            limit: self.limit,
            height_mm,
            cuts: held.cuts,
        };
        kept.with(held.change)
    }

    fn with(self, change: LevelChange) -> KeptChange {
        KeptChange {
            change,
            kept: Some(self),
        }
    }
}

/// A search for the least change that keeps the limits of what spins.
struct Search<'a, F> {
    rows: &'a [Row],
    spin: Spin,
    least: &'a F,
}

impl<F: Fn(&[Row]) -> Verdict<LevelChange, Separation>> Search<'_, F> {
    /// Returns the height between two whose change is least, and that change.
    fn between(&self, free_mm: f64, best_mm: f64) -> Option<(f64, Held)> {
        let cost = |held: &Option<Held>| {
            let cost = held.as_ref().map(|held| held.change.cost);
            cost.unwrap_or(f64::INFINITY)
        };
        let sample = |height_mm: f64| (height_mm, self.first(height_mm));
        let is_better = |a: &(f64, Option<Held>), b: &(f64, Option<Held>)| cost(&a.1) < cost(&b.1);
        // Where neither is possible, the search goes on towards the best print.
        let [first, second] = golden_section([free_mm, best_mm], HEIGHT_ROUNDS, sample, is_better);
        let found = if is_better(&first, &second) {
            first
        } else {
            second
        };
        match found {
            (height_mm, Some(held)) => Some((height_mm, held)),
            _ => Some((best_mm, self.first(best_mm)?)),
        }
    }

    /// Returns the least change with the centre at a height that is tried first.
    fn first(&self, height_mm: f64) -> Option<Held> {
        let cones = self.spin.cones().into_iter();
        let touching = cones.map(|cone| cone.row_at(&self.spin.best, height_mm));
        self.at(height_mm, touching.collect())
    }

    /// Returns the least change with the centre at a height, from rows that hold there; `None` if
    /// there is none.
    fn at(&self, height_mm: f64, cuts: Vec<Row>) -> Option<Held> {
        let lies = Row::zero(quadric(&[(Z, 1.0), (ONE, -height_mm)]));
        let lever = self.spin.lever.map(|lever| Row {
            wanted: lever,
            ..at_most(quadric(&[(Z, 1.0)]))
        });
        let own: Vec<Row> = std::iter::once(lies).chain(lever).collect();
        let rows = [self.rows, &own].concat();
        let search = Search {
            rows: &rows,
            ..*self
        };
        match (self.least)(&[rows.as_slice(), &cuts].concat()) {
            Verdict::Found(change) => search.held(Held { change, cuts }, height_mm),
            Verdict::No(_) => None,
        }
    }

    /// Returns the least change that breaks no limit, from one that may break some.
    fn held(&self, start: Held, height_mm: f64) -> Option<Held> {
        let Held {
            mut change,
            mut cuts,
        } = start;
        let mut steps = change.steps;
        for _ in 0..MOST_ROUNDS {
            let broken = self.spin.broken_by(&change.moments, height_mm);
            if broken.is_empty() {
                let change = LevelChange { steps, ..change };
                return Some(Held { change, cuts });
            }
            // Rows that decide nothing any more would only make the others less certain.
            cuts.retain(|row| excess(row, &change.moments) > -MET);
            cuts.extend(broken);
            let rows = [self.rows, &cuts].concat();
            let Verdict::Found(next) = (self.least)(&rows) else {
                return None;
            };
            steps += next.steps;
            change = next;
        }
        None
    }
}

impl Spin {
    fn of(goal: &Goal, best: &Moments, share: f64) -> Self {
        let figures = compute_figures(goal, best);
        let is_top = goal.kind == GoalKind::Top;
        let weights = match goal.objective {
            Objective::SpinIt { gamma_c, gamma_i } => Some((gamma_c, gamma_i)),
            _ => None,
        };
        let limit = figures.spin_it.zip(weights);
        let lowering = |gamma_c: f64| match is_top && gamma_c > 0.0 {
            true => gamma_c * (best.0[Z] / goal.solid.0[Z]).powi(2),
            false => 0.0,
        };
        let flatness = limit.map(|(value, (gamma_c, gamma_i))| {
            ((value / share - lowering(gamma_c)) / gamma_i)
                .max(0.0)
                .sqrt()
        });
        let weighs_lever = weights.is_some_and(|(gamma_c, _)| is_top && gamma_c > 0.0);
        let speed = figures.critical_speed_rpm.filter(|_| weights.is_none());
        // What is asked is the objective. Another figure keeps what a stable spin needs.
        let kept_margin = match goal.objective {
            Objective::Dominance => share,
            _ => LEAST_MARGIN,
        };
        let to_rad_s = std::f64::consts::TAU / 60.0;
        Self {
            speed: speed.map(|rpm| (rpm * to_rad_s / share).powi(2)),
            dominance: 1.0 - kept_margin * (1.0 - figures.dominance_ratio),
            flatness,
            lever: weighs_lever.then_some(best.0[Z]),
            best_mm: is_top.then_some(figures.center_height_mm),
            best: *best,
        }
    }

    fn cones(&self) -> Vec<Cone> {
        let speed = self.speed.map(|square| Cone {
            weights: [STANDARD_GRAVITY_MM_S2, -square, square],
            is_norm: false,
        });
        let flatness = self.flatness.map(|root| Cone {
            weights: [0.0, -root, 1.0],
            is_norm: true,
        });
        let dominance = Cone {
            weights: [0.0, -self.dominance, 1.0],
            is_norm: false,
        };
        speed
            .into_iter()
            .chain(flatness)
            .chain([dominance])
            .collect()
    }

    /// Returns the rows that these moments break.
    fn broken_by(&self, moments: &Moments, height_mm: f64) -> Vec<Row> {
        let cones = self.cones().into_iter();
        let rows = cones.map(|cone| cone.row_at(moments, height_mm));
        rows.filter(|row| excess(row, moments) > MET).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;
    use crate::field::DensityRange;
    use crate::hollow::dual::units::index::{XX, YY};
    use crate::hollow::goals::cone::tensor;
    use crate::hollow::worlds::{self, World};
    use crate::hollow::{Fill, NearWished, PrintLevels};

    fn near(wished: f64, keep: Option<f64>) -> NearWished {
        let range = DensityRange::new(0.15, 1.0).unwrap();
        NearWished {
            wished,
            levels: PrintLevels::even(range, 5).unwrap(),
            least_angle_rad: 0.0,
            keep,
        }
    }

    /// Returns the figures of the best of two densities, and of the least change.
    fn both(world: &World, near: &NearWished) -> [crate::goal::Figures; 2] {
        let problem = world.problem();
        let fill = Fill::between(near.levels.range());
        let best = fill.solve(&problem, None, &Watch::silent());
        assert!(best.is_usable(), "{:?}", best.status);
        let found = near.solve(&problem, None, &Watch::silent());
        assert!(found.is_usable(), "{:?}", found.status);
        [best, found].map(|solution| compute_figures(&world.goal, &solution.moments))
    }

    #[test]
    fn a_top_keeps_the_share_of_its_best_speed_that_is_ordered() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        for share in [0.5, 0.8, 0.95] {
            let [best, found] = both(&world, &near(0.5, Some(share)));
            let speeds = [best, found].map(|figures| figures.critical_speed_rpm.unwrap());
            let limit = speeds[0] / share;
            assert!(speeds[1] <= limit * (1.0 + 1e-4), "{share}: {speeds:?}");
            assert!(found.off_axis_mm < 1e-4, "{found:?}");
        }
    }

    #[test]
    fn what_is_kept_costs_no_more_than_the_best_and_more_the_more_is_kept() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let cost = |share: f64| {
            let found = near(0.5, Some(share)).solve(&world.problem(), None, &Watch::silent());
            found.certificate.value
        };
        let costs = [0.3, 0.6, 0.8, 0.9, 0.97].map(cost);
        assert!(
            costs.windows(2).all(|pair| pair[0] <= pair[1] + 1e-6),
            "{costs:?}"
        );
        // The two densities at their best change the interior by this, root mean square.
        let near = near(0.5, None);
        let fill = Fill::between(near.levels.range());
        let problem = world.problem();
        let best = fill.solve(&problem, None, &Watch::silent());
        let whole = world.columns.moments().volume();
        let emptied = crate::interior::moments_where_positive(&world.columns, &best.quadric);
        let sparse = emptied.volume() / whole;
        let rms = (sparse * 0.35_f64.powi(2) + (1.0 - sparse) * 0.5_f64.powi(2)).sqrt();
        assert!(costs[4] < rms, "{costs:?} {rms}");
        assert!(costs[0] < 0.8 * costs[4], "{costs:?}");
    }

    #[test]
    fn yo_yos_stay_dominant_and_keep_their_figure() {
        let world = worlds::egg(Objective::SPIN_IT);
        let [best, found] = both(&world, &near(0.4, Some(0.9)));
        let spin_it = [best, found].map(|figures| figures.spin_it.unwrap());
        assert!(spin_it[1] <= spin_it[0] / 0.9 * (1.0 + 1e-5), "{spin_it:?}");
    }

    #[test]
    fn the_row_touches_its_cone_and_lies_below_it_elsewhere() {
        let world = worlds::egg_on_its_side(Objective::CriticalSpeed);
        let solid = world.fixed;
        let other = solid - world.columns.moments() * 0.4;
        let spin = Spin {
            speed: Some(40.0),
            dominance: 0.9,
            flatness: Some(1.3),
            lever: None,
            best_mm: None,
            best: solid,
        };
        let height_mm = 0.3 * solid.0[Z] / solid.0[ONE];
        let value = |cone: &Cone, moments: &Moments| {
            let row = cone.row_at(moments, height_mm);
            row.quadric
                .0
                .iter()
                .zip(moments.0)
                .map(|(c, s)| c * s)
                .sum::<f64>()
        };
        for cone in spin.cones() {
            let [about_x, across, about_y] = tensor(&solid, height_mm);
            let convex = if cone.is_norm {
                (about_x.powi(2) + 2.0 * across.powi(2) + about_y.powi(2)).sqrt()
            } else {
                0.5 * (about_x + about_y) + (0.5 * (about_x - about_y)).hypot(across)
            };
            let axial = solid.0[XX] + solid.0[YY];
            let [a, b, c] = cone.weights;
            let exact = a * solid.0[Z] + b * axial + c * convex;
            let size = exact.abs().max(axial);
            assert!(
                (value(&cone, &solid) - exact).abs() < 1e-9 * size,
                "{cone:?}"
            );
            let touched = cone.row_at(&other, height_mm);
            let below: f64 = touched
                .quadric
                .0
                .iter()
                .zip(solid.0)
                .map(|(c, s)| c * s)
                .sum();
            assert!(below <= exact + 1e-9 * size, "{cone:?}");
        }
    }
}
