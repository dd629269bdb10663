//! The back of the sheet: the checks, the proof, and the hashes of all files.

use maud::{Markup, html};

use super::cleaning::cost;
use super::deed::match_table;
use super::fields::{file_name, sentence};
use super::figure::{Picture, Role, figures, figures_of};
use super::inputs::PageInputs;
use super::words;
use crate::base::numbers::{coordinates, extent, number, quantity, quantity_or_dash};
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::sheet::{BossRow, Checklist, PartRow, VoidRow};
use crate::verify::{Check, Figures};

/// A guide to the figures.
const READING: &str = "For engineers. I_a ≤ I_b ≤ I_c are the moments of inertia about the three principal axes through the centre of mass. \
    The axis of I_c is the one a body spins about stably; the farther I_b/I_c is below 1 the better. Spin-It's functional adds the squares of such \
    ratios (for a top also the centre's height): the lower the better. It was optimised if the sheet says so, and differs from \
    the ratio or the speed on the first page. The score of a cut adds up its drawbacks: 0 is best.";

/// Returns the table of checks.
pub(super) fn checks(checks: &[Check]) -> Markup {
    html! {
        section {
            h2 { "Checks on the written files" }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Check" }
                        th scope="col" { "Promise" }
                        th scope="col" class="n" { "Measured" }
                        th scope="col" class="n" { "Limit" }
                        th scope="col" { "Verdict" }
                    }
                }
                tbody { @for check in checks { (check_line(check)) } }
            }
            p class="small" { "Measured on the triangles of the files in this kit, put together as on this sheet, by a part of the program that knows nothing of the solver." }
        }
    }
}

fn check_line(check: &Check) -> Markup {
    html! {
        tr {
            th scope="row" { (check.kind) }
            td data-head="Promise" {
                (check.promise)
                @if let Some(detail) = check.detail.as_ref().filter(|_| !check.pass) {
                    br;
                    span class="small" { (sentence(detail)) }
                }
            }
            td class="n" data-head="Measured" { (quantity_or_dash(check.value, &check.unit)) }
            td class="n" data-head="Limit" { (check.comparison.sign()) " " (quantity(check.limit, &check.unit)) }
            td data-head="Verdict" { @if check.pass { strong class="pass" { "✓ kept" } } @else { strong class="fail" { "✗ broken" } } }
        }
    }
}

/// Returns the proof in words, pictures and numbers.
pub(super) fn proof(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        section {
            h2 { "How good it is" }
            p class="small" { (READING) }
            @for sentence in words::certificate(sheet) { p { (sentence) } }
            (cost(sheet))
            (boss_rounds(sheet))
            (figures(pictures, Role::Proof))
            h3 { "Before and after" }
            p class="small" {
                "Blue: the solid ellipsoid of the same mass and inertia. The quartered disc is the centre of mass, the dash-dotted line the axis of the goal, "
                "the thick line the axis of the greatest moment I_c."
            }
            (figures_of(pictures, &[Role::Inertia, Role::Made]))
            (match_table(sheet))
            (bodies(sheet))
        }
    }
}

/// A column of the table of bodies: its head, its unit, and its figure.
type Column = (&'static str, &'static str, fn(&Figures) -> Option<f64>);

