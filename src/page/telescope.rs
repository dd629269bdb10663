//! The job sheet of a telescope: what the shop does, in the order in which it is done.

use maud::{Markup, html};

use super::document::styled_document;
use super::fields::{blank, file_name};
use super::figure::{Picture, Role, figures};
use super::in_place;
use super::job_id::JobId;
use super::poses::poses;
use super::running::style;
use super::stage::{Stage, viewer};
use super::wing_frame::{self as frame, Cover};
use crate::base::numbers::{measured, measured_extent, number};
use crate::base::units::format_count;
use crate::sheet::telescope::{JointRow, TelescopePrinter, TelescopeSheet};

/// The turn below which a joint does not turn, degrees: it is not seen.
const WHOLE_TURN_DEG: f64 = 0.5;

/// The word of a broken verdict.
pub(super) const DO_NOT_PRINT: &str = "✗ do not print: see certificate";
/// The lines that the shop fills in.
pub(super) const FIELDS: [&str; 5] = ["Order", "Quantity", "Due", "Machine", "Material lot"];
/// The names of the steps in their order.
pub(super) const STEPS: [&str; 6] = ["Print", "Clean", "Dry fit", "Assemble", "Open", "Test"];

/// Everything the pages of a telescope show.
#[derive(Debug, Clone, Copy)]
pub struct TelescopePage<'a> {
    /// The checklist.
    pub sheet: &'a TelescopeSheet,
    /// SHA-256 of `checklist.json`, hexadecimal.
    pub sha256: &'a str,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// The view for a screen; `None` for a page with pictures only.
    pub view: Option<&'a Stage>,
}

impl TelescopePage<'_> {
    pub(super) fn job_id(&self) -> JobId<'_> {
        JobId {
            name: &self.sheet.job,
            sha256: self.sha256,
        }
    }
}

/// Returns the job sheet as a self-contained HTML page with its pictures.
pub fn telescope_job(page: &TelescopePage) -> String {
    let job = page.job_id();
    let steps = steps(page);
    let names: Vec<&str> = steps.iter().map(|(name, _)| *name).collect();
    let body = html! {
        (cover(page, &job))
        main {
            @if let Some(view) = page.view { (viewer(view)) }
            (frame::steps(steps))
            (sign_off(&names))
            (card(page.sheet))
        }
    };
    styled_document(
        &format!("Job sheet: {}", page.sheet.job),
        &body,
        &style(&job),
    )
}

/// Returns the steps with their names.
fn steps(page: &TelescopePage) -> Vec<(&'static str, Markup)> {
    if page.sheet.in_place {
        let steps = [
            in_place::print(page.sheet),
            in_place::clean(page.sheet),
            in_place::free(page.sheet, page.pictures),
            open(page),
            test(page),
        ];
        return in_place::STEPS.into_iter().zip(steps).collect();
    }
    let steps = [print, clean, dry_fit, assemble, open, test];
    STEPS
        .into_iter()
        .zip(steps.map(|step| step(page)))
        .collect()
}

fn cover(page: &TelescopePage, job: &JobId) -> Markup {
    let sheet = page.sheet;
    let content = html! {
        (figures(page.pictures, Role::State))
        (facts(sheet))
    };
    let cover = Cover {
        job,
        promise: promise(sheet),
        broken: DO_NOT_PRINT,
        fields: &FIELDS,
    };
    cover.draw(sheet, &content)
}

/// Words what the telescope does, in one sentence.
pub(super) fn promise(sheet: &TelescopeSheet) -> String {
    let stands = sheet.least_angle_deg.map_or(String::new(), |least| {
        format!(
            " It stands at every state until leaned by {}.",
            measured(least, "°")
        )
    });
    format!(
        "{} that open from {} to {} along the curve.{stands}",
        format_count(sheet.shells.len(), "shell"),
        measured(sheet.collapsed_mm[0], "mm"),
        measured(sheet.curve.length_mm, "mm"),
    )
}

fn facts(sheet: &TelescopeSheet) -> Markup {
    let rows: [(&str, String); 7] = [
        ("All in", measured_extent(&sheet.collapsed_mm)),
        ("All out", measured_extent(&sheet.extended_mm)),
        ("Printer", sheet.printer.name.clone()),
        ("Material", sheet.material.name.clone()),
        ("Mass", mass_words(sheet)),
        (
            "Kit",
            match sheet.in_place {
                true => format!(
                    "{}, printed in each other",
                    format_count(sheet.shells.len(), "shell")
                ),
                false => format!(
                    "{}, {}",
                    format_count(sheet.shells.len(), "shell"),
                    format_count(sheet.shells.len(), "cap")
                ),
            },
        ),
        ("Opens", sheet.order_words.clone()),
    ];
    html! {
        table class="facts" {
            @for (name, words) in rows { tr { th scope="row" { (name) } td { (words) } } }
        }
    }
}

