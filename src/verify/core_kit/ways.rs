//! The ways out of the units: taken apart in their order, none meets what still stands.

use rayon::prelude::*;

use super::ballast::ballast_body;
use super::bench::{BenchJoint, bench_joints};
use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::joining::{misjoined, polyhedron_of};
use super::panels::shared_mm3;
use super::promise::CorePartKind;
use super::rod_promise::RodPromise;
use super::rods::panel_for_rods;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Bvh, Point, Vector};
use crate::mesh::{ClipError, TriMesh, spread_points};
use crate::repair::weld;

/// Steps on the way out at which overlaps are measured, mm.
const STEPS_MM: [f64; 3] = [0.2, 3.0, 40.0];
/// Way at both ends of a ray along which surfaces that touch do not count, mm. A corner that is no
/// deeper in a body slides along it.
const TOUCH_MM: f64 = 0.02;
/// Step at which the depth of a corner is looked at on its way, mm: a sixth of the thinnest wall.
const STEP_MM: f64 = 0.2;
/// Number of points on each body's surface that are looked at besides its corners: thin things can
/// pass between corners.
const SPREAD: usize = 4000;
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
    /// Things that belong to no unit, or to several, and polyhedra that come to no other.
    pub strays: Vec<String>,
}

/// The bodies of a unit.
struct UnitBodies {
    bodies: Vec<TriMesh>,
    way: Vector,
    id: String,
    /// The number of its polyhedron, from 1; `None` if it has parts of several.
    polyhedron: Option<usize>,
}

/// A step of putting the object together.
struct Step<'a> {
    moving: Vec<&'a TriMesh>,
    standing: Vec<&'a TriMesh>,
    /// The direction in which it is undone.
    way: Vector,
    id: String,
}

/// Measures the ways of all units, and of polyhedra that are joined.
///
/// # Errors
/// The boolean engine fails, or the watch is stopped.
pub fn measure_ways(evidence: &CoreEvidence, watch: &Watch) -> Result<WayFacts, CoreVerifyError> {
    let mut facts = WayFacts {
        strays: [strays(evidence), misjoined(evidence)].concat(),
        ..WayFacts::default()
    };
    let units: Vec<UnitBodies> = bodies(evidence)?;
    let benched = bench_joints(&evidence.promise);
    let parts: Vec<TriMesh> = match benched.is_empty() {
        true => Vec::new(),
        false => evidence.parts.iter().map(weld).collect(),
    };
    let on_bench = benched
        .iter()
        .map(|joint| bench_step(evidence, joint, &parts));
    let steps: Vec<Step> = steps(evidence, &units)
        .into_iter()
        .chain(on_bench)
        .collect();
    let ways = steps.par_iter().map(|step| {
        watch.check()?;
        measure_way(step)
    });
    let ways: Vec<Way> = ways.collect::<Result<_, CoreVerifyError>>()?;
    for (step, way) in steps.iter().zip(ways) {
        let Way {
            overlap_mm3,
            standing_mm3,
            barred,
        } = way;
        if overlap_mm3 > facts.overlap_mm3 {
            facts.overlap_mm3 = overlap_mm3;
            facts.worst = Some(step.id.clone());
        }
        facts.standing_mm3 = facts.standing_mm3.max(standing_mm3);
        if let Some(first) = barred.first() {
            let [x, y, z] = [0, 1, 2].map(|k| first[k]);
            facts.barred.push(format!(
                "{} meets others at {} points, such as ({x:.1}, {y:.1}, {z:.1}) mm",
                step.id,
                barred.len()
            ));
        }
    }
    Ok(facts)
}

/// Returns the steps in which the object is put together: the units of every polyhedron, then the
/// polyhedra, then the units that come last.
fn steps<'a>(evidence: &CoreEvidence, units: &'a [UnitBodies]) -> Vec<Step<'a>> {
    let promise = &evidence.promise;
    let all = || promise.units.iter().zip(units).enumerate();
    let of_units = all().map(|(index, (unit, own))| {
        let stands = all().take(index).filter(|(_, (other, theirs))| {
            unit.is_last || (!other.is_last && theirs.polyhedron == own.polyhedron)
        });
        Step {
            moving: own.bodies.iter().collect(),
            standing: stands.flat_map(|(_, (_, own))| &own.bodies).collect(),
            way: own.way,
            id: own.id.clone(),
        }
    });
    let of_joins = promise.joins.iter().map(|join| {
        let within = |numbers: &[usize]| {
            let own = all().filter(|(_, (unit, own))| {
                let is_in = own.polyhedron.is_some_and(|at| numbers.contains(&at));
                is_in && !unit.is_last
            });
            own.flat_map(|(_, (_, own))| &own.bodies).collect()
        };
        Step {
            moving: within(&join.moving),
            standing: within(&join.standing),
            way: Vector::from(join.way),
            id: join.name(),
        }
    });
    of_units.chain(of_joins).collect()
}

