//! The last steps: weigh it, and try what it was made for, with the figures to expect.

use maud::{Markup, html};

use super::Checklist;
use super::page::{blank, mass_window, mass_with_window};
use super::words::quantity;
use crate::goal::GoalKind;

/// Every part and the whole on the scales.
pub(super) fn weigh(sheet: &Checklist) -> Markup {
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

/// Where it balances, and what it must do.
pub(super) fn test(sheet: &Checklist) -> Markup {
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
