//! The step of a job sheet in which ballast is laid on a panel of a base, with its picture.

use std::fmt::Write;

use maud::{Markup, PreEscaped, html};

use crate::base::numbers::measured;
use crate::base::units::format_count;
use crate::sheet::core_kit::{BALLAST_GLUE, BallastRow, CoreSheet};

/// Margin of the picture, mm.
const MARGIN_MM: f64 = 18.0;
/// Distance of an edge's words from it, and their height, mm.
const WORDS_MM: [f64; 2] = [9.0, 8.0];

/// Returns how ballast is laid; nothing without any.
pub(super) fn lay(sheet: &CoreSheet) -> Markup {
    let Some(first) = sheet.ballast.first() else {
        return html! {};
    };
    html! {
        div class="together" {
            p {
                "☐ Glue " (format_count(sheet.ballast.len(), "piece")) " of " code { (first.id) } " on the inside of panel " (first.panel)
                " with " (BALLAST_GLUE) ", before it is joined: " (measured(sheet.masses.ballast_g, "g"))
                " in all. Weigh them first. Roughen both sides with emery cloth, wipe them clean, and wear gloves: the glue harms skin until it is hard. "
                "The picture shows the panel from inside. Each edge has the number of the panel that comes there. "
                "Measure square to a ruler that lies along the tips of an edge's fingers."
            }
            ul class="ticks" {
                @for (index, row) in sheet.ballast_rows.iter().enumerate() {
                    li { "Piece " (index + 1) ": its centre is " (places(row)) "." }
                }
            }
            (PreEscaped(picture(sheet)))
        }
    }
}

/// Words the distances of a piece from its edges.
fn places(row: &BallastRow) -> String {
    let distances = row.from.iter();
    let words: Vec<String> = distances
        .map(|edge| {
            format!(
                "{} from the edge to panel {}",
                measured(edge.distance_mm, "mm"),
                edge.to
            )
        })
        .collect();
    words.join(" and ")
}

/// Writes the number of the next panel beside each edge.
fn edge_words(sheet: &CoreSheet) -> String {
    let [apart_mm, high_mm] = WORDS_MM;
    let mut words = String::new();
    for edge in &sheet.ballast_edges {
        let [start, end] = edge.ends_mm;
        let way = [end[0] - start[0], end[1] - start[1]];
        let length_mm = way[0].hypot(way[1]);
        let out = [way[1] / length_mm, -way[0] / length_mm];
        let at = [0, 1].map(|k| f64::midpoint(start[k], end[k]) + out[k] * apart_mm);
        let [x, y] = seen_inside(at);
        let _ = write!(
            words,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{high_mm}\" text-anchor=\"middle\" \
             dominant-baseline=\"central\" stroke=\"none\" fill=\"currentColor\">panel {}</text>",
            edge.to
        );
    }
    words
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
    let mut pieces = edge_words(sheet);
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
