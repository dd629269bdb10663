//! The checklist's rows about voids: how each is opened and cleaned, and what cleaning cost.

use super::{CleaningRound, Setup, rows::Sheet};
use crate::cut::{CutPlan, VoidAccess};
use crate::report::{CleaningRow, KeptRow, VoidRow, is_clean};
use crate::verify::{PromisedCut, PromisedVoid};

/// One row for each void.
pub fn void_rows(sheet: &Sheet) -> Vec<VoidRow> {
    let (setup, plan) = (sheet.setup, &sheet.assembly.plan);
    let row = |access: &VoidAccess| {
        let id = void_id(access.void);
        VoidRow {
            volume_mm3: access.volume_mm3,
            opened_by: access.opened_by.clone(),
            opening_mm: access.opening_mm,
            least_opening_mm: least_opening_mm(setup, plan, access.void),
            depth_mm: access.depth_mm,
            sight_ratio: Some(access.sight_ratio),
            method: setup.printer.cleaning_rule().rule.words().to_owned(),
            is_clean: is_clean(&sheet.judgement.checks, &id),
            clean: setup.printer.cleaning.clone(),
            id,
        }
    };
    plan.voids.iter().map(row).collect()
}

/// The name of a void on the sheet.
pub fn void_id(void: usize) -> String {
    format!("V{}", void + 1)
}

/// The opening a void needs, mm: that of what is laid into it, or the printer's.
fn least_opening_mm(setup: &Setup, plan: &CutPlan, void: usize) -> f64 {
    let loads = &setup.load.parts;
    let first = plan.voids.len().saturating_sub(loads.len());
    let laid = void.checked_sub(first).and_then(|index| loads.get(index));
    laid.map_or(setup.printer.min_opening_mm.value, |placed| 2.0 * placed.lump.shape.radius_mm())
}

/// The voids as the judge sees them.
pub fn promised_voids(setup: &Setup, plan: &CutPlan) -> Vec<PromisedVoid> {
    let promised = |access: &VoidAccess| PromisedVoid {
        id: void_id(access.void),
        sight_ratio: Some(access.sight_ratio),
        least_opening_mm: Some(least_opening_mm(setup, plan, access.void)),
    };
    plan.voids.iter().map(promised).collect()
}

/// The cuts as the judge sees them.
pub fn promised_cuts(plan: &CutPlan) -> Vec<PromisedCut> {
    plan.cuts.iter().map(|cut| PromisedCut { point_mm: cut.point_mm, normal: cut.normal }).collect()
}

/// The rounds in which something was kept solid, with their values as `shown` tells them.
pub fn cleaning_rows(rounds: &[CleaningRound], shown: impl Fn(f64) -> f64) -> Vec<CleaningRow> {
    let kept = |(void, why): &(usize, String)| KeptRow { void: void_id(*void), why: why.clone() };
    let row = |round: &CleaningRound| CleaningRow {
        voids: round.kept.iter().map(kept).collect(),
        volume_mm3: round.volume_mm3,
        value_before: shown(round.value_before),
        value_after: round.value_after.map(&shown),
    };
    rounds.iter().map(row).collect()
}
