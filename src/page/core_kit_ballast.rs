//! The step of a job sheet in which ballast is laid on a panel of a base, with its picture.

use std::fmt::Write;

use maud::{Markup, PreEscaped, html};

use crate::base::numbers::measured;
use crate::base::units::format_count;
use crate::sheet::core_kit::CoreSheet;

/// Margin of the picture, mm.
const MARGIN_MM: f64 = 4.0;

/// Returns how ballast is laid; nothing without any.
pub(super) fn lay(sheet: &CoreSheet) -> Markup {
    let Some(first) = sheet.ballast.first() else {
        return html! {};
    };
    html! {
        div class="together" {
            p {
                "☐ Glue " (format_count(sheet.ballast.len(), "piece")) " of " code { (first.id) } " on the inside of panel " (first.panel)
                " with strong glue for metal and wood, before it is joined: " (measured(sheet.masses.ballast_g, "g"))
                " in all. Weigh them first. The picture shows the panel from inside, true to scale in itself."
            }
            (PreEscaped(picture(sheet)))
        }
    }
}

/// Draws the panel from inside: mirrored, with its pieces.
fn picture(sheet: &CoreSheet) -> String {
    let corners: Vec<[f64; 2]> = sheet
        .ballast_panel_mm
        .iter()
        .map(|at| seen_inside(*at))
        .collect();
    let bound = |pick: fn(f64, f64) -> f64, start: f64, axis: usize| {
        corners.iter().map(|at| at[axis]).fold(start, pick)
    };
    let [left, top] = [0, 1].map(|axis| bound(f64::min, f64::INFINITY, axis) - MARGIN_MM);
    let [right, low] = [0, 1].map(|axis| bound(f64::max, f64::NEG_INFINITY, axis) + MARGIN_MM);
    let mut path = String::new();
    for [x, y] in &corners {
        let _ = write!(path, "{x:.1},{y:.1} ");
    }
    let mut pieces = String::new();
    for (index, piece) in sheet.ballast.iter().enumerate() {
        let [x, y] = seen_inside(piece.at_mm);
        let radius = piece.lump.shape.radius_mm();
        let _ = write!(
            pieces,
            "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius:.1}\"/>\
             <text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"8\" text-anchor=\"middle\" \
             dominant-baseline=\"central\" stroke=\"none\" fill=\"currentColor\">{}</text>",
            index + 1
        );
    }
    format!(
        "<svg role=\"img\" aria-label=\"The panel from inside, with its ballast\" \
         style=\"width:100%;max-height:80mm\" viewBox=\"{left:.1} {top:.1} {:.1} {:.1}\" \
         fill=\"none\" stroke=\"currentColor\" stroke-width=\"0.6\"><polygon points=\"{path}\"/>{pieces}</svg>",
        right - left,
        low - top
    )
}

/// Returns a point of a panel as it is seen from inside: x runs to the left, and y upward.
fn seen_inside([x, y]: [f64; 2]) -> [f64; 2] {
    [-x, -y]
}
