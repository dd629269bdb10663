//! The rows of voids and cuts, and the rounds in which voids were made smaller.

use super::facts::Facts;
use crate::cut::{Cut, CutPlan, CutSide, DrainHole, VoidAccess, VoidId};
use crate::geom::Point;
use crate::run::{CleaningRound, KeptSolid, Made, Placed, WrittenPart};
use crate::sheet::{CleaningRow, CutRow, KeptRow, SideRow, VoidRow, is_clean};
use crate::verify::{CellsOrder, PromisedCut, PromisedHole, PromisedPlug, PromisedVoid, VoidFacts};

/// Steps in a millimetre to which the places of cells are stated: no file's rounding is finer.
const STEPS_A_MM: f64 = 1e5;
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
            drained_by: holes_of(made, access.void).map(|hole| hole.id).collect(),
            parts: holders(facts.made, access.void),
            opening_mm: measured_mm(access.void).unwrap_or(access.opening_mm),
            least_opening_mm: least_opening_mm(placed, access),
            depth_mm: access.depth_mm,
            sight_ratio: sight_ratio(made, access),
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

/// Returns the drain holes as the judge reads them.
pub fn drain_holes(made: &Made) -> Vec<PromisedHole> {
    // Plugs are the last parts, in the order of their holes.
    let plugged = made.plan.plugged().count();
    let mut plugs = made.parts[made.parts.len().saturating_sub(plugged)..].iter();
    let hole = |hole: &DrainHole| PromisedHole {
        id: hole.id.to_string(),
        void: hole.void.to_string(),
        from_mm: hole.from_mm,
        to_mm: hole.to_mm,
        diameter_mm: hole.diameter_mm,
        mouth_mm: hole.plug_gap_mm.map(|_| hole.mouth_mm),
        plug: hole.plug_gap_mm.and_then(|gap_mm| {
            Some(PromisedPlug {
                part: plugs.next()?.part.id.to_string(),
                gap_mm,
            })
        }),
        volume_mm3: hole.volume_mm3,
    };
    made.plan.drains.iter().map(hole).collect()
}

/// Returns the cells as the judge reads them; `None` in a print without cells.
pub fn cells_order(placed: &Placed, made: &Made) -> Option<CellsOrder> {
    let sizes = placed.cells.as_ref()?.cells.sizes;
    let voids = made.hollowed.voids.iter();
    let near = |at: &Point| [at.x, at.y, at.z].map(|mm| (mm * STEPS_A_MM).round() / STEPS_A_MM);
    let doors = made.cells.doors.iter();
    Some(CellsOrder {
        size_mm: sizes.size_mm,
        wall_mm: sizes.wall_mm,
        opening_mm: sizes.opening_mm,
        density_ratio: placed.fill.density_ratio(),
        drained_mm3: voids.map(|void| void.mesh().signed_volume_mm3()).sum(),
        places_mm: made.cells.places.iter().map(near).collect(),
        openings_mm: doors.map(|ends| ends.each_ref().map(near)).collect(),
    })
}

/// Returns the drain holes of a void.
fn holes_of(made: &Made, void: VoidId) -> impl Iterator<Item = PromisedHole> + use<> {
    let holes = drain_holes(made).into_iter();
    holes.filter(move |hole| hole.void == void.to_string())
}

/// Returns the share of a void's wall in sight; `None` if it drains, for which nobody looks in.
fn sight_ratio(made: &Made, access: &VoidAccess) -> Option<f64> {
    let is_drained = holes_of(made, access.void).next().is_some();
    (!is_drained).then_some(access.sight_ratio)
}

/// Returns the opening that a void needs, mm: for its ballast, else the printer's least. Two drain
/// holes may be smaller, where the process says so.
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
        sight_ratio: sight_ratio(made, access),
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