/// Words the mass, and how much of it is ballast.
fn mass_words(sheet: &TelescopeSheet) -> String {
    let ballast_g: f64 = sheet.ballast.iter().map(|piece| piece.lump.mass_g).sum();
    let whole = measured(sheet.mass_g, "g");
    match sheet.ballast.is_empty() {
        true => whole,
        false => format!("{whole}, {} of it ballast", measured(ballast_g, "g")),
    }
}

fn print(page: &TelescopePage) -> Markup {
    let sheet = page.sheet;
    html! {
        p {
            "Layers of " (number(sheet.printer.layer_mm)) "\u{a0}mm, never scaled."
            @if sheet.printer.is_filament { " Solid (100 % infill)." }
            " The parts lie in their files as they are printed: " code { "plate.3mf" } " holds all of them."
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Part" } th scope="col" { "Lies" } th scope="col" { "Support" }
                    th scope="col" class="n" { "Size" } th scope="col" class="n" { "Mass" }
                }
            }
            tbody {
                @for (part, row) in sheet.parts.iter().zip(&sheet.part_rows) {
                    tr {
                        th scope="row" { "☐ " (row.id) " " (file_name(&part.file)) }
                        td data-head="Lies" { (row.lies) }
                        td data-head="Support" { (row.support) }
                        td class="n" data-head="Size" { (measured_extent(&row.size_mm)) }
                        td class="n" data-head="Mass" { (measured(row.mass_g, "g")) }
                    }
                }
            }
        }
    }
}

pub(super) fn clean(_page: &TelescopePage) -> Markup {
    html! {
        ul class="ticks" {
            li { "Take off all support. Nothing may be left in a bore, on a flange, or in the gap of a flange." }
            li { "Break the first layer's edge at every mouth and flange with a knife, if it stands out." }
            li { "Wash, blow out and cure as the process asks. Look through every bore against a light." }
        }
    }
}

pub(super) fn dry_fit(page: &TelescopePage) -> Markup {
    let sheet = page.sheet;
    html! {
        ul class="ticks" {
            @for joint in &sheet.joint_rows {
                li {
                    strong { (joint.id) } ": put " (joint.shells[1]) " into " (joint.shells[0])
                    " from behind, mouth first. It must slide by its own weight, "
                    @if sheet.is_pressed { "until the ring grips in the last millimetres." }
                    @else { "to its stop." }
                }
            }
            li { "Try every cap in its own shell: its slot fits the rib one way only." }
        }
        p class="small" {
            "Clearance " (measured(sheet.clearance_mm, "mm")) " on each side: " (sheet.clearance_source) "."
            @if !sheet.is_clearance_proved { " It counts as unproved until the slide coupon, or a pair of shells, was tried on this machine." }
        }
        (figures(page.pictures, Role::CutJoint))
    }
}

pub(super) fn assemble(page: &TelescopePage) -> Markup {
    let sheet = page.sheet;
    let count = sheet.shells.len();
    html! {
        p { "From the inside out. A cap goes in only after everything that lies in its shell." }
        ul class="ticks" {
            @for shell in (1..=count).rev() {
                li {
                    @if shell < count { "Put the pack of " (sheet.shells[shell].id) " into " (sheet.shells[shell - 1].id) " from behind, mouth first. " }
                    "Glue " (cap_id(sheet, shell)) " into " (sheet.shells[shell - 1].id) ": glue on the spigot alone, none on the flange, slot on the rib."
                    @if shell == 1 && sheet.foot.is_some() { " " (cap_id(sheet, 1)) " is the foot." }
                    @if shell == 1 { (lay_ballast(sheet)) }
                }
            }
        }
        (glue(&sheet.printer))
        (figures(page.pictures, Role::Exploded))
    }
}

/// Returns how ballast is glued into the foot; nothing without any.
fn lay_ballast(sheet: &TelescopeSheet) -> Markup {
    html! {
        @if let Some(first) = sheet.ballast.first() {
            " Glue " (format_count(sheet.ballast.len(), "piece")) " of " (first.name) " (" code { (first.id) } ", "
            (measured(first.lump.mass_g, "g")) " each by the list: weigh them) into its pocket, with epoxy, none of it below the foot."
        }
    }
}

/// Returns the id of the cap of a shell, from 1.
fn cap_id(sheet: &TelescopeSheet, shell: usize) -> &str {
    let mut parts = sheet.parts.iter();
    let own = parts.find(|part| part.shell == shell && !part.is_tube);
    own.map_or("", |part| part.id.as_str())
}

