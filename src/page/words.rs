//! Goals, promises and proofs in words.

use super::deed::{floats, handles, runs_true};
use super::hardware::{rod, word};
use crate::base::numbers::{coordinates, measured, number, quantity, quantity_or_dash};
use crate::base::units::{format_count, show_wobble};
use crate::goal::GoalKind;
use crate::sheet::{
    Certificate, Checklist, GoalRow, ObjectiveName, Process, Taken, Taker, WallRow,
};
use crate::verify::{
    CONTACT_LIMIT_MM, Check, Comparison, FigureName, Hardware, HardwareKind, SpinFacts,
};

/// Relative difference up to which the ordered and the printed wall count as equal.
const SAME_WALL_RATIO: f64 = 1e-3;

/// Relative gap of a certificate up to which it is rounding, of either sign.
const NO_GAP_RATIO: f64 = 1e-9;

/// Words the goal and the objective, in one sentence.
pub fn goal(goal: &GoalRow) -> String {
    let [at, along] = [&goal.aim.origin_mm, &goal.aim.axis].map(coordinates);
    let best = best(goal.objective).to_owned() + &weights(goal);
    match goal.aim.kind {
        GoalKind::Top => {
            format!(
                "top: spins on its contact point {at}\u{a0}mm about the axis {along}, with {best}"
            )
        }
        GoalKind::Yoyo => {
            format!("yo-yo: spins about the axis {along} through {at}\u{a0}mm, with {best}")
        }
        GoalKind::Stand => {
            format!("standing: {along} is up, the middle of its support {at}\u{a0}mm, with {best}")
        }
        GoalKind::Float => format!(
            "floating: {along} is up, {}with {best}",
            goal.aim.water.map_or(String::new(), |order| format!(
                "in a liquid of {} up to {} above its lowest point, ",
                quantity(order.liquid_g_cm3, "g/cm³"),
                quantity(order.waterline_mm, "mm")
            ))
        ),
        GoalKind::Balance => format!(
            "rotor: turns about the axis {along} through {at}\u{a0}mm{}, with {best}",
            goal.aim.rotor.map_or(String::new(), |order| format!(
                " at {}",
                quantity(order.speed_rpm, "rpm")
            ))
        ),
        GoalKind::Match => format!(
            "match: has the mass, the centre of mass {at}\u{a0}mm and the inertia of another body, with {best}"
        ),
    }
}

/// Words the weights of Spin-It's functional; empty without weights, and for a yo-yo, which has
/// only one.
fn weights(goal: &GoalRow) -> String {
    match (goal.aim.kind, goal.spin_it_weights) {
        (GoalKind::Top, Some([c, i])) => format!(" (γ_c = {}, γ_I = {})", number(c), number(i)),
        _ => String::new(),
    }
}

/// Words what an objective asks for.
fn best(objective: ObjectiveName) -> &'static str {
    match objective {
        ObjectiveName::CriticalSpeed => "the least speed at which it stays upright",
        ObjectiveName::SpinIt => "the least value of Spin-It's functional",
        ObjectiveName::Dominance => "the most dominant axis",
        ObjectiveName::TopplingAngle => "the largest tilt before it topples",
        ObjectiveName::LowestCenter => "the lowest centre of mass",
        ObjectiveName::MetacentricHeight => "the greatest metacentric height",
        ObjectiveName::LeastRemoved => "the least material removed that balances it",
        ObjectiveName::LeastUnbalance => "the least unbalance",
        ObjectiveName::LeastChange => "the least change of infill",
    }
}

/// Words what the finished object does, in one sentence with its figure.
pub fn promise(sheet: &Checklist) -> String {
    let body = &sheet.assembly;
    match (
        sheet.goal.aim.kind,
        body.critical_speed_rpm,
        body.topples_deg,
        body.dominance_ratio,
    ) {
        (GoalKind::Top, Some(rpm), _, _) => format!("Spins upright from {}.", measured(rpm, "rpm")),
        (GoalKind::Top, None, _, _) => "Does not spin upright at any speed.".to_owned(),
        (GoalKind::Yoyo, _, _, Some(ratio)) if ratio < 1.0 => {
            format!("Spins steadily as a yo-yo: {}.", show_wobble(ratio))
        }
        (GoalKind::Yoyo, ..) => "Does not spin steadily about its axis.".to_owned(),
        (GoalKind::Stand, _, Some(tilt), _) if tilt > 0.0 => {
            format!("Stands until tilted by {}.", measured(tilt, "°"))
        }
        (GoalKind::Stand, ..) => "Does not stand.".to_owned(),
        (GoalKind::Float, ..) => floats(sheet),
        (GoalKind::Balance, ..) => runs_true(sheet),
        (GoalKind::Match, ..) => handles(sheet),
    }
}

