//! The checklist as one page a shop works from: no network, good on a screen and on paper.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::cover::cover;
use super::figure::Picture;
use super::parts_table::parts;
use super::proof;
use super::qr::JobId;
use super::running::style;
use super::steps::{step_names, steps};
use super::view::{View, viewer};
use super::weighing::printed_g;
use super::words::{number, quantity};
use super::{Checklist, grid};

/// How the page looks; part of the page, so that it is one file.
const STYLE: &str = include_str!("page.css");
/// What the page may load: its own pictures and style, and nothing from outside.
const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// Everything the page shows.
#[derive(Debug, Clone, Copy)]
pub struct Papers<'a> {
    /// The job sheet.
    pub sheet: &'a Checklist,
    /// The SHA-256 of the job sheet as it is written for machines, hexadecimal.
    pub sha256: &'a str,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// What can be turned and taken apart on a screen; none where there are pictures only.
    pub view: Option<&'a View>,
}

/// The checklist as a self-contained HTML page with the pictures inside it.
pub fn page(papers: &Papers) -> String {
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

/// A page of the shop's papers, with their look and nothing from outside.
pub fn document(title: &str, body: &Markup) -> String {
    written(title, body, "")
}

fn written(title: &str, body: &Markup, style: &str) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(style)) }
            }
            body { (body) }
        }
    }
    .into_string()
}

/// The mass of something printed, and what a sound print of it may weigh where the density was
/// measured; else its share of all parts, which no density changes.
pub(super) fn mass_with_window(sheet: &Checklist, mass_g: f64) -> Markup {
    html! {
        (quantity(mass_g, "g"))
        @if let Some(spread) = sheet.material.density_spread_ratio { (window(mass_g, spread)) }
        @else {
            br;
            span class="small" { (number(100.0 * mass_g / printed_g(sheet))) " % of all parts" }
        }
    }
}

/// A mass, and what a sound piece of it may weigh.
pub(super) fn mass_window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! { (quantity(mass_g, "g")) (window(mass_g, spread_ratio)) }
}

fn window(mass_g: f64, spread_ratio: f64) -> Markup {
    html! {
        br;
        span class="small" { (number(mass_g * (1.0 - spread_ratio))) "–" (quantity(mass_g * (1.0 + spread_ratio), "g")) }
    }
}

/// The path of a file, which breaks behind `/`, `_` and `-` where the line is too short.
pub(super) fn file_name(path: &str) -> Markup {
    html! { code { @for piece in path.split_inclusive(['/', '_', '-']) { (piece) wbr; } } }
}

/// A line to write on.
pub(super) fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
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
