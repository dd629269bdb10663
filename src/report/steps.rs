//! The steps of a job in the order they are done, with boxes to tick and to fill.

use maud::{Markup, html};

use super::hardware::fitting;
use super::joinery::{cut_list, films};
use super::page::{figure, mass_window, mass_with_window};
use super::words::{coordinates, quantity};
use super::{BallastRow, Checklist, JointRow, PartRow, Picture, VoidRow};
use crate::goal::GoalKind;
use crate::units::{MM3_PER_CM3, counted};
use crate::verify::FillOrder;

/// The share of a void's surface in sight from which nothing is said of hidden corners: sampling cannot tell more.
const ALL_IN_SIGHT_RATIO: f64 = 0.995;

/// Every step: print, clean, dry fit, fill the voids or lay in the ballast where that is asked for, glue, put in what is not
/// printed, weigh, test.
pub(super) fn steps(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    let steps = [
        Some(("Print", print(sheet, pictures))),
        Some(("Clean every void", clean(sheet))),
        Some(("Dry fit", dry_fit(sheet))),
        sheet.fill.map(|fill| ("Fill every void", filling(sheet, fill))),
        (!sheet.ballast.is_empty()).then(|| ("Lay in the ballast", ballast(sheet))),
        Some(("Glue", glue(sheet))),
        (!sheet.hardware.is_empty()).then(|| ("Put in the hardware", fitting(sheet))),
        Some(("Weigh", weigh(sheet))),
        Some(("Test", test(sheet))),
    ];
    html! {
        @for (index, (name, step)) in steps.iter().flatten().enumerate() {
            section { h2 { (index + 1) ". " (name) } (step) }
        }
    }
}

fn filling(sheet: &Checklist, fill: FillOrder) -> Markup {
    html! {
        p {
            "With the cut faces up and level, fill every piece of a void flush with its cut face with a material of "
            (quantity(fill.density_g_cm3, "g/cm³")) ", without bubbles, and let it set. Keep sockets and cut faces clean."
        }
        table {
            tr { th { "Done" } th { "Void" } th class="n" { "Filling, in all its pieces" } th { "Weighed, g" } }
            @for void in &sheet.voids {
                tr {
                    td { "☐" } td { strong { (void.id) } }
                    td class="n" { (quantity(void.volume_mm3 / MM3_PER_CM3, "cm³")) ", " (quantity(void.volume_mm3 / MM3_PER_CM3 * fill.density_g_cm3, "g")) }
                    td { (blank()) }
                }
            }
        }
    }
}

fn ballast(sheet: &Checklist) -> Markup {
    html! {
        p { "Weigh each piece first: one outside its window spoils the balance. Glue it into its pocket so that it cannot rattle." }
        table {
            tr {
                th { "Done" } th { "Piece" } th class="n" { "Mass" } th { "Weighed, g" } th { "Into" } th { "Centre, model frame" }
            }
            @for row in &sheet.ballast { (ballast_line(row)) }
        }
        p class="small" { "What the sizes and masses rest on:" }
        @for source in ballast_sources(sheet) { p class="small" { (source) } }
    }
}

fn ballast_line(row: &BallastRow) -> Markup {
    let lump = &row.order.lump;
    html! {
        tr {
            td { "☐" }
            td { strong { (row.order.id) } ": " (row.name) " (" code { (row.part) } ")" }
            td class="n" { (mass_window(lump.mass_g, row.mass_spread_ratio)) }
            td { (blank()) }
            td { "pocket " (row.void) ", open along " (row.opened_by.join(", ")) ", " (quantity(row.clearance_mm, "mm")) " of room all around" }
            td { (coordinates(&lump.center_mm)) @if !lump.shape.is_ball() { ", axis " (coordinates(&lump.axis)) } }
        }
    }
}

/// The sources of the ballast's numbers, each once.
fn ballast_sources(sheet: &Checklist) -> Vec<&String> {
    let mut sources: Vec<&String> = sheet.ballast.iter().flat_map(|row| &row.sources).collect();
    sources.sort();
    sources.dedup();
    sources
}

fn print(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    let picture_of =
        |part: &PartRow| pictures.iter().find(|picture| part.picture.as_ref() == Some(&picture.file));
    html! {
        p {
            "Files are in mm, each in its print pose, resting on z = 0. Do not turn, scale or repair them, and do not let the slicer fill the voids."
        }
        ul class="ticks" {
            @for part in &sheet.parts {
                li {
                    strong { (part.id) } ": " code { (part.file) } ", " (part.lies) ", layers of " (quantity(sheet.printer.layer_mm, "mm"))
                    "." br; span class="field" { "Machine " (blank()) } " " span class="field" { "Lot " (blank()) }
                }
            }
        }
        div class="pictures" {
            @for picture in sheet.parts.iter().filter_map(picture_of) { (figure(picture)) }
        }
    }
}

