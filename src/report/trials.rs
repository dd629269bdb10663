//! The last step: trying what it was made for, with the figures to expect.

use maud::{Markup, html};

use super::Checklist;
use super::page::blank;
use super::words::{extent, number, quantity};
use crate::goal::GoalKind;

/// Pictures a second of a slow-motion film: most telephones take it. With 30 a top above 900 rpm turns twice in a picture.
const FILM_PER_S: f64 = 240.0;
/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;
/// The length of the board of the tilt test, mm: long enough to measure a degree (5 mm), short enough to be at hand.
const BOARD_MM: f64 = 300.0;

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
    let size_mm = sheet.finished_size_mm.unwrap_or(sheet.model.size_mm);
    let size = format!("Measure it over all, along the model's own axes: {}.", extent(&size_mm));
    let own = match sheet.goal.aim.kind {
        GoalKind::Top => top_lines(sheet),
        GoalKind::Yoyo => yoyo_lines(),
        GoalKind::Stand => standing_lines(sheet),
        GoalKind::Float => floating_lines(sheet),
        GoalKind::Balance => rotor_lines(sheet),
    };
    [size].into_iter().chain(own).collect()
}

/// How to find a centre of mass with a thread, and where it must be.
fn hang(place: &str) -> String {
    format!(
        "Find its balance point: hang it by a thread from two places, one after the other. The line of the thread, carried on through it, \
         passes through the centre of mass both times: {place}."
    )
}

/// How to try a top.
fn top_lines(sheet: &Checklist) -> Vec<String> {
    let height = quantity(sheet.assembly.center_height_mm, "mm");
    let spin = sheet.assembly.critical_speed_rpm.map(|rpm| {
        format!(
            "Spin it upright on its contact point, on a hard smooth table, faster than {}, which is {} turns a second. It stays upright; \
             as friction slows it below that speed it leans over and falls. To see its speed, put a mark on its side and film it with \
             {FILM_PER_S} pictures a second: at that speed a turn takes {} pictures.",
            quantity(rpm, "rpm"),
            number(rpm / S_PER_MIN),
            number((FILM_PER_S * S_PER_MIN / rpm).round())
        )
    });
    let hang = hang(&format!("on the spin axis, {height} above the contact point"));
    tip(sheet).into_iter().chain([hang]).chain(spin).collect()
}

/// How to try a yo-yo.
fn yoyo_lines() -> Vec<String> {
    vec![
        hang("in the spin point, on the axis"),
        "Hold it between two points on its axis: it stays however it is turned, as its centre of mass lies on the axis.".to_owned(),
        "Spin it up about its axis and let go in the air: it goes on turning about that axis and does not wobble.".to_owned(),
    ]
}

/// How to try what stands.
fn standing_lines(sheet: &Checklist) -> Vec<String> {
    let height = quantity(sheet.assembly.center_height_mm, "mm");
    let tilt = sheet.assembly.topples_deg.map(|deg| {
        format!(
            "Set it on a rough board, {} long, and raise one end slowly: it stands until the board leans by {}, when that end is {} up, \
             whichever way it is turned.",
            quantity(BOARD_MM, "mm"),
            quantity(deg, "°"),
            quantity(BOARD_MM * deg.to_radians().sin(), "mm")
        )
    });
    [hang(&format!("{height} above the ground"))].into_iter().chain(tilt).collect()
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
