//! The certificate: what was promised, what was measured, and the proof that no other hollowing is
//! better.

use maud::{Markup, html};

use super::bound;
use super::document::styled_document;
use super::fields::sentence;
use super::figure::{Role, figures};
use super::grid;
use super::inputs::PageInputs;
use super::job_id::JobId;
use super::proof;
use super::running::{code, style};
use super::words;
use crate::base::numbers::{extent, number, quantity};
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{Checklist, MaterialRow};

/// Returns the certificate of a kit as a self-contained HTML page.
pub fn certificate(inputs: &PageInputs) -> String {
    let (sheet, pictures) = (inputs.sheet, inputs.pictures);
    let job = JobId {
        name: &sheet.job,
        sha256: inputs.sha256,
    };
    let body = html! {
        header class="cover" {
            div class="title" {
                p class="small" { "Certificate" }
                h1 { (sheet.job) }
                p { "Job id " strong { (job.short()) } }
                p class="promise" { (words::promise(sheet)) }
            }
            div class="code" { (code(&job)) }
        }
        main {
            (facts(sheet))
            (proof::checks(&sheet.checks))
            (proof::proof(sheet, pictures))
            section { h2 { "Sections at the cuts" } (figures(pictures, Role::Cut)) }
            (bound::numbers(sheet))
            (proof::parts(sheet))
            (proof::voids(sheet))
            (grid::table(&sheet.grid))
            (proof::files(inputs))
        }
    };
    styled_document(&format!("Certificate: {}", sheet.job), &body, &style(&job))
}

/// Returns what was asked for, in numbers.
fn facts(sheet: &Checklist) -> Markup {
    let [x, y] = sheet.printer.pixel_mm.map(|pitch| number(pitch * 1000.0));
    html! {
        table class="facts" {
            tr { th scope="row" { "Goal" } td { (words::goal(&sheet.goal)) ". Coordinates are along the model's own axes." } }
            @if let Some(choice) = &sheet.goal.choice {
                tr { th scope="row" { "Way up" } td { (sentence(choice)) } }
            }
            tr {
                th scope="row" { "Model" }
                td {
                    (sheet.model.file) ", " (extent(&sheet.model.size_mm)) ", "
                    (quantity(sheet.model.volume_mm3 / MM3_PER_CM3, "cm³")) " solid"
                }
            }
            tr {
                th scope="row" { "Printer" }
                td {
                    (sheet.printer.name) " (" (sheet.printer.process) "), " (x) " × " (y) "\u{a0}µm, layers of "
                    (quantity(sheet.printer.layer_mm * 1000.0, "µm"))
                }
            }
            tr { th scope="row" { "Material" } td { (material(&sheet.material)) } }
            tr {
                th scope="row" { "Mass" }
                td {
                    (quantity(sheet.assembly.mass_g, "g")) "; "
                    (quantity(sheet.solid.mass_g, "g")) " if it were solid"
                }
            }
            tr { th scope="row" { "Wall" } td { (words::wall(&sheet.wall)) } }
            @for offer in &sheet.offers { tr { th scope="row" { "Other plan" } td { (sentence(offer)) } } }
        }
    }
}

/// Names the material and its density, with the source.
fn material(material: &MaterialRow) -> Markup {
    html! {
        (material.name) ", " (quantity(material.density_g_cm3, "g/cm³")) " ("
        (material.density_sure)
        @if material.density_spread_ratio.is_none() { ", not measured by this shop" }
        ": " (material.density_source) ")"
    }
}
