//! A printer and the orders of a plate, in Cura's words.

use crate::io::threemf::{CURA_OVERLAP_LINES, PlateObject, SparseRegion};
use crate::slicer::error::SlicerError;
use crate::slicer::settings::{FILAMENT_MM, SliceSettings};

/// A setting and its value.
pub(super) type Pair = (String, String);

/// Distance of the lines of support, in widths: Cura's usual density of 15 %.
const SUPPORT_LINES: f64 = 100.0 / 15.0;
/// Dense layers at the top of a support, as other slicers lay for the same plate.
const ROOF_LAYERS: f64 = 2.0;
/// A right angle, degrees: Cura's angle of overhangs is that to the vertical.
const RIGHT_DEG: f64 = 90.0;
/// Per cent of solid print.
const SOLID_PERCENT: f64 = 100.0;

/// The widths of the lines of parts, supports and brims, of which the engine derives none.
const WIDTHS: [&str; 11] = [
    "line_width",
    "wall_line_width",
    "wall_line_width_0",
    "wall_line_width_x",
    "skin_line_width",
    "infill_line_width",
    "skirt_brim_line_width",
    "support_line_width",
    "support_interface_line_width",
    "support_roof_line_width",
    "support_bottom_line_width",
];
/// The heights of layers, likewise.
const HEIGHTS: [&str; 5] = [
    "layer_height",
    "layer_height_0",
    "infill_sparse_thickness",
    "support_infill_sparse_thickness",
    "support_z_distance",
];
/// The flows of the lines of parts and supports, of which the engine derives none.
const FLOWS: [&str; 11] = [
    "material_flow",
    "wall_material_flow",
    "wall_0_material_flow",
    "wall_x_material_flow",
    "skin_material_flow",
    "infill_material_flow",
    "skirt_brim_material_flow",
    "support_material_flow",
    "support_interface_material_flow",
    "support_roof_material_flow",
    "support_bottom_material_flow",
];
/// Solid print is infill alone: the engine cuts regions into infill, and never into skin.
const NO_SKIN: [&str; 4] = [
    "top_layers",
    "bottom_layers",
    "initial_bottom_layers",
    "skin_edge_support_layers",
];
/// What would change sizes, or cut parts where their boxes overlap.
const AS_DRAWN: [(&str, &str); 7] = [
    ("center_object", "false"),
    ("machine_center_is_zero", "false"),
    ("carve_multiple_volumes", "false"),
    ("xy_offset", "0"),
    ("xy_offset_layer_0", "0"),
    ("hole_xy_offset", "0"),
    ("magic_spiralize", "false"),
];

/// The patterns of infill: the name in PrusaSlicer's words or Cura's, and Cura's. Last comes the
/// number of directions among which the lines of a density are shared.
const PATTERNS: [(&str, &str, f64); 13] = [
    ("gyroid", "gyroid", 1.0),
    ("rectilinear", "lines", 1.0),
    ("alignedrectilinear", "lines", 1.0),
    ("line", "lines", 1.0),
    ("lines", "lines", 1.0),
    ("zigzag", "zigzag", 1.0),
    ("concentric", "concentric", 1.0),
    ("grid", "grid", 2.0),
    ("triangles", "triangles", 3.0),
    ("stars", "trihexagon", 3.0),
    ("trihexagon", "trihexagon", 3.0),
    ("cubic", "cubic", 3.0),
    ("adaptivecubic", "cubicsubdiv", 3.0),
];

/// Words a pair.
fn pair(key: &str, value: impl ToString) -> Pair {
    (key.to_owned(), value.to_string())
}

/// Returns a length without the digits that rounding leaves, mm.
fn mm(length_mm: f64) -> String {
    let rounded = format!("{length_mm:.6}");
    rounded
        .trim_end_matches('0')
        .trim_end_matches('.')
        .to_owned()
}

/// Returns the settings of a printer, and of all that a plate orders as a whole.
pub(super) fn of_plate(settings: &SliceSettings, objects: &[PlateObject]) -> Vec<Pair> {
    let [width, depth, height] = settings.room_mm();
    let (line_mm, layer_mm) = (settings.line_mm(), settings.layer_mm());
    let mut pairs = vec![
        pair("machine_width", width),
        pair("machine_depth", depth),
        pair("machine_height", height),
        pair("relative_extrusion", true),
        pair("infill_pattern", "lines"),
        pair("infill_sparse_density", SOLID_PERCENT),
        pair("infill_line_distance", mm(line_mm)),
        pair("infill_overlap_mm", mm(CURA_OVERLAP_LINES * line_mm)),
        pair("support_line_distance", mm(SUPPORT_LINES * line_mm)),
        pair(
            "support_initial_layer_line_distance",
            mm(SUPPORT_LINES * line_mm),
        ),
        pair("support_top_distance", mm(layer_mm)),
        pair("support_bottom_distance", mm(layer_mm)),
        pair("support_interface_enable", true),
        pair("support_roof_enable", true),
        pair("support_roof_height", mm(ROOF_LAYERS * layer_mm)),
        pair("support_roof_line_distance", mm(line_mm)),
    ];
    pairs.extend(WIDTHS.map(|key| pair(key, mm(line_mm))));
    pairs.extend(HEIGHTS.map(|key| pair(key, mm(layer_mm))));
    pairs.extend(NO_SKIN.map(|key| pair(key, 0)));
    pairs.extend(AS_DRAWN.map(|(key, value)| pair(key, value)));
    pairs.extend(adhesion(line_mm, objects));
    // The engine asks the plate as a whole before it asks the meshes.
    let supported = objects.iter().any(|object| object.overhang_deg.is_some());
    pairs.push(pair("support_enable", supported));
    pairs
}

