//! The steps of a job in their order, with boxes to tick and fields to fill in.

use maud::{Markup, html};

use super::cleaning::clean_one;
use super::fields::{blank, mass_window};
use super::figure::{Picture, Role, figures};
use super::gluing::{dry_fit, glue};
use super::hardware::fit_hardware;
use super::printing::print_step;
use super::trials::test_step;
use super::weighing::{weigh_parts, weigh_whole};
use crate::base::numbers::{coordinates, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{BallastRow, Checklist};
use crate::verify::FillOrder;

/// Returns the names of the steps in their order. Parts are weighed while they can still be
/// cleaned; filling, ballast and hardware are steps only if the job has them.
pub(super) fn step_names(sheet: &Checklist) -> Vec<&'static str> {
    let names = [
        Some("Print"),
        Some("Clean every void"),
        Some("Weigh the parts"),
        Some("Dry fit"),
        sheet.fill.map(|_| "Fill every void"),
        (!sheet.ballast.is_empty()).then_some("Lay in the ballast"),
        Some("Glue"),
        (!sheet.hardware.is_empty()).then_some("Put in the hardware"),
        Some("Weigh the whole"),
        Some("Test"),
    ];
    names.into_iter().flatten().collect()
}

/// Returns every step with its pictures.
pub(super) fn steps(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    let steps = [
        Some(print_step(sheet)),
        Some(html! { (clean(sheet)) (mouths_note(sheet)) }),
        Some(weigh_parts(sheet)),
        Some(html! { (dry_fit(sheet)) (figures(pictures, Role::Cut)) }),
        sheet.fill.map(|fill| filling(sheet, fill)),
        (!sheet.ballast.is_empty()).then(|| ballast(sheet)),
        Some(html! { (glue(sheet)) (figures(pictures, Role::Exploded)) }),
        (!sheet.hardware.is_empty()).then(|| fit_hardware(sheet, pictures)),
        Some(weigh_whole(sheet)),
        Some(test_step(sheet)),
    ];
    let steps = step_names(sheet)
        .into_iter()
        .zip(steps.into_iter().flatten());
    html! {
        @for (index, (name, step)) in steps.enumerate() {
            section class="step" { h2 id=(format!("step-{}", index + 1)) { (index + 1) ". " (name) } (step) }
        }
    }
}

/// Returns where to look for drawings of the mouths.
fn mouths_note(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.voids.is_empty() && !sheet.cuts.is_empty() {
            p class="small" { "“Dry fit” below shows where each void opens; the first page shows the inside." }
        }
    }
}

fn filling(sheet: &Checklist, fill: FillOrder) -> Markup {
    html! {
        p {
            "With the cut faces up and level, fill every piece of a void flush with its cut face with a material of "
            (quantity(fill.density_g_cm3, "g/cm³")) ", without bubbles, and let it set. Keep sockets and cut faces clean."
        }
        table {
            tr { th { "Done" } th { "Void" } th class="n" { "Filling, in all its pieces" } th { "Weighed, g" } }
            @for void in &sheet.voids {
                tr {
                    td { "☐" } td { strong { (void.id) } }
                    td class="n" {
                        (quantity(void.volume_mm3 / MM3_PER_CM3, "cm³")) ", "
                        (quantity(void.volume_mm3 / MM3_PER_CM3 * fill.density_g_cm3, "g"))
                    }
                    td { (blank()) }
                }
            }
        }
    }
}

fn ballast(sheet: &Checklist) -> Markup {
    html! {
        p { "Weigh each piece first: one outside its window spoils the balance. Glue it into its pocket so that it cannot rattle." }
        table {
            tr {
                th { "Done" } th { "Piece" } th class="n" { "Mass" } th { "Weighed, g" } th { "Into" } th { "Centre, model frame" }
            }
            @for row in &sheet.ballast { (ballast_line(row)) }
        }
        p class="small" { "Sources of the sizes and masses:" }
        @for source in ballast_sources(sheet) { p class="small" { (source) } }
    }
}

fn ballast_line(row: &BallastRow) -> Markup {
    let lump = &row.order.lump;
    html! {
        tr {
            td { "☐" }
            td { strong { (row.order.id) } ": " (row.name) " (" code { (row.part) } ")" }
            td class="n" { (mass_window(lump.mass_g, row.mass_spread_ratio)) }
            td { (blank()) }
            td { "pocket " (row.void) ", open along " (row.opened_by.join(", ")) ", " (quantity(row.clearance_mm, "mm")) " of room all around" }
            td {
                (coordinates(&lump.center_mm))
                @if !lump.shape.is_ball() { ", axis " (coordinates(&lump.axis)) }
            }
        }
    }
}

/// Returns the sources of the ballast's numbers, each once.
fn ballast_sources(sheet: &Checklist) -> Vec<&String> {
    let mut sources: Vec<&String> = sheet.ballast.iter().flat_map(|row| &row.sources).collect();
    sources.sort();
    sources.dedup();
    sources
}

fn clean(sheet: &Checklist) -> Markup {
    html! {
        @if sheet.voids.is_empty() { p { "There are no voids: nothing to clean." } }
        ul class="ticks" {
            @for void in &sheet.voids { (clean_one(sheet, void)) }
        }
    }
}
