//! The checklist as one page a shop works from: no network, good on a screen and on paper.

use maud::{Markup, html};

use super::cover::cover;
use super::document::written;
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

/// The checklist as a self-contained HTML page with the pictures inside it.
pub fn page(papers: &PageInputs) -> String {
    let (sheet, pictures) = (papers.sheet, papers.pictures);
    let job = JobId {
        name: &sheet.job,
        sha256: papers.sha256,
    };
    let body = html! {
        (cover(papers, &job))
        main {
            @if let Some(view) = papers.view { (viewer(view)) }
            (parts(sheet, pictures))
            (steps(sheet, pictures))
            (sign_off(sheet))
            (grid::table(&sheet.grid))
            (proof::checks(&sheet.checks))
            (proof::proof(sheet, pictures))
            (proof::files(papers))
        }
    };
    written(&format!("Job sheet: {}", sheet.job), &body, &style(&job))
}

/// A line for every step, in the order of the sheet.
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
