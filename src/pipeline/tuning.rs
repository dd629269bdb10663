//! Whether a body is near enough to its goal's constraints, or has to be solved for again.

use crate::goal::{Goal, GoalKind, Objective};
use crate::mass::{Body, Moments};

/// How near to its place the centre of mass must be, mm: a tenth of what a kit promises.
const CENTER_TOLERANCE_MM: f64 = 0.0005;
/// How near to its direction the principal axis must be, rad: a tenth of the promised 0.05°.
const TILT_TOLERANCE_RAD: f64 = 8.7e-5;
/// The share by which the mass of what floats may be off: a hundredth of what a kit promises.
const MASS_TOLERANCE_RATIO: f64 = 1e-5;
/// The share of a rotor's permissible unbalance that may be left in the written parts.
const GRADE_SHARE_RATIO: f64 = 0.1;

/// Whether a body of these moments (goal frame) is as near to the goal's constraints, or to what was `solved` where they
/// cannot be met, as a written kit needs to be.
pub fn is_tuned(goal: &Goal, solved: &Moments, moments: &Moments) -> bool {
    let body = Body::new(moments, 1.0);
    let off_axis_mm = body.center.xy().coords.norm();
    match goal.kind {
        GoalKind::Top => off_axis_mm <= CENTER_TOLERANCE_MM && is_upright(&body),
        GoalKind::Yoyo => body.center.coords.norm() <= CENTER_TOLERANCE_MM && is_upright(&body),
        GoalKind::Float => is_trimmed(goal, moments),
        GoalKind::Balance => is_balanced(goal, &(*moments - *solved), moments),
        GoalKind::Stand => goal.objective != Objective::LowestCenter || off_axis_mm <= CENTER_TOLERANCE_MM,
    }
}

/// Whether a body weighs what the water carries, with its centre over that of buoyancy.
fn is_trimmed(goal: &Goal, moments: &Moments) -> bool {
    let afloat = goal.afloat.unwrap_or_default();
    let aside_mm = (moments.centroid() - afloat.buoyancy).xy().norm();
    let excess = (moments.volume() - afloat.material_mm3).abs();
    aside_mm <= CENTER_TOLERANCE_MM && excess <= MASS_TOLERANCE_RATIO * afloat.material_mm3
}

/// Whether the static and couple unbalance in excess of what was solved for are a tenth of what the rotor's grade allows, and no more than any centre may be off.
/// A couple counts as the offset of the mass at a lever of its radius of gyration.
fn is_balanced(goal: &Goal, excess: &Moments, moments: &Moments) -> bool {
    let allowed_mm = goal.spindle.map_or(f64::INFINITY, |spindle| spindle.rotor.permissible_mm());
    let [_, x, y, _, _, yz, xz, ..] = excess.0;
    let volume = moments.volume();
    let radius_mm = (moments.second().trace() / volume).sqrt();
    let worst_mm = (x.hypot(y) / volume).max(xz.hypot(yz) / (volume * radius_mm));
    worst_mm <= (GRADE_SHARE_RATIO * allowed_mm).min(CENTER_TOLERANCE_MM)
}

/// Whether the axis of the greatest moment is the z axis.
fn is_upright(body: &Body) -> bool {
    let axis = body.principal().axes.column(2).into_owned();
    axis.xy().norm() <= TILT_TOLERANCE_RAD
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Frame, Matrix, Vector};
    use crate::goal::{Rotor, Spindle};

    /// What was solved for; only a rotor is compared with it.
    const SOLVED: Moments = Moments([0.0; 10]);

    fn goal(kind: GoalKind) -> Goal {
        Goal {
            kind,
            frame: Frame::identity(),
            objective: Objective::default_of(kind),
            support: Vec::new(),
            spindle: None,
            afloat: None,
            solid: Moments::default(),
        }
    }

    /// A flat disc-like body at `center`, turned by `tilt` about x.
    fn body(center: Vector, tilt: f64) -> Moments {
        let turn = Matrix::new(1.0, 0.0, 0.0, 0.0, tilt.cos(), -tilt.sin(), 0.0, tilt.sin(), tilt.cos());
        let second = Matrix::from_diagonal(&Vector::new(900.0, 800.0, 100.0));
        Moments::from_parts(10.0, &Vector::zeros(), &second).rotated(&turn).translated(&center)
    }

    #[test]
    fn a_top_may_have_its_centre_anywhere_on_its_axis() {
        let top = goal(GoalKind::Top);
        assert!(is_tuned(&top, &SOLVED, &body(Vector::new(0.0, 0.0, 7.0), 0.0)));
        assert!(!is_tuned(&top, &SOLVED, &body(Vector::new(0.001, 0.0, 7.0), 0.0)));
        assert!(!is_tuned(&top, &SOLVED, &body(Vector::new(0.0, 0.0, 7.0), 1e-3)));
    }

    #[test]
    fn a_yoyo_must_have_its_centre_at_the_spin_point() {
        let yoyo = goal(GoalKind::Yoyo);
        assert!(is_tuned(&yoyo, &SOLVED, &body(Vector::zeros(), 0.0)));
        assert!(!is_tuned(&yoyo, &SOLVED, &body(Vector::new(0.0, 0.0, 0.001), 0.0)));
    }

    #[test]
    fn what_stands_is_free_unless_its_centre_has_a_place() {
        let aside = body(Vector::new(1.0, 0.0, 7.0), 0.3);
        let stand = goal(GoalKind::Stand);
        assert!(is_tuned(&stand, &SOLVED, &aside));
        assert!(!is_tuned(&Goal { objective: Objective::LowestCenter, ..stand }, &SOLVED, &aside));
    }

    #[test]
    fn a_rotor_is_compared_with_what_was_solved_and_a_couple_counts_at_its_radius() {
        let spindle = Some(Spindle { rotor: Rotor::default(), ends_mm: [-5.0, 5.0] });
        let rotor = Goal { spindle, ..goal(GoalKind::Balance) };
        let upright = body(Vector::new(0.0, 0.0, 7.0), 0.0);
        assert!(is_tuned(&rotor, &SOLVED, &upright));
        let aside = body(Vector::new(0.001, 0.0, 7.0), 0.0);
        assert!(!is_tuned(&rotor, &SOLVED, &aside) && is_tuned(&rotor, &aside, &aside));
        assert!(!is_tuned(&rotor, &SOLVED, &body(Vector::new(0.0, 0.0, 0.0), 1e-3)));
    }

    #[test]
    fn a_fast_rotor_is_tuned_to_a_tenth_of_its_grade() {
        let fast = Rotor { speed_rpm: 60_000.0, ..Rotor::default() };
        let spindle = Some(Spindle { rotor: fast, ends_mm: [-5.0, 5.0] });
        let rotor = Goal { spindle, ..goal(GoalKind::Balance) };
        // G 2.5 at 60 000 rpm allows 0.4 µm.
        assert!(!is_tuned(&rotor, &SOLVED, &body(Vector::new(0.0001, 0.0, 0.0), 0.0)));
        assert!(is_tuned(&rotor, &SOLVED, &body(Vector::new(0.00003, 0.0, 0.0), 0.0)));
    }
}
