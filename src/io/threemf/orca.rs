//! The print settings of each object of a package, as Bambu Studio and OrcaSlicer read them. Other
//! programs pass over this part of the package.

use std::fmt::Write as _;

use quick_xml::escape::escape;

use super::nested::piece_name;
use super::settings::{PrintSettings, Subject, on_or_off};
use super::sparse::{Infill, Pair};

/// Path of the settings.
pub const ORCA_PART: &str = "Metadata/model_settings.config";
/// The map of a part within its object: it stays where its mesh is.
const STAYS: &str = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";

/// Support that takes little material: it follows the overhang, and ends in two dense layers.
const LEAN: [[&str; 2]; 3] = [
    ["support_type", "normal(auto)"],
    ["support_style", "snug"],
    ["support_interface_top_layers", "2"],
];

/// The widths of the lines of a part, in the words of Bambu Studio and OrcaSlicer. Presets have one
/// for every kind.
pub const ORCA_WIDTHS: [&str; 6] = [
    "line_width",
    "inner_wall_line_width",
    "outer_wall_line_width",
    "sparse_infill_line_width",
    "internal_solid_infill_line_width",
    "top_surface_line_width",
];

/// What is laid where the solid print meets a region, as PrusaSlicer's dialect says it.
const AROUND_REGIONS: [[&str; 2]; 5] = [
    ["top_shell_thickness", "0"],
    ["bottom_shell_thickness", "0"],
    ["minimum_sparse_infill_area", "70"],
    ["bridge_flow", "1"],
    ["thick_bridges", "1"],
];

/// Returns the settings of an object.
fn pairs(subject: &Subject, settings: &PrintSettings) -> Vec<Pair> {
    let mut pairs = vec![
        ("sparse_infill_density", "100%".to_owned()),
        ("layer_height", settings.layer_mm.to_string()),
        ("wall_loops", settings.walls.perimeters.to_string()),
        ("enable_support", on_or_off(settings.overhang_deg.is_some())),
    ];
    if let Some(angle_deg) = settings.overhang_deg {
        pairs.push(("support_threshold_angle", format!("{angle_deg:.0}")));
        pairs.extend(LEAN.map(|[key, value]| (key, value.to_owned())));
    }
    pairs.extend(subject.brim());
    if !subject.infill.is_empty() {
        pairs.extend(ORCA_WIDTHS.map(|key| (key, settings.line_mm.to_string())));
        let layers = ["top_shell_layers", "bottom_shell_layers"];
        pairs.extend(layers.map(|key| (key, settings.walls.solid_layers.to_string())));
        pairs.extend(AROUND_REGIONS.map(|[key, value]| (key, value.to_owned())));
    }
    pairs
}

/// Returns the settings of a region.
fn region_pairs(infill: &Infill) -> Vec<Pair> {
    let [anchor, most] = infill.anchors();
    vec![
        ("sparse_infill_density", format!("{}%", infill.percent)),
        ("sparse_infill_pattern", infill.pattern.clone()),
        anchor,
        most,
        ("minimum_sparse_infill_area", "0".to_owned()),
        ("top_shell_layers", "0".to_owned()),
        ("bottom_shell_layers", "0".to_owned()),
    ]
}

/// Returns the objects' settings. The pieces of objects with regions are numbered from `first` on.
pub fn orca_xml(objects: &[Subject], first: usize, settings: &PrintSettings) -> String {
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n");
    let mut piece = first;
    for subject in objects {
        let (id, name) = (subject.id, escape(subject.name));
        // Writing into a string cannot fail.
        let _ = write!(
            xml,
            "<object id=\"{id}\">\n<metadata key=\"name\" value=\"{name}\"/>\n"
        );
        for (key, value) in pairs(subject, settings) {
            let _ = writeln!(xml, "<metadata key=\"{key}\" value=\"{value}\"/>");
        }
        if !subject.infill.is_empty() {
            let pieces = subject.infill.iter().map(|infill| {
                let pairs = region_pairs(infill);
                ("modifier_part", pairs)
            });
            let body = std::iter::once(("normal_part", Vec::new()));
            for (number, (kind, pairs)) in body.chain(pieces).enumerate() {
                let name = piece_name(subject.name, number);
                xml += &part_xml(piece, kind, &[("name", name)], &pairs);
                piece += 1;
            }
        }
        xml.push_str("</object>\n");
    }
    xml + "</config>\n"
}

/// Returns a part of an object: one of its components, with its settings.
fn part_xml(id: usize, kind: &str, own: &[Pair], pairs: &[Pair]) -> String {
    let stays = [("matrix", STAYS.to_owned())];
    let pairs = own.iter().chain(&stays).chain(pairs);
    let pairs = pairs.map(|(key, value)| {
        let value = escape(value.as_str());
        format!("<metadata key=\"{key}\" value=\"{value}\"/>\n")
    });
    let pairs: String = pairs.collect();
    format!("<part id=\"{id}\" subtype=\"{kind}\">\n{pairs}</part>\n")
}
