//! Figures of merit of a body of given moments: speeds, angles and ratios that need no density.

use serde::{Deserialize, Serialize};

use super::kind::{GoalKind, Objective};
use super::placement::Goal;
use super::support;
use crate::base::units::STANDARD_GRAVITY_MM_S2;
use crate::geom::{Matrix, Point, Vector};
use crate::mass::{Body, Moments};

/// The figures of a body with respect to a goal; density cancels in every one of them.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// The distance of the centre of mass, mm. Top, balance: from the spin axis. Yo-yo: from the
    /// spin point. Stand, float: from the middle of the support or the centre of buoyancy, seen
    /// from above.
    pub off_axis_mm: f64,
    /// The height of the centre of mass above the origin, mm.
    pub center_height_mm: f64,
    /// The angle between z and the nearest principal axis, rad.
    pub axis_tilt_rad: f64,
    /// The largest moment across the axis over the moment about it (I_b/I_c), about the centre;
    /// below 1 it is dominant.
    pub dominance_ratio: f64,
    /// Top: the least speed at which it spins upright (Spin-It eq. 1). `None` if no speed is
    /// enough, and for other goals.
    pub critical_speed_rpm: Option<f64>,
    /// The value of Spin-It's functional with the goal's weights, 1 if it has none. `None` except
    /// for tops and yo-yos.
    pub spin_it: Option<f64>,
    /// Stand: the tilt at which it topples, rad, negative if it does not stand. `None` for the
    /// others.
    pub toppling_angle_rad: Option<f64>,
}

/// Returns the figures of the body with these moments in the goal frame.
pub fn compute_figures(goal: &Goal, moments: &Moments) -> Figures {
    let body = Body::new(moments, 1.0);
    let tensor = &body.inertia_g_mm2;
    let center = body.center;
    let is_top = goal.kind == GoalKind::Top;
    Figures {
        off_axis_mm: if goal.kind == GoalKind::Yoyo {
            center.coords.norm()
        } else {
            let place = goal
                .afloat
                .map_or_else(Point::origin, |afloat| afloat.buoyancy);
            (center.x - place.x).hypot(center.y - place.y)
        },
        center_height_mm: center.z,
        axis_tilt_rad: tilt_of_nearest_axis(&body),
        dominance_ratio: largest_across(tensor) / tensor[(2, 2)],
        critical_speed_rpm: if is_top {
            critical_speed_rpm(&body)
        } else {
            None
        },
        spin_it: spin_it(goal, moments),
        toppling_angle_rad: (goal.kind == GoalKind::Stand)
            .then(|| toppling_angle_rad(&goal.support, moments)),
    }
}

/// Returns the angle between z and the principal axis nearest to it, rad.
fn tilt_of_nearest_axis(body: &Body) -> f64 {
    let axes = body.principal().axes;
    let tilt = |axis: Vector| axis.x.hypot(axis.y).atan2(axis.z.abs());
    axes.column_iter()
        .map(|axis| tilt(axis.into()))
        .fold(f64::INFINITY, f64::min)
}

/// Returns the largest moment of inertia about an axis across z, from the upper left 2 × 2 of the
/// tensor.
fn largest_across(tensor: &Matrix) -> f64 {
    let mean = 0.5 * (tensor[(0, 0)] + tensor[(1, 1)]);
    mean + (0.5 * (tensor[(0, 0)] - tensor[(1, 1)])).hypot(tensor[(0, 1)])
}

/// Returns the critical speed, turns a minute: ω² = M g ℓ/(I_c − I_b) about the centre of mass
/// (Spin-It eq. 1).
fn critical_speed_rpm(body: &Body) -> Option<f64> {
    let tensor = &body.inertia_g_mm2;
    let margin = tensor[(2, 2)] - largest_across(tensor);
    let lever = body.mass_g * body.center.z;
    (margin > 0.0 && lever >= 0.0).then(|| to_rpm((STANDARD_GRAVITY_MM_S2 * lever / margin).sqrt()))
}

/// Converts an angular speed from rad/s to turns a minute.
pub(crate) fn to_rpm(omega_rad_s: f64) -> f64 {
    omega_rad_s * 60.0 / std::f64::consts::TAU
}

/// Evaluates Spin-It's functional: eq. 2 and 6 about the spin point (yo-yo), eq. 3 and 7 (top).
fn spin_it(goal: &Goal, moments: &Moments) -> Option<f64> {
    let (gamma_c, gamma_i) = match goal.objective {
        Objective::SpinIt { gamma_c, gamma_i } => (gamma_c, gamma_i),
        _ => (0.0, 1.0),
    };
    let [volume, _, _, z, xy, _, _, xx, yy, zz] = moments.0;
    let steiner = match goal.kind {
        GoalKind::Top => z * z / volume,
        GoalKind::Yoyo => 0.0,
        GoalKind::Stand | GoalKind::Float | GoalKind::Balance | GoalKind::Match => return None,
    };
    let gamma_c = if goal.kind == GoalKind::Top {
        gamma_c
    } else {
        0.0
    };
    let (i_xx, i_yy, i_zz) = (yy + zz - steiner, xx + zz - steiner, xx + yy);
    let flatness = (i_xx * i_xx + 2.0 * xy * xy + i_yy * i_yy) / (i_zz * i_zz);
    let lowering = if gamma_c > 0.0 {
        gamma_c * (z / goal.solid.0[3]).powi(2)
    } else {
        0.0
    };
    Some(lowering + gamma_i * flatness)
}

