//! The steps of a job sheet in which the units of an object on a base come together.

use maud::{Markup, html};

use super::fields::sentence;
use super::figure::{Picture, Role, figures};
use crate::base::numbers::measured;
use crate::base::units::format_count;
use crate::sheet::core_kit::CoreSheet;
use crate::verify::UnitPromise;

/// Returns the step of joining units, and polyhedra if there are several.
pub(super) fn join(sheet: &CoreSheet, pictures: &[Picture]) -> Markup {
    let before: Vec<&UnitPromise> = if sheet.joins.is_empty() {
        let units = &sheet.units;
        units[..units.len().saturating_sub(1)].iter().collect()
    } else {
        sheet.units.iter().filter(|unit| !unit.is_last).collect()
    };
    html! {
        p {
            "Join the units in this order, each along the normal of its panel. Wood glue on fingers and on the free flanges of brackets. "
            "Every panel has its number in its middle, and beside each edge the number of the panel that comes there."
        }
        @if sheet.joins.is_empty() { (unit_list(&before)) }
        @else { (polyhedra(sheet, &before)) }
        (figures(pictures, Role::Exploded))
        (figures(pictures, Role::CutAway))
        (figures(pictures, Role::State))
    }
}

fn unit_list(units: &[&UnitPromise]) -> Markup {
    html! {
        ol {
            @for unit in units {
                li { "☐ " (unit.id) @if !unit.parts.is_empty() { ": " (unit.parts.join(", ")) } }
            }
        }
    }
}

/// Returns the lists of several polyhedra, and how they come together.
fn polyhedra(sheet: &CoreSheet, before: &[&UnitPromise]) -> Markup {
    let own = |index: usize| {
        let units = before
            .iter()
            .filter(move |unit| unit.polyhedron == Some(index + 1));
        units.copied().collect::<Vec<&UnitPromise>>()
    };
    html! {
        p { "The base is " (sheet.base.polyhedra.len()) " polyhedra, each put together for itself. One side of each stays open, to reach its bolts or the ends of its rods." }
        @for (index, row) in sheet.base.polyhedra.iter().enumerate() {
            h3 { "Polyhedron " (index + 1) @if let Some(panel) = row.closed_by { ", without panel " (panel) } }
            (unit_list(&own(index)))
        }
        h3 { "Bring together" }
        ol {
            @for join in &sheet.joins {
                li {
                    "☐ " (sentence(&join.name())) " comes to " (join.others()) "."
                    @if join.rods > 0 {
                        " It slides on " (format_count(join.rods, "rod")) ". Put wood glue into the holes of the panel that slides on. Push until the shell parts touch. Put a ring of glue about each end inside."
                    }
                    @if join.bolts > 0 {
                        " Put " (format_count(join.bolts, "bolt"))
                        " through both panels from inside, a washer under each head and each nut. Tighten them by hand first, then all round."
                    }
                }
            }
        }
    }
}

/// Returns the step of cutting rods and gluing them into the first of their panels; empty without
/// any.
pub(super) fn rods(sheet: &CoreSheet) -> Markup {
    html! {
        @if !sheet.rods.is_empty() {
            h3 { "Rods between polyhedra" }
            p {
                "Saw them square, to half a millimetre, and break their edges. First screw the parts to the panel, on the bench. "
                "Then put wood glue into the holes of the panel. Push each rod from outside through the parts and the panel. Two rods keep a polyhedron from turning. Let the glue set."
            }
            table class="stack" {
                thead { tr {
                    th scope="col" { "Rod" }
                    th scope="col" { "From" }
                    th scope="col" class="n" { "Length" }
                    th scope="col" { "Glued into" }
                    th scope="col" class="n" { "Stands out inside" }
                    th scope="col" { "Then goes into" }
                } }
                tbody {
                    @for rod in &sheet.rods {
                        tr {
                            th scope="row" { "☐ " (rod.name) }
                            td data-head="From" { code { (rod.id) } }
                            td class="n" data-head="Length" { (measured(rod.length_mm, "mm")) }
                            td data-head="Glued into" { "panel " (rod.panels[0]) }
                            td class="n" data-head="Stands out inside" { (measured(rod.stands_mm, "mm")) }
                            td data-head="Then goes into" { "panel " (rod.panels[1]) }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the step of closing the object.
pub(super) fn close(sheet: &CoreSheet) -> Markup {
    let last: Vec<&UnitPromise> = if sheet.joins.is_empty() {
        sheet.units.last().into_iter().collect()
    } else {
        sheet.units.iter().filter(|unit| unit.is_last).collect()
    };
    let words = if last.len() > 1 {
        "come last, in this order"
    } else {
        "comes last"
    };
    let names: Vec<String> = last
        .iter()
        .map(|unit| format!("{} ({})", unit.id, unit.parts.join(", ")))
        .collect();
    html! {
        @if !names.is_empty() {
            p { "☐ " (names.join(", ")) " " (words) ". Nothing can be reached inside afterwards: look for loose screws first." }
        }
        p { "Glue, screws and brackets hold the base. It does not lock by its shape, so let the glue set before you lift it." }
    }
}
