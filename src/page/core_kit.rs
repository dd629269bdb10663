//! The job sheet of an object on a laser-cut base: what the shop does, in the order in which it is
//! done.

use maud::{Markup, PreEscaped, html};

use super::core_kit_ballast as ballast;
use super::core_kit_joining as joining;
use super::core_kit_work::ways;
use super::document::styled_document;
use super::fields::{blank, file_name};
use super::figure::{Picture, Role, figures};
use super::job_id::JobId;
use super::running::style;
use super::stage::{Stage, viewer};
use super::wing_frame::{self as frame, Cover};
use crate::base::numbers::{measured, measured_extent, number};
use crate::base::units::format_count;
use crate::sheet::core_kit::{CoreSheet, CutSheetRow};
use crate::verify::{CorePartKind, CutSheetPromise, UnitPromise};

/// The lines that the shop fills in.
const FIELDS: [&str; 7] = [
    "Order",
    "Quantity",
    "Due",
    "Printer",
    "Cutter",
    "Material lot",
    "Sheet lot",
];
/// The names of the steps in their order.
const STEPS: [&str; 7] = ["Buy", "Cut", "Print", "Screw on", "Join", "Close", "Test"];

/// Everything the page of an object on a base shows.
#[derive(Debug, Clone, Copy)]
pub struct CorePage<'a> {
    /// The checklist.
    pub sheet: &'a CoreSheet,
    /// SHA-256 of `checklist.json`, hexadecimal.
    pub sha256: &'a str,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// The view for a screen; `None` for a page with pictures only.
    pub view: Option<&'a Stage>,
    /// The drawings of the sheets, as SVG files.
    pub drawings: &'a [String],
}

impl CorePage<'_> {
    pub(super) fn job_id(&self) -> JobId<'_> {
        JobId {
            name: &self.sheet.job,
            sha256: self.sha256,
        }
    }
}

/// Returns the job sheet as a self-contained HTML page with its pictures.
pub fn core_job(page: &CorePage) -> String {
    let job = page.job_id();
    let join = |page: &CorePage| joining::join(page.sheet, page.pictures);
    let close = |page: &CorePage| joining::close(page.sheet);
    let steps: [fn(&CorePage) -> Markup; 7] = [buy, cut, print, screw_on, join, close, test];
    let body = html! {
        (cover(page, &job))
        main {
            @if let Some(view) = page.view { (viewer(view)) }
            (frame::steps(STEPS.into_iter().zip(steps.map(|step| step(page)))))
        }
    };
    styled_document(
        &format!("Job sheet: {}", page.sheet.job),
        &body,
        &style(&job),
    )
}

fn cover(page: &CorePage, job: &JobId) -> Markup {
    let sheet = page.sheet;
    let content = html! {
        (figures(page.pictures, Role::Cover))
        (facts(sheet))
    };
    let cover = Cover {
        job,
        promise: promise(sheet),
        broken: "✗ do not make: see certificate",
        fields: &FIELDS,
    };
    cover.draw(sheet, &content)
}

/// Words what the object does, in one sentence.
pub(super) fn promise(sheet: &CoreSheet) -> String {
    let stands = sheet.toppling_deg.map_or(String::new(), |toppling| {
        format!(" It stands until leaned by {}.", measured(toppling, "°"))
    });
    format!(
        "{} of {}, in {} on a base of {}.{stands}",
        measured_extent(&sheet.model.size_mm),
        measured(sheet.mass_g, "g"),
        format_count(shell_parts(sheet), "printed part"),
        format_count(sheet.base.panels, "panel"),
    )
}

fn shell_parts(sheet: &CoreSheet) -> usize {
    let parts = sheet.parts.iter();
    parts
        .filter(|part| part.kind == CorePartKind::Shell)
        .count()
}

fn facts(sheet: &CoreSheet) -> Markup {
    let machines = [
        ("Size", measured_extent(&sheet.model.size_mm)),
        (
            "Printer",
            format!("{}, {}", sheet.printer.name, sheet.material.name),
        ),
        (
            "Cutter",
            format!("{}, {}", sheet.cutter.name, sheet.sheet.name),
        ),
    ];
    let whole: f64 = sheet
        .cut_sheets
        .iter()
        .map(|of| of.size_mm[0] * of.size_mm[1])
        .sum();
    let base = [
        (
            "Sheets",
            format!(
                "{}, {} of their area is panels",
                format_count(sheet.cut_sheets.len(), "sheet"),
                measured(100.0 * sheet.base.panels_mm2 / whole, "%")
            ),
        ),
        (
            "Base",
            format!(
                "{}, {} of the model's volume, at least {} below its surface",
                format_count(sheet.base.panels, "panel"),
                measured(100.0 * sheet.base.volume_ratio, "%"),
                measured(sheet.distance_mm, "mm")
            ),
        ),
        (
            "Edges",
            format!(
                "{} with fingers, {} with brackets, {} glued alone",
                sheet.base.finger_edges, sheet.base.bracket_edges, sheet.base.glued_edges
            ),
        ),
    ];
    let rows = machines.into_iter().chain(masses(sheet));
    let rows = rows.chain(ways(sheet)).chain(base);
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
        }
    }
}

