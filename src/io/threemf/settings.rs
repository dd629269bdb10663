//! The print settings of each object of a package, as PrusaSlicer reads them. Other programs pass
//! over this part of the package.

use std::fmt::Write as _;
use std::ops::Range;

use quick_xml::escape::escape;

use super::sparse::{Infill, Pair, around_regions};
use crate::base::dialect::Dialect;
use crate::base::walls::Walls;
use crate::mesh::{BRIM_MM, GOOD_FOOT_MM2};

/// Path of PrusaSlicer's settings; SuperSlicer reads them too.
pub const PRUSA_PART: &str = "Metadata/Slic3r_PE_model.config";

/// The settings with which an object must be printed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintSettings {
    /// The family of slicers whose words a package with regions has; others have those of all.
    pub dialect: Dialect,
    /// Height of a layer, mm.
    pub layer_mm: f64,
    /// Width of a line, mm.
    pub line_mm: f64,
    /// The lines and layers that are laid solid around what is filled.
    pub walls: Walls,
    /// Angle to the horizontal from which surfaces print without support, degrees; `None` for no
    /// support.
    pub overhang_deg: Option<f64>,
}

/// An object of a package, as its settings name it.
pub struct Subject<'a> {
    /// Its identifier in the package.
    pub id: usize,
    /// Its name.
    pub name: &'a str,
    /// Number of its triangles.
    pub triangles: usize,
    /// The infill of its last triangles, which bound regions; empty without regions.
    pub infill: &'a [Infill],
    /// Area of its section just above the plate, mm².
    pub foot_mm2: f64,
}

impl Subject<'_> {
    /// Returns the brim that holds it on the plate; none if its foot is large enough. Both dialects
    /// have the same words for it.
    pub fn brim(&self) -> Vec<Pair> {
        let brim = [
            ("brim_type", "outer_only".to_owned()),
            ("brim_width", BRIM_MM.to_string()),
        ];
        let is_needed = self.foot_mm2 < GOOD_FOOT_MM2;
        brim.into_iter().filter(|_| is_needed).collect()
    }
}

/// The widths of the lines of a part, in PrusaSlicer's words. Presets have one for every kind.
const WIDTHS: [&str; 6] = [
    "extrusion_width",
    "perimeter_extrusion_width",
    "external_perimeter_extrusion_width",
    "infill_extrusion_width",
    "solid_infill_extrusion_width",
    "top_infill_extrusion_width",
];

/// What decides beside widths and densities how much is laid, in PrusaSlicer's words: its usual
/// values. Presets of machines have others, and the masses of the sheet are those of these.
const LAID_PRUSA: [[&str; 2]; 3] = [
    ["infill_every_layers", "1"],
    ["infill_only_where_needed", "0"],
    ["ensure_vertical_shell_thickness", "0"],
];

/// Support that takes little material, in PrusaSlicer's words: it follows the overhang, has no
/// sheath, and ends in two dense layers.
const LEAN_PRUSA: [[&str; 2]; 3] = [
    ["support_material_style", "snug"],
    ["support_material_with_sheath", "0"],
    ["support_material_interface_layers", "2"],
];

impl PrintSettings {
    /// Returns the settings in PrusaSlicer's words.
    fn for_prusa(&self) -> Vec<Pair> {
        let mut pairs = vec![
            ("fill_density", "100%".to_owned()),
            ("fill_pattern", "rectilinear".to_owned()),
            ("layer_height", self.layer_mm.to_string()),
            ("perimeters", self.walls.perimeters.to_string()),
            ("infill_overlap", percent(self.walls.overlap_ratio)),
            ("support_material", on_or_off(self.overhang_deg.is_some())),
        ];
        pairs.extend(WIDTHS.map(|key| (key, self.line_mm.to_string())));
        pairs.extend(LAID_PRUSA.map(|[key, value]| (key, value.to_owned())));
        if let Some(angle_deg) = self.overhang_deg {
            pairs.push(("support_material_auto", on_or_off(true)));
            pairs.push(("support_material_threshold", format!("{angle_deg:.0}")));
            pairs.extend(LEAN_PRUSA.map(|[key, value]| (key, value.to_owned())));
        }
        pairs
    }
}

/// Returns a ratio in per cent, to a hundredth.
fn percent(ratio: f64) -> String {
    format!("{}%", (ratio * 1e4).round() / 1e2)
}

pub(super) fn on_or_off(is_on: bool) -> String {
    u8::from(is_on).to_string()
}

