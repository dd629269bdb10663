//! The arguments of single goals: a rotor's speed and grade, a liquid, the hardware of yo-yos and
//! tops.

use clap::Args;

use super::values::{angle, grade, mass, numbers, speed};
use crate::base::units::Length;
use crate::goal::{Hardware, Liquid, Rod, Rotor, Target, TipChoice, Water, Waterline};
use crate::job::Like;

/// The arguments of the goal balance.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct RotorArgs {
    /// The speed of the rotor, such as 3000rpm or 50Hz [default: 3000rpm]
    #[arg(long, value_name = "RPM", value_parser = speed, allow_hyphen_values = true)]
    pub speed: Option<f64>,
    /// The balance quality grade G to reach at that speed (ISO 21940-11), in mm/s [default:
    /// 2.5]
    #[arg(long, value_name = "MM/S", value_parser = grade, allow_hyphen_values = true)]
    pub grade: Option<f64>,
    /// The diameter of a bore that is made along the axis after printing [default: none]
    ///
    /// A hub stays solid around it. Without this option a bore or shaft of the model is found.
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub bore: Option<Length>,
}

impl RotorArgs {
    /// Returns the rotor with what was given in place of `default`; `None` if there is neither.
    pub(super) fn or_default(&self, default: Option<Rotor>) -> Option<Rotor> {
        let is_given = self.speed.is_some() || self.grade.is_some() || self.bore.is_some();
        let known = default.or(is_given.then(Rotor::default))?;
        Some(Rotor {
            speed_rpm: self.speed.unwrap_or(known.speed_rpm),
            grade_mm_s: self.grade.unwrap_or(known.grade_mm_s),
            bore: self.bore.or(known.bore),
        })
    }
}

/// The arguments of the goal float.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct WaterArgs {
    /// The liquid it floats in: water, seawater or a density in g/cm³ [default: water]
    #[arg(long, value_name = "LIQUID", allow_hyphen_values = true)]
    pub liquid: Option<Liquid>,
    /// The waterline: a LENGTH above the lowest point, or auto for the most stable one [default:
    /// auto]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub waterline: Option<Waterline>,
}

impl WaterArgs {
    /// Returns the water with what was given in place of `default`; `None` if there is neither.
    pub(super) fn or_default(&self, default: Option<Water>) -> Option<Water> {
        let is_given = self.liquid.is_some() || self.waterline.is_some();
        let known = default.or(is_given.then(Water::default))?;
        Some(Water {
            liquid: self.liquid.unwrap_or(known.liquid),
            waterline: self.waterline.unwrap_or(known.waterline),
        })
    }
}

/// The arguments of the goal match.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct MatchArgs {
    /// The mass that a match must have, in g; with its centre and inertia
    #[arg(
        long,
        value_name = "G",
        value_parser = mass,
        allow_hyphen_values = true,
        requires_all = ["center", "inertia"]
    )]
    pub mass: Option<f64>,
    /// The centre of mass that a match must have, in mm of the scaled model
    #[arg(
        long,
        value_name = "X,Y,Z",
        value_parser = numbers::<3>,
        allow_hyphen_values = true,
        requires_all = ["mass", "inertia"]
    )]
    pub center: Option<[f64; 3]>,
    /// The inertia tensor that a match must have about its centre of mass, in g·mm² and in the
    /// axes of the model: XX,YY,ZZ,XY,XZ,YZ. Entries off the diagonal have the signs of the tensor
    #[arg(
        long,
        value_name = "XX,YY,ZZ,XY,XZ,YZ",
        value_parser = numbers::<6>,
        allow_hyphen_values = true,
        requires_all = ["mass", "center"]
    )]
    pub inertia: Option<[f64; 6]>,
    /// Match the body in this file at this density in g/cm³, such as original.stl@2.70
    ///
    /// It has the axes of the model and is scaled as the model.
    #[arg(
        long,
        value_name = "FILE@DENSITY",
        conflicts_with_all = ["mass", "center", "inertia"]
    )]
    pub like: Option<Like>,
}

impl MatchArgs {
    /// Returns the mass properties that were typed; `None` if none were.
    pub(super) fn target(&self) -> Option<Target> {
        Some(Target {
            mass_g: self.mass?,
            center_mm: self.center?,
            inertia_g_mm2: self.inertia?,
        })
    }
}

/// The promises of a top and of a standing object.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct PromiseArgs {
    /// The least lean of a top, in degrees, at which more than its tip or its round foot may touch
    /// the floor [default: 10]
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true)]
    pub least_lean: Option<f64>,
    /// The least tilt, in degrees, at which a standing object may topple [default: 5]
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true)]
    pub least_angle: Option<f64>,
}

/// The arguments for parts that are not printed, for the goals yoyo and top.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Hardware")]
pub struct HardwareArgs {
    /// Cut a yo-yo into two halves at the spin point, across its axis, and set them this far apart
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub string_gap: Option<Length>,
    /// The axle that joins a yo-yo's halves: DIAMETER or DIAMETERxLENGTH [default: up to two
    /// diameters into each half]
    ///
    /// If it is not of steel, add :DENSITY (g/cm³), such as 6mmx30mm:2.7.
    #[arg(long, value_name = "ROD", allow_hyphen_values = true)]
    pub axle: Option<Rod>,
    /// The mass of nuts, washers or a bearing on the axle in the gap, in g
    #[arg(long, value_name = "G", value_parser = mass, allow_hyphen_values = true)]
    pub hardware_mass: Option<f64>,
    /// The steel pin a top spins on: auto, none or a size such as 4mmx26mm [default: auto]
    ///
    /// Auto takes a stock pin if the top does not spin on its own foot. A size is DIAMETERxLENGTH
    /// or DIAMETERxLENGTHxDEPTH. If it is not of steel, add :DENSITY (g/cm³), as 4mmx26mm:2.7.
    #[arg(long, value_name = "auto|none|ROD", allow_hyphen_values = true)]
    pub tip: Option<TipChoice>,
    /// A stem at the upper end of a top's axis to spin it by: a ROD, same form as the tip
    #[arg(long, value_name = "ROD", allow_hyphen_values = true)]
    pub stem: Option<Rod>,
}

impl HardwareArgs {
    /// Returns the hardware that was ordered besides a tip; `None` if none was.
    pub fn order(&self) -> Option<Hardware> {
        let Self {
            string_gap,
            axle,
            hardware_mass: mass_g,
            stem,
            ..
        } = *self;
        let hardware = Hardware {
            string_gap,
            axle,
            mass_g,
            tip: None,
            stem,
        };
        (!hardware.is_empty()).then_some(hardware)
    }
}