fn clean(sheet: &Checklist) -> Markup {
    html! {
        @if sheet.voids.is_empty() { p { "There are no voids: nothing to clean." } }
        ul class="ticks" {
            @for void in &sheet.voids { (clean_one(sheet, void)) }
        }
    }
}

fn clean_one(sheet: &Checklist, void: &VoidRow) -> Markup {
    let full_g = void.volume_mm3 / MM3_PER_CM3 * sheet.material.density_g_cm3;
    html! {
        li {
            strong { (void.id) } ", " (quantity(void.volume_mm3 / MM3_PER_CM3, "cm³")) ", "
            @if void.opened_by.is_empty() { strong class="fail" { "opened by no cut" } }
            @else {
                "opened by " (void.opened_by.join(", ")) " to " (quantity(void.opening_mm, "mm")) " across, "
                (quantity(void.depth_mm, "mm")) " deep"
            }
            ". " (void.clean)
            @if let Some(hidden) = hidden_ratio(sheet, void) {
                " " (format!("{:.0} %", hidden * 100.0)) " of its wall is out of sight of the opening: reach it with a bent tool."
            }
            " Left full of support, it adds about " (quantity(full_g, "g")) "."
        }
    }
}

/// The share of a void's wall that is out of sight, if there is one and support must be seen to be removed.
fn hidden_ratio(sheet: &Checklist, void: &VoidRow) -> Option<f64> {
    let needs_sight = matches!(sheet.printer.support.as_str(), "breakaway" | "water-jet");
    void.sight_ratio.filter(|sight| needs_sight && *sight < ALL_IN_SIGHT_RATIO).map(|sight| 1.0 - sight)
}

fn dry_fit(sheet: &Checklist) -> Markup {
    html! {
        @if sheet.joints.is_empty() { p { "It is one part: nothing to fit." } }
        (cut_list(sheet))
        ul class="ticks" {
            @for joint in &sheet.joints {
                li {
                    strong { (joint.id) } ": " (joint.parts[0]) " on " (joint.parts[1]) " along " (joint.cut) ". "
                    @if joint.pins == 0 { "No pins: align the outlines by eye and touch." }
                    @else { (counted(joint.pins, "pin")) " must seat fully. No gap and no step at the seam." }
                }
            }
        }
    }
}

fn glue(sheet: &Checklist) -> Markup {
    html! {
        @if sheet.joints.is_empty() { p { "Nothing to glue." } }
        @else {
            p { "In this order; each joint sets before the next." }
            table {
                tr {
                    th { "Done" } th { "Joint" } th { "Parts" } th { "Cut" } th class="n" { "Area" } th { "Alignment" } th { "Adhesive, clamped until" }
                }
                @for joint in &sheet.joints { (glue_line(joint)) }
            }
            @if sheet.goal.aim.kind == GoalKind::Float {
                p { strong { "Seal every joint all around: " } "a void that fills with water sinks it or turns it over." }
            }
            (films(sheet))
            p class="small" { "Thin glue, kept off the voids: a gram of it off the axis is a gram out of balance." }
        }
    }
}

fn glue_line(joint: &JointRow) -> Markup {
    html! {
        tr {
            td { "☐" }
            td { strong { (joint.id) } }
            td { (joint.parts.join(" + ")) }
            td { (joint.cut) }
            td class="n" { (quantity(joint.area_mm2, "mm²")) }
            td {
                @if joint.pins == 0 { "no room for pins" }
                @else { (counted(joint.pins, "pin")) ", clearance " (quantity(joint.clearance_mm, "mm")) " a side" }
                @if let Some(note) = &joint.note { br; (note) }
            }
            td { (blank()) }
        }
    }
}

fn weigh(sheet: &Checklist) -> Markup {
    html! {
        @if sheet.material.density_spread_ratio.is_none() {
            p {
                "The density is not measured (" (sheet.material.density_sure) "), so no window is given, only each part's share of the whole, which no density changes. "
                "Print and weigh coupons for a window: " code { "equipoise coupon --printer " (sheet.printer.id) }
            }
        }
        table {
            tr { th { "What" } th class="n" { "Expected" } th { "Weighed, g" } th { @if sheet.material.density_spread_ratio.is_some() { "In the window" } @else { "Share of the whole, %" } } }
            @for part in &sheet.parts {
                tr { td { (part.id) } td class="n" { (mass_with_window(sheet, part.mass_g)) } td { (blank()) } td { (tick_or_blank(sheet)) } }
            }
            tr {
                td { strong { (all_glued(sheet)) } } td class="n" { (assembled_mass(sheet)) } td { (blank()) } td { (tick_or_blank(sheet)) }
            }
        }
        p class="small" { "A part too heavy still holds support or powder: clean it again before gluing." }
    }
}

