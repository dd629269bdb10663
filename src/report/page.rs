//! The checklist as one page a shop works from: no network, no script, good on a screen and on A4.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::base64::base64;
use super::grid;
use super::joinery;
use super::steps::steps;
use super::words::{self, coordinates, extent, number, quantity, quantity_or_dash};
use super::{Checklist, PartRow, Picture, Verdict};
use crate::units::{MM3_PER_CM3, counted};
use crate::verify::{Check, Figures};

/// How the page looks; part of the page, so that it is one file.
const STYLE: &str = include_str!("page.css");
/// How much of a hash is shown: enough to tell files apart by eye. The whole is in checklist.json.
const SHORT_HASH: usize = 12;

/// The checklist as a self-contained HTML page with the pictures inside it.
pub fn page(sheet: &Checklist, pictures: &[Picture]) -> String {
    let body = html! {
        (header(sheet))
        (warnings(sheet))
        (overview(sheet, pictures))
        (parts(sheet))
        (steps(sheet, pictures))
        (grid::table(&sheet.grid))
        (checks(&sheet.checks))
        (proof(sheet))
        (sign_off())
        (small_print(sheet))
    };
    document(&format!("Job sheet: {}", sheet.job), &body)
}

/// A page of the shop's papers, with their look and nothing from outside.
pub fn document(title: &str, body: &Markup) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body { (body) }
        }
    }
    .into_string()
}

fn header(sheet: &Checklist) -> Markup {
    let (class, word) = match sheet.verdict {
        Verdict::Pass => ("verdict pass", "✓ all promises kept"),
        Verdict::Fail => ("verdict fail", "✗ do not print: see checks"),
    };
    html! {
        header {
            div {
                p class="small" { "Job sheet" }
                h1 { (sheet.job) }
            }
            p class=(class) { (word) }
            p class="promise" { (words::promise(sheet)) }
        }
        table class="facts" {
            tr { th { "Model" } td { (sheet.model.file) ", " (extent(&sheet.model.size_mm)) ", " (quantity(sheet.model.volume_mm3 / MM3_PER_CM3, "cm³")) " solid" } }
            tr { th { "Printer" } td { (sheet.printer.name) " (" (sheet.printer.process) "), " (pixels(sheet)) ", layers of " (quantity(sheet.printer.layer_mm, "mm")) } }
            tr { th { "Material" } td { (sheet.material.name) ", " (quantity(sheet.material.density_g_cm3, "g/cm³")) " (" (sheet.material.density_sure) ": " (sheet.material.density_source) ")" } }
            tr { th { "Goal" } td { (words::goal(&sheet.goal)) ". Coordinates are along the model's own axes." } }
            tr { th { "Mass" } td { (quantity(sheet.assembly.mass_g, "g")) " in all" (of_hardware(sheet)) @if !sheet.ballast.is_empty() { " with " (counted(sheet.ballast.len(), "piece")) " of ballast" } "; " (quantity(sheet.solid.mass_g, "g")) " if it were solid" } }
            tr { th { "Wall" } td { "ordered " (quantity(sheet.wall.required_mm, "mm")) ", thinnest measured " (quantity_or_dash(sheet.wall.measured_min_mm, "mm")) } }
        }
    }
}

/// How much of the mass is not printed.
fn of_hardware(sheet: &Checklist) -> String {
    let mass_g: f64 = sheet.hardware.iter().map(|piece| piece.mass_g).sum();
    if mass_g > 0.0 { format!(", {} of it hardware", quantity(mass_g, "g")) } else { String::new() }
}

fn pixels(sheet: &Checklist) -> String {
    let [x, y] = sheet.printer.pixel_mm.map(|pitch| number(pitch * 1000.0));
    format!("{x} × {y}\u{a0}µm")
}

fn warnings(sheet: &Checklist) -> Markup {
    html! {
        @for warning in &sheet.warnings { p class="warn" { strong { "Mind: " } (warning) } }
    }
}

/// The pictures of the whole: every picture that no part claims.
fn overview(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    let of_a_part =
        |picture: &Picture| sheet.parts.iter().any(|part| part.picture.as_ref() == Some(&picture.file));
    html! {
        h2 { "What it is" }
        div class="pictures" {
            @for picture in pictures.iter().filter(|picture| !of_a_part(picture)) { (figure(picture)) }
        }
    }
}

/// One picture with its caption.
pub(super) fn figure(picture: &Picture) -> Markup {
    let source = format!("data:image/png;base64,{}", base64(&picture.png));
    html! {
        figure {
            img src=(source) alt=(picture.caption);
            figcaption { (picture.caption) }
        }
    }
}

fn parts(sheet: &Checklist) -> Markup {
    html! {
        h2 { "Parts" }
        table {
            tr {
                th { "Part and file" } th class="n" { "Mass" } th class="n" { "Volume" } th { "Size on the plate" }
                th { "Lies with" } th { "Pins, sockets" }
            }
            @for part in &sheet.parts { (part_line(sheet, part)) }
        }
        p class="small" { "Print one of each. Sizes are along the printer's x, y and z. Below each file the first digits of its SHA-256." }
    }
}

fn part_line(sheet: &Checklist, part: &PartRow) -> Markup {
    html! {
        tr {
            td {
                strong { (part.id) } @if let Some(half) = &part.half { ", half " (half) } br; code { (part.file) } br;
                span class="small" { code { (part.sha256.get(..SHORT_HASH).unwrap_or(&part.sha256)) } }
            }
            td class="n" { (mass_with_window(sheet, part.mass_g)) }
            td class="n" { (quantity(part.volume_mm3 / MM3_PER_CM3, "cm³")) }
            td { (extent(&part.size_mm)) }
            td { (part.lies) }
            td {
                (counted(part.pins.len(), "pin")) ", " (counted(part.sockets.len(), "socket"))
                @for mark in &part.marks { br; "“" (mark.text) "” sunk into its face in " (mark.cut) }
            }
        }
    }
}