/// Names the glue, and how it is used.
pub(super) fn glue(printer: &TelescopePrinter) -> Markup {
    let glue = printer
        .glue
        .as_deref()
        .unwrap_or("a glue for this material");
    html! {
        p {
            "Glue: " (glue) "."
            @if let Some(hold) = printer.glue_hold_s { " Hold for " (measured(hold, "s")) "." }
            @if let Some(cure) = printer.glue_cure_h { " Whole strength after " (number(cure)) "\u{a0}h." }
        }
        @if let Some(safety) = &printer.glue_safety { p class="warn" { strong { "Danger: " } (safety) } }
    }
}

fn open(page: &TelescopePage) -> Markup {
    let sheet = page.sheet;
    let steps = sheet.order.iter().flatten();
    let row = |id: &String| sheet.joint_rows.iter().find(|joint| joint.id == *id);
    html! {
        p {
            "Open the joints " (sheet.order_words) ", one after the other: other orders were not proved free. Close them the other way round."
        }
        table class="stack" {
            thead {
                tr {
                    th scope="col" { "Joint" } th scope="col" class="n" { "Comes out" }
                    th scope="col" { "Then turns" } th scope="col" { "Slides" }
                    th scope="col" { "Stops" } th scope="col" { "Holds" }
                }
            }
            tbody { @for joint in steps.filter_map(row) { (joint_line(joint)) } }
        }
        @if sheet.is_pressed { p class="small" { "Over the last millimetres it takes a push: a ring is pressed in, and holds the shell." } }
        (poses(&sheet.poses, page.pictures))
    }
}

pub(super) fn joint_line(joint: &JointRow) -> Markup {
    html! {
        tr {
            th scope="row" { (joint.id) ": " (joint.shells[1]) " out of " (joint.shells[0]) }
            td class="n" data-head="Comes out" { (measured(joint.stroke_mm, "mm")) " ± " (measured(joint.tolerance_mm, "mm")) }
            td data-head="Then turns" { (turn(joint)) }
            td data-head="Slides" { "☐" }
            td data-head="Stops" { "☐" }
            td data-head="Holds" { "☐" }
        }
    }
}

/// Words a turn as it is seen from the tip.
fn turn(joint: &JointRow) -> String {
    if joint.turn_deg.abs() < WHOLE_TURN_DEG {
        return "not at all".to_owned();
    }
    let way = if joint.turn_deg > 0.0 {
        "left"
    } else {
        "right"
    };
    format!(
        "{way} by {} ± {}, seen from the tip",
        measured(joint.turn_deg.abs(), "°"),
        measured(joint.play_deg, "°")
    )
}

fn test(page: &TelescopePage) -> Markup {
    let sheet = page.sheet;
    html! {
        ul class="ticks" {
            li { "Open and close it three times. No joint may jam, come apart, or need a tool." }
            li {
                "All out, the tip may be moved by " (measured(sheet.tip_play_mm, "mm")) " at most, by hand and without force."
            }
            li {
                "Hold it beside the curve: it is off it by " (measured(sheet.deviation.max_mm, "mm")) " at the worst place, by design."
            }
            @if let Some(least) = sheet.least_angle_deg {
                li {
                    "Set it on a level table, all in, half open and all out. Lean its foot by " (measured(least, "°"))
                    ": it must come back."
                    @if let Some(worst) = sheet.worst_toppling_deg {
                        " By calculation it topples at " (measured(worst, "°")) " where it is worst."
                    }
                }
            }
        }
    }
}

pub(super) fn sign_off(steps: &[&str]) -> Markup {
    html! {
        section class="together" {
            h2 id="sign-off" { "Sign-off" }
            table class="stack" {
                thead { tr { th scope="col" { "Step" } th scope="col" { "Name" } th scope="col" { "Date" } th scope="col" { "Remarks" } } }
                tbody {
                    @for (index, step) in steps.iter().chain(&["Release"]).enumerate() {
                        tr {
                            th scope="row" { (index + 1) ". " (step) }
                            @for head in ["Name", "Date", "Remarks"] { td data-head=(head) { (blank()) } }
                        }
                    }
                }
            }
        }
    }
}

fn card(sheet: &TelescopeSheet) -> Markup {
    html! {
        section class="card together" aria-label="Card for the customer" {
            h2 { (sheet.job) }
            p class="promise" { (promise(sheet)) }
            p { "Pull the shells out " (sheet.order_words) ", and turn each as far as it goes. Push them in the other way round." }
            p { "Made of " (sheet.material.name) ", " (measured(sheet.mass_g, "g")) ". It is not a toy for children under three: small parts can come off." }
        }
    }
}