/// Returns the least tilt that brings the centre of mass over an edge of the support, rad.
fn toppling_angle_rad(polygon: &[[f64; 2]], moments: &Moments) -> f64 {
    let center = moments.centroid();
    let margin =
        |(normal, offset): &([f64; 2], f64)| normal[0] * center.x + normal[1] * center.y - offset;
    let least = support::edges(polygon)
        .iter()
        .map(margin)
        .fold(f64::INFINITY, f64::min);
    least.atan2(center.z)
}

#[cfg(test)]
mod tests {
    use super::super::{Contact, Request, Up, place, testing::*};
    use super::*;

    #[test]
    fn a_flat_disc_of_a_block_has_its_closed_form_critical_speed() {
        // 20 × 20 × 2: I_c = M (20² + 20²)/12, I_b = M (20² + 2²)/12, ℓ = 1: ω² = 12 g/(800 − 404).
        let solid = block([-10., -10., 0.], [10., 10., 2.]);
        let goal = place(&solid, 0.5, &Request::new(GoalKind::Top).unpromised())
            .unwrap()
            .goal;
        let got = compute_figures(&goal, &goal.solid);
        let expected = to_rpm((12.0 * STANDARD_GRAVITY_MM_S2 / 396.0).sqrt());
        assert!((got.critical_speed_rpm.unwrap() / expected - 1.0).abs() < 1e-12);
        assert!((got.dominance_ratio - 404.0 / 800.0).abs() < 1e-12);
        assert!(got.axis_tilt_rad < 1e-9 && got.off_axis_mm < 1e-12);
    }

    #[test]
    fn a_tower_has_no_critical_speed() {
        let goal = place(
            &block([0., 0., 0.], [2., 2., 9.]),
            0.5,
            &Request::new(GoalKind::Top).unpromised(),
        )
        .unwrap()
        .goal;
        assert_eq!(compute_figures(&goal, &goal.solid).critical_speed_rpm, None);
    }

    #[test]
    fn a_block_topples_when_its_center_is_over_its_edge() {
        let goal = place(
            &block([0., 0., 0.], [4., 6., 5.]),
            0.5,
            &Request::new(GoalKind::Stand),
        )
        .unwrap()
        .goal;
        let angle = compute_figures(&goal, &goal.solid)
            .toppling_angle_rad
            .unwrap();
        assert!((angle - (2.0f64 / 2.5).atan()).abs() < 1e-12);
    }

    #[test]
    fn a_tilted_slab_shows_its_tilt() {
        let solid = block([-5., -5., -1.], [5., 5., 1.]);
        let tilt = 0.02_f64;
        let request = Request {
            up: Up::Along([tilt.sin(), 0.0, tilt.cos()]),
            contact: Some(Contact::Center),
            ..Request::new(GoalKind::Top).unpromised()
        };
        let goal = place(&solid, 0.5, &request).unwrap().goal;
        assert!((compute_figures(&goal, &goal.solid).axis_tilt_rad - tilt).abs() < 1e-9);
    }

    #[test]
    fn the_functional_of_a_yo_yo_ignores_the_weight_of_the_lever() {
        // About its centre of mass a cube has s_z = 0, so that s_z over that of the solid would be
        // 0/0. Its three moments are equal and the functional is γ_I (1 + 1).
        let solid = block([-1., -1., -1.], [1., 1., 1.]);
        for gamma_c in [0.0, 1.0] {
            let objective = Objective::SpinIt {
                gamma_c,
                gamma_i: 3.0,
            };
            let request = Request {
                objective,
                ..Request::new(GoalKind::Yoyo)
            };
            let goal = place(&solid, 0.5, &request).unwrap().goal;
            assert_eq!(goal.solid.0[3], 0.0);
            assert!(
                (compute_figures(&goal, &goal.solid).spin_it.unwrap() - 6.0).abs() < 1e-12,
                "{gamma_c}"
            );
        }
    }

    #[test]
    fn without_a_lever_weight_a_tops_functional_is_its_tensors_alone() {
        // A cube on its face: about the centre all moments are equal, whatever the lever.
        let solid = block([-1., -1., 0.], [1., 1., 2.]);
        let spin_it = |gamma_c| {
            let objective = Objective::SpinIt {
                gamma_c,
                gamma_i: 1.0,
            };
            let goal = place(
                &solid,
                0.5,
                &Request {
                    objective,
                    ..Request::new(GoalKind::Top).unpromised()
                },
            )
            .unwrap()
            .goal;
            compute_figures(&goal, &goal.solid).spin_it.unwrap()
        };
        assert!((spin_it(0.0) - 2.0).abs() < 1e-12);
        assert!((spin_it(0.5) - 2.5).abs() < 1e-12);
    }
}
