//! Distance of a body from its goal's constraints: whether it must be solved for again.

use crate::goal::{Goal, GoalKind, Objective, compute_figures};
use crate::hollow::TILT_MARGIN_RAD;
use crate::mass::{Body, Moments};
use crate::run::Placed;

/// Tolerance of the centre of mass, mm: a tenth of what a kit promises.
const CENTER_TOLERANCE_MM: f64 = 0.0005;
/// Tolerance of the principal axis, rad: a tenth of the promised 0.05°.
const TILT_TOLERANCE_RAD: f64 = 8.7e-5;
/// Tolerance of the mass of what floats, as a share: a hundredth of what a kit promises.
const MASS_TOLERANCE_RATIO: f64 = 1e-5;
/// Tolerance of a match: a tenth of what a kit promises. It is a share of the mass, and for each
/// entry of the inertia tensor a share of the trace.
const MATCH_TOLERANCE_RATIO: f64 = 1e-4;
/// Tolerance of the mass of what is made of cells: half of what is promised of them.
const CELLS_TOLERANCE_RATIO: f64 = 5e-4;
/// Share of a rotor's permissible unbalance that may be left in the written parts.
const GRADE_SHARE_RATIO: f64 = 0.1;

/// Tolerance of the tilt that an object near a wished infill must bear, rad: half of the margin
/// that it is solved with.
const BEARING_TOLERANCE_RAD: f64 = 0.5 * TILT_MARGIN_RAD;

/// Returns the distance of a body from all that it was solved for, in the tolerances of a written
/// kit. That is the usual defect, and the tilt that an object near a wished infill must bear.
pub fn shortfall_ratio(placed: &Placed, solved: &Moments, moments: &Moments) -> f64 {
    let goal = placed.goal();
    let own = defect_ratio(goal, solved, moments).max(out_of_cells(placed, solved, moments));
    let near = placed
        .sparse
        .as_ref()
        .and_then(|nested| nested.near.as_ref());
    let reached_rad = compute_figures(goal, moments).toppling_angle_rad;
    match near.zip(reached_rad) {
        Some((near, reached_rad)) if goal.kind == GoalKind::Stand => {
            own.max((near.least_angle_rad - reached_rad) / BEARING_TOLERANCE_RAD)
        }
        _ => own,
    }
}

/// Returns the distance of a body with cells from the mass that was solved for, in tolerances.
/// Farther off they are placed by a density that is not theirs.
fn out_of_cells(placed: &Placed, solved: &Moments, moments: &Moments) -> f64 {
    if placed.cells.is_none() {
        return 0.0;
    }
    (moments.volume() / solved.volume() - 1.0).abs() / CELLS_TOLERANCE_RATIO
}

/// Returns the distance of a body from the goal's constraints, in the tolerances of a written kit.
///
/// The constraint that is missed most counts. Moments are in the goal frame. A rotor that cannot
/// meet its constraints is compared with what was `solved`. A kit breaks its promise at about ten.
pub fn defect_ratio(goal: &Goal, solved: &Moments, moments: &Moments) -> f64 {
    let body = Body::new(moments, 1.0);
    let aside = body.center.xy().coords.norm() / CENTER_TOLERANCE_MM;
    match goal.kind {
        GoalKind::Top => aside.max(lean(&body)),
        GoalKind::Yoyo => (body.center.coords.norm() / CENTER_TOLERANCE_MM).max(lean(&body)),
        GoalKind::Float => out_of_trim(goal, moments),
        GoalKind::Balance => unbalance(goal, &(*moments - *solved), moments),
        GoalKind::Match => mismatch(goal, moments),
        GoalKind::Stand if goal.objective == Objective::LowestCenter => aside,
        GoalKind::Stand => 0.0,
    }
}

/// Returns the distance of the weight from what the water carries, and of the centre from that of
/// buoyancy, in tolerances.
fn out_of_trim(goal: &Goal, moments: &Moments) -> f64 {
    let afloat = goal.afloat.unwrap_or_default();
    let aside_mm = (moments.centroid() - afloat.buoyancy).xy().norm();
    let excess = (moments.volume() - afloat.material_mm3).abs();
    (aside_mm / CENTER_TOLERANCE_MM).max(excess / (MASS_TOLERANCE_RATIO * afloat.material_mm3))
}

/// Returns the distance of a match from its mass, centre and inertia, in tolerances.
fn mismatch(goal: &Goal, moments: &Moments) -> f64 {
    let wanted = goal.wanted.unwrap_or_default().moments;
    let (now, then) = (Body::new(moments, 1.0), Body::new(&wanted, 1.0));
    let mass_ratio = (now.mass_g / then.mass_g - 1.0).abs();
    let center_mm = (now.center - then.center).norm();
    let off = (now.inertia_g_mm2 - then.inertia_g_mm2).amax();
    let inertia_ratio = off / then.inertia_g_mm2.trace();
    (center_mm / CENTER_TOLERANCE_MM).max(mass_ratio.max(inertia_ratio) / MATCH_TOLERANCE_RATIO)
}

