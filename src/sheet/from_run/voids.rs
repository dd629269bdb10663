//! The rows of voids and cuts, and the rounds in which voids were made smaller.

use super::facts::Facts;
use crate::cut::{Cut, CutPlan, CutSide, VoidAccess, VoidId};
use crate::geom::Point;
use crate::run::{CleaningRound, KeptSolid, Made, Placed, WrittenPart};
use crate::sheet::{CleaningRow, CutRow, KeptRow, SideRow, VoidRow, is_clean};
use crate::verify::{PromisedCut, PromisedVoid, VoidFacts};

/// Distance up to which a vertex lies on a void's wall, mm; booleans keep vertices to 1e-6 mm.
const SAME_MM: f64 = 1e-5;
/// Least number of vertices on a void's wall of a part that holds it: a pin may touch the rim of a
/// mouth with fewer.
const LEAST_VERTICES: usize = 8;

/// Returns a row for each void.
pub fn void_rows(facts: &Facts) -> Vec<VoidRow> {
    let (placed, made) = (facts.placed, facts.made);
    let judged = |void: VoidId| facts.judgement.voids.get(void.index());
    let measured_mm = |void: VoidId| judged(void).and_then(VoidFacts::opening_mm);
    let row = |access: &VoidAccess| {
        let id = access.void.to_string();
        VoidRow {
            volume_mm3: access.volume_mm3,
            opened_by: access.opened_by.iter().map(ToString::to_string).collect(),
            parts: holders(facts.made, access.void),
            opening_mm: measured_mm(access.void).unwrap_or(access.opening_mm),
            least_opening_mm: least_opening_mm(placed, access),
            depth_mm: access.depth_mm,
            sight_ratio: Some(access.sight_ratio),
            method: placed.shop.printer.cleaning_method().to_owned(),
            is_clean: is_clean(&facts.judgement.checks, &id),
            clean: placed.shop.printer.cleaning.clone(),
            id,
        }
    };
    made.plan.voids.iter().map(row).collect()
}

/// Returns the ids of the parts that have vertices of a void's wall: a cut keeps the vertices
/// beside it.
fn holders(made: &Made, void: VoidId) -> Vec<String> {
    let Some(void) = made.hollowed.voids.get(void.index()) else {
        return Vec::new();
    };
    let wall = void.body.bvh();
    let holds = |written: &&WrittenPart| {
        let corners = written.part.solid.mesh().vertices().iter();
        let on_wall = |p: &&Point| wall.closest(p, SAME_MM, &[]).is_some();
        corners.filter(on_wall).take(LEAST_VERTICES).count() == LEAST_VERTICES
    };
    made.parts
        .iter()
        .filter(holds)
        .map(|written| written.part.id.to_string())
        .collect()
}

/// Returns the opening that a void needs, mm: for its ballast, else the printer's least.
fn least_opening_mm(placed: &Placed, access: &VoidAccess) -> f64 {
    let printer = &placed.shop.printer;
    access
        .part_opening_mm
        .unwrap_or(printer.min_opening_mm.value)
}

/// Returns the voids as the judge reads them.
pub fn promised_voids(placed: &Placed, made: &Made) -> Vec<PromisedVoid> {
    let promised = |access: &VoidAccess| PromisedVoid {
        id: access.void.to_string(),
        sight_ratio: Some(access.sight_ratio),
        least_opening_mm: Some(least_opening_mm(placed, access)),
    };
    made.plan.voids.iter().map(promised).collect()
}

/// Returns the rows of the cuts.
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

/// Returns the cuts as the judge reads them.
pub fn promised_cuts(plan: &CutPlan) -> Vec<PromisedCut> {
    plan.cuts
        .iter()
        .map(|cut| PromisedCut {
            point_mm: cut.point_mm,
            normal: cut.normal,
        })
        .collect()
}

/// Returns the rounds in which something was kept solid; `convert` changes values to the unit of
/// the sheet.
pub fn cleaning_rows(rounds: &[CleaningRound], convert: impl Fn(f64) -> f64) -> Vec<CleaningRow> {
    let kept = |kept: &KeptSolid| KeptRow {
        void: kept.void.to_string(),
        why: kept.cause.to_string(),
    };
    let row = |round: &CleaningRound| CleaningRow {
        voids: round.kept.iter().map(kept).collect(),
        volume_mm3: round.volume_mm3,
        value_before: convert(round.value_before),
        value_after: round.value_after.map(&convert),
        by_plan: round.by_plan,
    };
    rounds.iter().map(row).collect()
}
