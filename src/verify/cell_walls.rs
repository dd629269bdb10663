//! Cells inside of a piece: what a kit states of them, and what its files have.

use rayon::prelude::*;
use serde::Serialize;

use super::limits::{HOLE_LIMIT_MM, WALL_TOLERANCE_MM};
use super::{Body, CellsOrder, Check, CheckKind, HoleFacts, Limit, Promise};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point, Vector};
use crate::mesh::spread_points;

/// Points on the walls of all cells from which their thickness is measured, besides the middle of
/// each triangle.
const POINTS: usize = 40_000;
/// Distance up to which a wall is measured, in stated walls: a thicker one is no matter.
const REACH_WALLS: f64 = 2.0;
/// Distance from the surface at which a ray begins, mm.
const OFF_MM: f64 = 1e-4;
/// Twice the area of a triangle that has no normal to speak of, mm².
const SLIVER_MM2: f64 = 1e-4;
/// Least cosine of the angle between the sides of a wall: 60°.
const FACING_COSINE: f64 = 0.5;
/// Steps along an opening at which its room is measured.
const STEPS: usize = 16;
/// The stated volume may differ by this share from that of the files.
const VOLUME_RATIO: f64 = 1e-5;

/// The facts about the cells of a piece.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct CellFacts {
    /// The thinnest wall that was found between two voids, or a void and itself, mm.
    pub wall_mm: f64,
    /// The diameter of the widest ball that passes the narrowest opening, mm; 0 if it is closed.
    pub opening_mm: f64,
    /// The cells that lie in no void with a free drain hole.
    pub closed: usize,
    /// The volume of all voids, mm³.
    pub drained_mm3: f64,
}

/// Measures the stated cells on the uncut result; `None` if none are stated.
pub(super) fn measure_cells(
    promise: &Promise,
    body: &Body,
    holes: &[HoleFacts],
    watch: &Watch,
) -> Result<Option<CellFacts>, Cancelled> {
    let Some(order) = &promise.cells else {
        return Ok(None);
    };
    watch.check()?;
    let wall_mm = thinnest_mm(body, REACH_WALLS * order.wall_mm);
    watch.check()?;
    let openings = order.openings_mm.par_iter();
    let free = openings.map(|ends| free_mm(body, ends));
    Ok(Some(CellFacts {
        wall_mm,
        opening_mm: free.reduce(|| f64::INFINITY, f64::min),
        closed: count_closed(promise, order, body, holes),
        drained_mm3: -body.shells.inner_mesh().signed_volume_mm3(),
    }))
}

/// Returns the thinnest wall behind the surfaces of voids along their normals, up to a reach, mm.
fn thinnest_mm(body: &Body, reach_mm: f64) -> f64 {
    let inner: Vec<[Point; 3]> = body.shells.inner_mesh().iter_corners().collect();
    let middles = inner.par_iter().map(|corners| {
        let [a, b, c] = corners.map(|p| p.coords);
        (Point::from((a + b + c) / 3.0), corners)
    });
    let spread = spread_points(&inner, POINTS);
    let spread = spread.par_iter().map(|p| (p.at, &inner[p.triangle]));
    let depth = |(at, corners): (Point, &[Point; 3])| {
        let inward = into_wall(corners)?;
        let [from, to] = [OFF_MM, reach_mm].map(|mm| at + inward * mm);
        let share = body.whole.first_crossing(&from, &to)?;
        let behind = from + (to - from) * share;
        let nearest = body.whole.closest(&behind, OFF_MM, &[])?;
        let behind = body.welded.corners(nearest.triangle as usize);
        // An edge of the material is no wall: its sides meet, or do not face each other.
        let is_edge = corners.iter().any(|corner| behind.contains(corner));
        let is_wall = !is_edge && into_wall(&behind)?.dot(&inward) <= -FACING_COSINE;
        is_wall.then_some(OFF_MM + share * (reach_mm - OFF_MM))
    };
    let depths = middles.chain(spread).filter_map(depth);
    depths.reduce(|| reach_mm, f64::min)
}

/// Returns the unit direction from the surface of a void into the wall; `None` for a sliver.
fn into_wall([a, b, c]: &[Point; 3]) -> Option<Vector> {
    // Surfaces look away from the material.
    (b - a)
        .cross(&(c - a))
        .try_normalize(SLIVER_MM2)
        .map(|out| -out)
}

