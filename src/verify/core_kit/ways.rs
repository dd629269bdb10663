//! The ways out of the units: taken apart in their order, none meets what still stands.

use rayon::prelude::*;

use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::panels::{panel_body, shared_mm3};
use crate::base::watch::Watch;
use crate::geom::{Aabb, Bvh, Point, Vector};
use crate::mesh::TriMesh;
use crate::repair::weld;

/// Steps on the way out at which overlaps are measured, mm.
const STEPS_MM: [f64; 3] = [0.2, 3.0, 40.0];
/// Way at both ends of a ray along which surfaces that touch do not count, mm.
const TOUCH_MM: f64 = 0.02;
/// Depth into its own body from which a corner is looked at, mm.
const IN_MM: f64 = 0.01;

/// The facts about the ways of units.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct WayFacts {
    /// The greatest volume that a unit shares with what still stands at a step of its way, mm³.
    pub overlap_mm3: f64,
    /// The unit that has it.
    pub worst: Option<String>,
    /// Corners of surfaces that meet another one on the way, in words.
    pub barred: Vec<String>,
    /// The greatest volume that two things share where they stand, mm³.
    pub standing_mm3: f64,
    /// Things that belong to no unit, or to several.
    pub strays: Vec<String>,
}

/// The bodies of a unit.
struct UnitBodies {
    bodies: Vec<TriMesh>,
    way: Vector,
    id: String,
}

/// Measures the ways of all units, the last joined one first.
///
/// # Errors
/// The boolean engine fails, or the watch is stopped.
pub fn measure_ways(evidence: &CoreEvidence, watch: &Watch) -> Result<WayFacts, CoreVerifyError> {
    let mut facts = WayFacts {
        strays: strays(evidence),
        ..WayFacts::default()
    };
    let units: Vec<UnitBodies> = bodies(evidence);
    let ways = (0..units.len()).into_par_iter().map(|unit| {
        watch.check()?;
        let standing: Vec<&TriMesh> = units[..unit].iter().flat_map(|one| &one.bodies).collect();
        measure_way(&units[unit], &standing)
    });
    let ways: Vec<(f64, f64, usize)> = ways.collect::<Result<_, CoreVerifyError>>()?;
    for (unit, (overlap_mm3, standing_mm3, barred)) in units.iter().zip(ways) {
        if overlap_mm3 > facts.overlap_mm3 {
            facts.overlap_mm3 = overlap_mm3;
            facts.worst = Some(unit.id.clone());
        }
        facts.standing_mm3 = facts.standing_mm3.max(standing_mm3);
        if barred > 0 {
            facts
                .barred
                .push(format!("{} meets others at {barred} corners", unit.id));
        }
    }
    Ok(facts)
}

/// Returns the things that belong to no unit, or to several.
fn strays(evidence: &CoreEvidence) -> Vec<String> {
    let units = &evidence.promise.units;
    let parts = evidence.promise.parts.iter().filter_map(|part| {
        let count = units
            .iter()
            .filter(|unit| unit.parts.contains(&part.id))
            .count();
        (count != 1).then(|| format!("part {} is in {count} units", part.id))
    });
    let panels = evidence.panels.panels.iter().filter_map(|panel| {
        let own = units.iter().filter(|unit| unit.panel == Some(panel.panel));
        let count = own.count();
        (count != 1).then(|| format!("panel {} is in {count} units", panel.panel))
    });
    parts.chain(panels).collect()
}

fn bodies(evidence: &CoreEvidence) -> Vec<UnitBodies> {
    let units = evidence.promise.units.iter();
    units
        .map(|unit| {
            let parts = unit.parts.iter().filter_map(|id| evidence.part(id));
            let parts = parts.map(|part| weld(&evidence.parts[part]));
            let panel = unit.panel.map(|panel| panel.wrapping_sub(1));
            let panel = panel.filter(|panel| *panel < evidence.panels.panels.len());
            let panel = panel.map(|panel| panel_body(evidence, panel));
            UnitBodies {
                bodies: parts.chain(panel).collect(),
                way: Vector::from(unit.way),
                id: unit.id.clone(),
            }
        })
        .collect()
}

/// Returns the greatest volume that a unit shares with others on its way, and where it stands. The
/// third number is that of corners that meet a surface on the way.
fn measure_way(
    unit: &UnitBodies,
    standing: &[&TriMesh],
) -> Result<(f64, f64, usize), CoreVerifyError> {
    let at = |step_mm: f64| -> Result<f64, CoreVerifyError> {
        let mut shared = 0.0;
        for body in &unit.bodies {
            let moved = body.map_vertices(|p| p + unit.way * step_mm);
            let near = standing
                .iter()
                .filter(|other| meets(&moved.aabb(), &other.aabb()));
            for other in near {
                shared += shared_mm3(&moved, other)?;
            }
        }
        Ok(shared)
    };
    let mut overlap_mm3 = 0.0_f64;
    for step_mm in STEPS_MM {
        overlap_mm3 = overlap_mm3.max(at(step_mm)?);
    }
    Ok((overlap_mm3, at(0.0)?, barred(unit, standing)))
}

fn meets(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|k| a.min[k] < b.max[k] && b.min[k] < a.max[k])
}

/// Counts the corners of a unit that meet what stands on the way out. Those of what stands that
/// meet the unit on the way back count too.
fn barred(unit: &UnitBodies, standing: &[&TriMesh]) -> usize {
    let own = Bvh::new(unit.bodies.iter().flat_map(|body| body.iter_corners()));
    let others = Bvh::new(standing.iter().flat_map(|body| body.iter_corners()));
    if own.is_empty() || others.is_empty() {
        return 0;
    }
    let reach_mm = own.aabb().union(&others.aabb()).size().norm();
    let is_barred = |bvh: &Bvh, p: &Point, way: Vector| {
        bvh.crosses_segment(&(p + way * TOUCH_MM), &(p + way * reach_mm))
    };
    let ahead = unit.bodies.iter().flat_map(inner_corners);
    let ahead = ahead.filter(|p| is_barred(&others, p, unit.way));
    let back = standing.iter().flat_map(|body| inner_corners(body));
    let back = back.filter(|p| is_barred(&own, p, -unit.way));
    ahead.count() + back.count()
}

/// Returns the corners of a body, each moved into it by a little. Surfaces that slide along each
/// other, as fingers do, then do not count.
fn inner_corners(body: &TriMesh) -> Vec<Point> {
    let mut normals = vec![Vector::zeros(); body.vertices().len()];
    for (triangle, [a, b, c]) in body.triangles().iter().zip(body.iter_corners()) {
        let area = (b - a).cross(&(c - a));
        for &corner in triangle {
            normals[corner as usize] += area;
        }
    }
    let corners = body.vertices().iter().zip(normals);
    let inner =
        corners.map(|(p, normal)| p - normal.try_normalize(0.0).unwrap_or_default() * IN_MM);
    inner.collect()
}