/// Returns the static and couple unbalance in excess of what was solved for, in tolerances.
///
/// The tolerance is a tenth of what the rotor's grade allows, at most that of any centre. A couple
/// counts as the offset of the mass at a lever of its radius of gyration.
fn unbalance(goal: &Goal, excess: &Moments, moments: &Moments) -> f64 {
    let allowed_mm = goal
        .spindle
        .map_or(f64::INFINITY, |spindle| spindle.rotor.permissible_mm());
    let [_, x, y, _, _, yz, xz, ..] = excess.0;
    let volume = moments.volume();
    let radius_mm = (moments.second().trace() / volume).sqrt();
    let worst_mm = (x.hypot(y) / volume).max(xz.hypot(yz) / (volume * radius_mm));
    worst_mm / (GRADE_SHARE_RATIO * allowed_mm).min(CENTER_TOLERANCE_MM)
}

/// Returns the tilt of the axis of the greatest moment from the z axis, in tolerances.
fn lean(body: &Body) -> f64 {
    let axis = body.principal().axes.column(2).into_owned();
    axis.xy().norm() / TILT_TOLERANCE_RAD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Frame, Matrix, Vector};
    use crate::goal::{Rotor, Spindle};

    fn is_tuned(goal: &Goal, solved: &Moments, moments: &Moments) -> bool {
        defect_ratio(goal, solved, moments) <= 1.0
    }

    /// The solved moments; only a rotor is compared with them.
    const SOLVED: Moments = Moments([0.0; 10]);

    fn goal(kind: GoalKind) -> Goal {
        Goal {
            kind,
            frame: Frame::identity(),
            objective: Objective::default_for(kind),
            support: Vec::new(),
            spindle: None,
            afloat: None,
            wanted: None,
            solid: Moments::default(),
        }
    }

    /// A flat disc-like body at `center`, turned by `tilt` about x.
    fn body(center: Vector, tilt: f64) -> Moments {
        let turn = Matrix::new(
            1.0,
            0.0,
            0.0,
            0.0,
            tilt.cos(),
            -tilt.sin(),
            0.0,
            tilt.sin(),
            tilt.cos(),
        );
        let second = Matrix::from_diagonal(&Vector::new(900.0, 800.0, 100.0));
        Moments::from_parts(10.0, &Vector::zeros(), &second)
            .rotated(&turn)
            .translated(&center)
    }

    #[test]
    fn a_top_may_have_its_centre_anywhere_on_its_axis() {
        let top = goal(GoalKind::Top);
        assert!(is_tuned(
            &top,
            &SOLVED,
            &body(Vector::new(0.0, 0.0, 7.0), 0.0)
        ));
        assert!(!is_tuned(
            &top,
            &SOLVED,
            &body(Vector::new(0.001, 0.0, 7.0), 0.0)
        ));
        assert!(!is_tuned(
            &top,
            &SOLVED,
            &body(Vector::new(0.0, 0.0, 7.0), 1e-3)
        ));
    }

    #[test]
    fn a_yoyo_must_have_its_centre_at_the_spin_point() {
        let yoyo = goal(GoalKind::Yoyo);
        assert!(is_tuned(&yoyo, &SOLVED, &body(Vector::zeros(), 0.0)));
        assert!(!is_tuned(
            &yoyo,
            &SOLVED,
            &body(Vector::new(0.0, 0.0, 0.001), 0.0)
        ));
    }

    #[test]
    fn what_stands_is_free_unless_its_centre_has_a_place() {
        let aside = body(Vector::new(1.0, 0.0, 7.0), 0.3);
        let stand = goal(GoalKind::Stand);
        assert!(is_tuned(&stand, &SOLVED, &aside));
        assert!(!is_tuned(
            &Goal {
                objective: Objective::LowestCenter,
                ..stand
            },
            &SOLVED,
            &aside
        ));
    }

    #[test]
    fn a_rotor_is_compared_with_what_was_solved_and_a_couple_counts_at_its_radius() {
        let spindle = Some(Spindle {
            rotor: Rotor::default(),
            ends_mm: [-5.0, 5.0],
        });
        let rotor = Goal {
            spindle,
            ..goal(GoalKind::Balance)
        };
        let upright = body(Vector::new(0.0, 0.0, 7.0), 0.0);
        assert!(is_tuned(&rotor, &SOLVED, &upright));
        let aside = body(Vector::new(0.001, 0.0, 7.0), 0.0);
        assert!(!is_tuned(&rotor, &SOLVED, &aside) && is_tuned(&rotor, &aside, &aside));
        assert!(!is_tuned(
            &rotor,
            &SOLVED,
            &body(Vector::new(0.0, 0.0, 0.0), 1e-3)
        ));
    }

    #[test]
    fn a_fast_rotor_is_tuned_to_a_tenth_of_its_grade() {
        let fast = Rotor {
            speed_rpm: 60_000.0,
            ..Rotor::default()
        };
        let spindle = Some(Spindle {
            rotor: fast,
            ends_mm: [-5.0, 5.0],
        });
        let rotor = Goal {
            spindle,
            ..goal(GoalKind::Balance)
        };
        // G 2.5 at 60 000 rpm allows 0.4 µm.
        assert!(!is_tuned(
            &rotor,
            &SOLVED,
            &body(Vector::new(0.0001, 0.0, 0.0), 0.0)
        ));
        assert!(is_tuned(
            &rotor,
            &SOLVED,
            &body(Vector::new(0.00003, 0.0, 0.0), 0.0)
        ));
    }
}