/// The columns of the table of bodies; a column is shown if a body has its figure.
const COLUMNS: [Column; 13] = [
    ("Off the axis", "mm", |body| body.axis_offset_mm),
    ("Axis tilt", "°", |body| body.axis_tilt_deg),
    ("I_b/I_c", "", |body| body.dominance_ratio),
    ("Critical speed", "rpm", |body| body.critical_speed_rpm),
    ("Centre's height", "mm", |body| Some(body.center_height_mm)),
    ("Topples at", "°", |body| body.topples_deg),
    ("Waterline", "mm", |body| {
        body.afloat.map(|afloat| afloat.waterline_mm)
    }),
    ("Off buoyancy", "mm", |body| {
        body.afloat.map(|afloat| afloat.offset_mm)
    }),
    ("GM", "mm", |body| {
        body.afloat.map(|afloat| afloat.metacentric_height_mm)
    }),
    ("Rights from", "°", |body| {
        body.afloat.map(|afloat| afloat.rights_from_deg)
    }),
    ("Static unbalance", "g·mm", |body| {
        body.unbalance.map(|unbalance| unbalance.static_g_mm)
    }),
    ("Couple", "g·mm²", |body| {
        body.unbalance.map(|unbalance| unbalance.couple_g_mm2)
    }),
    ("Grade G", "mm/s", |body| {
        body.unbalance.map(|unbalance| unbalance.grade_mm_s)
    }),
];

fn bodies(sheet: &Checklist) -> Markup {
    let bodies = [
        ("solid", &sheet.solid),
        ("hollowed", &sheet.hollowed),
        ("assembly", &sheet.assembly),
    ];
    let columns = COLUMNS
        .iter()
        .filter(|(_, _, of)| bodies.iter().any(|(_, body)| of(body).is_some()));
    let columns: Vec<&Column> = columns.collect();
    html! {
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Body" } th scope="col" class="n" { "Mass" } th scope="col" { "Centre of mass, mm" }
                    @for (head, _, _) in &columns { th scope="col" class="n" { (head) } }
                }
            }
            tbody {
                @for (name, body) in bodies {
                    tr {
                        th scope="row" { (name) }
                        td class="n" data-head="Mass" { (quantity(body.mass_g, "g")) }
                        td data-head="Centre of mass, mm" { (coordinates(&body.center_mm)) }
                        @for (head, unit, of) in &columns {
                            td class="n" data-head=(head) { (quantity_or_dash(of(body), unit)) }
                        }
                    }
                }
            }
        }
    }
}

/// Returns the table of parts with their masses as computed.
pub(super) fn parts(sheet: &Checklist) -> Markup {
    html! {
        section {
            h2 { "Parts" }
            p { "Sizes are along the printer's x, y and z; z = 0 is the plate." }
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Part" } th scope="col" { "File" } th scope="col" class="n" { "Size" }
                        th scope="col" class="n" { "Volume" } th scope="col" class="n" { "Mass" } th scope="col" class="n" { "Triangles" }
                        th scope="col" { "Pins, sockets, marks" }
                    }
                }
                tbody { @for part in &sheet.parts { (part_line(part)) } }
            }
        }
    }
}

fn part_line(part: &PartRow) -> Markup {
    html! {
        tr {
            th scope="row" { (part.id) }
            td data-head="File" { (file_name(&part.file)) }
            td class="n" data-head="Size" { (extent(&part.size_mm)) }
            td class="n" data-head="Volume" { (quantity(part.volume_mm3 / MM3_PER_CM3, "cm³")) }
            td class="n" data-head="Mass" { (quantity(part.mass_g, "g")) }
            td class="n" data-head="Triangles" { (part.triangles) }
            td data-head="Pins, sockets, marks" {
                (format_count(part.pins.len(), "pin")) ", " (format_count(part.sockets.len(), "socket"))
                @for mark in &part.marks { ", “" (mark.text) "” sunk into its face in " (mark.cut) }
            }
        }
    }
}

/// Returns the table of voids: how each is opened and cleaned.
pub(super) fn voids(sheet: &Checklist) -> Markup {
    html! {
        @if !sheet.voids.is_empty() {
            section {
                h2 { "Voids" }
                table class="stack" {
                    thead {
                        tr {
                            th scope="col" { "Void" } th scope="col" class="n" { "Volume" } th scope="col" class="n" { "Opening" }
                            th scope="col" class="n" { "Needed" } th scope="col" class="n" { "Depth" } th scope="col" class="n" { "Wall in sight" }
                            th scope="col" { "Opened by, and cleaned by" }
                        }
                    }
                    tbody { @for void in &sheet.voids { (void_line(void)) } }
                }
            }
        }
    }
}