/// Returns the rows of masses.
fn masses(sheet: &CoreSheet) -> [(&'static str, String); 3] {
    let masses = &sheet.masses;
    let grams = |g: f64| measured(g, "g");
    [
        ("Mass", grams(sheet.mass_g)),
        (
            "of which",
            format!(
                "printed parts {}, panels {}, brackets {}, screws and inserts {}, glue {}{}{}",
                grams(masses.shell_g),
                grams(masses.panels_g),
                grams(masses.brackets_g),
                grams(masses.fasteners_g),
                grams(masses.glue_g),
                match sheet.rods.is_empty() {
                    true => String::new(),
                    false => format!(", rods {}", grams(masses.rods_g)),
                },
                match sheet.ballast.is_empty() {
                    true => String::new(),
                    false => format!(", ballast {}", grams(masses.ballast_g)),
                }
            ),
        ),
        (
            "By the paper",
            format!(
                "{} if solid down to the base, by the supplement to CofiFab (2016) with its panels \
                 taken as thin",
                grams(masses.paper_g)
            ),
        ),
    ]
}

fn buy(page: &CorePage) -> Markup {
    html! {
        table class="stack" {
            thead { tr { th scope="col" { "Thing" } th scope="col" class="n" { "Pieces" } th scope="col" { "Id" } } }
            tbody {
                @for row in &page.sheet.buy {
                    tr {
                        th scope="row" { "☐ " (row.name) }
                        td class="n" data-head="Pieces" { (row.count) }
                        td data-head="Id" { code { (row.id) } }
                    }
                }
            }
        }
        p class="small" { "And wood glue for the panels" @if let Some(glue) = &page.sheet.printer.glue { ", " (glue) " for parts that are glued to parts" } "." }
        @if let Some(safety) = &page.sheet.printer.glue_safety { p class="warn" { strong { "Danger: " } (safety) } }
    }
}

fn cut(page: &CorePage) -> Markup {
    let sheet = page.sheet;
    let cutter = &sheet.cutter;
    html! {
        p {
            "Measure the sheet: the joints are drawn for " (measured(sheet.sheet.cut.thickness_mm, "mm"))
            " (" (sheet.sheet.thickness_source) "). "
            @if cutter.compensates_kerf { "Leave the offset of your software on: it offsets the lines." }
            @else {
                "Switch off the offset of your software: the lines are offset for a cut of "
                (measured(cutter.kerf_mm, "mm")) " (" (cutter.kerf_source) "). "
                "Set its merging of lines to 0.01 mm at most, or it eats the reliefs in inner corners."
            }
            " Engrave first, then cut holes, then outlines. The engraved side is the inside: parts will cover the other one."
        }
        @for (index, (of, row)) in sheet.cut_sheets.iter().zip(&sheet.sheet_rows).enumerate() {
            div class="together" {
                (cut_sheet(of, row))
                @if let Some(svg) = page.drawings.get(index) { (PreEscaped(fitted(svg))) }
            }
        }
    }
}

fn cut_sheet(of: &CutSheetPromise, row: &CutSheetRow) -> Markup {
    let panels: Vec<String> = of.panels.iter().map(|at| at.panel.to_string()).collect();
    let [length, width] = of.size_mm;
    html! {
        h3 { "☐ " (file_name(&of.dxf)) }
        p {
            (measured(length, "mm")) " × " (measured(width, "mm")) @if of.is_turned { " (the sheet lies turned by a quarter)" } ", panels " (panels.join(", ")) ". Cut "
            (measured(row.cut_mm / 1000.0, "m")) " in " (row.pierces) " pieces, engrave "
            (measured(row.engraved_mm / 1000.0, "m")) ". Panels fill " (measured(100.0 * row.sheet_ratio, "%")) " of it."
            @if let Some(seconds) = row.cut_s { " About " (measured(seconds / 60.0, "min")) " of cutting, as an estimate." }
        }
    }
}

/// The hairlines of drawings, and lines that are seen on the page.
const HAIRLINE: &str = "stroke-width=\"0.1\"";
const SEEN: &str = "stroke-width=\"0.8\"";

/// Returns a drawing as wide as the page, but so low that two sheets share one on paper.
fn fitted(svg: &str) -> String {
    let body = svg.split_once("viewBox=").map_or("", |(_, body)| body);
    let body = body.replace(HAIRLINE, SEEN);
    format!(
        "<svg role=\"img\" aria-label=\"The sheet with its panels\" style=\"width:100%;max-height:105mm\" viewBox={body}"
    )
}

fn print(page: &CorePage) -> Markup {
    let sheet = page.sheet;
    html! {
        p {
            "Layers of " (number(sheet.printer.layer_mm)) "\u{a0}mm, solid (100 % infill), never scaled. "
            "The parts lie in their files as they are printed; the plates hold all of them."
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Part" } th scope="col" { "Lies" } th scope="col" class="n" { "Size" }
                    th scope="col" class="n" { "Mass" } th scope="col" class="n" { "Weighed" } th scope="col" { "Held by" }
                }
            }
            tbody {
                @for (part, row) in sheet.parts.iter().zip(&sheet.part_rows) {
                    tr {
                        th scope="row" { "☐ " (row.id) " " (file_name(&part.file)) }
                        td data-head="Lies" { (row.lies) }
                        td class="n" data-head="Size" { (measured_extent(&row.size_mm)) }
                        td class="n" data-head="Mass" { (measured(row.mass_g, "g")) }
                        td class="n" data-head="Weighed" { (blank()) }
                        td data-head="Held by" { (row.held_by) }
                    }
                }
            }
        }
    }
}

