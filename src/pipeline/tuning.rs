//! Whether a body is near enough to its goal's constraints, or has to be solved for again.

use crate::goal::{Goal, GoalKind, Objective};
use crate::mass::{Body, Moments};

/// How near to its place the centre of mass must be, mm: a tenth of what a kit promises.
const CENTER_TOLERANCE_MM: f64 = 0.0005;
/// How near to its direction the principal axis must be, rad: a tenth of the promised 0.05°.
const TILT_TOLERANCE_RAD: f64 = 8.7e-5;

/// Whether a body of these moments (goal frame) is as near to the goal's constraints as a written kit needs to be.
pub fn is_tuned(goal: &Goal, moments: &Moments) -> bool {
    let body = Body::new(moments, 1.0);
    let off_axis_mm = body.center.xy().coords.norm();
    match goal.kind {
        GoalKind::Top => off_axis_mm <= CENTER_TOLERANCE_MM && is_upright(&body),
        GoalKind::Yoyo => body.center.coords.norm() <= CENTER_TOLERANCE_MM && is_upright(&body),
        GoalKind::Stand => goal.objective != Objective::LowestCenter || off_axis_mm <= CENTER_TOLERANCE_MM,
    }
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

    fn goal(kind: GoalKind) -> Goal {
        Goal {
            kind,
            frame: Frame::identity(),
            objective: Objective::default_of(kind),
            support: Vec::new(),
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
        assert!(is_tuned(&top, &body(Vector::new(0.0, 0.0, 7.0), 0.0)));
        assert!(!is_tuned(&top, &body(Vector::new(0.001, 0.0, 7.0), 0.0)));
        assert!(!is_tuned(&top, &body(Vector::new(0.0, 0.0, 7.0), 1e-3)));
    }

    #[test]
    fn a_yoyo_must_have_its_centre_at_the_spin_point() {
        let yoyo = goal(GoalKind::Yoyo);
        assert!(is_tuned(&yoyo, &body(Vector::zeros(), 0.0)));
        assert!(!is_tuned(&yoyo, &body(Vector::new(0.0, 0.0, 0.001), 0.0)));
    }

    #[test]
    fn what_stands_is_free_unless_its_centre_has_a_place() {
        let aside = body(Vector::new(1.0, 0.0, 7.0), 0.3);
        let stand = goal(GoalKind::Stand);
        assert!(is_tuned(&stand, &aside));
        assert!(!is_tuned(&Goal { objective: Objective::LowestCenter, ..stand }, &aside));
    }
}
