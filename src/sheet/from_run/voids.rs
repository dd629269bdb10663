//! The checklist's rows about voids: how each is opened and cleaned, and what cleaning cost.

use super::facts::Facts;
use crate::cut::{Cut, CutPlan, CutSide, VoidAccess, VoidId};
use crate::geom::{Bvh, Point};
use crate::run::{CleaningRound, KeptSolid, Made, Placed, WrittenPart};
use crate::sheet::{CleaningRow, CutRow, KeptRow, SideRow, VoidRow, is_clean};
use crate::verify::{PromisedCut, PromisedVoid};

/// How near to a void's wall a corner lies on it, mm: the booleans keep corners to 1e-6 mm.
const SAME_MM: f64 = 1e-5;
/// Corners on a void's wall that make a part one of those that hold it: a pin may touch a mouth's
/// rim with fewer.
const LEAST_CORNERS: usize = 8;

/// One row for each void.
pub fn void_rows(facts: &Facts) -> Vec<VoidRow> {
    let (placed, made) = (facts.placed, facts.made);
    let row = |access: &VoidAccess| {
        let id = access.void.to_string();
        VoidRow {
            volume_mm3: access.volume_mm3,
            opened_by: access.opened_by.iter().map(ToString::to_string).collect(),
            parts: holders(facts.made, access.void),
            opening_mm: access.opening_mm,
            least_opening_mm: least_opening_mm(placed, access),
            depth_mm: access.depth_mm,
            sight_ratio: Some(access.sight_ratio),
            method: placed.shop.printer.cleaning_rule().rule.words().to_owned(),
            is_clean: is_clean(&facts.judgement.checks, &id),
            clean: placed.shop.printer.cleaning.clone(),
            id,
        }
    };
    made.plan.voids.iter().map(row).collect()
}

/// The ids of the parts on whose surface corners of a void lie: cutting keeps those that it does
/// not cut.
fn holders(made: &Made, void: VoidId) -> Vec<String> {
    let Some(body) = made.hollowed.voids.get(void.index()) else {
        return Vec::new();
    };
    let wall = Bvh::new(body.mesh().iter_corners());
    let holds = |written: &&WrittenPart| {
        let corners = written.part.solid.mesh().vertices().iter();
        let on_wall = |p: &&Point| wall.closest(p, SAME_MM, &[]).is_some();
        corners.filter(on_wall).take(LEAST_CORNERS).count() == LEAST_CORNERS
    };
    made.parts
        .iter()
        .filter(holds)
        .map(|written| written.part.id.to_string())
        .collect()
}

/// The opening a void needs, mm: that of what is laid into it, or the printer's.
fn least_opening_mm(placed: &Placed, access: &VoidAccess) -> f64 {
    let printer = &placed.shop.printer;
    access
        .part_opening_mm
        .unwrap_or(printer.min_opening_mm.value)
}

/// The voids as the judge sees them.
pub fn promised_voids(placed: &Placed, made: &Made) -> Vec<PromisedVoid> {
    let promised = |access: &VoidAccess| PromisedVoid {
        id: access.void.to_string(),
        sight_ratio: Some(access.sight_ratio),
        least_opening_mm: Some(least_opening_mm(placed, access)),
    };
    made.plan.voids.iter().map(promised).collect()
}

/// The cuts as the sheet lists them.
pub fn cut_rows(plan: &CutPlan) -> Vec<CutRow> {
    let side = |side: &CutSide| SideRow {
        cut: side.cut.to_string(),
        side: side.side.word().to_owned(),
    };
    let row = |cut: &Cut| CutRow {
        id: cut.id.to_string(),
        point_mm: cut.point_mm,
        normal: cut.normal,
        within: cut.within.iter().map(side).collect(),
    };
    plan.cuts.iter().map(row).collect()
}

/// The cuts as the judge sees them.
pub fn promised_cuts(plan: &CutPlan) -> Vec<PromisedCut> {
    plan.cuts
        .iter()
        .map(|cut| PromisedCut {
            point_mm: cut.point_mm,
            normal: cut.normal,
        })
        .collect()
}

/// The rounds in which something was kept solid, with their values as `shown` tells them.
pub fn cleaning_rows(rounds: &[CleaningRound], shown: impl Fn(f64) -> f64) -> Vec<CleaningRow> {
    let kept = |kept: &KeptSolid| KeptRow {
        void: kept.void.to_string(),
        why: kept.cause.to_string(),
    };
    let row = |round: &CleaningRound| CleaningRow {
        voids: round.kept.iter().map(kept).collect(),
        volume_mm3: round.volume_mm3,
        value_before: shown(round.value_before),
        value_after: round.value_after.map(&shown),
        by_plan: round.by_plan,
    };
    rounds.iter().map(row).collect()
}
