//! The last step: trying what it was made for, with the figures to expect.

use maud::{Markup, html};

use super::fields::blank;
use crate::base::numbers::{extent, number, quantity};
use crate::goal::GoalKind;
use crate::sheet::{Checklist, FootRow};

/// Pictures a second of a slow-motion film: most telephones take it. With 30 a top above 900 rpm
/// turns twice in a picture.
const FILM_PER_S: f64 = 240.0;

/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

/// Up to this tilt a foot was tried, degrees: what rights itself from there is not told to fall
/// from farther.
const MOST_TILT_DEG: f64 = 45.0;

/// The length of the board of the tilt test, mm: long enough to measure a degree (5 mm), short
/// enough to be at hand.
const BOARD_MM: f64 = 300.0;

/// Where it balances, and what it must do.
pub(super) fn test(sheet: &Checklist) -> Markup {
    html! {
        ul class="ticks together" {
            @for line in test_lines(sheet) { li { (line) } }
            li { "Result: " (blank()) }
        }
    }
}

/// What to try, with the figures to expect.
fn test_lines(sheet: &Checklist) -> Vec<String> {
    let size_mm = sheet.finished_size_mm.unwrap_or(sheet.model.size_mm);
    let size = format!(
        "Measure it over all, along the model's own axes: {}.",
        extent(&size_mm)
    );
    let own = match sheet.goal.aim.kind {
        GoalKind::Top => top_lines(sheet),
        GoalKind::Yoyo => yoyo_lines(sheet),
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

/// How to try a top: one that falls when it is slow, or one that stands on its foot.
fn top_lines(sheet: &Checklist) -> Vec<String> {
    let height = quantity(sheet.assembly.center_height_mm, "mm");
    let hang = hang(&format!(
        "on the spin axis, {height} above the contact point"
    ));
    let rpm = sheet.assembly.critical_speed_rpm;
    let spin: Vec<String> = match sheet.foot {
        Some(foot) => foot_lines(&foot, rpm).collect(),
        None => rpm.map(falling_line).into_iter().collect(),
    };
    tip(sheet).into_iter().chain([hang]).chain(spin).collect()
}

/// How to try a top that falls when it is slow.
fn falling_line(rpm: f64) -> String {
    format!(
        "Spin it upright on its contact point, on a hard smooth table, faster than {}, which is {} turns a second. It stays upright; \
         as friction slows it below that speed it leans over and falls. To see its speed, put a mark on its side and film it with \
         {FILM_PER_S} pictures a second: at that speed a turn takes {} pictures.",
        quantity(rpm, "rpm"),
        number(rpm / S_PER_MIN),
        number((FILM_PER_S * S_PER_MIN / rpm).round())
    )
}

/// How to try a top that stands on its foot: no fall shows the speed that is promised.
fn foot_lines(foot: &FootRow, rpm: Option<f64>) -> impl Iterator<Item = String> {
    let tilt = quantity(foot.rights_to_deg, "°");
    let beyond = if foot.rights_to_deg < MOST_TILT_DEG {
        "; leaned further it falls over"
    } else {
        ""
    };
    let rest = format!(
        "Set it on its contact without spinning it: it stands, as its foot is flatter than its centre of mass is high. Leaned by up to {tilt} \
         and let go, it comes back{beyond}."
    );
    let spin = rpm.map(|rpm| {
        format!(
            "Spin it upright on a hard smooth table: it turns about its axis, rubs on its foot, slows down and stops standing. It does not fall \
             when it is slow, so the {} promised, which are for a contact in one point, cannot be seen from a fall; they can with a tip under it.",
            quantity(rpm, "rpm")
        )
    });
    [rest].into_iter().chain(spin)
}

/// How to try a yo-yo.
fn yoyo_lines(sheet: &Checklist) -> Vec<String> {
    let string = sheet.string_gap_mm.map(|gap_mm| {
        format!(
            "Tie a string thinner than {} round the axle in the gap, wind it up, hold its end and let the yo-yo fall: it runs down the string \
             and up again without leaning to either side.",
            quantity(gap_mm, "mm")
        )
    });
    let held = [
        hang("in the spin point, on the axis"),
        "Hold it between two points on its axis: it stays however it is turned, as its centre of mass lies on the axis.".to_owned(),
        "Spin it up about its axis and let go in the air: it goes on turning about that axis and does not wobble.".to_owned(),
    ];
    held.into_iter().chain(string).collect()
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
    [hang(&format!("{height} above the ground"))]
        .into_iter()
        .chain(tilt)
        .collect()
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
    let liquid = sheet
        .goal
        .aim
        .water
        .map(|order| format!(" in a liquid of {}", quantity(order.liquid_g_cm3, "g/cm³")));
    let liquid = liquid.unwrap_or_default();
    let depth = sheet.assembly.afloat.map(|afloat| {
        format!(
            "{only_if}{} lies {} deep{liquid}; leaned by {} to any side and let go, it comes back.",
            if is_measured { "It" } else { "it" },
            quantity(afloat.waterline_mm, "mm"),
            quantity(afloat.rights_from_deg, "°")
        )
    });
    let tight = "Held under water for a minute no bubbles rise from the seams, and it weighs as much as before.";
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
    let level =
        "Laid with its shaft on two level knife edges, it stays however it is turned.".to_owned();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;

    fn told(foot: Option<FootRow>) -> String {
        let mut sheet = sample().0;
        sheet.foot = foot;
        test(&sheet).into_string()
    }

    #[test]
    fn a_top_on_a_point_falls_when_slow_and_one_on_a_flat_foot_does_not() {
        let (falls, stays) = ("leans over and falls", "does not fall when it is slow");
        let on_a_point = told(None);
        assert!(on_a_point.contains(falls) && !on_a_point.contains(stays));
        let foot = FootRow {
            radius_mm: 500.0,
            center_height_mm: 16.0,
            rights_to_deg: 45.0,
        };
        let on_a_foot = told(Some(foot));
        assert!(
            !on_a_foot.contains(falls)
                && on_a_foot.contains(stays)
                && on_a_foot.contains("45° and let go")
        );
        assert!(
            !on_a_foot.contains("leaned further"),
            "nothing is known beyond 45°"
        );
        assert!(
            told(Some(FootRow {
                rights_to_deg: 7.0,
                ..foot
            }))
            .contains("leaned further it falls over")
        );
    }
}