/// Words what is printed and glued: parts, joints with the planes they lie in, pins, voids.
pub fn pieces(sheet: &Checklist) -> String {
    let pins = sheet.parts.iter().map(|part| part.pins.len()).sum();
    let planes = sheet.cuts.len();
    // Several joints may lie in one plane, and a shop would look for more cuts.
    let in_planes = match planes {
        _ if planes >= sheet.joints.len() => String::new(),
        1 => " (in one plane)".to_owned(),
        _ => format!(" (in {planes} planes)"),
    };
    let plugs = sheet.plugs().count();
    let cells = sheet.cells.as_ref().map_or(0, |own| own.places_mm.len());
    let counts = [
        (sheet.parts.len().saturating_sub(plugs), "part", ""),
        (plugs, "plug", ""),
        (sheet.drains.len(), "drain hole", ""),
        (sheet.joints.len(), "glue joint", in_planes.as_str()),
        (pins, "pin", ""),
        (sheet.voids.len(), "void", ""),
        (cells, "cell", ""),
    ];
    let counts = counts.into_iter().filter(|(count, ..)| *count > 0);
    let words = counts.map(|(count, word, more)| format_count(count, word) + more);
    words.collect::<Vec<_>>().join(", ")
}

/// Words an axis that is not the natural up.
pub fn axis_off(off_deg: f64) -> String {
    format!(
        "{off_deg:.0}° off the model's natural up, on which it would not spin; hold it as in the \
         picture"
    )
}

/// Words what is bought and not printed, and what it is cut to; `None` if that is nothing.
pub fn bought(sheet: &Checklist) -> Option<String> {
    let name = |piece: &Hardware| match piece.kind {
        HardwareKind::Ring => rod(piece),
        _ => format!("{} ({})", word(&piece.kind), rod(piece)),
    };
    let names: Vec<String> = sheet.hardware.iter().map(name).collect();
    (!names.is_empty()).then(|| format!("to buy: {}", names.join("; ")))
}

/// The last words of a promise that its value completes, such as "it stands until tilted by".
const OPEN_ENDS: [&str; 10] = [
    " by", " of", " from", " within", " is", " least", " most", " than", " for", " G",
];

/// Words a broken promise in one sentence, with what was measured and what is promised.
pub fn broken(check: &Check) -> String {
    let (kind, promise, unit) = (&check.kind, &check.promise, &check.unit);
    if check.limit == 0.0 && unit.is_empty() && check.comparison == Comparison::AtMost {
        let found = check.value.map_or_else(|| "not known".to_owned(), number);
        return format!("Broken: {kind}, {promise}: {found}; it must be none.");
    }
    let limit = quantity(check.limit, unit);
    let value = check.value.map(|value| {
        let is_clear = measured(value, unit) != measured(check.limit, unit);
        let words = if is_clear { measured } else { quantity };
        words(value, unit)
    });
    let found = match value {
        Some(value) if OPEN_ENDS.iter().any(|end| promise.ends_with(end)) => format!(" {value}"),
        Some(value) => format!(": measured {value}"),
        None => ": there is no such value".to_owned(),
    };
    let than = match check.comparison {
        Comparison::AtMost => "at most",
        Comparison::AtLeast => "at least",
        Comparison::Below => "less than",
        Comparison::Above => "more than",
    };
    format!("Broken: {kind}, {promise}{found}; {than} {limit} is promised.")
}

