//! The cleaning of each void, and the material kept solid for it.

use maud::{Markup, html};

use super::fields::residue;
use crate::base::numbers::quantity;
use crate::base::units::MM3_PER_CM3;
use crate::sheet::{Checklist, VoidRow, checks_of_void};
use crate::verify::{Check, CheckKind};

/// Least volume kept solid that is reported, mm³. Less changes no figure that is shown: other
/// differences come from solving again with pins and on the printer's own columns.
const LEAST_REPORTED_MM3: f64 = 0.05;

/// Share of a void's surface in sight from which hidden corners are not mentioned: sampling is not
/// more accurate.
const ALL_IN_SIGHT_RATIO: f64 = 0.995;

/// Returns the instruction to clean a void, with a box to tick.
pub(super) fn clean_one(sheet: &Checklist, void: &VoidRow) -> Markup {
    let full_g = void.volume_mm3 / MM3_PER_CM3 * sheet.material.density_g_cm3;
    html! {
        li {
            strong { (void.id) }
            @if !void.parts.is_empty() { " in " (void.parts.join(", ")) }
            ", " (quantity(void.volume_mm3 / MM3_PER_CM3, "cm³")) ", "
            @if void.opened_by.is_empty() { strong class="fail" { "opened by no cut" } }
            @else {
                "opened by " (void.opened_by.join(", ")) " to " (quantity(void.opening_mm, "mm")) " across ("
                (quantity(void.least_opening_mm, "mm")) " needed), " (quantity(void.depth_mm, "mm")) " deep"
            }
            ". Method: " (void.method) (in_sight(sheet, void)) ": "
            @for check in checks_of_void(&sheet.checks, &void.id) {
                (verdict(check)) " "
            }
            br; (void.clean) " Left full of " (residue(&sheet.printer.process)) ", it adds about " (quantity(full_g, "g")) "."
        }
    }
}

fn verdict(check: &Check) -> Markup {
    let word = if matches!(check.kind, CheckKind::VoidOpen { .. }) {
        "open"
    } else {
        "clean"
    };
    html! {
        @if check.pass { "✓ " (word) }
        @else { strong class="fail" { "✗ not " (word) } }
    }
}

/// Words the share of a void's wall in sight, if the cleaning rule needs sight; else empty.
fn in_sight(sheet: &Checklist, void: &VoidRow) -> String {
    let percent = |ratio: f64| format!("{:.0}", 100.0 * ratio);
    match void.sight_ratio {
        Some(sight) if sheet.printer.cleaning.rule.needs_sight() => {
            let reach = sheet.printer.cleaning.reach_mm;
            let reach = reach.map_or(String::new(), |mm| {
                format!(" within {}", quantity(mm, "mm"))
            });
            let rest = percent(1.0 - sight);
            let bent = if sight < ALL_IN_SIGHT_RATIO {
                format!(" (reach the other {rest} % with a bent tool)")
            } else {
                String::new()
            };
            format!(", {} % of the wall{reach}{bent}", percent(sight))
        }
        _ => String::new(),
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
                "So that every void can be cleaned" (by_plan(sheet)) ", " (quantity(proof.kept_solid_mm3 / MM3_PER_CM3, "cm³"))
                " that could have been emptied stays solid: the " (name) " is " (quantity(proof.value, unit)) " instead of "
                (quantity(before, unit)) "."
            }
        }
        @if !proof.cleaning_rounds.is_empty() {
            table {
                tr { th { "Round" } th { "Void and why" } th class="n" { "Kept solid" } th class="n" { "Before" } th class="n" { "After" } }
                @for (index, round) in proof.cleaning_rounds.iter().enumerate() {
                    tr {
                        td { (index + 1) }
                        td { @for kept in &round.voids { (kept.void) ": " (kept.why) br; } }
                        td class="n" { (quantity(round.volume_mm3 / MM3_PER_CM3, "cm³")) }
                        td class="n" { (quantity(round.value_before, unit)) }
                        td class="n" {
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
