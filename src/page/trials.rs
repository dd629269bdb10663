//! The last step: the tests of the finished object, with the figures to expect.

use maud::{Markup, html};

use super::fields::blank;
use super::figure::{Picture, Role, figure};
use crate::base::numbers::{coordinates, measured, measured_extent, number, quantity};
use crate::goal::GoalKind;
use crate::sheet::{Checklist, FootRow, ShaftKind, ShaftRow};
use crate::verify::CONTACT_LIMIT_MM;

/// Frames per second of slow motion, which most telephones can film. At 30 the turns of a fast top
/// cannot be counted.
const FILM_PER_S: f64 = 240.0;

/// Seconds in a minute.
const S_PER_MIN: f64 = 60.0;

/// Greatest tilt at which a foot was computed, degrees. Of larger tilts the sheet says nothing.
const MOST_TILT_DEG: f64 = 45.0;

/// Length of the board of the tilt test, mm: long enough to measure a degree (5 mm), short enough
/// to be at hand.
const BOARD_MM: f64 = 300.0;

/// Angle up to which the lean of a board can be told, degrees: 2 mm at its end are 0.4°.
const BOARD_DEG: f64 = 0.5;

/// Returns the tests with boxes to tick and a picture of the centre of mass, and a line for the
/// result.
pub(super) fn test_step(sheet: &Checklist, pictures: &[Picture]) -> Markup {
    html! {
        div class="beside" {
            @if let Some(picture) = pictures.iter().find(|picture| picture.role == Role::Test) {
                div class="pictures" {
                    (figure(picture))
                }
            }
            ul class="ticks" {
                @for line in test_lines(sheet) { li { (line) } }
                li { "Result: " (blank()) }
            }
        }
    }
}

/// Words the tests, with the figures to expect.
fn test_lines(sheet: &Checklist) -> Vec<String> {
    let size_mm = sheet.finished_size_mm.unwrap_or(sheet.model.size_mm);
    let within = sheet.size_within_mm().map(|mm| {
        let mm = measured(mm, "mm");
        format!(", each within {mm}")
    });
    let size = format!(
        "Measure its overall size: {}{}.",
        measured_extent(&size_mm),
        within.unwrap_or_default()
    );
    let own = match sheet.goal.aim.kind {
        GoalKind::Top => top_lines(sheet),
        GoalKind::Yoyo => yoyo_lines(sheet),
        GoalKind::Stand => standing_lines(sheet),
        GoalKind::Float => floating_lines(sheet),
        GoalKind::Balance => rotor_lines(sheet),
        GoalKind::Match => match_lines(sheet),
    };
    [size].into_iter().chain(own).collect()
}

/// Words the test of the centre of mass with a thread, and where it must be.
fn hang_line(place: &str) -> String {
    format!(
        "Hang it by a thread from two places, one after the other. The line of the thread passes through the centre of mass both times: \
         {place}."
    )
}

/// Words the tests of a match.
fn match_lines(sheet: &Checklist) -> Vec<String> {
    let center = coordinates(&sheet.assembly.center_mm);
    vec![
        format!("Weigh it: {}.", measured(sheet.assembly.mass_g, "g")),
        hang_line(&format!("at {center}\u{a0}mm in the axes of the model")),
        "Hang it and the original side by side by two threads each, and turn both by the same \
         angle: they swing in step."
            .to_owned(),
    ]
}

/// Words the tests of a top: one that falls when it is slow, or one that stands on its foot.
fn top_lines(sheet: &Checklist) -> Vec<String> {
    let height = measured(sheet.assembly.center_height_mm, "mm");
    let hang = hang_line(&format!(
        "on the spin axis, {height} above the contact point"
    ));
    let rpm = sheet.assembly.critical_speed_rpm;
    let spin: Vec<String> = match sheet.foot {
        Some(foot) => foot_lines(&foot, rpm).collect(),
        None => rpm.map(falling_line).into_iter().collect(),
    };
    tip_line(sheet)
        .into_iter()
        .chain([hang])
        .chain(lean_line(sheet))
        .chain(spin)
        .collect()
}

/// Words the test of the promised lean; `None` if none is promised.
fn lean_line(sheet: &Checklist) -> Option<String> {
    let least = sheet.goal.aim.least_lean_deg.filter(|deg| *deg > 0.0)?;
    let least = quantity(least, "°");
    let foot = if sheet.goal.spins_on?.has_tip {
        "tip"
    } else {
        "round foot"
    };
    Some(format!(
        "Set it upright on a flat table and lean it by hand to every side: up to {least} only its {foot} touches the table."
    ))
}

