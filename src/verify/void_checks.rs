//! The checks of the voids: every one open and clean by the printer's rule.

use super::limits::{GAP_TOLERANCE_MM, HOLE_LIMIT_MM, OPENING_SLACK_RATIO, SIGHT_TOLERANCE_RATIO};
use super::{
    Check, CheckKind, Cleaning, CleaningRule, HoleFacts, InfillOrder, Judgement, Limit, PlugFacts,
    Promise, PromisedVoid, VoidFacts,
};
use crate::goal::GoalKind;

/// Checks that every drain hole is as free as stated and leads to its void; `None` without any.
pub(super) fn holes_check(holes: &[HoleFacts]) -> Option<Check> {
    let lack_mm = |hole: &HoleFacts| match hole.void {
        Some(_) if !hole.is_apart => hole.diameter_mm,
        Some(_) => (hole.diameter_mm - hole.free_mm).max(0.0),
        None => hole.diameter_mm,
    };
    let worst_mm = holes.iter().map(lack_mm).reduce(f64::max)?;
    let narrow = holes.iter().filter(|hole| lack_mm(hole) > HOLE_LIMIT_MM);
    let narrow: Vec<String> = narrow
        .map(|hole| match hole.void {
            Some(_) if !hole.is_apart => format!("{}: the same as another hole", hole.id),
            Some(_) => format!("{}: {:.2} mm free", hole.id, hole.free_mm),
            None => format!("{}: leads to no void", hole.id),
        })
        .collect();
    let promise = "every drain hole is free by its diameter; short by at most";
    let limit = Limit::at_most(HOLE_LIMIT_MM, "mm");
    let check = Check::new(CheckKind::DrainHoles, promise, Some(worst_mm), limit);
    Some(check.at((!narrow.is_empty()).then(|| narrow.join("; "))))
}

/// Length by which a plug must be wider than its hole, on each side, mm.
const LEAST_HOLD_MM: f64 = 0.05;

/// Checks that every plug has its gap in its hole and cannot fall in, and that every hole of what
/// floats has one; `None` without plugs that are stated or needed.
pub(super) fn plugs_check(promise: &Promise, plugs: &[PlugFacts]) -> Option<Check> {
    let floats = promise.goal.kind == GoalKind::Float;
    let open = promise
        .drains
        .iter()
        .filter(|hole| floats && hole.plug.is_none());
    let open = open.map(|hole| (f64::INFINITY, format!("{}: water gets in", hole.id)));
    let stated = plugs.iter().map(|plug| {
        let (part, hole, ordered_mm) = (&plug.part, &plug.hole, plug.ordered_gap_mm);
        match plug.gap_mm {
            None => (
                f64::INFINITY,
                format!("{part} for {hole}: not there, or not its own"),
            ),
            Some(_) if ordered_mm <= 0.0 => (f64::INFINITY, format!("{part} has no gap in {hole}")),
            Some(_) if plug.hold_mm < LEAST_HOLD_MM => {
                (f64::INFINITY, format!("{part} falls into {hole}"))
            }
            Some(gap_mm) => {
                let lack_mm = (ordered_mm - gap_mm).max(0.0);
                (lack_mm, format!("{part} in {hole}: {gap_mm:.3} mm"))
            }
        }
    });
    let all: Vec<(f64, String)> = open.chain(stated).collect();
    let worst_mm = all.iter().map(|(lack_mm, _)| *lack_mm).reduce(f64::max)?;
    let wrong = all
        .iter()
        .filter(|(lack_mm, _)| *lack_mm > GAP_TOLERANCE_MM);
    let wrong: Vec<&str> = wrong.map(|(_, words)| words.as_str()).collect();
    let promise = "every plug has its gap on each side in its drain hole; short by at most";
    let limit = Limit::at_most(GAP_TOLERANCE_MM, "mm");
    let check = Check::new(CheckKind::Plugs, promise, Some(worst_mm), limit);
    Some(check.at((!wrong.is_empty()).then(|| wrong.join("; "))))
}

/// Returns the check of a void that stays in one piece: holes wide enough, and for a liquid two.
fn drained_checks(promise: &Promise, cleaning: &Cleaning, void: &VoidFacts) -> Vec<Check> {
    let least_mm = promise.printer.minimum_opening_mm.unwrap_or(0.0);
    let open = match promise.drains_liquid() {
        false => opening_check(void, cleaning.pair_opening_mm, least_mm),
        true => {
            let second_mm = void.openings_mm.first().and_then(|widths| widths.get(1));
            let words = format!("{} has a drain and a vent, each of at least", void.id);
            let kind = CheckKind::VoidOpen {
                void: void.id.clone(),
            };
            let limit = Limit::at_least(least_mm * (1.0 - OPENING_SLACK_RATIO), "mm");
            let value = Some(second_mm.copied().unwrap_or(0.0));
            Check::new(kind, &words, value, limit)
        }
    };
    let reached = cleaning.reach_mm.map(|_| {
        let words = format!(
            "the wall of {} is within reach of its holes, to a share of",
            void.id
        );
        let kind = CheckKind::VoidClean {
            void: void.id.clone(),
        };
        let limit = Limit::at_least(cleaning.sight_ratio, "");
        Check::new(kind, &words, Some(void.sight_ratio), limit)
    });
    std::iter::once(open).chain(reached).collect()
}

/// The most by which a region may stick out of the one around it, mm: the rounding of files, and
/// what is smoothed of slivers.
const NESTED_MM: f64 = 1e-3;