/// Returns the diameter of the widest ball that passes an opening along its axis, mm; 0 if
/// something lies in its way.
fn free_mm(body: &Body, ends: &[[f64; 3]; 2]) -> f64 {
    let [from, to] = ends.map(Point::from);
    let is_air = |at: &Point| body.whole.winding(at) == 0 && body.outside.winding(at) != 0;
    if !(is_air(&from) && is_air(&to)) || body.whole.crosses_segment(&from, &to) {
        return 0.0;
    }
    let room_mm = |step: usize| {
        let at = from + (to - from) * (step as f64 / STEPS as f64);
        let nearest = body.whole.closest(&at, f64::INFINITY, &[]);
        nearest.map_or(0.0, |nearest| nearest.distance_squared.sqrt())
    };
    2.0 * (0..=STEPS).map(room_mm).fold(f64::INFINITY, f64::min)
}

/// Counts the cells whose place lies in no void that a free hole drains.
fn count_closed(promise: &Promise, order: &CellsOrder, body: &Body, holes: &[HoleFacts]) -> usize {
    let voids = promise.voids.iter().zip(&body.shells.inward);
    let is_drained = |id: &str| {
        let mut leading = holes.iter();
        leading.any(|hole| hole.free_mm > 0.0 && hole.void.as_deref() == Some(id))
    };
    let drained = voids.filter(|(void, _)| is_drained(&void.id));
    let drained: Vec<Bvh> = drained
        .map(|(_, shell)| Bvh::new(shell.iter_corners()))
        .collect();
    let places = order.places_mm.par_iter().map(|at| Point::from(*at));
    places
        .filter(|at| !drained.iter().any(|shell| shell.winding(at) != 0))
        .count()
}

/// Checks the walls between cells and the openings by which every cell drains. They are held
/// against what is stated, and against what the process needs. Empty without cells.
pub(super) fn cell_checks(promise: &Promise, found: Option<&CellFacts>) -> Vec<Check> {
    let (Some(order), Some(found)) = (&promise.cells, found) else {
        return Vec::new();
    };
    let printer = &promise.printer;
    let wall_mm = order.wall_mm.max(printer.minimum_wall_mm);
    let least_mm = printer.minimum_opening_mm.unwrap_or(0.0);
    let opening_mm = order.opening_mm.max(least_mm);
    let openings = match found.closed {
        // A single cell has no openings but its drain holes.
        0 if order.openings_mm.is_empty() && order.places_mm.len() == 1 => opening_mm,
        0 if found.opening_mm.is_finite() => found.opening_mm,
        _ => 0.0,
    };
    let closed = format!("{} cells do not drain", found.closed);
    vec![
        Check::new(
            CheckKind::CellWalls,
            "every wall between two cells is at least",
            Some(found.wall_mm),
            Limit::at_least(wall_mm - WALL_TOLERANCE_MM, "mm"),
        ),
        Check::new(
            CheckKind::CellOpenings,
            "every cell drains through openings that are free by at least",
            Some(openings),
            Limit::at_least(opening_mm - HOLE_LIMIT_MM, "mm"),
        )
        .at((found.closed > 0).then_some(closed)),
    ]
}

/// Finds what a kit states falsely of its cells, a sentence each.
pub(super) fn find_false_cells(promise: &Promise, found: Option<&CellFacts>) -> Vec<String> {
    let (Some(order), Some(found)) = (&promise.cells, found) else {
        return Vec::new();
    };
    let mut faults = Vec::new();
    let mut compare = |key: &str, [stated, found]: [f64; 2], slack: f64| {
        let is_near = (stated - found).abs() <= slack;
        let fault = format!("cells.{key} states {stated}, the files have {found}");
        faults.extend((!is_near).then_some(fault));
    };
    compare("wall_mm", [order.wall_mm, found.wall_mm], WALL_TOLERANCE_MM);
    let slack_mm3 = VOLUME_RATIO * found.drained_mm3;
    compare(
        "drained_mm3",
        [order.drained_mm3, found.drained_mm3],
        slack_mm3,
    );
    faults
}
