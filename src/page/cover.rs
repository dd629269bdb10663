//! The head of the job sheet: the object and its promise, the verdict, and the facts.

use maud::{Markup, html};

use super::fields::{THIN_LAYER_MM, UM_PER_MM, blank, sentence};
use super::figure::{Role, figures};
use super::inputs::PageInputs;
use super::job_id::JobId;
use super::running::{code, on_screen};
use super::steps::step_names;
use super::tools::you_need;
use super::words;
use crate::base::numbers::{measured, measured_extent, number};
use crate::base::units::format_count;
use crate::sheet::{Checklist, Verdict};

/// Returns the head of the sheet.
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
            div class="code" { (code(job)) }
        }
        section aria-label="Overview" {
            (order_fields())
            (warnings(sheet))
            div class="glance" {
                (figures(inputs.pictures, Role::Cover))
                (facts(sheet))
            }
            (overview(sheet))
            (shortfall(sheet))
        }
    }
}

fn verdict(sheet: &Checklist) -> Markup {
    let (class, word) = match sheet.verdict {
        Verdict::Pass => ("verdict pass", "✓ all promises kept"),
        Verdict::Fail => ("verdict fail", "✗ do not print: see certificate"),
    };
    let broken = sheet.checks.iter().filter(|check| !check.pass);
    html! {
        p class=(class) { (word) }
        @for check in broken { p class="fail" { (words::broken(check)) } }
    }
}

fn warnings(sheet: &Checklist) -> Markup {
    html! {
        @for warning in &sheet.warnings { p class="warn" { strong { "Warning: " } (sentence(warning)) } }
    }
}

fn shortfall(sheet: &Checklist) -> Markup {
    html! {
        @if let Some(words) = words::shortfall(sheet) {
            p class="small" { strong { "Short of the best: " } (words) }
        }
    }
}

/// Words the infill.
fn infill(sheet: &Checklist) -> &'static str {
    match &sheet.infill {
        Some(infill) if infill.inner.is_empty() => "solid, with a region of sparse infill",
        Some(_) => "solid walls, with regions of sparse infill",
        None => "solid (100 % infill)",
    }
}

fn facts(sheet: &Checklist) -> Markup {
    let size_mm = sheet.finished_size_mm.unwrap_or(sheet.model.size_mm);
    let rows: [(&str, Markup); 7] = [
        ("Size", html! { (measured_extent(&size_mm)) }),
        ("Printer", html! { (sheet.printer.name) }),
        (
            "Settings",
            html! { "layers of " (layer(sheet)) ", " (infill(sheet)) ", never scaled" },
        ),
        ("Material", html! { (sheet.material.name) }),
        ("Mass", mass(sheet)),
        ("Kit", kit(sheet)),
        ("You need", html! { (you_need(sheet)) }),
    ];
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
            @if let Some(time) = &sheet.print_time {
                tr { th scope="row" { "Print time" } td { (time.words()) " (" (time.slicer_words()) ")" } }
            }
            @if let Some(off_deg) = sheet.goal.off_natural_deg {
                tr { th scope="row" { "Axis" } td { (words::axis_off(off_deg)) } }
            }
            @if let Some(foot) = words::spins_on(sheet) {
                tr { th scope="row" { "Spins on" } td { (foot) } }
            }
        }
    }
}

/// Returns what is printed, and what is bought.
fn kit(sheet: &Checklist) -> Markup {
    html! {
        (words::pieces(sheet))
        @if let Some(bought) = words::bought(sheet) { "; " (bought) }
    }
}

/// Words the height of a layer, in micrometres if it is thin.
fn layer(sheet: &Checklist) -> String {
    let mm = sheet.printer.layer_mm;
    if mm < THIN_LAYER_MM {
        format!("{:.0}\u{a0}µm", mm * UM_PER_MM)
    } else {
        format!("{}\u{a0}mm", number(mm))
    }
}

/// Returns the mass, with the share of hardware and ballast.
fn mass(sheet: &Checklist) -> Markup {
    let hardware_g: f64 = sheet.hardware.iter().map(|piece| piece.mass_g).sum();
    html! {
        (measured(sheet.assembly.mass_g, "g")) " in all"
        @if hardware_g > 0.0 { ", " (measured(hardware_g, "g")) " of it hardware" }
        @if !sheet.ballast.is_empty() { ", with " (format_count(sheet.ballast.len(), "piece")) " of ballast" }
        " (solid it would be " (measured(sheet.solid.mass_g, "g")) ")"
    }
}

/// Returns links to the steps, for a screen.
fn overview(sheet: &Checklist) -> Markup {
    html! {
        nav class="steps screen-only" aria-label="Steps" {
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
            @for field in ["Order", "Quantity", "Due", "Machine", "Material lot"] {
                span class="field" { (field) " " (blank()) } " "
            }
        }
    }
}