/// A box to tick where there is a window, a line to write a share on where there is none.
fn tick_or_blank(sheet: &Checklist) -> Markup {
    if sheet.material.density_spread_ratio.is_some() {
        html! { "☐" }
    } else {
        blank()
    }
}

fn all_glued(sheet: &Checklist) -> &'static str {
    if sheet.hardware.is_empty() { "all, glued" } else { "all, glued, with the hardware" }
}

/// The mass of everything, with the window that the print's density and the pieces of ballast leave.
fn assembled_mass(sheet: &Checklist) -> Markup {
    let printed_g: f64 = sheet.parts.iter().map(|part| part.mass_g).sum();
    let spread_g: f64 = sheet.ballast.iter().map(|row| row.order.lump.mass_g * row.mass_spread_ratio).sum();
    let mass_g = sheet.assembly.mass_g;
    match sheet.material.density_spread_ratio {
        // A filling is as heavy as it was mixed: its own spread is not known here.
        Some(ratio) => mass_window(mass_g, (ratio * printed_g + spread_g) / mass_g),
        None => mass_with_window(sheet, mass_g),
    }
}

fn test(sheet: &Checklist) -> Markup {
    html! {
        ul class="ticks" {
            @for line in test_lines(sheet) { li { (line) } }
            li { "Result: " (blank()) }
        }
    }
}

/// What to try, with the figures to expect.
fn test_lines(sheet: &Checklist) -> Vec<String> {
    let body = &sheet.assembly;
    let height = quantity(body.center_height_mm, "mm");
    match sheet.goal.aim.kind {
        GoalKind::Top => {
            let speed = body.critical_speed_rpm.map(|rpm| {
                format!(
                    "Spin it on its contact point faster than {}: it stays upright, and falls below that.",
                    quantity(rpm, "rpm")
                )
            });
            let hang = format!("Its centre of mass lies {height} above the contact point, on the axis.");
            tip(sheet).into_iter().chain(speed).chain([hang]).collect()
        }
        GoalKind::Yoyo => vec![
            "Held between two points on its axis it stays however it is turned: its centre of mass lies on the axis."
                .to_owned(),
            "Spun up about its axis and let go in the air, it goes on turning about it and does not wobble.".to_owned(),
        ],
        GoalKind::Stand => {
            let tilt = body.topples_deg.map(|deg| {
                format!(
                    "Set on a tilted board it stands up to {}, whichever way it is turned.",
                    quantity(deg, "°")
                )
            });
            let height = format!("Its centre of mass lies {height} above the ground.");
            tilt.into_iter().chain([height]).collect()
        }
        GoalKind::Float => floating_lines(sheet),
        GoalKind::Balance => rotor_lines(sheet),
    }
}

/// How to try what floats.
fn floating_lines(sheet: &Checklist) -> Vec<String> {
    let is_measured = sheet.material.density_spread_ratio.is_some();
    let only_if = if is_measured {
        String::new()
    } else {
        let mass = quantity(sheet.assembly.mass_g, "g");
        format!("Its density was not measured: if it weighs {mass}, ")
    };
    let depth = sheet.assembly.afloat.map(|afloat| {
        format!(
            "{only_if}{} lies {} deep; leaned by {} to any side and let go, it comes back.",
            if is_measured { "It" } else { "it" },
            quantity(afloat.waterline_mm, "mm"),
            quantity(afloat.rights_from_deg, "°")
        )
    });
    let tight =
        "Held under water for a minute no bubbles rise from the seams, and it weighs as much as before.";
    [tight.to_owned()].into_iter().chain(depth).collect()
}

/// How to try a rotor.
fn rotor_lines(sheet: &Checklist) -> Vec<String> {
    let residual = sheet.assembly.unbalance.map(|unbalance| {
        format!(
            "On a balancing machine, planes at its two ends: no more than {} is left in either.",
            quantity(unbalance.end_plane_g_mm, "g·mm")
        )
    });
    let level = "Laid with its shaft on two level knife edges, it stays however it is turned.".to_owned();
    [level].into_iter().chain(residual).collect()
}

/// What to add under a top whose contact point hangs in the air.
fn tip(sheet: &Checklist) -> Option<String> {
    let gap_mm = sheet.goal.contact_gap_mm;
    (gap_mm > 0.0).then(|| {
        let gap = quantity(gap_mm, "mm");
        format!("Its contact point hangs {gap} below it: glue on a tip of that length, as light as may be; the figures do not count its mass.")
    })
}

/// A line to write on.
fn blank() -> Markup {
    html! { span class="fill" { "\u{a0}" } }
}
