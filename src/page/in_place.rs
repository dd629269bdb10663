//! Steps of the job sheet for a telescope whose shells are printed in each other.

use maud::{Markup, html};

use super::fields::file_name;
use super::figure::{Picture, Role, figures};
use crate::base::numbers::{measured, measured_extent, number};
use crate::sheet::telescope::TelescopeSheet;

/// The names of the steps in their order.
pub(super) const STEPS: [&str; 5] = ["Print", "Clean", "Free", "Open", "Test"];

/// Returns how all shells are printed at once.
pub(super) fn print(sheet: &TelescopeSheet) -> Markup {
    html! {
        p {
            "Layers of " (number(sheet.printer.layer_mm)) "\u{a0}mm, never scaled."
            @if sheet.printer.is_filament { " Solid (100 % infill), no support, no raft, no brim between the shells." }
            " Print " code { "in-place.3mf" } ": all shells lie in it in each other, tail down. Load it as one object, and move none of its bodies."
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Body" } th scope="col" class="n" { "Size" } th scope="col" class="n" { "Mass" }
                }
            }
            tbody {
                @for (part, row) in sheet.parts.iter().zip(&sheet.part_rows) {
                    tr {
                        th scope="row" { (row.id) " " (file_name(&part.file)) }
                        td class="n" data-head="Size" { (measured_extent(&row.size_mm)) }
                        td class="n" data-head="Mass" { (measured(row.mass_g, "g")) }
                    }
                }
            }
        }
        p class="small" {
            "In the slicer's preview every shell must be a ring of its own in all layers. If two rings touch, the lines are too wide for a gap of "
            (measured(sheet.clearance_mm, "mm")) "."
        }
    }
}

/// Returns how powder, or the first layer's edge, is taken off.
pub(super) fn clean(sheet: &TelescopeSheet) -> Markup {
    let has_vents = sheet.parts.iter().any(|part| part.vent_mm.is_some());
    html! {
        ul class="ticks" {
            @if has_vents {
                li { "Let the powder run out of the holes and of the gaps at both ends. Blow through every hole." }
                li { "Blast with the telescope all in, then half open, then all out. No powder may fall out when it is shaken." }
            } @else {
                li { "Take the print off the plate. Break the first layer's edge at every ring with a thin blade." }
                li { "Pull strings out of the gaps. Look into the gaps against a light." }
            }
        }
    }
}

/// Returns how the shells are freed of each other.
pub(super) fn free(sheet: &TelescopeSheet, pictures: &[Picture]) -> Markup {
    html! {
        p { "From the inside out. Never pull with a tool." }
        ul class="ticks" {
            @for joint in sheet.joint_rows.iter().rev() {
                li {
                    strong { (joint.id) } ": push " (joint.shells[1]) " from behind until it comes free of "
                    (joint.shells[0]) ", a millimetre at first. Push it back and forth until it slides by itself."
                }
            }
        }
        p class="small" {
            "Clearance " (measured(sheet.clearance_mm, "mm")) " on each side: " (sheet.clearance_source) "."
            @if !sheet.is_clearance_proved { " It counts as unproved until a pair of shells came free on this machine." }
        }
        (figures(pictures, Role::CutJoint))
        (figures(pictures, Role::Exploded))
    }
}