/// Returns the settings of the brim, which Cura has for a plate as a whole.
fn adhesion(line_mm: f64, objects: &[PlateObject]) -> Vec<Pair> {
    let widths = objects.iter().filter_map(|object| object.brim_mm);
    let brim_mm = widths.fold(0.0, f64::max);
    if brim_mm == 0.0 {
        return vec![pair("adhesion_type", "skirt")];
    }
    vec![
        pair("adhesion_type", "brim"),
        pair("brim_width", mm(brim_mm)),
        pair("brim_line_count", (brim_mm / line_mm).ceil()),
        pair("skirt_brim_minimal_length", 0),
    ]
}

/// Returns the settings of the extruder, whose own list would hold otherwise.
pub(super) fn of_extruder(settings: &SliceSettings) -> Vec<Pair> {
    let mut pairs = vec![
        pair("material_diameter", FILAMENT_MM),
        pair("machine_nozzle_size", mm(settings.nozzle_mm())),
    ];
    if let Some(ratio) = settings.flow_ratio() {
        pairs.extend(FLOWS.map(|key| pair(key, mm(ratio * SOLID_PERCENT))));
    }
    pairs
}

/// Returns the settings of an object.
pub(super) fn of_object(object: &PlateObject) -> Vec<Pair> {
    let mut pairs = vec![
        pair("wall_line_count", object.perimeters),
        pair("support_enable", object.overhang_deg.is_some()),
    ];
    let angle_deg = object.overhang_deg.map(|deg| RIGHT_DEG - deg);
    pairs.extend(angle_deg.map(|deg| pair("support_angle", deg)));
    pairs
}

/// Returns the settings of a region of sparse infill, the `order`-th of its object from 1.
///
/// # Errors
/// Cura has no such pattern.
pub(super) fn of_region(
    region: &SparseRegion,
    order: usize,
    line_mm: f64,
) -> Result<Vec<Pair>, SlicerError> {
    let pattern = PATTERNS.iter().find(|(name, _, _)| *name == region.pattern);
    let (_, pattern, directions) = pattern.ok_or_else(|| SlicerError::NoPattern {
        pattern: region.pattern.clone(),
    })?;
    let distance_mm = match region.percent {
        0.0 => 0.0,
        percent => directions * line_mm * SOLID_PERCENT / percent,
    };
    Ok(vec![
        pair("infill_mesh", true),
        pair("infill_mesh_order", order),
        pair("infill_pattern", pattern),
        pair("infill_sparse_density", region.percent),
        pair("infill_line_distance", mm(distance_mm)),
        // No walls around it, and no lines beyond its edge.
        pair("wall_line_count", 0),
        pair("infill_overlap_mm", 0),
        pair("support_enable", false),
    ])
}

/// Returns the settings of a mesh within which no support is laid.
pub(super) fn of_blocker() -> Vec<Pair> {
    vec![pair("anti_overhang_mesh", true)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriMesh;

    fn value(pairs: &[Pair], key: &str) -> String {
        let found = pairs.iter().rev().find(|(name, _)| name == key);
        found.map_or_else(String::new, |(_, value)| value.clone())
    }

    fn region(pattern: &str, percent: f64) -> SparseRegion {
        SparseRegion {
            mesh: TriMesh::default(),
            pattern: pattern.to_owned(),
            percent,
        }
    }

    #[test]
    fn the_distance_of_lines_follows_from_the_density_and_the_pattern() {
        for (pattern, percent, distance) in [
            ("gyroid", 15.0, "3"),
            ("rectilinear", 50.0, "0.9"),
            ("grid", 20.0, "4.5"),
            ("stars", 30.0, "4.5"),
            ("lines", 0.0, "0"),
        ] {
            let pairs = of_region(&region(pattern, percent), 1, 0.45).unwrap();
            assert_eq!(value(&pairs, "infill_line_distance"), distance, "{pattern}");
        }
        let wrong = of_region(&region("honeycomb", 15.0), 1, 0.45).unwrap_err();
        assert!(wrong.to_string().contains("honeycomb"), "{wrong}");
    }

    #[test]
    fn angles_are_turned_and_a_brim_has_as_many_lines_as_it_needs() {
        let object = PlateObject {
            name: "P01".to_owned(),
            outside: TriMesh::default(),
            perimeters: 2,
            overhang_deg: Some(40.0),
            brim_mm: Some(5.0),
            regions: Vec::new(),
            blocked: Vec::new(),
        };
        assert_eq!(value(&of_object(&object), "support_angle"), "50");
        let whole = adhesion(0.45, &[object]);
        assert_eq!(value(&whole, "brim_line_count"), "12");
        assert_eq!(value(&adhesion(0.45, &[]), "adhesion_type"), "skirt");
    }
}