/// Words the spin test of a top that falls when it is slow.
fn falling_line(rpm: f64) -> String {
    format!(
        "Spin it upright on a hard, smooth table, faster than {} ({:.1} turns a second). It stays upright until friction slows it \
         below that speed. To see its speed, put a mark on its side and film it at {FILM_PER_S} frames a second. \
         At that speed a turn takes {} frames. Slower, it leans over and falls.",
        measured(rpm, "rpm"),
        rpm / S_PER_MIN,
        number((FILM_PER_S * S_PER_MIN / rpm).round())
    )
}

/// Words the tests of a top that stands on its foot. It never falls, so they cannot show the
/// promised speed.
fn foot_lines(foot: &FootRow, rpm: Option<f64>) -> impl Iterator<Item = String> {
    let tilt = measured(foot.rights_to_deg, "°");
    let beyond = if foot.rights_to_deg < MOST_TILT_DEG {
        "; leaned further it falls over"
    } else {
        ""
    };
    let rest = format!(
        "Set it on its contact without spinning it: it stands, because its foot is flat enough for the height of its centre of mass. Leaned by up to {tilt} \
         and let go, it comes back{beyond}."
    );
    let spin = rpm.map(|rpm| {
        format!(
            "Spin it upright on a hard smooth table: it turns about its axis, rubs on its foot, slows down and comes to rest standing. It does not fall \
             when it is slow, so no fall shows the promised {}, which hold for contact in one point. Put a tip under it to see them.",
            measured(rpm, "rpm")
        )
    });
    [rest].into_iter().chain(spin)
}

/// Words the tests of a yo-yo.
fn yoyo_lines(sheet: &Checklist) -> Vec<String> {
    let string = sheet.string_gap_mm.map(|gap_mm| {
        format!(
            "Tie a string thinner than {} around the axle in the gap. Wind it up, hold its end and let the yo-yo fall. It runs down the string \
             and up again without leaning to either side.",
            measured(gap_mm, "mm")
        )
    });
    let held = [
        hang_line("in the spin point, on the axis"),
        "Hold it between two points on its axis: it stays in any position.".to_owned(),
        "Spin it up about its axis and let go in the air: it goes on turning about that axis and does not wobble.".to_owned(),
    ];
    held.into_iter().chain(string).collect()
}

/// Words the tests of an object that stands.
fn standing_lines(sheet: &Checklist) -> Vec<String> {
    let height = measured(sheet.assembly.center_height_mm, "mm");
    let tilt = sheet.assembly.topples_deg.map(|deg| {
        let limit = (deg > BOARD_DEG).then(|| {
            let least = measured(raised_mm(deg - BOARD_DEG), "mm");
            format!(" Reject it if it falls before that end is {least} up.")
        });
        let limit = limit.unwrap_or_default();
        format!(
            "Set it on a rough board, {} long, and raise one end slowly. It stands until the board leans by {}: that end is then {} up. \
             It does so whichever way it is turned.{limit}",
            measured(BOARD_MM, "mm"),
            measured(deg, "°"),
            measured(raised_mm(deg), "mm")
        )
    });
    [hang_line(&format!("{height} above its lowest point"))]
        .into_iter()
        .chain(tilt)
        .collect()
}

/// Returns how far the end of the board is raised when it leans, mm.
fn raised_mm(lean_deg: f64) -> f64 {
    BOARD_MM * lean_deg.to_radians().sin()
}

/// Words the tests of an object that floats.
fn floating_lines(sheet: &Checklist) -> Vec<String> {
    let is_measured = sheet.material.density_spread_ratio.is_some();
    let only_if = if is_measured {
        String::new()
    } else {
        let mass = measured(sheet.assembly.mass_g, "g");
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
            measured(afloat.waterline_mm, "mm"),
            measured(afloat.rights_from_deg, "°")
        )
    });
    let tight = "Hold it under water for a minute: no bubbles rise from the seams, and it weighs as much as before.";
    [tight.to_owned()].into_iter().chain(depth).collect()
}

/// Words the tests of a rotor.
fn rotor_lines(sheet: &Checklist) -> Vec<String> {
    let residual = sheet.goal.aim.rotor.map(|order| {
        let left_g_mm = order.allowed_g_mm(sheet.assembly.mass_g);
        format!(
            "On a balancing machine, with planes at its two ends: at most {} is left in either. \
             That is grade G\u{a0}{} at {}.",
            measured(left_g_mm, "g·mm"),
            number(order.grade_mm_s),
            quantity(order.speed_rpm, "rpm")
        )
    });
    ream_line(sheet)
        .into_iter()
        .chain([level_line(&sheet.goal.turns_on)])
        .chain(residual)
        .collect()
}

