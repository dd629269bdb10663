//! The checklist as one page a shop works from: no network, no script, good on a screen and on A4.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::base64::base64;
use super::steps::steps;
use super::words::{self, extent, number, quantity, quantity_or_dash};
use super::{Checklist, PartRow, Picture, Verdict};
use crate::verify::Check;

/// How the page looks; part of the page, so that it is one file.
const STYLE: &str = include_str!("page.css");
/// How much of a hash is shown: enough to tell files apart by eye. The whole is in checklist.json.
const SHORT_HASH: usize = 12;

/// The checklist as a self-contained HTML page with the pictures inside it.
pub fn page(sheet: &Checklist, pictures: &[Picture]) -> String {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { "Job sheet: " (sheet.job) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (header(sheet))
                (warnings(sheet))
                (overview(sheet, pictures))
                (parts(sheet))
                (steps(sheet, pictures))
                (checks(&sheet.checks))
                (proof(sheet))
                (sign_off())
                (small_print(sheet))
            }
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
            tr { th { "Model" } td { (sheet.model.file) ", " (extent(&sheet.model.size_mm)) ", " (quantity(sheet.model.volume_mm3 / 1000.0, "cm³")) " solid" } }
            tr { th { "Printer" } td { (sheet.printer.name) " (" (sheet.printer.process) "), " (pixels(sheet)) ", layers of " (quantity(sheet.printer.layer_mm, "mm")) } }
            tr { th { "Material" } td { (sheet.material.name) ", " (quantity(sheet.material.density_g_cm3, "g/cm³")) " (" (sheet.material.density_sure) ": " (sheet.material.density_source) ")" } }
            tr { th { "Goal" } td { (goal(sheet)) } }
            tr { th { "Mass" } td { (quantity(sheet.assembly.mass_g, "g")) " in all; " (quantity(sheet.solid.mass_g, "g")) " if it were solid" } }
            tr { th { "Wall" } td { "ordered " (quantity(sheet.wall.required_mm, "mm")) ", thinnest measured " (quantity_or_dash(sheet.wall.measured_min_mm, "mm")) } }
        }
    }
}

fn pixels(sheet: &Checklist) -> String {
    let [x, y] = sheet.printer.pixel_mm.map(|pitch| number(pitch * 1000.0));
    format!("{x} × {y}\u{a0}µm")
}

fn goal(sheet: &Checklist) -> String {
    let [origin, axis] = [sheet.goal.aim.origin_mm, sheet.goal.aim.axis].map(|v| v.map(number).join(", "));
    let kind = format!("{:?}", sheet.goal.aim.kind).to_lowercase();
    let objective = sheet.goal.objective.replace('_', " ");
    format!("{kind}, best {objective}; about ({origin})\u{a0}mm along ({axis}), model axes")
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
                th { "Lies" } th { "Pins, sockets" } th { "SHA-256" }
            }
            @for part in &sheet.parts { (part_line(sheet, part)) }
        }
        p class="small" { "One of each. Sizes are along the printer's x, y and z." }
    }
}

fn part_line(sheet: &Checklist, part: &PartRow) -> Markup {
    html! {
        tr {
            td { strong { (part.id) } br; code { (part.file) } }
            td class="n" { (mass_with_window(sheet, part.mass_g)) }
            td class="n" { (quantity(part.volume_mm3 / 1000.0, "cm³")) }
            td { (extent(&part.size_mm)) }
            td { (part.lies) }
            td { (words::counted(part.pins.len(), "pin")) ", " (words::counted(part.sockets.len(), "socket")) }
            td { code { (part.sha256.get(..SHORT_HASH).unwrap_or(&part.sha256)) } }
        }
    }
}

/// The mass, and what a sound print may weigh where the density's spread is known.
pub(super) fn mass_with_window(sheet: &Checklist, mass_g: f64) -> Markup {
    html! {
        (quantity(mass_g, "g"))
        @if let Some(spread) = sheet.material.density_spread_ratio {
            br;
            span class="small" { (number(mass_g * (1.0 - spread))) "–" (quantity(mass_g * (1.0 + spread), "g")) }
        }
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
                    td { (check.promise) @if let Some(detail) = &check.detail { br; span class="small" { (detail) } } }
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
        (bodies(sheet))
    }
}

fn bodies(sheet: &Checklist) -> Markup {
    let bodies = [("solid", &sheet.solid), ("hollowed", &sheet.hollowed), ("assembly", &sheet.assembly)];
    html! {
        table {
            tr {
                th { "Body" } th class="n" { "Mass" } th { "Centre, model axes" } th class="n" { "Off the axis" }
                th class="n" { "Axis tilt" } th class="n" { "I_b/I_c" } th class="n" { "Critical speed" }
                th class="n" { "Topples at" }
            }
            @for (name, body) in bodies {
                tr {
                    td { (name) }
                    td class="n" { (quantity(body.mass_g, "g")) }
                    td { (body.center_mm.map(number).join(", ")) "\u{a0}mm" }
                    td class="n" { (quantity_or_dash(body.axis_offset_mm, "mm")) }
                    td class="n" { (quantity_or_dash(body.axis_tilt_deg, "°")) }
                    td class="n" { (quantity_or_dash(body.dominance_ratio, "")) }
                    td class="n" { (quantity_or_dash(body.critical_speed_rpm, "rpm")) }
                    td class="n" { (quantity_or_dash(body.topples_deg, "°")) }
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
        @for source in &sheet.printer.sources { p class="small" { (source) } }
        p class="small" {
            "Made by " (sheet.tool.name) " " (sheet.tool.version) " from " (sheet.model.file) " (SHA-256 " code { (sheet.model.sha256) } ", "
            (sheet.model.triangles) " triangles, scaled by " (number(sheet.model.scale_ratio)) ") for printer profile " code { (sheet.printer.id) }
            ", material " code { (sheet.material.id) } ". The same numbers are in checklist.json; job.toml repeats the run."
        }
    }
}
