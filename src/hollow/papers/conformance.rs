//! One suite for all methods: the properties each must have, and their agreement.
//!
//! Let q be the optimal quadric (no unit, positive in the void). The *regret* of an interior is R =
//! ∫|q| over the region where it differs from the optimal one. It is the loss, as a part of the
//! solid's volume. Two facts hold up to rounding. First, R ≥ 0 for every interior. Second, the
//! volume V of the difference is at most √(2RW), W = Σ area/|∂q/∂z| over the void's surface, to
//! first order. Differences cost least in a band along the surface, where a depth d costs
//! |∂q/∂z|d²/2; Cauchy and Schwarz give the rest. The size of R depends on each method's cells.

use super::super::*;
use crate::geom::Point;
use crate::goal::Objective;
use crate::hollow::worlds::{self, World};
use crate::interior::moments_and_derivative;

/// Pitch of the columns. Its size does not matter, but a voxel has to be as high as they are wide.
const PITCH_MM: f64 = 1.0;
/// Regret left by the optimisers: their final slope is 1e-4, and the regret is quadratic in it.
const UNDONE: f64 = 1e-5;
/// Additional regret from smoothing λ_max. It is in the numerator's units; the smoothed numerator
/// is too large by this much at most.
const SMOOTHED: f64 = 1e-4;
/// Allowance for the first-order band: in an egg of 12 mm the surface bends by some per cent within
/// a cell of 1 mm.
const BEND: f64 = 1.2;

/// The optimal quadric as the judge of other interiors.
struct Judge<'a> {
    world: &'a World,
    best: Solution,
    emptied: crate::interior::Emptied,
    /// Density W of the band, mm³.
    density: f64,
}

impl<'a> Judge<'a> {
    fn of(world: &'a World) -> Self {
        let best = solve(&world.problem(), &Settings::default(), &Watch::silent());
        let emptied = crate::interior::Emptied::where_positive(&world.columns, &best.quadric);
        let density = moments_and_derivative(&world.columns, &best.quadric).1[(0, 0)];
        Self {
            world,
            best,
            emptied,
            density,
        }
    }

    fn volume(&self) -> f64 {
        self.world.fixed.volume()
    }

    /// Returns the regret R.
    fn regret(&self, found: &Found) -> f64 {
        let more = found.moments - self.best.moments;
        self.best
            .quadric
            .0
            .iter()
            .zip(more.0)
            .map(|(q, s)| q * s)
            .sum::<f64>()
            / self.volume()
    }

    /// Returns the greatest loss from whole cells of this height. A cell cut by the surface at a
    /// slope k is kept or emptied whole, which costs k·h²/8 per area.
    fn loss_of_cells(&self, height_mm: f64) -> f64 {
        let columns = &self.world.columns;
        let is_inside = |column: usize, z: f64| {
            columns
                .intervals_of(column)
                .iter()
                .any(|[bottom, top]| *bottom < z && z < *top)
        };
        let slope = |column: usize, z: f64| {
            let [x, y] = columns.centers[column];
            self.best.quadric.gradient(&Point::new(x, y, z)).z.abs()
        };
        let of_column = |column: usize| {
            let pieces = self.emptied.pieces_of(column).iter();
            let ends = pieces.flat_map(|piece| [piece.bottom_mm, piece.top_mm]);
            ends.filter(|&z| is_inside(column, z))
                .map(|z| slope(column, z))
                .sum::<f64>()
        };
        let slopes: f64 = (0..columns.len()).map(of_column).sum();
        let area_mm2 = columns.pitch_mm[0] * columns.pitch_mm[1];
        slopes * area_mm2 * height_mm * height_mm / 8.0 / self.volume()
    }
}

/// Returns every method with the loss its cells may add, in multiples of the loss of whole cells.
fn methods() -> Vec<(Box<dyn Method>, f64)> {
    let octree = ByOctree {
        levels: crate::interior::Levels {
            inner: 3,
            boundary: 4,
        },
        ..ByOctree::default()
    };
    vec![
        (Box::new(ByQuadric::default()), 0.0),
        (Box::new(ByRays::default()), 0.0),
        // Twice the loss of cells at the quadric's own multipliers, as the method's differ a
        // little.
        (Box::new(ByVoxels::default()), 2.0),
        // Leaves up to twice the width are not split if the surface barely touches them. Rounding
        // moves as much again.
        (Box::new(octree), 2.0 * 4.0),
    ]
}

