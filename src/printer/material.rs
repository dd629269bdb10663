//! Materials: their density and its spread from print to print.

use serde::Serialize;

use super::{Sourced, Sure};
use crate::base::units::MM3_PER_CM3;

/// A material.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Its id, by which jobs name it.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// Density as printed and cured, g/cm³.
    pub density_g_cm3: Sourced<f64>,
    /// The greatest relative deviation of a sound print's mass from volume × density; `None` if
    /// unknown.
    pub density_spread_ratio: Option<Sourced<f64>>,
    /// Gap on each side for shells that slide; `None` if the printer's own holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub clearance_slide_per_side_mm: Option<Sourced<f64>>,
    /// The share of the drawn lines' volume that is extruded, so that a print weighs what it
    /// should: the extrusion multiplier of slicers. `None` if theirs holds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow_ratio: Option<Sourced<f64>>,
    /// The lot on which the density was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lot: Option<String>,
    /// The day of the measurement, year-month-day.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_on: Option<String>,
}

impl Material {
    /// Returns the density in the library's own unit, g/mm³.
    pub fn density_g_mm3(&self) -> f64 {
        self.density_g_cm3.value / MM3_PER_CM3
    }

    /// True if the shop measured the density on its own prints. Only then can absolute masses be
    /// judged.
    pub fn is_measured(&self) -> bool {
        self.density_g_cm3.sure == Sure::Measured
    }

    /// Returns the relative spread of a sound print's mass; `None` unless the spread and the
    /// density were both measured.
    pub fn measured_spread_ratio(&self) -> Option<f64> {
        let spread = self.density_spread_ratio.as_ref()?;
        (self.is_measured() && spread.sure == Sure::Measured).then_some(spread.value)
    }

    /// Returns the least and the greatest mass of a sound print of `mass_g`, g; `None` unless
    /// density and spread were measured.
    pub fn weighing_window_g(&self, mass_g: f64) -> Option<[f64; 2]> {
        self.measured_spread_ratio()
            .map(|spread| [mass_g * (1.0 - spread), mass_g * (1.0 + spread)])
    }
}

/// A material that the printer does not print.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{printer} does not print `{id}`; remedy: {remedy}")]
pub struct MaterialError {
    /// The printer's id.
    pub printer: String,
    /// The id asked for.
    pub id: String,
    /// The nearest of the printer's materials, or all of them.
    pub remedy: String,
}
