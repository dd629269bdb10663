//! The cleaning of each void, and the material kept solid for it.

use maud::{Markup, html};

use super::fields::{residue, residue_density_ratio};
use crate::base::numbers::{coordinates, measured, quantity};
use crate::base::units::{MM3_PER_CM3, format_count};
use crate::geom::Vector;
use crate::sheet::{Checklist, Process, VoidRow, checks_of_void};
use crate::verify::{Check, CheckKind, CleaningRule, PromisedHole};

/// Least volume kept solid that is reported, mm³. Less changes no figure that is shown: other
/// differences come from solving again with pins and on the printer's own columns.
const LEAST_REPORTED_MM3: f64 = 0.05;

/// Share of a void's surface in sight from which hidden corners are not mentioned: sampling is not
/// more accurate.
const ALL_IN_SIGHT_RATIO: f64 = 0.995;

/// Sine of the rise from which a side looks up or down: 30°.
const LEVEL_SINE: f64 = 0.5;

/// Returns the instruction to clean a void, with a box to tick.
pub(super) fn clean_one(sheet: &Checklist, void: &VoidRow) -> Markup {
    let is_in_several = void.parts.len() > 1;
    html! {
        li class=[is_in_several.then_some("boxed")] {
            strong { (void.id) }
            @if let [part] = &void.parts[..] { " in " (part) } ": "
            @if !void.drained_by.is_empty() { (holes_of(sheet, void)) }
            @else if void.opened_by.is_empty() { strong class="fail" { "opened by no cut. " } }
            @else {
                (measured(void.opening_mm, "mm")) " wide at its narrowest opening and " (measured(void.depth_mm, "mm")) " deep, open at the cut face. "
            }
            @for check in checks_of_void(&sheet.checks, &void.id) {
                @if !check.pass { (broken(check)) " " }
            }
            // Holes have their own way, and a cut is of no use to them.
            @if void.drained_by.is_empty() { (void.clean) (hidden_rest(sheet, void)) }
            (left_full(sheet, void))
            (part_boxes(void))
        }
    }
}

/// Words the drain holes of a void, where they are, and how they are used.
fn holes_of(sheet: &Checklist, void: &VoidRow) -> Markup {
    let holes = sheet.drains.iter().filter(|hole| hole.void == void.id);
    let holes: Vec<&PromisedHole> = holes.collect();
    let place = |hole: &&PromisedHole| {
        let at = coordinates(&hole.from_mm);
        format!("{} on its {} at {at} mm", hole.id, side_of(sheet, hole))
    };
    let places: Vec<String> = holes.iter().map(place).collect();
    let width = holes
        .iter()
        .map(|hole| hole.diameter_mm)
        .fold(0.0, f64::max);
    html! {
        (format_count(holes.len(), "drain hole")) " of " (measured(width, "mm")) " (" (places.join("; ")) "), "
        (measured(void.depth_mm, "mm")) " to its farthest point. "
        (way_out(&sheet.printer.process, holes.len())) " "
    }
}

/// Names the side of the finished object that a hole is in: by the way it faces.
pub(super) fn side_of(sheet: &Checklist, hole: &PromisedHole) -> &'static str {
    let way = Vector::from(hole.from_mm) - Vector::from(hole.to_mm);
    let up = Vector::from(sheet.goal.aim.axis).normalize();
    match way.normalize().dot(&up) {
        rise if rise < -LEVEL_SINE => "underside",
        rise if rise > LEVEL_SINE => "upper side",
        _ => "flank",
    }
}

/// Tells how the content leaves through so many holes.
fn way_out(process: &Process, holes: usize) -> &'static str {
    match process {
        Process::Sla => {
            "Let the resin run out with one hole down and the other open, and flush solvent \
             through both."
        }
        Process::Sls | Process::Mjf if holes > 1 => {
            "Turn and knock it with a hole down, and blow into the other one until no more powder \
             comes."
        }
        Process::Sls | Process::Mjf => {
            "Turn and knock it with the hole down, and blow in with a thin nozzle until no more \
             powder comes."
        }
        _ => "Turn it so that a hole is the lowest place.",
    }
}

/// Returns a box for each part of a void that lies in several; nothing if it lies in one.
fn part_boxes(void: &VoidRow) -> Markup {
    html! {
        @if void.parts.len() > 1 {
            br; "Clean in: " @for part in &void.parts { "☐\u{a0}" (part) " " }
        }
    }
}

/// Words what is too much if a void is not cleaned. Filament printers fill no hollow with support:
/// a little is in it at most, which is told with the part's support.
fn left_full(sheet: &Checklist, void: &VoidRow) -> String {
    let Some(ratio) = residue_density_ratio(&sheet.printer.process) else {
        return String::new();
    };
    let full_g = ratio * void.volume_mm3 / MM3_PER_CM3 * sheet.material.density_g_cm3;
    let (residue, full) = (residue(&sheet.printer.process), measured(full_g, "g"));
    format!(" Left full of {residue}, it weighs about {full} too much.")
}

fn broken(check: &Check) -> Markup {
    let word = if matches!(check.kind, CheckKind::VoidOpen { .. }) {
        "Not open!"
    } else {
        "Cannot be cleaned!"
    };
    html! { strong class="fail" { (word) } }
}

