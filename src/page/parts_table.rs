//! The table of parts: each in its print pose, with its mass and fields for the shop.

use maud::{Markup, html};

use super::fields::{blank, file_name, half_name, mass_with_window};
use super::figure::Picture;
use super::hardware::bar;
use crate::base::numbers::{extent, quantity};
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::sheet::{Checklist, PartRow};

/// Digits of a hash that are shown: enough to tell files apart by eye. The whole hash is at the end
/// of the sheet.
const SHORT_HASH: usize = 12;

/// Returns the section of the parts.
pub(super) fn parts(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        section class="new-page" {
            h2 id="parts" { "Parts" }
            p { "Print one of each, just as the file lies: z = 0 is the plate. Sizes are along the printer's x, y and z." }
            table class="parts" {
                thead { tr { th scope="col" { "As it lies on the plate" } th scope="col" { "Part and file" } th scope="col" class="n" { "Mass" } th scope="col" { "To fill in" } } }
                tbody { @for part in &sheet.parts { (line(sheet, part, pictures)) } }
            }
            (bought(sheet))
        }
    }
}

/// Lists the hardware, which is bought and not printed; empty if there is none.
fn bought(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.hardware.is_empty() {
            p { "Not printed, to have at hand:" }
            ul class="ticks" {
                @for piece in &sheet.hardware { li { strong { (piece.id) } ", " (bar(piece)) } }
            }
        }
    }
}

fn line(sheet: &Checklist, part: &PartRow, pictures: &[Picture]) -> Markup {
    let picture = pictures
        .iter()
        .find(|picture| part.picture.as_ref() == Some(&picture.file));
    html! {
        tr {
            td class="picture" { @if let Some(picture) = picture { (picture.image()) } }
            td { (description(part)) }
            td class="n" { (mass_with_window(sheet, part.mass_g)) }
            td class="boxes" {
                @for field in ["Machine", "Material lot", "Operator"] { span class="field" { (field) " " (blank()) } br; }
                span class="field" { "Part OK ☐" }
            }
        }
    }
}

/// Returns what a part is, how it lies, and its file.
fn description(part: &PartRow) -> Markup {
    html! {
        strong class="part-id" { (part.id) } @if let Some(half) = part.half { ", half " (half_name(half)) } br;
        (file_name(&part.file)) br;
        "SHA-256 " code { (part.sha256.get(..SHORT_HASH).unwrap_or(&part.sha256)) "…" } br;
        (extent(&part.size_mm)) br;
        (quantity(part.volume_mm3 / MM3_PER_CM3, "cm³")) ", " (part.triangles) " triangles" br;
        (part.lies) br;
        (format_count(part.pins.len(), "pin")) ", " (format_count(part.sockets.len(), "socket"))
        @for mark in &part.marks { br; "“" (mark.text) "” sunk into its face in " (mark.cut) }
    }
}
