//! The figures of a body for its goal, computed from its ten moments alone.

use serde::{Deserialize, Serialize};

use super::hardware::mass_moments;
use super::rotor::ends_mm;
use super::{Afloat, Aim, FigureName, Hull, Promise, Support, Unbalance, WaterOrder};
use crate::base::units::STANDARD_GRAVITY_MM_S2;
use crate::geom::{Frame, Matrix};
use crate::goal::GoalKind;
use crate::mass::{Body, Moments};
use crate::mesh::TriMesh;

/// Revolutions per minute in one radian per second.
const RPM_PER_RAD_S: f64 = 60.0 / std::f64::consts::TAU;
/// Cubic millimetres in one cubic centimetre.
const MM3_PER_CM3: f64 = 1000.0;

/// The setting of the figures: the material, the goal, and what the goal needs of the surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// The density, g/cm³.
    pub density_g_cm3: f64,
    /// The goal as placed on the model.
    pub aim: Aim,
    /// The support polygon of the outer surface, in the goal frame; only for an object that stands.
    pub support: Option<Support>,
    /// The extent of the outer surface along the axis, goal frame, mm; only for a rotor, which has
    /// its planes there.
    pub ends_mm: Option<[f64; 2]>,
    /// The outer surface in the goal frame; only for an object that floats.
    pub hull: Option<Hull>,
    /// The moments of the hardware times its densities, model frame, g, g·mm and g·mm².
    pub hardware: Moments,
}

/// The mass properties of a body and its figures for the goal.
///
/// A figure is `None` if the goal does not ask for it or if it does not exist. An example is the
/// critical speed of a top that cannot spin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// The mass with the hardware, g.
    pub mass_g: f64,
    /// The printed volume, mm³.
    pub volume_mm3: f64,
    /// The centre of mass, model frame, mm.
    pub center_mm: [f64; 3],
    /// The inertia tensor about the centre of mass, model axes, g·mm².
    pub inertia_g_mm2: [[f64; 3]; 3],
    /// I_a ≤ I_b ≤ I_c about the centre of mass, g·mm².
    pub principal_moments_g_mm2: [f64; 3],
    /// The height of the centre of mass over the contact or the ground along the axis, mm.
    pub center_height_mm: f64,
    /// The distance of the centre of mass from the spin axis (yo-yo: from the spin point), mm.
    pub axis_offset_mm: Option<f64>,
    /// The angle between the spin axis and the principal axis nearest to it, degrees.
    pub axis_tilt_deg: Option<f64>,
    /// The larger transverse moment over the axial one about the centre, I_b/I_c. Below 1 the axis
    /// is dominant.
    pub dominance_ratio: Option<f64>,
    /// Spin-It's squared ratio (I_xx² + 2 I_xy² + I_yy²)/I_zz² about the centre (eq. 6).
    pub spin_it_ratio: Option<f64>,
    /// The least speed at which a top stays up, rpm (Spin-It eq. 1).
    pub critical_speed_rpm: Option<f64>,
    /// The tilt at which a standing object topples, degrees; negative if it does not stand.
    pub topples_deg: Option<f64>,
    /// The residual unbalance of a rotor.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unbalance: Option<Unbalance>,
    /// The floating position and stability; `None` if it sinks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub afloat: Option<Afloat>,
}

impl Setting {
    /// Returns the setting of a kit: its goal, and the properties of the outer surface (model
    /// frame) that the goal needs.
    pub fn new(promise: &Promise, outer: &TriMesh) -> Self {
        let (aim, frame) = (promise.goal, promise.goal.frame());
        Self {
            density_g_cm3: promise.material.density_g_cm3,
            aim,
            support: (aim.kind == GoalKind::Stand).then(|| Support::of_mesh(outer, &frame)),
            ends_mm: (aim.kind == GoalKind::Balance).then(|| ends_mm(outer, &frame)),
            hull: (aim.kind == GoalKind::Float).then(|| Hull::new(outer, &frame)),
            hardware: mass_moments(&promise.hardware),
        }
    }

    /// Returns the density, g/mm³.
    pub fn density_g_mm3(&self) -> f64 {
        self.density_g_cm3 / MM3_PER_CM3
    }
}