fn hold_together(world: &World) {
    let judge = Judge::of(world);
    let is_smoothed = matches!(
        world.goal.objective,
        Objective::CriticalSpeed | Objective::Dominance
    );
    let slack = UNDONE + if is_smoothed { SMOOTHED } else { 0.0 };
    for (method, cells) in methods() {
        let found = method.find(&world.problem(), &Watch::silent()).unwrap();
        let (regret, loss) = (judge.regret(&found), judge.loss_of_cells(PITCH_MM));
        let differs = found.emptied.difference_mm3(&judge.emptied, &world.columns);
        let band = (2.0 * regret.max(0.0) * judge.volume() * judge.density).sqrt();
        let says = format!(
            "{} on {:?}: {:?}, value {} (best {}), regret {regret:.2e} (cells {loss:.2e}), differs {differs:.3} (band \
             {band:.3}) of {:.1} mm³, residual {:.1e} {:?}, {} of {}",
            method.name(),
            world.goal.objective,
            found.outcome,
            found.value,
            judge.best.certificate.value,
            judge.emptied.moments(&world.columns).volume(),
            found.residual,
            found.rounding,
            found.iterations,
            found.variables,
        );
        let residual = found
            .rounding
            .map_or(found.residual, |rounding| rounding.residual_before);
        assert!(
            matches!(found.outcome, Outcome::Optimal | Outcome::Converged),
            "{says}"
        );
        assert!(residual <= Accuracy::default().residual, "{says}");
        let drawn = world.fixed - found.emptied.moments(&world.columns);
        assert!(
            drawn
                .0
                .iter()
                .zip(found.moments.0)
                .all(|(a, b)| (a - b).abs() < 1e-9 * world.fixed.0[9]),
            "{says}"
        );
        assert!(regret >= -1e-12, "{says}");
        assert!(regret <= cells * loss + slack, "{says}");
        assert!(differs <= BEND * band + 1e-6 * judge.volume(), "{says}");
    }
}

fn spin_it(gamma_c: f64) -> Objective {
    Objective::SpinIt {
        gamma_c,
        gamma_i: 1.0,
    }
}

#[test]
fn all_methods_find_the_same_yoyo() {
    hold_together(&worlds::egg_at(spin_it(0.0), PITCH_MM));
}

#[test]
fn all_methods_find_the_same_most_dominant_yoyo() {
    hold_together(&worlds::egg_at(Objective::Dominance, PITCH_MM));
}

#[test]
fn all_methods_find_the_same_top_by_spin_its_functional() {
    for gamma_c in [0.0, 1.0] {
        hold_together(&worlds::egg_on_its_side_at(spin_it(gamma_c), PITCH_MM));
    }
}

#[test]
fn all_methods_find_the_same_slowest_top() {
    hold_together(&worlds::egg_on_its_side_at(
        Objective::CriticalSpeed,
        PITCH_MM,
    ));
}

#[test]
fn all_methods_fill_a_bottle_to_the_same_height() {
    hold_together(&worlds::bottle());
}

#[test]
fn where_the_constraints_cannot_be_met_none_says_that_they_are() {
    let mut world = worlds::egg_at(spin_it(0.0), PITCH_MM);
    let shift = crate::geom::Vector::new(-6.0, 0.0, 0.0);
    world.fixed = world.fixed.translated(&shift);
    world
        .columns
        .centers
        .iter_mut()
        .for_each(|center| center[0] += shift.x);
    world.goal.solid = world.fixed;
    for (method, _) in methods() {
        let found = method.find(&world.problem(), &Watch::silent()).unwrap();
        assert!(
            matches!(
                found.outcome,
                Outcome::Impossible | Outcome::ConstraintsMissed
            ),
            "{:?}",
            found.outcome
        );
    }
}

#[test]
fn one_thread_and_three_give_the_same_bits() {
    let world = worlds::egg_at(spin_it(0.0), PITCH_MM);
    for (method, _) in methods() {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            pool.install(|| method.find(&world.problem(), &Watch::silent()).unwrap())
        };
        assert_eq!(with(1), with(3), "{}", method.name());
    }
}

#[test]
fn a_cancelled_run_says_so() {
    let watch = Watch::silent();
    watch.cancel();
    let world = worlds::egg_at(spin_it(0.0), PITCH_MM);
    for (method, _) in methods() {
        assert_eq!(
            method.find(&world.problem(), &watch).unwrap().outcome,
            Outcome::Cancelled
        );
    }
}

#[test]
fn with_nothing_to_empty_the_papers_methods_refuse_by_name() {
    let mut world = worlds::bottle();
    world.columns = crate::interior::Columns {
        starts: vec![0],
        ..Default::default()
    };
    for (method, _) in methods().into_iter().skip(1) {
        let refused = method.find(&world.problem(), &Watch::silent());
        assert_eq!(
            refused,
            Err(MethodError::NothingToEmpty {
                method: method.name()
            })
        );
    }
}

#[test]
fn what_floats_or_runs_true_is_not_for_the_papers_methods() {
    let worlds = [worlds::tank(120.0, [0.0; 2]), worlds::coupled_rotor(1.0)];
    for (method, _) in methods().into_iter().skip(1) {
        for world in &worlds {
            let (method_word, kind) = (method.name(), world.goal.kind);
            let refused = method.find(&world.problem(), &Watch::silent());
            assert_eq!(
                refused,
                Err(MethodError::NotItsGoal {
                    method: method_word,
                    kind
                })
            );
        }
    }
}