fn void_line(void: &VoidRow) -> Markup {
    html! {
        tr {
            th scope="row" { (void.id) }
            td class="n" data-head="Volume" { (quantity(void.volume_mm3 / MM3_PER_CM3, "cm³")) }
            td class="n" data-head="Opening" { (quantity(void.opening_mm, "mm")) }
            td class="n" data-head="Needed" { (quantity(void.least_opening_mm, "mm")) }
            td class="n" data-head="Depth" { (quantity(void.depth_mm, "mm")) }
            @let sight = void.sight_ratio.map(|ratio| 100.0 * ratio);
            td class="n" data-head="Wall in sight" { (quantity_or_dash(sight, "%")) }
            td data-head="Opened by, and cleaned by" { (opened_by(void)) ": " (void.method) }
        }
    }
}

/// Names the cuts or drain holes that open a void.
fn opened_by(void: &VoidRow) -> String {
    let names = void.opened_by.iter().chain(&void.drained_by);
    names.map(String::as_str).collect::<Vec<_>>().join(", ")
}

/// Returns the hashes of all files, and the sources of the numbers.
pub(super) fn files(inputs: &PageInputs) -> Markup {
    let sheet = inputs.sheet;
    html! {
        section class="loose" {
            h2 { "Files, software and sources" }
            p { "To test whether a file belongs to this sheet, " code { "equipoise verify" } " compares all of them, " code { "sha256sum" } " a single one." }
            table class="hashes stack" {
                thead { tr { th scope="col" { "What" } th scope="col" { "SHA-256" } } }
                tbody {
                    (hash_line("checklist.json", inputs.sha256))
                    @for (file, sha256) in &sheet.files { (hash_line(file, sha256)) }
                    (hash_line(&format!("the model, {}", sheet.model.file), &sheet.model.sha256))
                    (hash_line(&format!("the printer profile, {}", sheet.printer.id), &sheet.printer.profile_sha256))
                }
            }
            p {
                "Made by " (sheet.tool.name) " " (sheet.tool.version) " from " (sheet.model.file)
                " (" (sheet.model.triangles)
                " triangles, scaled by " (number(sheet.model.scale_ratio)) ") for printer profile " code { (sheet.printer.id) } ", material "
                code { (sheet.material.id) } ". The same numbers are in checklist.json; job.toml repeats the run."
            }
            @for note in &sheet.notes { p class="small" { (sentence(note)) } }
            h3 { "Sources of the printer's numbers, and how certain they are" }
            ul class="sources small" { @for source in &sheet.printer.sources { li { (source) } } }
        }
    }
}

fn hash_line(what: &str, sha256: &str) -> Markup {
    html! { tr { th scope="row" { (what) } td data-head="SHA-256" { code { (sha256) } } } }
}

/// Returns what the rounds kept solid around pins, and what it cost.
fn boss_rounds(sheet: &Checklist) -> Markup {
    let figure = sheet.certificate.figure;
    html! {
        @for row in &sheet.rounds {
            p {
                "Boss round " (row.round) ": the walls alone leave pins too little room, so material was kept solid around "
                (list_bosses(&row.bosses)) ". The " (figure.name()) " went from " (quantity(row.before, figure.unit())) " to "
                (quantity(row.after, figure.unit())) "; " (quantity(row.kept_solid_mm3, "mm³"))
                " that could have been emptied stay solid."
            }
        }
    }
}

fn list_bosses(bosses: &[BossRow]) -> String {
    let named = bosses.iter().map(|boss| {
        format!(
            "{} at {} between {}",
            boss.pin,
            coordinates(&boss.center_mm),
            boss.parts.join(" and ")
        )
    });
    named.collect::<Vec<_>>().join(", ")
}