/// Returns the step of joining two groups of parts on the bench.
fn bench_step<'a>(evidence: &CoreEvidence, joint: &BenchJoint, parts: &'a [TriMesh]) -> Step<'a> {
    let bodies = |ids: &[&String]| {
        let own = ids.iter().filter_map(|id| evidence.part(id));
        own.filter_map(|part| parts.get(part)).collect()
    };
    Step {
        moving: bodies(&joint.moving),
        standing: bodies(&joint.standing),
        way: joint.way,
        id: format!("{} on {}", joint.peg.into, joint.peg.on),
    }
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
    let brackets = evidence.promise.parts.iter().filter_map(|part| {
        let mut own = units.iter().filter(|unit| unit.parts.contains(&part.id));
        let is_bracket = part.kind == CorePartKind::Bracket;
        let is_elsewhere = is_bracket && own.any(|unit| unit.panel != Some(part.panel));
        let words = || format!("{} stands on another panel than {}", part.id, part.panel);
        is_elsewhere.then(words)
    });
    let panels = evidence.panels.panels.iter().filter_map(|panel| {
        let own = units.iter().filter(|unit| unit.panel == Some(panel.panel));
        let count = own.count();
        (count != 1).then(|| format!("panel {} is in {count} units", panel.panel))
    });
    parts.chain(brackets).chain(panels).collect()
}

/// Returns the bodies of all units. Rods go with the panel into which they are glued first.
fn bodies(evidence: &CoreEvidence) -> Result<Vec<UnitBodies>, ClipError> {
    let units = evidence.promise.units.iter();
    units
        .map(|unit| {
            let parts = unit.parts.iter().filter_map(|id| evidence.part(id));
            let parts = parts.map(|part| weld(&evidence.parts[part]));
            let panel = unit.panel.map(|panel| panel.wrapping_sub(1));
            let panel = panel.filter(|panel| *panel < evidence.panels.panels.len());
            let panel = panel.map(|panel| panel_for_rods(evidence, panel));
            let rods = evidence.promise.rods.iter();
            let rods = rods.filter(|rod| rod.is_sized() && unit.panel == Some(rod.panels[0]));
            let ballast = evidence.promise.ballast.iter();
            let ballast = ballast.filter(|piece| unit.panel == Some(piece.panel));
            Ok(UnitBodies {
                bodies: parts
                    .chain(panel.transpose()?)
                    .chain(ballast.map(ballast_body))
                    .chain(rods.map(RodPromise::body))
                    .collect(),
                way: Vector::from(unit.way),
                id: unit.id.clone(),
                polyhedron: polyhedron_of(evidence, unit),
            })
        })
        .collect()
}

/// The way of a unit.
struct Way {
    /// The greatest volume that it shares with others on its way, mm³.
    overlap_mm3: f64,
    /// The same where it stands, mm³.
    standing_mm3: f64,
    /// The points that meet a surface on the way.
    barred: Vec<Point>,
}