/// Words the part of a top that touches the floor and how far it leans; `None` for other goals.
pub fn spins_on(sheet: &Checklist) -> Option<String> {
    let SpinFacts {
        has_tip,
        radius_mm,
        lean_deg,
        gap_mm,
        ..
    } = sheet.goal.spins_on?;
    let part = if has_tip {
        format!(
            "a tip with a round end of {} radius",
            measured(radius_mm, "mm")
        )
    } else if gap_mm > CONTACT_LIMIT_MM {
        return Some(format!(
            "nothing yet: its contact is {} off it",
            measured(gap_mm, "mm")
        ));
    } else if radius_mm > 0.0 {
        format!(
            "its own foot, round as a ball of {} radius",
            measured(radius_mm, "mm")
        )
    } else {
        "its own foot".to_owned()
    };
    let name = if has_tip { "tip" } else { "foot" };
    let clear = if lean_deg > 0.0 {
        let lean = measured(lean_deg, "°");
        format!("leaned by less than {lean} only the {name} touches the floor")
    } else {
        "other places touch the floor first".to_owned()
    };
    let waived = if sheet.goal.aim.least_lean_deg == Some(0.0) {
        "; no lean was promised"
    } else {
        ""
    };
    Some(format!("{part}; {clear}{waived}"))
}

/// Words the certificate, a sentence each.
pub fn certificate(sheet: &Checklist) -> Vec<String> {
    let (proof, unit) = (&sheet.certificate, sheet.certificate.figure.unit());
    let is_change = proof.figure == FigureName::InfillChangeRatio;
    let is_top = sheet.goal.aim.kind == GoalKind::Top;
    let better = if proof.figure.more_is_better() {
        "higher"
    } else {
        "lower"
    };
    let what = if is_change {
        "infill of these densities that does what was asked"
    } else {
        "hollowing"
    };
    let mut words = vec![
        format!(
            "It is proved that no {what} of this model with a wall of {}{}{} has a {} {better} than {}.",
            quantity(sheet.wall.required_mm, "mm"),
            solid_places(sheet),
            if is_top {
                " and its centre of mass at this height"
            } else {
                ""
            },
            proof.figure.name(),
            quantity(proof.bound, unit)
        ),
        match sheet
            .infill
            .as_ref()
            .and_then(|infill| infill.field.as_ref())
        {
            Some(field) => format!(
                "The field that was ordered has {}: {field}.",
                quantity(proof.value, unit)
            ),
            None => format!(
                "The calculated optimum is {}, {} away from that.",
                quantity(proof.value, unit),
                gap(proof.gap_ratio)
            ),
        },
    ];
    words.extend((is_top && !is_change).then(|| other_heights(proof)));
    words.extend(proof.proof.as_ref().map(|first| {
        format!(
            "If only the wall stayed solid, no hollowing could have a {} {better} than {}. Anyone can check this without the solver: `verify` does, from the numbers in checklist.json.",
            proof.figure.name(),
            quantity(first.bound, unit)
        )
    }));
    words.extend(proof.written_value.map(|written| {
        let share = proof.share_of_bound(written);
        format!(
            "The files of this kit, with {}, reach {}: {:.2} % of the best possible.",
            what_is_made(sheet),
            quantity(written, unit),
            share * 100.0
        )
    }));
    words
}

/// Words what the files have beyond the calculated voids.
fn what_is_made(sheet: &Checklist) -> &'static str {
    match (sheet.cuts.is_empty(), sheet.drains.is_empty()) {
        (true, false) if sheet.cells.is_some() => "walls of cells, drain holes and rounding",
        (true, false) => "drain holes and rounding",
        (true, true) => "rounding",
        (false, _) => "pins, sockets and rounding",
    }
}