/// The mass, and what a sound print may weigh where the density was measured; else its share of the whole, which no
/// density changes.
pub(super) fn mass_with_window(sheet: &Checklist, mass_g: f64) -> Markup {
    html! {
        (quantity(mass_g, "g"))
        @if let Some(spread) = sheet.material.density_spread_ratio { (window(mass_g, spread)) }
        @else {
            br;
            span class="small" { (number(100.0 * mass_g / sheet.assembly.mass_g)) " % of the whole" }
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

fn checks(checks: &[Check]) -> Markup {
    html! {
        h2 { "Checks on the written files" }
        table {
            tr { th { "Check" } th { "Promise" } th class="n" { "Measured" } th class="n" { "Limit" } th { "Verdict" } }
            @for check in checks {
                tr {
                    td { (check.name) }
                    td { (check.promise) @if let Some(detail) = check.detail.as_ref().filter(|_| !check.pass) { br; span class="small" { (detail) } } }
                    td class="n" { (quantity_or_dash(check.value, &check.unit)) }
                    td class="n" { (check.comparison.sign()) " " (quantity(check.limit, &check.unit)) }
                    td { @if check.pass { strong class="pass" { "✓ kept" } } @else { strong class="fail" { "✗ broken" } } }
                }
            }
        }
        p class="small" { "Measured on the triangles of the files in this kit, put together as on this sheet, by a part of the program that knows nothing of the solver." }
    }
}

fn proof(sheet: &Checklist) -> Markup {
    html! {
        h2 { "How good it is" }
        @for sentence in words::certificate(sheet) { p { (sentence) } }
        (joinery::rounds(sheet))
        (bodies(sheet))
    }
}

/// A column of the table of bodies: its head, its unit, and what stands in it.
type Column = (&'static str, &'static str, fn(&Figures) -> Option<f64>);

/// What is told of a body where it is known.
const COLUMNS: [Column; 13] = [
    ("Off the axis", "mm", |body| body.axis_offset_mm),
    ("Axis tilt", "°", |body| body.axis_tilt_deg),
    ("I_b/I_c", "", |body| body.dominance_ratio),
    ("Critical speed", "rpm", |body| body.critical_speed_rpm),
    ("Centre's height", "mm", |body| Some(body.center_height_mm)),
    ("Topples at", "°", |body| body.topples_deg),
    ("Waterline", "mm", |body| body.afloat.map(|afloat| afloat.waterline_mm)),
    ("Off buoyancy", "mm", |body| body.afloat.map(|afloat| afloat.offset_mm)),
    ("GM", "mm", |body| body.afloat.map(|afloat| afloat.metacentric_height_mm)),
    ("Rights from", "°", |body| body.afloat.map(|afloat| afloat.rights_from_deg)),
    ("Static unbalance", "g·mm", |body| body.unbalance.map(|unbalance| unbalance.static_g_mm)),
    ("Couple", "g·mm²", |body| body.unbalance.map(|unbalance| unbalance.couple_g_mm2)),
    ("Grade G", "mm/s", |body| body.unbalance.map(|unbalance| unbalance.grade_mm_s)),
];

fn bodies(sheet: &Checklist) -> Markup {
    let bodies = [("solid", &sheet.solid), ("hollowed", &sheet.hollowed), ("assembly", &sheet.assembly)];
    let columns = COLUMNS.iter().filter(|(_, _, of)| bodies.iter().any(|(_, body)| of(body).is_some()));
    let columns: Vec<&Column> = columns.collect();
    html! {
        table {
            tr {
                th { "Body" } th class="n" { "Mass" } th { "Centre of mass, mm" }
                @for (head, _, _) in &columns { th class="n" { (head) } }
            }
            @for (name, body) in bodies {
                tr {
                    td { (name) }
                    td class="n" { (quantity(body.mass_g, "g")) }
                    td { (coordinates(&body.center_mm)) }
                    @for (_, unit, of) in &columns { td class="n" { (quantity_or_dash(of(body), unit)) } }
                }
            }
        }
    }
}

fn sign_off() -> Markup {
    html! {
        h2 { "Sign-off" }
        table {
            tr { th { "Step" } th { "Name" } th { "Date" } th { "Remarks" } }
            @for step in ["printed", "cleaned", "glued", "weighed", "tested", "released"] {
                tr { td { (step) } td { span class="fill" { "\u{a0}" } } td { span class="fill" { "\u{a0}" } } td { "\u{a0}" } }
            }
        }
    }
}

fn small_print(sheet: &Checklist) -> Markup {
    html! {
        h2 { "Small print" }
        @for note in &sheet.notes { p class="small" { (note) } }
        p class="small" { "What the printer's numbers rest on, and how sure they are:" }
        @for source in &sheet.printer.sources { p class="small" { (source) } }
        p class="small" {
            "Made by " (sheet.tool.name) " " (sheet.tool.version) " from " (sheet.model.file) " (SHA-256 " code { (sheet.model.sha256) } ", "
            (sheet.model.triangles) " triangles, scaled by " (number(sheet.model.scale_ratio)) ") for printer profile " code { (sheet.printer.id) }
            ", material " code { (sheet.material.id) } ". The same numbers are in checklist.json; job.toml repeats the run."
        }
    }
}