/// Checks that a print of one piece has its regions of sparse infill, and no other cavity.
///
/// An STL cannot say that its cavity is infill: there the region must have a file of its own.
/// A region inside of another must be there, and nowhere stick out of that.
pub(super) fn regions_check(promise: &Promise, found: &Judgement, infill: &InfillOrder) -> Check {
    let parts = &found.parts;
    let inner = infill.inner.iter().enumerate().filter(|(index, level)| {
        let facts = found.inner_regions.get(*index);
        facts.is_none_or(|facts| facts.count != level.regions || facts.outside_mm > NESTED_MM)
    });
    let inner_faults = inner.count() + found.inner_regions.len().abs_diff(infill.inner.len());

    let found: usize = parts.iter().map(|part| part.cavities).sum();
    let is_stl = |file: &str| file.ends_with(".stl");
    let unsaid = infill.levels().iter().any(|level| level.file.is_none());
    let unsaid = unsaid && promise.parts.iter().any(|part| is_stl(&part.file));
    let wrong = found.abs_diff(infill.regions) + usize::from(unsaid) + inner_faults;
    let promise = "every region of sparse infill is there, and there is no void besides";
    let limit = Limit::at_most(0.0, "");
    Check::new(
        CheckKind::ClosedCavities,
        promise,
        Some(wrong as f64),
        limit,
    )
}

/// Checks that every void is open and clean by the printer's rule; empty if no cleaning was
/// ordered.
pub(super) fn void_checks(promise: &Promise, found: &[VoidFacts]) -> Vec<Check> {
    let Some(cleaning) = promise.printer.cleaning else {
        return Vec::new();
    };
    // Infill is no void, and stays inside.
    if promise.infill.is_some() {
        return Vec::new();
    }
    let mut checks = Vec::new();
    for (index, void) in found.iter().enumerate() {
        let is_drained = promise.drains.iter().any(|hole| hole.void == void.id);
        if is_drained && promise.can_drain(&cleaning) {
            checks.extend(drained_checks(promise, &cleaning, void));
            continue;
        }
        let ordered = promise.voids.get(index);
        let least_mm = ordered
            .and_then(|void| void.least_opening_mm)
            .or(promise.printer.minimum_opening_mm);
        checks.push(opening_check(
            void,
            cleaning.pair_opening_mm,
            least_mm.unwrap_or(0.0),
        ));
        let share = match cleaning.rule {
            CleaningRule::InSight => Some(("in sight of its openings", void.sight_ratio)),
            CleaningRule::InSightOrSelfSupporting => Some((
                "in sight of its openings, or printed without support",
                void.clean_ratio,
            )),
            CleaningRule::MeltOut | CleaningRule::PowderEscape => None,
        };
        checks.extend(share.map(|(what, ratio)| {
            let promise = format!("the wall of {} is {what}, to a share of", void.id);
            let kind = CheckKind::VoidClean {
                void: void.id.clone(),
            };
            Check::new(
                kind,
                &promise,
                Some(ratio),
                Limit::at_least(cleaning.sight_ratio, ""),
            )
        }));
    }
    checks.extend(agreement_check(promise, found));
    checks
}

/// Checks that every piece of a void has an opening wide enough, or two if two smaller ones do.
fn opening_check(void: &VoidFacts, pair_mm: Option<f64>, least_mm: f64) -> Check {
    let by_pair = |openings: &Vec<f64>| {
        let second_mm = openings.get(1).copied().unwrap_or(0.0);
        let one_mm = openings.first().copied().unwrap_or(0.0);
        let narrow = 1.0 - OPENING_SLACK_RATIO;
        if pair_mm.is_some_and(|pair_mm| second_mm >= pair_mm * narrow) {
            one_mm.max(least_mm)
        } else {
            one_mm
        }
    };
    let narrowest_mm = void.openings_mm.iter().map(by_pair).reduce(f64::min);
    let promise = match pair_mm {
        Some(pair_mm) => {
            let id = &void.id;
            format!("every piece of {id} opens by two ways of {pair_mm} mm, or by one of")
        }
        None => format!("every piece of {} opens by", void.id),
    };
    let limit = Limit::at_least(least_mm * (1.0 - OPENING_SLACK_RATIO), "mm");
    // A void of dimples alone lies in plain sight.
    let value = narrowest_mm.or((void.sight_ratio > 0.0).then_some(least_mm));
    let kind = CheckKind::VoidOpen {
        void: void.id.clone(),
    };
    Check::new(kind, &promise, value, limit)
}

/// Checks that the sheet lists every void, with the share of its wall in sight; `None` without
/// voids.
fn agreement_check(promise: &Promise, found: &[VoidFacts]) -> Option<Check> {
    if found.is_empty() && promise.voids.is_empty() {
        return None;
    }
    let off = |(void, facts): (&PromisedVoid, &VoidFacts)| {
        Some((void.sight_ratio? - facts.sight_ratio).abs())
    };
    let worst = promise
        .voids
        .iter()
        .zip(found)
        .filter_map(off)
        .fold(0.0, f64::max);
    let is_whole = promise.voids.len() == found.len();
    let promise = "the sheet states the share of every void's wall in sight, within";
    Some(Check::new(
        CheckKind::VoidsAsStated,
        promise,
        is_whole.then_some(worst),
        Limit::at_most(SIGHT_TOLERANCE_RATIO, ""),
    ))
}
