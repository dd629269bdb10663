//! Pieces shared by several sections of the page: blanks, masses with their windows, file names.

use maud::{Markup, html};

use crate::base::numbers::{number, quantity};
use crate::sheet::{Checklist, Half, PartRow, Process};
use crate::verify::InfillOrder;

/// Deviation of a sound print's mass where the profile gives none, as a share of the mass.
const COMMON_SPREAD_RATIO: f64 = 0.03;

/// Returns a line to write on.
pub(super) fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
}

/// Returns a sentence of the checklist, with what stands between backticks set as code.
pub(super) fn sentence(text: &str) -> Markup {
    let pieces = text.split('`').enumerate();
    html! {
        @for (index, piece) in pieces {
            @if index % 2 == 1 { code { (piece) } } @else { (piece) }
        }
    }
}

/// Returns the path of a file, which may break after `/`, `_` and `-`.
pub(super) fn file_name(path: &str) -> Markup {
    html! { code { @for piece in path.split_inclusive(['/', '_', '-']) { (piece) wbr; } } }
}

/// Returns a mass and the limits of a good piece.
pub(super) fn mass_window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! { (quantity(mass_g, "g")) (window(mass_g, spread_ratio)) }
}

fn window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! {
        br;
        span class="small" {
            "reject outside " (number(mass_g * (1.0 - spread_ratio))) "–"
            (quantity(mass_g * (1.0 + spread_ratio), "g"))
        }
    }
}

/// Returns the mass of a part as it is printed, g: by the toolpaths, if they were weighed.
pub(super) fn printed_mass_g(sheet: &Checklist, part: &PartRow) -> f64 {
    let toolpaths = sheet.toolpaths.as_ref();
    let laid_g = toolpaths.and_then(|toolpaths| toolpaths.mass_of(&part.id));
    laid_g.unwrap_or(part.mass_g)
}

/// Returns the mass of all parts as they are printed, g.
pub(super) fn mass_of_parts_g(sheet: &Checklist) -> f64 {
    let parts = sheet.parts.iter();
    parts.map(|part| printed_mass_g(sheet, part)).sum()
}

/// Names a half of a yo-yo.
pub(super) fn half_name(half: Half) -> &'static str {
    match half {
        Half::A => "A",
        Half::B => "B",
    }
}

/// Micrometres in a millimetre.
pub(super) const UM_PER_MM: f64 = 1000.0;

/// Height of a layer below which it is named in micrometres, mm.
pub(super) const THIN_LAYER_MM: f64 = 0.1;

/// Density of loose powder over that of the sintered material. Beds of polyamide are packed to
/// 0.45–0.5 g/cm³, and parts have 0.95–1.01.
const POWDER_RATIO: f64 = 0.5;

/// Returns the density of what fills an uncleaned void over that of the material; `None` for
/// filament, of which a lattice at most is left.
pub(super) fn residue_density_ratio(process: &Process) -> Option<f64> {
    match process {
        Process::Fdm => None,
        Process::Sls | Process::Mjf => Some(POWDER_RATIO),
        _ => Some(1.0),
    }
}

/// Names the residue that a process may leave in a void.
pub(super) fn residue(process: &Process) -> &'static str {
    match process {
        Process::Sla => "resin or support",
        Process::Sls | Process::Mjf => "powder",
        Process::Mjp => "wax",
        _ => "support",
    }
}

/// The deviation of a print with sparse infill whose toolpaths nobody weighed, as a share of its
/// mass. The slicer lays anchors and edges besides: 3.3 % more for a bunny of 40 mm, 2.1 % at 60.
const UNSLICED_SPREAD_RATIO: f64 = 0.05;

/// Returns the deviation of a sound print's mass, as a share of the mass.
pub(super) fn spread_ratio(sheet: &Checklist) -> f64 {
    let material = &sheet.material;
    let known = material
        .density_spread_ratio
        .or(material.typical_spread_ratio);
    let spread = known.unwrap_or(COMMON_SPREAD_RATIO);
    let is_unsliced = |infill: &InfillOrder| infill.beyond.is_none();
    match sheet.infill.as_ref().is_some_and(is_unsliced) {
        true => spread.max(UNSLICED_SPREAD_RATIO),
        false => spread,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_powder_processes_leave_powder_and_only_sla_leaves_resin() {
        for (process, left) in [
            ("fdm", "support"),
            ("sla", "resin or support"),
            ("sls", "powder"),
            ("polyjet", "support"),
        ] {
            assert_eq!(residue(&Process::from(process.to_owned())), left);
        }
    }

    #[test]
    fn what_stands_between_backticks_is_code_and_a_lone_backtick_loses_no_word() {
        let shown = |text| sentence(text).into_string();
        let tip = "give a tip (`tip = …`) or none";
        assert_eq!(shown(tip), "give a tip (<code>tip = …</code>) or none");
        assert_eq!(shown("a ` b"), "a <code> b</code>");
    }
}