impl Figures {
    /// Returns the figures of a printed region with a load inside. Both are moments of the print's
    /// density (model frame). The volume is that of the print alone.
    pub fn with_load(printed: &Moments, load: &Moments, setting: &Setting) -> Self {
        Self {
            volume_mm3: printed.volume(),
            ..Self::new(&(*printed + *load), setting)
        }
    }

    /// Returns the figures of the region with these moments (model frame) and the setting's
    /// hardware in it. As exact as the moments: nothing is sampled.
    pub fn new(printed: &Moments, setting: &Setting) -> Self {
        let density_g_mm3 = setting.density_g_mm3();
        let moments = &(*printed + setting.hardware * density_g_mm3.recip());
        let body = Body::new(moments, density_g_mm3);
        let frame = setting.aim.frame();
        let plain = Self::without_goal(printed.volume(), &body);
        match setting.aim.kind {
            GoalKind::Top => plain.for_top(&body, &frame),
            GoalKind::Yoyo => plain.for_yoyo(&body, &frame),
            GoalKind::Stand => plain.for_stand(&body, &frame, setting.support.as_ref()),
            GoalKind::Float => plain.for_float(&body, setting),
            GoalKind::Balance => plain.for_rotor(moments, setting),
            GoalKind::Match => plain,
        }
    }

    /// Returns the value of one figure, if this body has it.
    pub fn value_of(&self, name: FigureName) -> Option<f64> {
        match name {
            FigureName::CriticalSpeedRpm => self.critical_speed_rpm,
            FigureName::DominanceRatio => self.dominance_ratio,
            FigureName::SpinItRatio => self.spin_it_ratio,
            FigureName::TopplesDeg => self.topples_deg,
            FigureName::CenterHeightMm => Some(self.center_height_mm),
            FigureName::MetacentricHeightMm => {
                self.afloat.map(|afloat| afloat.metacentric_height_mm)
            }
            FigureName::MassG => Some(self.mass_g),
            FigureName::BalanceGradeMmS => self.unbalance.map(|unbalance| unbalance.grade_mm_s),
            // What was wished does not show in what was made.
            FigureName::InfillChangeRatio => None,
        }
    }

    fn without_goal(volume_mm3: f64, body: &Body) -> Self {
        let inertia = &body.inertia_g_mm2;
        Self {
            mass_g: body.mass_g,
            volume_mm3,
            center_mm: body.center.coords.into(),
            inertia_g_mm2: [0, 1, 2].map(|row| [0, 1, 2].map(|column| inertia[(row, column)])),
            principal_moments_g_mm2: body.principal().moments_g_mm2,
            center_height_mm: 0.0,
            axis_offset_mm: None,
            axis_tilt_deg: None,
            dominance_ratio: None,
            spin_it_ratio: None,
            critical_speed_rpm: None,
            topples_deg: None,
            unbalance: None,
            afloat: None,
        }
    }

    fn for_top(self, body: &Body, frame: &Frame) -> Self {
        let local = body.in_frame(frame);
        Self {
            axis_offset_mm: Some(local.center.x.hypot(local.center.y)),
            critical_speed_rpm: critical_speed_rpm(&local),
            ..self.for_spinning(body, frame)
        }
    }

    fn for_yoyo(self, body: &Body, frame: &Frame) -> Self {
        Self {
            axis_offset_mm: Some((body.center - frame.origin).norm()),
            ..self.for_spinning(body, frame)
        }
    }

    fn for_stand(self, body: &Body, frame: &Frame, support: Option<&Support>) -> Self {
        let center = frame.to_local(&body.center);
        let ground_mm = support.map_or(0.0, |support| support.ground_mm);
        Self {
            center_height_mm: center.z - ground_mm,
            topples_deg: support.map(|support| support.toppling_angle(&center).to_degrees()),
            ..self
        }
    }

    fn for_float(self, body: &Body, setting: &Setting) -> Self {
        let center = setting.aim.frame().to_local(&body.center);
        let float = |(hull, order): (&Hull, WaterOrder)| {
            hull.float(body.mass_g / (order.liquid_g_cm3 / MM3_PER_CM3), &center)
        };
        let afloat = setting.hull.as_ref().zip(setting.aim.water).and_then(float);
        Self {
            center_height_mm: center.z,
            afloat,
            ..self
        }
    }

