//! The job sheet: what the shop does, in the order in which it is done, with nothing else. It works
//! on a screen and on paper, without a network.

use maud::html;

use super::cover::cover;
use super::document::styled_document;
use super::hand_over;
use super::inputs::PageInputs;
use super::job_id::JobId;
use super::running::style;
use super::steps::steps;
use super::view::viewer;
use crate::sheet::Verdict;

/// Returns the job sheet as a self-contained HTML page with its pictures.
pub fn job(inputs: &PageInputs) -> String {
    let sheet = inputs.sheet;
    let job = JobId {
        name: &sheet.job,
        sha256: inputs.sha256,
    };
    let body = html! {
        (cover(inputs, &job))
        main {
            @if let Some(view) = inputs.view { (viewer(view)) }
            (steps(sheet, inputs.pictures))
            (hand_over::sign_off(sheet))
            @if sheet.verdict == Verdict::Pass { (hand_over::card(sheet)) }
        }
    };
    styled_document(&format!("Job sheet: {}", sheet.job), &body, &style(&job))
}
