//! The job sheet as one page to work from, on a screen or on paper, without a network.

use maud::{Markup, html};

use super::cover::cover;
use super::document::styled_document;
use super::fields::blank;
use super::grid;
use super::inputs::PageInputs;
use super::job_id::JobId;
use super::parts_table::parts;
use super::proof;
use super::running::style;
use super::steps::{step_names, steps};
use super::view::viewer;
use crate::sheet::Checklist;

/// Returns the job sheet as a self-contained HTML page with its pictures.
pub fn page(inputs: &PageInputs) -> String {
    let (sheet, pictures) = (inputs.sheet, inputs.pictures);
    let job = JobId {
        name: &sheet.job,
        sha256: inputs.sha256,
    };
    let body = html! {
        (cover(inputs, &job))
        main {
            @if let Some(view) = inputs.view { (viewer(view)) }
            (parts(sheet, pictures))
            (steps(sheet, pictures))
            (sign_off(sheet))
            (grid::table(&sheet.grid))
            (proof::checks(&sheet.checks))
            (proof::proof(sheet, pictures))
            (proof::files(inputs))
        }
    };
    styled_document(&format!("Job sheet: {}", sheet.job), &body, &style(&job))
}

/// Returns a table to sign every step off, in the order of the sheet.
fn sign_off(sheet: &Checklist) -> Markup {
    let steps = step_names(sheet).into_iter();
    html! {
        section class="together" {
            h2 id="sign-off" { "Sign-off" }
            table {
                thead { tr { th scope="col" { "Step" } th scope="col" { "Name" } th scope="col" { "Date" } th scope="col" { "Remarks" } } }
                tbody {
                    @for step in ["Prepare"].into_iter().chain(steps).chain(["Release"]) {
                        tr { th scope="row" { (step) } td { (blank()) } td { (blank()) } td { "\u{a0}" } }
                    }
                }
            }
        }
    }
}
