//! The text of a profile as written in its file, not yet checked.

use std::collections::BTreeMap;

use serde::Deserialize;
use toml::{Spanned, value::Datetime};

use super::{Corner, Grid, PrintPose, Quantity, Support, Sure};
use crate::base::dialect::Dialect;

/// The file of a printer or a process.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ProfileText {
    pub id: Spanned<String>,
    pub name: Spanned<String>,
    pub inherits: Option<Spanned<String>>,
    pub grid: Option<Grid>,
    pub support: Option<Support>,
    pub print_pose: Option<PrintPose>,
    pub cleaning: Option<Spanned<String>>,
    pub glue: Option<Spanned<String>>,
    pub glue_safety: Option<Spanned<String>>,
    pub materials: Option<Spanned<Vec<Spanned<String>>>>,
    pub default_material: Option<Spanned<String>>,
    pub build_volume_mm: Option<Spanned<ValueText<[f64; 3]>>>,
    pub largest_part_mm: Option<Spanned<ValueText<[f64; 3]>>>,
    pub compensates_shrinkage: Option<Spanned<ValueText<bool>>>,
    pub dialect: Option<Spanned<ValueText<Dialect>>>,
    pub infill_pattern: Option<Spanned<String>>,
    pub infill_core_ratio: Option<Spanned<ValueText<Vec<[f64; 2]>>>>,
    #[serde(default)]
    pub excluded_corners: Vec<Spanned<CornerText>>,
    #[serde(default)]
    pub walls_by_part_size: Vec<Spanned<WallText>>,
    #[serde(default)]
    pub numbers: BTreeMap<Quantity, Spanned<ValueText<f64>>>,
    #[serde(default)]
    pub material: Vec<MaterialText>,
}

/// The file of a material, or a `[[material]]` table of a printer.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MaterialText {
    pub id: Spanned<String>,
    pub name: Spanned<String>,
    pub density_g_cm3: Spanned<ValueText<f64>>,
    pub density_spread_ratio: Option<Spanned<ValueText<f64>>>,
    pub clearance_slide_per_side_mm: Option<Spanned<ValueText<f64>>>,
    pub flow_ratio: Option<Spanned<ValueText<f64>>>,
    pub lot: Option<Spanned<String>>,
    pub measured_on: Option<Spanned<Datetime>>,
}

/// A value with its source.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct ValueText<T> {
    pub value: Option<T>,
    pub dpi: Option<f64>,
    pub source: Option<String>,
    pub sure: Option<Sure>,
}

/// An excluded corner of the plate.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct CornerText {
    pub corner: Corner,
    pub size_mm: [f64; 2],
    pub source: Option<String>,
    pub sure: Option<Sure>,
}

/// The thinnest wall of parts up to a size.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct WallText {
    pub up_to_mm: f64,
    pub wall_mm: f64,
    pub source: Option<String>,
    pub sure: Option<Sure>,
}