/// Words how to reach what is out of sight and must be cleaned, if the cleaning rule needs sight;
/// else empty. Walls that print without support have nothing on them to clean.
fn hidden_rest(sheet: &Checklist, void: &VoidRow) -> String {
    let Some(sight) = void.sight_ratio else {
        return String::new();
    };
    let rule = sheet.printer.cleaning.rule;
    if !rule.needs_sight() || sight >= ALL_IN_SIGHT_RATIO {
        return String::new();
    }
    let percent = |ratio: f64| format!("{:.0}\u{a0}%", 100.0 * (1.0 - ratio));
    if rule != CleaningRule::InSightOrSelfSupporting {
        let rest = percent(sight);
        return format!(" The last {rest} cannot be seen: use a bent tool.");
    }
    let is_clean_share = |check: &&Check| matches!(check.kind, CheckKind::VoidClean { .. });
    let mut checks = checks_of_void(&sheet.checks, &void.id);
    let clean = checks.find(is_clean_share).and_then(|check| check.value);
    match clean.unwrap_or(sight) {
        clean if clean >= ALL_IN_SIGHT_RATIO => {
            let hidden = percent(sight);
            format!(" {hidden} of its wall cannot be seen, and prints without support.")
        }
        clean => {
            let rest = percent(clean);
            format!(" {rest} of its wall cannot be seen and may hold support: use a bent tool.")
        }
    }
}

/// Returns the cost of cleaning in sentences; empty if nothing was kept solid.
pub(super) fn cost(sheet: &Checklist) -> Markup {
    let proof = &sheet.certificate;
    let (unit, name) = (proof.figure.unit(), proof.figure.name());
    let is_reported = proof.kept_solid_mm3 >= LEAST_REPORTED_MM3;
    html! {
        @if let Some(before) = proof.value_before_cleaning.filter(|_| is_reported) {
            p {
                (aim(sheet)) (by_plan(sheet)) ", " (quantity(proof.kept_solid_mm3 / MM3_PER_CM3, "cm³"))
                " that could have been emptied stays solid: the " (name) " is " (quantity(proof.value, unit)) " instead of "
                (quantity(before, unit)) "."
            }
        }
        @if !proof.cleaning_rounds.is_empty() {
            table class="stack" {
                thead {
                    tr {
                        th scope="col" { "Round" }
                        th scope="col" { "Void and why" }
                        th scope="col" class="n" { "Kept solid" }
                        th scope="col" class="n" { "Before" }
                        th scope="col" class="n" { "After" }
                    }
                }
                tbody {
                @for (index, round) in proof.cleaning_rounds.iter().enumerate() {
                    tr {
                        th scope="row" { (index + 1) }
                        td data-head="Void and why" { @for kept in &round.voids { (kept.void) ": " (kept.why) br; } }
                        td class="n" data-head="Kept solid" { (quantity(round.volume_mm3 / MM3_PER_CM3, "cm³")) }
                        td class="n" data-head="Before" { (quantity(round.value_before, unit)) }
                        td class="n" data-head="After" {
                            @match round.value_after {
                                Some(after) => (quantity(after, unit)),
                                None => "undone: the goal could not be met",
                            }
                        }
                    }
                }
                }
            }
        }
    }
}

/// Words what ends of voids are kept solid for.
fn aim(sheet: &Checklist) -> &'static str {
    match sheet.printer.process {
        Process::Sla => "So that every void drains and can be cleaned",
        _ => "So that every void can be cleaned",
    }
}

/// Words that the plan keeps something solid too; else empty.
fn by_plan(sheet: &Checklist) -> &'static str {
    let is_any = sheet
        .certificate
        .cleaning_rounds
        .iter()
        .any(|round| round.by_plan);
    if is_any {
        ", and where the plan keeps the inside solid"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::sample;
    use crate::verify::Limit;

    #[test]
    fn a_hidden_wall_that_prints_without_support_needs_no_tool() {
        let mut sheet = sample().0;
        let mut void = sheet.voids[0].clone();
        void.sight_ratio = Some(0.71);
        let words = |sheet: &Checklist| hidden_rest(sheet, &void);
        assert!(words(&sheet).contains("The last 29\u{a0}% cannot be seen: use a bent tool"));
        sheet.printer.cleaning.rule = CleaningRule::InSightOrSelfSupporting;
        for (clean, said) in [
            (
                0.97,
                "3\u{a0}% of its wall cannot be seen and may hold support",
            ),
            (
                0.998,
                "29\u{a0}% of its wall cannot be seen, and prints without",
            ),
        ] {
            let kind = CheckKind::VoidClean {
                void: void.id.clone(),
            };
            let limit = Limit::at_least(0.95, "");
            sheet.checks = vec![Check::new(kind, "clean", Some(clean), limit)];
            assert!(words(&sheet).contains(said), "{}", words(&sheet));
        }
    }

    #[test]
    fn a_void_in_several_parts_has_a_box_for_each() {
        let sheet = sample().0;
        let mut void = sheet.voids[0].clone();
        void.parts = ["P01", "P02", "P03"].map(str::to_owned).to_vec();
        let page = clean_one(&sheet, &void).into_string();
        assert_eq!(page.matches('☐').count(), 3, "{page}");
        void.parts.truncate(1);
        let page = clean_one(&sheet, &void).into_string();
        assert!(page.contains("in P01: ") && !page.contains('☐'), "{page}");
    }
}