/// Words what took a tenth or more of the best figure; `None` if the kit is nearer to it.
pub fn shortfall(sheet: &Checklist) -> Option<String> {
    let shortfall = sheet.shortfall()?;
    let (figure, unit) = (sheet.certificate.figure, sheet.certificate.figure.unit());
    // A figure that should be small can lose more than all of it: then shares of the loss are told.
    let all: f64 = shortfall.taken.iter().map(|taken| taken.ratio).sum();
    let whole = all.max(1.0);
    let loses = if all > 1.0 {
        "Of the loss go"
    } else {
        "It loses"
    };
    let words = |taken: &Taken| {
        let what = match taken.by {
            Taker::Cleaning => &format!("where the inside stays solid because it {}", fault(sheet)),
            Taker::Plan => "to what the plan keeps solid",
            Taker::Bosses => "to bosses around pins",
            Taker::Making if sheet.cells.is_some() => "to cells that stay solid, and rounding",
            Taker::Making if sheet.cuts.is_empty() => "to drain holes and rounding",
            Taker::Making => "to cuts, pins and rounding",
        };
        format!("{:.0}\u{a0}% {what}", 100.0 * taken.ratio / whole)
    };
    let taken: Vec<String> = shortfall.taken.iter().map(words).collect();
    Some(format!(
        "If it needed no cuts and no cleaning, a {} of {} would be possible with this wall; \
         this kit reaches {}. {loses} {}.",
        figure.name(),
        measured(shortfall.best, unit),
        measured(shortfall.reached, unit),
        taken.join(", ")
    ))
}

/// Words the wall as it was ordered, as the printer makes it, and as measured.
pub fn wall(wall: &WallRow) -> String {
    let given = quantity(wall.required_mm, "mm");
    let ordered = match wall.asked_mm {
        Some(asked_mm) if (asked_mm - wall.required_mm).abs() > SAME_WALL_RATIO * asked_mm => {
            format!(
                "{} ordered, {given} as the printer makes it",
                quantity(asked_mm, "mm")
            )
        }
        Some(_) => format!("{given} ordered"),
        None => format!("{given}, the least this printer makes"),
    };
    let thinnest = quantity_or_dash(wall.measured_min_mm, "mm");
    format!("{ordered}; thinnest measured {thinnest}")
}

/// Words what was wrong with voids that stay solid.
fn fault(sheet: &Checklist) -> &'static str {
    match sheet.printer.process {
        Process::Sla => "could not be drained or cleaned",
        _ => "could not be cleaned",
    }
}

/// Words what the proof assumes solid besides the wall; empty if nothing.
fn solid_places(sheet: &Checklist) -> String {
    let proof = &sheet.certificate;
    let unclean = format!("where voids {}", fault(sheet));
    let by_plan = proof.cleaning_rounds.iter().any(|round| round.by_plan);
    let reasons = [
        (proof.kept_solid_mm3 > 0.0, &unclean[..]),
        (by_plan, "where the plan keeps it so"),
        (proof.bosses_mm3 > 0.0, "in bosses around pins"),
    ];
    let words: Vec<&str> = reasons
        .into_iter()
        .filter_map(|(is_so, words)| is_so.then_some(words))
        .collect();
    if words.is_empty() {
        String::new()
    } else {
        format!(", solid {},", words.join(" and "))
    }
}

/// Words the proof for other heights of a top's centre of mass.
fn other_heights(proof: &Certificate) -> String {
    let Some(over) = proof.over_heights else {
        return "Other heights of the centre of mass were searched, and none was better; a proof for them is missing."
            .to_owned();
    };
    format!(
        "At any other height of the centre of mass the {} could be lower by at most {} of it (proved on columns {} apart).",
        proof.figure.name(),
        number(1.0 - over.bound / over.value),
        quantity(over.pitch_mm, "mm")
    )
}

