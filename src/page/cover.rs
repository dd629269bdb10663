//! The first page: the object and its promise, the verdict, the facts, and links to the steps.

use maud::{Markup, html};

use super::fields::{blank, sentence};
use super::figure::{Role, figures};
use super::inputs::PageInputs;
use super::job_id::JobId;
use super::running::{code, on_screen};
use super::steps::step_names;
use super::words;
use crate::base::numbers::{extent, number, quantity};
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::sheet::{Checklist, MaterialRow, Verdict};

/// Returns the first page.
pub(super) fn cover(inputs: &PageInputs, job: &JobId) -> Markup {
    let sheet = inputs.sheet;
    html! {
        header class="cover" {
            (on_screen(job))
            div class="title" {
                p class="small" { "Job sheet" }
                h1 { (sheet.job) }
                p { "Job id " strong { (job.short()) } }
                p class="promise" { (words::promise(sheet)) }
                (verdict(sheet))
            }
            div class="code" { (code(job)) p class="small" { "Name of the job and SHA-256 of checklist.json" } }
        }
        section aria-label="Overview" {
            (order_fields())
            (warnings(sheet))
            div class="cover-pictures" {
                (figures(inputs.pictures, Role::Cover))
                (figures(inputs.pictures, Role::CutAway))
            }
            (facts(sheet))
            (overview(sheet))
        }
    }
}

fn verdict(sheet: &Checklist) -> Markup {
    let (class, word) = match sheet.verdict {
        Verdict::Pass => ("verdict pass", "✓ all promises kept"),
        Verdict::Fail => ("verdict fail", "✗ do not print: see checks"),
    };
    html! { p class=(class) { (word) } }
}

fn warnings(sheet: &Checklist) -> Markup {
    html! {
        @for warning in &sheet.warnings { p class="warn" { strong { "Warning: " } (sentence(warning)) } }
    }
}

fn facts(sheet: &Checklist) -> Markup {
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
                    (sheet.printer.name) " (" (sheet.printer.process) "), " (pixels(sheet))
                    ", layers of " (quantity(sheet.printer.layer_mm, "mm"))
                }
            }
            tr { th scope="row" { "Material" } td { (material(&sheet.material)) } }
            tr {
                th scope="row" { "Mass" }
                td {
                    (quantity(sheet.assembly.mass_g, "g")) " in all" (of_hardware(sheet))
                    @if !sheet.ballast.is_empty() {
                        " with " (format_count(sheet.ballast.len(), "piece")) " of ballast"
                    }
                    "; " (quantity(sheet.solid.mass_g, "g")) " if it were solid"
                }
            }
            tr { th scope="row" { "Wall" } td { (words::wall(&sheet.wall)) } }
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

/// Names the share of the mass that is hardware; empty if there is none.
fn of_hardware(sheet: &Checklist) -> String {
    let mass_g: f64 = sheet.hardware.iter().map(|piece| piece.mass_g).sum();
    if mass_g > 0.0 {
        format!(", {} of it hardware", quantity(mass_g, "g"))
    } else {
        String::new()
    }
}

fn pixels(sheet: &Checklist) -> String {
    let [x, y] = sheet.printer.pixel_mm.map(|pitch| number(pitch * 1000.0));
    format!("{x} × {y}\u{a0}µm")
}

/// Returns what the kit consists of, and links to the steps.
fn overview(sheet: &Checklist) -> Markup {
    html! {
        nav class="steps" aria-label="Steps" {
            p {
                "It comes as " strong { (format_count(sheet.parts.len(), "part")) }
                " with " (format_count(sheet.voids.len(), "void")) " inside, opened by "
                (format_count(sheet.cuts.len(), "cut")) " and joined at " (format_count(sheet.joints.len(), "glue joint")) ". Do these steps in order, and tick each one off:"
            }
            ol class="way" {
                @for (index, name) in step_names(sheet).into_iter().enumerate() {
                    li { a href=(format!("#step-{}", index + 1)) { (name) } }
                }
                li { a href="#sign-off" { "Sign off" } }
            }
        }
    }
}

/// Returns fields for what only the shop knows.
fn order_fields() -> Markup {
    html! {
        p class="fields" {
            @for field in ["Order", "Revision", "Quantity", "Due", "Prepared by"] {
                span class="field" { (field) " " (blank()) } " "
            }
        }
    }
}