/// Returns the objects' settings for PrusaSlicer.
pub fn prusa_xml(objects: &[Subject], settings: &PrintSettings) -> String {
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<config>\n");
    for subject in objects {
        let Subject { id, name, .. } = subject;
        let name = escape(*name);
        // Writing into a string cannot fail.
        let _ = write!(
            xml,
            "<object id=\"{id}\" instances_count=\"1\">\n\
             <metadata type=\"object\" key=\"name\" value=\"{name}\"/>\n"
        );
        let around = subject
            .infill
            .first()
            .map_or_else(Vec::new, |_| around_regions(&settings.walls));
        let pairs = settings.for_prusa().into_iter().chain(subject.brim());
        for (key, value) in pairs.chain(around) {
            let _ = writeln!(
                xml,
                "<metadata type=\"object\" key=\"{key}\" value=\"{value}\"/>"
            );
        }
        let whole = subject.triangles;
        let first = |index: usize| subject.infill.get(index).map_or(whole, |next| next.first);
        let usual = [
            ("name", name.into_owned()),
            ("volume_type", "ModelPart".to_owned()),
        ];
        xml += &volume_xml(0..first(0), &usual);
        for (index, infill) in subject.infill.iter().enumerate() {
            xml += &volume_xml(infill.first..first(index + 1), &infill.for_prusa());
        }
        xml += "</object>\n";
    }
    xml + "</config>\n"
}

/// Returns a volume of an object: some of its triangles, with their settings.
fn volume_xml(triangles: Range<usize>, pairs: &[Pair]) -> String {
    let (first, last) = (triangles.start, triangles.end.saturating_sub(1));
    let pairs = pairs.iter().map(|(key, value)| {
        format!("<metadata type=\"volume\" key=\"{key}\" value=\"{value}\"/>\n")
    });
    let pairs: String = pairs.collect();
    format!("<volume firstid=\"{first}\" lastid=\"{last}\">\n{pairs}</volume>\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::threemf::orca::orca_xml;

    const WALLS: Walls = Walls {
        perimeters: 2,
        solid_layers: 3,
        overlap_ratio: 0.25,
    };

    const SETTINGS: PrintSettings = PrintSettings {
        dialect: Dialect::Prusa,
        layer_mm: 0.2,
        line_mm: 0.45,
        walls: WALLS,
        overhang_deg: Some(45.0),
    };

    fn box_and_lid() -> [Subject<'static>; 2] {
        let subject = |id, name, foot_mm2| Subject {
            id,
            name,
            triangles: 12,
            infill: &[],
            foot_mm2,
        };
        [subject(2, "box <&>", 400.0), subject(3, "lid", 0.7)]
    }

    #[test]
    fn every_object_is_printed_solid_with_support_in_both_dialects() {
        let prusa = prusa_xml(&box_and_lid(), &SETTINGS);
        let orca = orca_xml(&box_and_lid(), 9, &SETTINGS);
        for (xml, said) in [
            (&prusa, "key=\"fill_density\" value=\"100%\""),
            (&prusa, "key=\"support_material\" value=\"1\""),
            (&prusa, "key=\"support_material_style\" value=\"snug\""),
            (&prusa, "key=\"extrusion_width\" value=\"0.45\""),
            (&prusa, "key=\"infill_overlap\" value=\"25%\""),
            (&prusa, "lastid=\"11\""),
            (&orca, "key=\"sparse_infill_density\" value=\"100%\""),
            (&orca, "key=\"enable_support\" value=\"1\""),
        ] {
            assert_eq!(xml.matches(said).count(), 2, "{said}: {xml}");
        }
        assert!(prusa.contains("box &lt;&amp;&gt;") && orca.contains("<object id=\"3\">"));
    }

    #[test]
    fn only_an_object_that_stands_on_a_point_has_a_brim() {
        let xmls = [
            prusa_xml(&box_and_lid(), &SETTINGS),
            orca_xml(&box_and_lid(), 9, &SETTINGS),
        ];
        for xml in xmls {
            let (cube, lid) = xml.split_once("</object>").unwrap();
            let brim = "key=\"brim_width\" value=\"5\"";
            assert!(!cube.contains("brim") && lid.contains(brim), "{xml}");
        }
    }

    #[test]
    fn without_support_it_is_switched_off_and_no_angle_is_given() {
        let settings = PrintSettings {
            overhang_deg: None,
            ..SETTINGS
        };
        let prusa = prusa_xml(&box_and_lid(), &settings);
        assert!(prusa.contains("key=\"support_material\" value=\"0\""));
        assert!(
            !prusa.contains("threshold")
                && !orca_xml(&box_and_lid(), 9, &settings).contains("angle")
        );
    }
}
