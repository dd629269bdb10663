//! What parts are made of: the density, and how far a print's mass may be from it.

use serde::Serialize;

use super::{Sourced, Sure};
use crate::base::units::MM3_PER_CM3;

/// A material.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Its id, as `--material` takes it.
    pub id: String,
    /// Its name for people.
    pub name: String,
    /// Density as printed and cured, g/cm³.
    pub density_g_cm3: Sourced<f64>,
    /// How far the mass of a sound print may be from volume × density, as a share of it; none where
    /// nothing is known.
    pub density_spread_ratio: Option<Sourced<f64>>,
    /// The lot that was measured.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lot: Option<String>,
    /// The day it was measured, year-month-day.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub measured_on: Option<String>,
}

impl Material {
    /// The density in the library's own units, g/mm³.
    pub fn density_g_mm3(&self) -> f64 {
        self.density_g_cm3.value / MM3_PER_CM3
    }

    /// Whether the density was measured on what the shop printed, so that absolute masses can be
    /// judged.
    pub fn is_measured(&self) -> bool {
        self.density_g_cm3.sure == Sure::Measured
    }

    /// The share by which the mass of a sound print may differ, where both it and the density were
    /// measured.
    pub fn measured_spread_ratio(&self) -> Option<f64> {
        let spread = self.density_spread_ratio.as_ref()?;
        (self.is_measured() && spread.sure == Sure::Measured).then_some(spread.value)
    }

    /// The lightest and heaviest a sound print of `mass_g` may weigh, g; none where the density was
    /// not measured.
    pub fn weighing_window_g(&self, mass_g: f64) -> Option<[f64; 2]> {
        self.measured_spread_ratio()
            .map(|spread| [mass_g * (1.0 - spread), mass_g * (1.0 + spread)])
    }
}

/// A material the printer does not offer.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{printer} does not print `{id}`; remedy: {remedy}")]
pub struct MaterialError {
    /// The printer's id.
    pub printer: String,
    /// The material asked for.
    pub id: String,
    /// The nearest of the printer's materials, or all of them.
    pub remedy: String,
}
