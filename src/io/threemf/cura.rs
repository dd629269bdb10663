//! The print settings of each mesh of a package, as Cura reads them: metadata of the object.
//!
//! Cura takes a region as an infill mesh: an object of its own that lies in another one, in one
//! group with it. Heights of layers and brims are not those of an object there.

use quick_xml::escape::escape;

use super::settings::PrintSettings;
use super::sparse::{Infill, Pair};

/// The namespace of Cura's settings.
pub const CURA_NAMESPACE: &str = "http://software.ultimaker.com/xml/cura/3mf/2015/10";
/// Its prefix.
pub const CURA_PREFIX: &str = "cura:";
/// Share of a line by which solid infill reaches into the walls. Cura's own is none for solid
/// print, which leaves slits along them.
pub const CURA_OVERLAP_LINES: f64 = 0.1;
/// Digits of a length in mm that rounding leaves.
const DIGITS: f64 = 1e6;
/// A right angle, degrees: Cura's angle of overhangs is that to the vertical.
const RIGHT_DEG: f64 = 90.0;

/// The widths of the lines of a part, of which each follows from another if none is stated.
const WIDTHS: [&str; 5] = [
    "line_width",
    "wall_line_width",
    "wall_line_width_0",
    "wall_line_width_x",
    "infill_line_width",
];
/// Solid print is infill alone: Cura cuts regions into infill, and never into skin.
const NO_SKIN: [&str; 3] = ["top_layers", "bottom_layers", "initial_bottom_layers"];

/// Returns the settings of a body.
pub fn for_body(settings: &PrintSettings) -> Vec<Pair> {
    let is_supported = settings.overhang_deg.is_some();
    let mut pairs = vec![
        ("infill_sparse_density", "100".to_owned()),
        ("infill_pattern", "lines".to_owned()),
        ("wall_line_count", settings.walls.perimeters.to_string()),
        ("support_enable", is_supported.to_string()),
    ];
    let angle_deg = settings.overhang_deg.map(|deg| RIGHT_DEG - deg);
    pairs.extend(angle_deg.map(|deg| ("support_angle", deg.to_string())));
    let overlap_mm = (CURA_OVERLAP_LINES * settings.line_mm * DIGITS).round() / DIGITS;
    pairs.push(("infill_overlap_mm", overlap_mm.to_string()));
    pairs.extend(WIDTHS.map(|key| (key, settings.line_mm.to_string())));
    pairs.extend(NO_SKIN.map(|key| (key, "0".to_owned())));
    pairs
}

/// Returns the settings of a region, the `order`-th of its object from 1. Of two infill meshes that
/// overlap, the one of the higher order holds.
pub fn for_region(infill: &Infill, order: usize) -> Vec<Pair> {
    let mut pairs = vec![
        ("infill_mesh", true.to_string()),
        ("infill_mesh_order", order.to_string()),
        ("infill_sparse_density", infill.percent.to_string()),
        ("infill_pattern", infill.pattern.clone()),
        // With walls, a shell would be laid around the region.
        ("wall_line_count", "0".to_owned()),
        ("infill_overlap_mm", "0".to_owned()),
        ("support_enable", false.to_string()),
    ];
    pairs.extend(NO_SKIN.map(|key| (key, "0".to_owned())));
    pairs
}

/// Returns settings as metadata of an object.
pub fn group_xml(pairs: &[Pair]) -> String {
    let pairs = pairs.iter().map(|(key, value)| {
        let value = escape(value.as_str());
        format!("<metadata name=\"{CURA_PREFIX}{key}\" preserve=\"1\">{value}</metadata>\n")
    });
    let pairs: String = pairs.collect();
    format!("<metadatagroup>\n{pairs}</metadatagroup>\n")
}
