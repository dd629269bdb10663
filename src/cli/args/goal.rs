//! What single goals take besides: how a rotor runs, how a thing floats, what is put into a yo-yo
//! or a top.

use clap::Args;

use super::values::factor;
use crate::base::units::Length;
use crate::goal::{Hardware, Liquid, Rod, Rotor, Water, Waterline};

/// How a rotor runs, for the goal balance.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct RotorArgs {
    /// The speed of a rotor to balance, in turns a minute [default: 3000]
    #[arg(long, value_name = "RPM", value_parser = factor, allow_hyphen_values = true)]
    pub speed: Option<f64>,
    /// The balance quality grade G it must reach at that speed (ISO 21940-11), in mm/s [default:
    /// 2.5]
    #[arg(long, value_name = "MM/S", value_parser = factor, allow_hyphen_values = true)]
    pub grade: Option<f64>,
    /// Keep a hub solid about a bore of this diameter on its axis [default: none; a bore of the
    /// model has its wall]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub bore: Option<Length>,
}

impl RotorArgs {
    /// What was said of the rotor, over `default`; none where nothing was said and there is no
    /// default.
    pub(super) fn over(&self, default: Option<Rotor>) -> Option<Rotor> {
        let is_said = self.speed.is_some() || self.grade.is_some() || self.bore.is_some();
        let known = default.or(is_said.then(Rotor::default))?;
        Some(Rotor {
            speed_rpm: self.speed.unwrap_or(known.speed_rpm),
            grade_mm_s: self.grade.unwrap_or(known.grade_mm_s),
            bore: self.bore.or(known.bore),
        })
    }
}

/// How an object floats, for the goal float.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct WaterArgs {
    /// What it floats in: water, seawater or a density in g/cm³ [default: water]
    #[arg(long, value_name = "LIQUID", allow_hyphen_values = true)]
    pub liquid: Option<Liquid>,
    /// How deep it lies: a LENGTH above its lowest point, or auto, where it is most stable
    /// [default: auto]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub waterline: Option<Waterline>,
}

impl WaterArgs {
    /// What was said of the water, over `default`; none where nothing was said and there is no
    /// default.
    pub(super) fn over(&self, default: Option<Water>) -> Option<Water> {
        let is_said = self.liquid.is_some() || self.waterline.is_some();
        let known = default.or(is_said.then(Water::default))?;
        Some(Water {
            liquid: self.liquid.unwrap_or(known.liquid),
            waterline: self.waterline.unwrap_or(known.waterline),
        })
    }
}

/// What is put into the object that is not printed, for the goals yoyo and top.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Hardware")]
pub struct HardwareArgs {
    /// Cut a yo-yo in two halves across its axis at the spin point, this far apart on the axle
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub string_gap: Option<Length>,
    /// The axle that joins a yo-yo's halves: DIAMETER, DIAMETERxLENGTH, either with :G_PER_CM3
    /// behind it; its mass counts [default: up to two diameters into each half, of steel]
    #[arg(long, value_name = "ROD", allow_hyphen_values = true)]
    pub axle: Option<Rod>,
    /// The mass of nuts, washers or a bearing about the axle in the gap, in g
    #[arg(long, value_name = "G", value_parser = factor, allow_hyphen_values = true)]
    pub hardware_mass: Option<f64>,
    /// A round-ended pin in a socket at a top's contact, on which it spins: DIAMETERxLENGTH,
    /// DIAMETERxLENGTHxDEPTH, either with :G_PER_CM3 behind it [default: half of its length inside,
    /// of steel]
    #[arg(long, value_name = "ROD", allow_hyphen_values = true)]
    pub tip: Option<Rod>,
    /// A stem on top of a top's axis to spin it by, as the tip
    #[arg(long, value_name = "ROD", allow_hyphen_values = true)]
    pub stem: Option<Rod>,
}

impl HardwareArgs {
    /// What was asked for; none where nothing was.
    pub fn asked(&self) -> Option<Hardware> {
        let Self {
            string_gap,
            axle,
            hardware_mass: mass_g,
            tip,
            stem,
        } = *self;
        let hardware = Hardware {
            string_gap,
            axle,
            mass_g,
            tip,
            stem,
        };
        (!hardware.is_empty()).then_some(hardware)
    }
}
