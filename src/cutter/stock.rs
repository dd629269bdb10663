//! Sheets as they are sold and measured.

use serde::Serialize;

use super::material::SheetMaterial;
use crate::base::sourced::Sourced;
use crate::base::units::MM3_PER_CM3;
use crate::base::words::choice;

choice! {
    /// The direction of a sheet's grain, which panels may have to follow.
    Grain, "grain" {
        /// Along the first side of the sheet.
        Along = "along",
        /// Along the second side of the sheet.
        Across = "across",
        /// No direction.
        None = "none",
    }
}

/// A size in which a sheet is sold.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StockSize {
    /// Both sides, mm.
    pub size_mm: Sourced<[f64; 2]>,
    /// The price of one, in the shop's currency; `None` if it is not known.
    pub price: Option<f64>,
}

/// A sheet.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StockSheet {
    /// The id, which is also the name of its file.
    pub id: String,
    /// The name for people.
    pub name: String,
    /// The parent that its profile names.
    pub inherits: Option<String>,
    /// SHA-256 of its profile and all parents.
    pub profile_sha256: String,
    /// The material.
    pub material: SheetMaterial,
    /// The thickness that joints are cut for, mm: measured, or else nominal.
    pub thickness_mm: Sourced<f64>,
    /// Least and greatest thickness of such sheets on sale, mm; `None` if they are not known.
    pub thickness_range_mm: Option<Sourced<[f64; 2]>>,
    /// The density, g/cm³.
    pub density_g_cm3: Sourced<f64>,
    /// The direction of the grain.
    pub grain: Grain,
    /// The sizes in which it is sold, as listed.
    pub sizes: Vec<StockSize>,
}

impl StockSheet {
    /// Returns the mass of a square millimetre, g.
    pub fn mass_per_area_g_mm2(&self) -> f64 {
        self.density_g_cm3.value / MM3_PER_CM3 * self.thickness_mm.value
    }

    /// Returns the sheet with a measured thickness; the source says who measured it and when.
    #[must_use]
    pub fn measured(mut self, thickness_mm: f64, source: &str) -> Self {
        self.thickness_mm = Sourced {
            value: thickness_mm,
            source: source.to_owned(),
            sure: crate::base::sourced::Sure::Measured,
            process_default_of: None,
        };
        self
    }
}