/// Measures the way of a unit past what still stands.
fn measure_way(step: &Step) -> Result<Way, CoreVerifyError> {
    let at = |step_mm: f64| -> Result<f64, CoreVerifyError> {
        let mut shared = 0.0;
        for body in &step.moving {
            let moved = body.map_vertices(|p| p + step.way * step_mm);
            let near = step
                .standing
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
    Ok(Way {
        overlap_mm3,
        standing_mm3: at(0.0)?,
        barred: barred(step),
    })
}

fn meets(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|k| a.min[k] < b.max[k] && b.min[k] < a.max[k])
}

/// Returns the points of a unit that meet what stands on the way out. Those of what stands that
/// meet the unit on the way back count too.
fn barred(step: &Step) -> Vec<Point> {
    let own = Bvh::new(step.moving.iter().flat_map(|body| body.iter_corners()));
    let others = Bvh::new(step.standing.iter().flat_map(|body| body.iter_corners()));
    if own.is_empty() || others.is_empty() {
        return Vec::new();
    }
    let reach_mm = own.aabb().union(&others.aabb()).size().norm();
    let is_barred = |bvh: &Bvh, p: &Point, way: Vector| {
        bvh.crosses_segment(&(p + way * TOUCH_MM), &(p + way * reach_mm))
            && dips(bvh, p, way * reach_mm)
    };
    let ahead = step.moving.iter().flat_map(|body| inner_points(body));
    let ahead = ahead.filter(|p| is_barred(&others, p, step.way));
    let back = step.standing.iter().flat_map(|body| inner_points(body));
    let back = back.filter(|p| is_barred(&own, p, -step.way));
    ahead.chain(back).collect()
}

/// Returns whether a point on its way goes deeper into a body than surfaces that slide along each
/// other. At a sharp edge between such surfaces a corner crosses one without going in.
fn dips(bvh: &Bvh, from: &Point, way: Vector) -> bool {
    let steps = (way.norm() / STEP_MM).ceil().max(1.0);
    (1..=steps as usize).any(|step| {
        let at = from + way * (step as f64 / steps);
        bvh.winding(&at) > 0 && bvh.closest(&at, TOUCH_MM, &[]).is_none()
    })
}

/// Returns the corners of a body and points spread over its surface, each moved into it by a
/// little. Surfaces that slide along each other, as fingers do, then do not count.
fn inner_points(body: &TriMesh) -> Vec<Point> {
    let triangles: Vec<[Point; 3]> = body.iter_corners().collect();
    let spread = spread_points(&triangles, SPREAD);
    let spread = spread.iter().map(|sample| {
        let [a, b, c] = triangles[sample.triangle];
        let normal = (b - a).cross(&(c - a)).try_normalize(0.0);
        sample.at - normal.unwrap_or_default() * IN_MM
    });
    inner_corners(body).into_iter().chain(spread).collect()
}

/// Returns the corners of a body, each moved into it by a little.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    /// Returns a wedge that is sharp along x: its lower side is level, its upper one slopes.
    fn wedge(slope: f64) -> TriMesh {
        let at = |x: f64, y: f64, z: f64| Point::new(x, y, z);
        let corners = vec![
            at(0.0, 0.0, 0.0),
            at(10.0, 0.0, 0.0),
            at(0.0, 10.0, 0.0),
            at(10.0, 10.0, 0.0),
            at(0.0, 10.0, 10.0 * slope),
            at(10.0, 10.0, 10.0 * slope),
        ];
        let triangles = vec![
            [0, 2, 3],
            [0, 3, 1],
            [0, 1, 5],
            [0, 5, 4],
            [2, 4, 5],
            [2, 5, 3],
            [0, 4, 2],
            [1, 3, 5],
        ];
        TriMesh::new(corners, triangles).unwrap()
    }

    fn meeting(body: &TriMesh, way: Vector, other: &TriMesh) -> Vec<Point> {
        barred(&Step {
            moving: vec![body],
            standing: vec![other],
            way,
            id: "unit 1".to_owned(),
        })
    }

    #[test]
    fn a_sharp_edge_that_slides_along_its_neighbour_is_free() {
        // A block lies on the level side of the wedge, and the wedge leaves along that side.
        let block =
            primitives::cuboid(&Point::new(-5.0, -5.0, -10.0), &Point::new(15.0, 15.0, 0.0));
        for slope in [0.3, 0.05, 0.01] {
            for way in [Vector::x(), Vector::y(), -Vector::y()] {
                let found = meeting(&wedge(slope), way, &block);
                assert!(found.is_empty(), "{slope} {way:?}: {found:?}");
            }
        }
    }

    #[test]
    fn a_corner_that_goes_into_another_body_is_barred() {
        let wall = primitives::cuboid(&Point::new(20.0, 4.0, -5.0), &Point::new(20.5, 6.0, 5.0));
        let moving = primitives::cuboid(&Point::origin(), &Point::new(10.0, 10.0, 1.0));
        let found = meeting(&moving, Vector::x(), &wall);
        assert!(!found.is_empty());
        let found = meeting(&moving, -Vector::x(), &wall);
        assert!(found.is_empty());
    }
}