    fn for_rotor(self, moments: &Moments, setting: &Setting) -> Self {
        let (local, density) = (
            moments.in_frame(&setting.aim.frame()),
            setting.density_g_mm3(),
        );
        let center = local.centroid();
        let unbalance = setting.aim.rotor.zip(setting.ends_mm);
        Self {
            center_height_mm: center.z,
            axis_offset_mm: Some(center.x.hypot(center.y)),
            unbalance: unbalance
                .map(|(order, ends_mm)| Unbalance::new(&local, density, ends_mm, &order)),
            ..self
        }
    }

    /// Adds the figures that tops and yo-yos have in common.
    fn for_spinning(self, body: &Body, frame: &Frame) -> Self {
        let local = body.in_frame(frame);
        let (inertia, axial) = (&local.inertia_g_mm2, local.inertia_g_mm2[(2, 2)]);
        let transverse = inertia.fixed_view::<2, 2>(0, 0).norm_squared();
        Self {
            center_height_mm: local.center.z,
            axis_tilt_deg: Some(axis_tilt(body, frame).to_degrees()),
            dominance_ratio: Some(largest_transverse(inertia) / axial),
            spin_it_ratio: Some(transverse / (axial * axial)),
            ..self
        }
    }
}

/// Returns the angle between the frame's axis and the principal axis nearest to it, radians.
fn axis_tilt(body: &Body, frame: &Frame) -> f64 {
    let axis = frame.axis();
    let axes = body.principal().axes;
    let angle = |i: usize| {
        axes.column(i)
            .cross(&axis)
            .norm()
            .atan2(axes.column(i).dot(&axis).abs())
    };
    [0, 1, 2]
        .map(angle)
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// Returns the larger eigenvalue of the upper 2×2 block of a tensor whose z is the spin axis.
fn largest_transverse(inertia: &Matrix) -> f64 {
    let (xx, xy, yy) = (inertia[(0, 0)], inertia[(0, 1)], inertia[(1, 1)]);
    0.5 * (xx + yy) + (0.5 * (xx - yy)).hypot(xy)
}

/// Returns ω = √(g M ℓ / (I_c − I_b)) in rpm, for a body in the goal frame (Spin-It eq. 1).
///
/// The moments are about the centre. Zero if the centre hangs below the contact. `None` if the axis
/// is not dominant, since no speed is enough then.
fn critical_speed_rpm(local: &Body) -> Option<f64> {
    let margin = local.inertia_g_mm2[(2, 2)] - largest_transverse(&local.inertia_g_mm2);
    let height_mm = local.center.z.max(0.0);
    let squared = STANDARD_GRAVITY_MM_S2 * local.mass_g * height_mm / margin;
    (margin > 0.0).then(|| squared.sqrt() * RPM_PER_RAD_S)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, Vector};

    /// Returns the moments of a box with one corner at `corner`, in closed form.
    fn box_moments(corner: [f64; 3], size: [f64; 3]) -> Moments {
        let [a, b, c] = size;
        let volume = a * b * c;
        let second = Matrix::from_diagonal(&(Vector::new(a * a, b * b, c * c) * (volume / 12.0)));
        let middle = Vector::from(corner) + Vector::from(size) * 0.5;
        Moments::from_parts(volume, &Vector::zeros(), &second).translated(&middle)
    }

    fn setting(kind: GoalKind, axis: [f64; 3]) -> Setting {
        Setting {
            density_g_cm3: 2.0,
            aim: Aim::new(kind, [0.0; 3], axis),
            support: None,
            ends_mm: None,
            hull: None,
            hardware: Moments::default(),
        }
    }

    fn plate() -> Moments {
        box_moments([-30.0, -20.0, 10.0], [60.0, 40.0, 4.0])
    }

    #[test]
    fn a_plate_has_the_mass_and_moments_of_the_textbook() {
        let figures = Figures::new(&plate(), &setting(GoalKind::Top, [0.0, 0.0, 1.0]));
        let mass = 60.0 * 40.0 * 4.0 * 2.0e-3;
        assert!((figures.mass_g - mass).abs() < 1e-12 * mass);
        let axial = mass / 12.0 * (60.0 * 60.0 + 40.0 * 40.0);
        assert!((figures.principal_moments_g_mm2[2] - axial).abs() < 1e-12 * axial);
        assert!((figures.center_height_mm - 12.0).abs() < 1e-13);
    }

    #[test]
    fn a_top_stays_up_from_the_speed_of_spin_it_equation_1() {
        let figures = Figures::new(&plate(), &setting(GoalKind::Top, [0.0, 0.0, 1.0]));
        let (ic, ib) = (60.0_f64.powi(2) + 40.0 * 40.0, 60.0 * 60.0 + 4.0 * 4.0);
        let omega = (9806.65 * 12.0 * 12.0 / (ic - ib)).sqrt();
        let rpm = omega * 60.0 / (2.0 * std::f64::consts::PI);
        assert!((figures.critical_speed_rpm.unwrap() - rpm).abs() < 1e-11 * rpm);
        assert!((figures.dominance_ratio.unwrap() - ib / ic).abs() < 1e-14);
    }

    #[test]
    fn the_speed_does_not_depend_on_the_density() {
        let light = Setting {
            density_g_cm3: 0.7,
            ..setting(GoalKind::Top, [0.0, 0.0, 1.0])
        };
        let speed = |setting| Figures::new(&plate(), setting).critical_speed_rpm.unwrap();
        let (a, b) = (
            speed(&light),
            speed(&setting(GoalKind::Top, [0.0, 0.0, 1.0])),
        );
        assert!((a - b).abs() < 1e-12 * a);
    }

    #[test]
    fn no_speed_is_enough_about_an_axis_that_is_not_dominant() {
        let figures = Figures::new(&plate(), &setting(GoalKind::Top, [1.0, 0.0, 0.0]));
        assert_eq!(figures.critical_speed_rpm, None);
        assert!(figures.dominance_ratio.unwrap() > 1.0);
    }

    #[test]
    fn an_axis_leaning_by_a_known_angle_is_reported_with_that_angle() {
        let lean = 0.01_f64;
        let figures = Figures::new(
            &plate(),
            &setting(GoalKind::Top, [lean.sin(), 0.0, lean.cos()]),
        );
        assert!((figures.axis_tilt_deg.unwrap() - lean.to_degrees()).abs() < 1e-9);
    }

    #[test]
    fn a_top_may_be_high_above_its_contact_but_a_yo_yo_must_be_at_its_point() {
        let offset = |kind| {
            Figures::new(&plate(), &setting(kind, [0.0, 0.0, 1.0]))
                .axis_offset_mm
                .unwrap()
        };
        assert!(offset(GoalKind::Top) < 1e-12);
        assert!((offset(GoalKind::Yoyo) - 12.0).abs() < 1e-12);
    }

    #[test]
    fn a_box_standing_on_its_face_topples_at_the_angle_of_its_diagonal() {
        let corners_mm = vec![[-30.0, -20.0], [30.0, -20.0], [30.0, 20.0], [-30.0, 20.0]];
        let support = Some(Support {
            corners_mm,
            ground_mm: 10.0,
        });
        // The polygon above holds only if the goal frame is not turned about z.
        let aim = Aim::new(GoalKind::Stand, [0.0; 3], [0.0, 0.0, 1.0]);
        assert_eq!(
            aim.frame().to_local(&Point::new(1.0, 0.0, 0.0)),
            Point::new(1.0, 0.0, 0.0)
        );
        let figures = Figures::new(
            &plate(),
            &Setting {
                density_g_cm3: 1.0,
                aim,
                support,
                ends_mm: None,
                hull: None,
                hardware: Moments::default(),
            },
        );
        assert!(
            (figures.topples_deg.unwrap() - (20.0_f64 / 2.0).atan().to_degrees()).abs() < 1e-12
        );
        assert!((figures.center_height_mm - 2.0).abs() < 1e-12);
        assert_eq!(figures.axis_offset_mm, None);
    }

    #[test]
    fn the_spin_it_ratio_does_not_depend_on_a_turn_of_the_frame_about_its_axis() {
        let value = |axis: [f64; 3]| {
            Figures::new(&plate(), &setting(GoalKind::Yoyo, axis))
                .spin_it_ratio
                .unwrap()
        };
        let (xx, yy, zz) = (
            40.0 * 40.0 + 16.0,
            60.0 * 60.0 + 16.0,
            60.0 * 60.0 + 40.0 * 40.0,
        );
        let want = (xx * xx + yy * yy) / (zz * zz);
        assert!((value([0.0, 0.0, 1.0]) - want).abs() < 1e-12);
        assert!((value([0.0, 0.0, -3.0]) - want).abs() < 1e-12);
    }
}
