//! The list of the materials of a dithered model, as `materials.json` says it.

use serde::{Deserialize, Serialize};

use crate::base::units::MM3_PER_CM3;
use crate::mass::{Body, Moments};

/// The list of the materials, beside their images.
pub const DITHER_FILE: &str = "materials.json";
/// Promised mass, as a share of it.
const MASS_RATIO: f64 = 1e-4;
/// Promised place of the centre, mm.
const CENTER_MM: f64 = 1e-3;
/// Promised entries of the inertia tensor, as a share of its trace.
const INERTIA_RATIO: f64 = 2e-4;

/// A model in two materials.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DitherRow {
    /// The version of this file.
    pub schema: u32,
    /// The model's file.
    pub model: String,
    /// The printer's id.
    pub printer: String,
    /// The density over that of the heavier material, as it was typed.
    pub field: String,
    /// The place of the model's origin on the plate, mm.
    pub origin_mm: [f64; 3],
    /// The heavier and the lighter material.
    pub materials: [MaterialRow; 2],
    /// What the model with this field weighs, on the plate.
    pub wanted: BodyRow,
    /// What the images weigh, on the plate.
    pub reached: BodyRow,
    /// The differences of the two.
    pub off: Off,
    /// Pixels whose material was changed at last, so that the sums are right.
    pub changed: usize,
}

/// A material and its images.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MaterialRow {
    /// The material's id.
    pub id: String,
    /// The folder of its images.
    pub folder: String,
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
    /// Its volume, mm³.
    pub volume_mm3: f64,
}

/// The mass properties of a body on the plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodyRow {
    /// Its mass, g.
    pub mass_g: f64,
    /// Its centre of mass, mm.
    pub center_mm: [f64; 3],
    /// Its inertia tensor about that centre, g·mm², in rows.
    pub inertia_g_mm2: [[f64; 3]; 3],
    /// Its principal moments, ascending, g·mm².
    pub principal_g_mm2: [f64; 3],
}

/// How far one body is from another.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Off {
    /// The difference of mass, as a share of it.
    pub mass_ratio: f64,
    /// The distance of the centres, mm.
    pub center_mm: f64,
    /// The greatest difference in the inertia tensor, as a share of its trace.
    pub inertia_ratio: f64,
}

impl DitherRow {
    /// The version of `materials.json` that this program writes.
    pub const SCHEMA: u32 = 1;
}

impl BodyRow {
    /// Returns the properties of what has these moments, mm³ to mm⁵, of a material.
    pub(super) fn of(moments: &Moments, density_g_cm3: f64) -> Self {
        let body = Body::new(moments, density_g_cm3 / MM3_PER_CM3);
        let inertia = body.inertia_g_mm2;
        Self {
            mass_g: body.mass_g,
            center_mm: body.center.coords.into(),
            inertia_g_mm2: [0, 1, 2].map(|row| [0, 1, 2].map(|column| inertia[(row, column)])),
            principal_g_mm2: body.principal().moments_g_mm2,
        }
    }

    /// Returns how far another body is from this one.
    pub fn off(&self, other: &Self) -> Off {
        let difference = |axis: usize| other.center_mm[axis] - self.center_mm[axis];
        let trace: f64 = [0, 1, 2]
            .map(|axis| self.inertia_g_mm2[axis][axis])
            .iter()
            .sum();
        let pairs = self.inertia_g_mm2.iter().zip(&other.inertia_g_mm2);
        let entries = pairs.flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).abs()));
        Off {
            mass_ratio: other.mass_g / self.mass_g - 1.0,
            center_mm: [0, 1, 2]
                .map(|axis| difference(axis).powi(2))
                .iter()
                .sum::<f64>()
                .sqrt(),
            inertia_ratio: entries.fold(0.0, f64::max) / trace,
        }
    }
}

impl Off {
    /// Returns whether mass, centre and inertia are as near as promised.
    pub fn is_kept(&self) -> bool {
        self.mass_ratio.abs() <= MASS_RATIO
            && self.center_mm <= CENTER_MM
            && self.inertia_ratio <= INERTIA_RATIO
    }

    /// Words what is promised: the mass, the centre and the inertia.
    pub fn promise() -> String {
        format!(
            "promised: mass within {} %, centre within {CENTER_MM} mm, inertia within {} % of its trace",
            100.0 * MASS_RATIO,
            100.0 * INERTIA_RATIO
        )
    }
}