/// Words how a bore is made round where seams cross it; `None` without a bore or a seam.
fn ream_line(sheet: &Checklist) -> Option<String> {
    let shaft = sheet.goal.turns_on.first()?;
    let is_crossed = shaft.kind != ShaftKind::ShaftEnd && !sheet.joints.is_empty();
    is_crossed.then(|| {
        let diameter = measured(shaft.diameter_mm, "mm");
        format!("Where a seam runs in the bore, take off glue and steps: ream it to {diameter}.")
    })
}

/// Words the test of a rotor on knife edges: any position must be one of rest.
fn level_line(turns_on: &[ShaftRow]) -> String {
    let on_edges = match turns_on.first() {
        Some(ShaftRow {
            kind: ShaftKind::ShaftEnd,
            diameter_mm,
        }) => {
            let diameter = measured(*diameter_mm, "mm");
            format!("Lay its shaft ({diameter}) on two level knife edges")
        }
        Some(ShaftRow { diameter_mm, .. }) => {
            let diameter = measured(*diameter_mm, "mm");
            format!(
                "Push a straight shaft of {diameter} through its bore, and lay it on two level \
                 knife edges"
            )
        }
        None => "Put a straight shaft on its axis, and lay it on two level knife edges".to_owned(),
    };
    format!("{on_edges}: it stays in any position.")
}

/// Words the tip to add under a top whose contact point is in the air.
fn tip_line(sheet: &Checklist) -> Option<String> {
    let gap_mm = sheet.goal.contact_gap_mm;
    (gap_mm > CONTACT_LIMIT_MM).then(|| {
        let gap = measured(gap_mm, "mm");
        format!("It has no tip: its contact point is {gap} below it. It spins as stated only on a support of that height.")
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    use crate::geom::play::Play;
    use crate::testing::sample;

    #[test]
    fn a_contact_in_the_air_is_told_with_its_gap_and_one_that_touches_is_not() {
        let mut sheet = sample().0;
        assert_eq!(tip_line(&sheet), None);
        sheet.goal.contact_gap_mm = 0.04;
        assert_eq!(tip_line(&sheet), None);
        sheet.goal.contact_gap_mm = 12.6;
        let said = tip_line(&sheet).unwrap().replace('\u{a0}', " ");
        assert!(said.contains("is 12.6 mm below it"), "{said}");
    }

    fn page_of(foot: Option<FootRow>) -> String {
        let mut sheet = sample().0;
        sheet.foot = foot;
        test_step(&sheet, &[]).into_string()
    }

    #[test]
    fn a_top_on_a_point_falls_when_slow_and_one_on_a_flat_foot_does_not() {
        let (falls, stays) = ("leans over and falls", "does not fall when it is slow");
        let on_a_point = page_of(None);
        assert!(on_a_point.contains(falls) && !on_a_point.contains(stays));
        let foot = FootRow {
            radius_mm: 500.0,
            center_height_mm: 16.0,
            rights_to_deg: 45.0,
        };
        let on_a_foot = page_of(Some(foot));
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
            page_of(Some(FootRow {
                rights_to_deg: 7.0,
                ..foot
            }))
            .contains("leaned further it falls over")
        );
    }

    #[test]
    fn the_overall_size_may_differ_by_the_printer_and_by_the_step_of_a_joint() {
        let mut sheet = sample().0;
        let within = |sheet: &Checklist| test_lines(sheet)[0].replace('\u{a0}', " ");
        assert!(within(&sheet).ends_with("each within 0.2 mm."));
        sheet.joints[0].play = Some(Play {
            shift_mm: 0.2,
            turn_deg: 0.1,
            step_mm: 0.3,
        });
        assert!(
            within(&sheet).ends_with("each within 0.5 mm."),
            "{}",
            within(&sheet)
        );
    }

    #[test]
    fn a_standing_object_has_a_reject_limit_unless_it_topples_at_once() {
        let lines = |topples_deg: f64| {
            let mut sheet = sample().0;
            sheet.assembly.topples_deg = Some(topples_deg);
            standing_lines(&sheet).join(" ")
        };
        // 300 mm times the sine of 9.5°.
        let said = lines(10.0);
        assert!(
            said.contains("Reject it if it falls before that end is 49.5"),
            "{said}"
        );
        assert!(!lines(0.4).contains("Reject"));
    }
}