fn screw_on(page: &CorePage) -> Markup {
    let sheet = page.sheet;
    html! {
        p {
            "Press the inserts hot into the bores of the parts, flush. Screw brackets to the outside of their panel first: "
            "their heads lie under the parts. "
            @if !sheet.pins.is_empty() { "Glue the parts of one panel to each other first, in the order below: their pins let them together one way. A part with several joints closes all of them at once. " }
            "Then screw every part to its panel from inside, on the bench. "
            "Glue parts that bear on no panel only when all is joined."
        }
        (pins(sheet))
        (figures(page.pictures, Role::Bench))
        (joining::rods(sheet))
        (ballast::lay(sheet))
        (figures(page.pictures, Role::Ballast))
        table class="stack" {
            thead { tr { th scope="col" { "Unit" } th scope="col" { "Panel" } th scope="col" { "Things" } th scope="col" class="n" { "Screws" } } }
            tbody {
                @for unit in sheet.units.iter().filter(|unit| unit.panel.is_some()) {
                    tr {
                        th scope="row" { "☐ " (unit.id) }
                        td data-head="Panel" { @if let Some(panel) = unit.panel { (panel) } }
                        td data-head="Things" { (unit.parts.join(", ")) }
                        td class="n" data-head="Screws" { (screws(sheet, unit)) }
                    }
                }
            }
        }
    }
}

/// Returns the list of the joints with pins, those within a unit first.
fn pins(sheet: &CoreSheet) -> Markup {
    let unit_of = |id: &String| sheet.units.iter().position(|unit| unit.parts.contains(id));
    let mut joints: Vec<(bool, [&String; 2], usize)> = Vec::new();
    for peg in &sheet.pins {
        let pair = [&peg.on, &peg.into];
        match joints.iter_mut().find(|(_, known, _)| *known == pair) {
            Some((_, _, count)) => *count += 1,
            None => joints.push((unit_of(&peg.on) != unit_of(&peg.into), pair, 1)),
        }
    }
    joints.sort_by_key(|(is_later, ..)| *is_later);
    html! {
        @if !joints.is_empty() {
            ul class="ticks" {
                @for (is_later, [on, into], count) in joints {
                    li {
                        (into) " on " (on) ", " (format_count(count, "pin"))
                        @if is_later { ", when all is joined" }
                        @if count == 1 { " (hold it straight: one pin lets it turn)" }
                        "."
                    }
                }
            }
        }
    }
}

/// Counts the screws of a unit.
fn screws(sheet: &CoreSheet, unit: &UnitPromise) -> usize {
    let fasteners = sheet.fasteners.iter();
    let own = fasteners.filter(|one| {
        one.kind == crate::verify::FastenerKind::Screw && unit.parts.contains(&one.part)
    });
    own.count()
}

fn test(page: &CorePage) -> Markup {
    let sheet = page.sheet;
    html! {
        ul class="ticks" {
            li { "Weigh it: " (measured(sheet.mass_g, "g")) " by calculation. Weighed: " (blank()) }
            @if let (Some(least), Some(toppling)) = (sheet.least_angle_deg, sheet.toppling_deg) {
                li {
                    "Set it on a level table. Lean it by " (measured(least, "°")) " to every side: it must come back. "
                    "By calculation it topples at " (measured(toppling, "°")) "."
                }
            }
            li { "Push at every part by hand: none may move." }
        }
    }
}