/// Words the relative distance between the optimum and its proved bound.
fn gap(ratio: f64) -> String {
    if ratio.abs() <= NO_GAP_RATIO {
        format!("less than {} of it", number(NO_GAP_RATIO))
    } else {
        format!("{} of it", number(ratio))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::CleaningRow;
    use crate::testing::sample;
    use crate::verify::{CheckKind, Limit};

    #[test]
    fn the_proof_names_the_places_that_stay_solid() {
        let (mut sheet, _) = sample();
        let is_said = |sheet: &Checklist| {
            certificate(sheet)[0].contains("solid where voids could not be cleaned")
        };
        assert!(!is_said(&sheet));
        sheet.certificate.kept_solid_mm3 = 12.0;
        assert!(is_said(&sheet));
        sheet.certificate.bosses_mm3 = 5.0;
        assert!(is_said(&sheet) && certificate(&sheet)[0].contains("in bosses around pins"));
        assert!(!certificate(&sheet)[0].contains("the plan keeps it so"));
        let round = CleaningRow {
            voids: Vec::new(),
            volume_mm3: 3.0,
            value_before: 1.0,
            value_after: Some(1.1),
            by_plan: true,
        };
        sheet.certificate.cleaning_rounds.push(round);
        assert!(
            certificate(&sheet)[0].contains("cleaned and where the plan keeps it so and in bosses")
        );
    }

    #[test]
    fn joints_in_one_plane_are_told_with_their_plane() {
        let (mut sheet, _) = sample();
        let joint = sheet.joints[0].clone();
        assert!(!pieces(&sheet).contains("plane"), "{}", pieces(&sheet));
        sheet.joints = vec![joint; 3];
        let said = pieces(&sheet);
        assert!(said.contains("3 glue joints (in one plane)"), "{said}");
        sheet.cuts.push(sheet.cuts[0].clone());
        assert!(pieces(&sheet).contains("(in 2 planes)"));
    }

    #[test]
    fn what_is_lost_does_not_contradict_what_the_cuts_allow() {
        let (mut sheet, _) = sample();
        let proof = &mut sheet.certificate;
        proof.value_before_cleaning = Some(100.0);
        proof.written_value = Some(200.0);
        proof.cleaning_rounds.clear();
        sheet.rounds.clear();
        let said = shortfall(&sheet).unwrap().replace('\u{a0}', " ");
        let best = "If it needed no cuts and no cleaning, a critical speed of 100 rpm would be";
        assert!(said.starts_with(best), "{said}");
        assert!(
            said.contains("It loses 100 % to cuts, pins and rounding."),
            "{said}"
        );
    }

    #[test]
    fn a_broken_promise_says_what_was_measured_and_what_is_promised() {
        let words = |kind: CheckKind, promise: &str, value: f64, limit: Limit| {
            broken(&Check::new(kind, promise, Some(value), limit))
        };
        assert_eq!(
            words(
                CheckKind::Standing,
                "it stands, and topples when tilted by",
                1.123,
                Limit::at_least(5.0, "°")
            ),
            "Broken: standing, it stands, and topples when tilted by 1.1°; at least 5° is promised."
        );
        let offset = "the centre of mass lies on the spin axis";
        assert_eq!(
            words(
                CheckKind::AxisOffset,
                offset,
                0.4,
                Limit::at_most(0.05, "mm")
            )
            .replace('\u{a0}', " "),
            "Broken: axis offset, the centre of mass lies on the spin axis: measured 0.4 mm; \
             at most 0.05 mm is promised."
        );
        let wall = "every wall between a void and the outside is at least";
        assert!(
            words(CheckKind::Wall, wall, 0.86, Limit::at_least(0.9, "mm"))
                .contains("is at least 0.86\u{a0}mm; at least 0.9\u{a0}mm is promised")
        );
        let crossings = "no surface passes through itself";
        assert!(
            words(
                CheckKind::SelfIntersections,
                crossings,
                3.0,
                Limit::at_most(0.0, "")
            )
            .ends_with("itself: 3; it must be none.")
        );
    }

    #[test]
    fn a_top_that_does_not_lean_is_not_said_to_lean_by_nothing() {
        let mut sheet = sample().0;
        sheet.goal.spins_on = Some(SpinFacts {
            has_tip: true,
            radius_mm: 2.0,
            lean_deg: 0.0,
            below_mm: 0.0,
            gap_mm: 0.0,
        });
        let said = spins_on(&sheet).unwrap();
        assert!(
            said.contains("; other places touch the floor first"),
            "{said}"
        );
    }

    #[test]
    fn a_wall_is_worded_as_ordered_and_as_printed() {
        let words = |asked_mm| {
            wall(&WallRow {
                required_mm: 1.016,
                asked_mm,
                measured_min_mm: Some(1.01),
            })
        };
        assert!(
            words(Some(1.0))
                .starts_with("1\u{a0}mm ordered, 1.016\u{a0}mm as the printer makes it")
        );
        assert!(words(Some(1.016)).starts_with("1.016\u{a0}mm ordered; thinnest"));
        assert!(words(None).contains("the least this printer makes"));
    }
}
