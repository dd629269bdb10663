//! The shell as it is put together: its parts cover the model, keep clear of the base, and have
//! their walls.

use rayon::prelude::*;

use super::ballast::ballast_body;
use super::certificate::{body_below, grown_base};
use super::error::CoreVerifyError;
use super::evidence::{CoreEvidence, plane_of};
use super::panels::shared_mm3;
use super::rod_promise::RodPromise;
use crate::base::watch::Watch;
use crate::geom::{Bvh, Frame, Plane, Point, Vector};
use crate::mesh::{MeshDistance, TriMesh, primitives, spread_points};
use crate::repair::weld;

/// Points on the model's surface at which a part must be, and points on each part at which walls
/// are measured.
const MODEL_SAMPLES: usize = 40_000;
const PART_SAMPLES: usize = 8_000;
/// Number of sides of a screw's head.
const HEAD_SIDES: u32 = 24;
/// Distance up to which a point lies on a surface, mm: rounding in files, and slivers that are
/// mended in them.
const ON_SURFACE_MM: f64 = 2e-3;
/// Distance from a bore within which its own wall is not measured, mm.
const BORE_MM: f64 = 0.05;
/// By how much the base is grown less than the gap when parts must keep clear of it, mm. It keeps
/// as far from planes to other polyhedra, at which their parts end.
const CLEAR_MM: f64 = 0.01;

/// The facts about the shell.
#[derive(Debug, Clone, PartialEq)]
pub struct ShellFacts {
    /// The greatest distance of a point of the model's surface from the nearest part, mm.
    pub uncovered_mm: f64,
    /// The greatest distance of a part's corner from the model, outside of it, mm.
    pub beyond_mm: f64,
    /// The volume of parts in the base grown by the gap, less a hundredth, mm³.
    pub in_base_mm3: f64,
    /// The volume of brackets outside of the base, or in a panel, mm³.
    pub brackets_mm3: f64,
    /// The sum of the volumes of parts with their listed voids, bores and sockets, but without
    /// pins, mm³.
    pub parts_mm3: f64,
    /// The least distance of an inner surface from the outside, a seam or a cut, mm; infinite for
    /// parts without a hollow.
    pub wall_mm: f64,
    /// The part with the thinnest wall.
    pub thinnest: Option<String>,
    /// The volume of screws' heads that lies in parts, panels or brackets, mm³.
    pub heads_mm3: f64,
    /// Inserts in the middle of which there is material.
    pub unbored: Vec<String>,
}

/// Measures the shell.
///
/// # Errors
/// The boolean engine fails, or the watch is stopped.
pub fn measure_shell(
    evidence: &CoreEvidence,
    watch: &Watch,
) -> Result<ShellFacts, CoreVerifyError> {
    let (wall_mm, thinnest) = thinnest_wall(evidence, watch)?;
    let clear_mm = (evidence.promise.gap_mm - CLEAR_MM).max(0.0);
    let mut in_base_mm3 = 0.0;
    for base in evidence.bases() {
        let grown = grown_base(evidence, &base, clear_mm, CLEAR_MM)?.to_mesh()?;
        for (_, mesh) in evidence.shell() {
            in_base_mm3 += shared_mm3(&weld(mesh), &grown)?;
        }
    }
    let volumes = evidence.shell().map(|(index, mesh)| {
        let part = &evidence.promise.parts[index];
        let [pins_mm3, sockets_mm3] = part.pins_mm3;
        mesh.signed_volume_mm3() + part.void_mm3 + part.bores_mm3 + sockets_mm3 - pins_mm3
    });
    Ok(ShellFacts {
        uncovered_mm: uncovered_mm(evidence),
        beyond_mm: beyond_mm(evidence),
        in_base_mm3,
        brackets_mm3: brackets_mm3(evidence)?,
        parts_mm3: volumes.sum(),
        wall_mm,
        thinnest,
        heads_mm3: heads_mm3(evidence)?,
        unbored: unbored(evidence),
    })
}

/// Returns the greatest distance of a sampled point of the model's surface from all parts, mm.
fn uncovered_mm(evidence: &CoreEvidence) -> f64 {
    let triangles: Vec<[Point; 3]> = evidence.model.iter_corners().collect();
    let parts = Bvh::new(evidence.shell().flat_map(|(_, mesh)| mesh.iter_corners()));
    let samples = spread_points(&triangles, MODEL_SAMPLES);
    let far = samples.par_iter().map(|sample| {
        let nearest = parts.closest(&sample.at, f64::INFINITY, &[]);
        nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared.sqrt())
    });
    far.reduce(|| 0.0, f64::max)
}

/// Returns the greatest distance of a part's corner from the model, outside of it, mm.
fn beyond_mm(evidence: &CoreEvidence) -> f64 {
    let surface = MeshDistance::new(&weld(&evidence.model));
    let shell: Vec<&TriMesh> = evidence.shell().map(|(_, mesh)| mesh).collect();
    let beyond = shell.par_iter().map(|mesh| {
        let depths = mesh.vertices().iter().map(|p| -surface.signed(p));
        depths.fold(0.0, f64::max)
    });
    beyond.reduce(|| 0.0, f64::max)
}

/// Returns the volume of brackets that is outside of the base or in a panel, mm³.
fn brackets_mm3(evidence: &CoreEvidence) -> Result<f64, CoreVerifyError> {
    let is_shell: Vec<usize> = evidence.shell().map(|(index, _)| index).collect();
    let bases = evidence.bases().into_iter();
    let bases = bases.map(|base| body_below(evidence, &base.planes, 0.0)?.to_mesh());
    let bases: Vec<TriMesh> = bases.collect::<Result<_, _>>()?;
    let count = evidence.panels.panels.len();
    let panels: Vec<TriMesh> = (0..count)
        .map(|panel| super::panels::panel_body(evidence, panel))
        .collect();
    let mut wrong_mm3 = 0.0;
    for (index, mesh) in evidence.parts.iter().enumerate() {
        if is_shell.contains(&index) {
            continue;
        }
        let body = weld(mesh);
        let mut inside_mm3 = 0.0_f64;
        for base in &bases {
            inside_mm3 = inside_mm3.max(shared_mm3(&body, base)?);
        }
        wrong_mm3 += (body.signed_volume_mm3() - inside_mm3).max(0.0);
        for panel in &panels {
            wrong_mm3 += shared_mm3(&body, panel)?;
        }
    }
    Ok(wrong_mm3)
}

/// Returns the volume of screws' heads that lies in parts, panels, brackets, rods or
/// ballast, mm³.
fn heads_mm3(evidence: &CoreEvidence) -> Result<f64, CoreVerifyError> {
    let screws = evidence.promise.fasteners.iter();
    let heads: Vec<TriMesh> = screws
        .filter(|one| one.head_mm[1] > 0.0)
        .map(|screw| {
            let [diameter_mm, height_mm] = screw.head_mm;
            let back = -Vector::from(screw.axis);
            let frame = Frame::with_axis(Point::from(screw.seat_mm), &back);
            primitives::cylinder(0.5 * diameter_mm, height_mm, HEAD_SIDES)
                .map_vertices(|p| frame.to_model(p))
        })
        .collect();
    let count = evidence.panels.panels.len();
    let panels = (0..count).map(|panel| super::panels::panel_body(evidence, panel));
    let parts = evidence.parts.iter().map(weld);
    let mut inside_mm3 = 0.0;
    let ballast = evidence.promise.ballast.iter().map(ballast_body);
    let rods = evidence.promise.rods.iter().map(RodPromise::body);
    for body in parts.chain(panels).chain(ballast).chain(rods) {
        for head in &heads {
            inside_mm3 += shared_mm3(head, &body)?;
        }
    }
    Ok(inside_mm3)
}

/// Returns the planes between a face of the base and all others, at which its parts meet those of
/// their cells. A small triangle elsewhere may lie in a plane between two other faces by chance.
fn seams(planes: &[Plane], own: usize) -> Vec<Plane> {
    let Some(a) = planes.get(own) else {
        return Vec::new();
    };
    let others = planes.iter().filter_map(|b| {
        let way: Vector = a.normal - b.normal;
        let length = way.norm();
        (length > 0.0).then(|| Plane {
            normal: way / length,
            offset_mm: (a.offset_mm - b.offset_mm) / length,
        })
    });
    others.collect()
}

/// Returns the thinnest wall of all parts, mm, and the part that has it.
fn thinnest_wall(
    evidence: &CoreEvidence,
    watch: &Watch,
) -> Result<(f64, Option<String>), CoreVerifyError> {
    let surface = MeshDistance::new(&weld(&evidence.model));
    let bases = evidence.bases();
    let shell: Vec<(usize, &TriMesh)> = evidence.shell().collect();
    let walls = shell.par_iter().map(|&(index, mesh)| {
        watch.check()?;
        let panel = evidence.promise.parts[index].panel.wrapping_sub(1);
        let own = evidence.base_of(&bases, panel);
        let judge = WallJudge {
            evidence,
            index,
            surface: &surface,
            planes: own.map_or(&[], |(base, _)| &base.planes),
            seams: &own.map_or_else(Vec::new, |(base, face)| seams(&base.planes, face)),
        };
        Ok((
            judge.wall_mm(mesh),
            evidence.promise.parts[index].id.clone(),
        ))
    });
    let walls: Vec<(f64, String)> = walls.collect::<Result<_, CoreVerifyError>>()?;
    let least = walls
        .into_iter()
        .reduce(|a, b| if b.0 < a.0 { b } else { a });
    Ok(match least {
        Some((wall_mm, id)) if wall_mm.is_finite() => (wall_mm, Some(id)),
        _ => (f64::INFINITY, None),
    })
}

/// The judge of a part's wall.
struct WallJudge<'a> {
    evidence: &'a CoreEvidence,
    index: usize,
    surface: &'a MeshDistance,
    /// The planes of its polyhedron.
    planes: &'a [Plane],
    seams: &'a [Plane],
}

impl WallJudge<'_> {
    /// Returns the thinnest wall of a part, mm. It is the least distance of its inner surface from
    /// the model's surface, and from its sides in seams and cuts.
    ///
    /// A point is an inner one if it lies on none of these, on no floor and in no bore.
    fn wall_mm(&self, mesh: &TriMesh) -> f64 {
        let part = &self.evidence.promise.parts[self.index];
        let gap_mm = self.evidence.promise.gap_mm;
        let floors: Vec<Plane> = self
            .planes
            .iter()
            .map(|plane| Plane {
                offset_mm: plane.offset_mm + gap_mm,
                ..*plane
            })
            .collect();
        let cuts: Vec<Plane> = part.cuts.iter().map(|&cut| plane_of(cut)).collect();
        let triangles: Vec<[Point; 3]> = mesh.iter_corners().collect();
        let samples = spread_points(&triangles, PART_SAMPLES);
        let is_on = |planes: &[Plane], at: &Point| {
            planes
                .iter()
                .any(|plane| plane.distance(at).abs() <= ON_SURFACE_MM)
        };
        let inner = samples.iter().filter_map(|sample| {
            let at = &sample.at;
            let depth_mm = self.surface.signed(at);
            let is_outer = depth_mm <= ON_SURFACE_MM
                || is_on(&floors, at)
                || is_on(self.seams, at)
                || is_on(&cuts, at)
                || self.is_in_bore(at)
                || self.is_on_pin(at);
            (!is_outer).then_some((at, depth_mm))
        });
        let all: Vec<&Plane> = self.seams.iter().chain(&cuts).collect();
        let in_any = |corners: &[Point; 3]| all.iter().any(|plane| lies_in(corners, plane));
        let sides = Bvh::new(triangles.iter().copied().filter(in_any));
        let walls = inner.map(|(at, depth_mm)| {
            let nearest = sides.closest(at, depth_mm.max(ON_SURFACE_MM), &[]);
            nearest.map_or(depth_mm, |nearest| nearest.distance_squared.sqrt())
        });
        walls.fold(f64::INFINITY, f64::min)
    }

    /// Returns true if a point lies on a pin or in a socket of the part.
    fn is_on_pin(&self, at: &Point) -> bool {
        let id = &self.evidence.promise.parts[self.index].id;
        let mut pins = self.evidence.promise.pins.iter();
        pins.any(|peg| {
            (peg.on == *id && peg.holds(at)) || (peg.into == *id && peg.is_socket_at(at))
        })
    }

    /// Returns true if a point lies on a bore of the part.
    fn is_in_bore(&self, at: &Point) -> bool {
        let part = &self.evidence.promise.parts[self.index];
        let panel = part.panel.wrapping_sub(1);
        let Some(of) = self.evidence.panels.panels.get(panel) else {
            return false;
        };
        let up = Vector::from(of.axes[2]);
        part.bosses.iter().any(|boss| {
            let arm = at - Point::from(boss.foot_mm);
            let along = arm.dot(&up);
            let aside = (arm - up * along).norm();
            let reach = -BORE_MM..=boss.depth_mm + BORE_MM;
            reach.contains(&along) && aside <= 0.5 * boss.bore_mm + BORE_MM
        })
    }
}

fn lies_in(corners: &[Point; 3], plane: &Plane) -> bool {
    corners
        .iter()
        .all(|p| plane.distance(p).abs() <= ON_SURFACE_MM)
}

/// Returns the inserts in the middle of which there is material, or whose part is missing.
fn unbored(evidence: &CoreEvidence) -> Vec<String> {
    use super::promise::FastenerKind;
    let mut wrong = Vec::new();
    for (index, mesh) in evidence.shell() {
        let id = &evidence.promise.parts[index].id;
        let inside = Bvh::new(mesh.iter_corners());
        let inserts = evidence.promise.fasteners.iter();
        let inserts = inserts.filter(|one| one.kind == FastenerKind::Insert && one.part == *id);
        let filled = inserts.filter(|one| inside.winding(&Point::from(one.center_mm)) > 0);
        let count = filled.count();
        if count > 0 {
            wrong.push(format!("{count} inserts of {id} have no bore"));
        }
    }
    let named = evidence.promise.fasteners.iter();
    let is_in_part = |kind| matches!(kind, FastenerKind::Screw | FastenerKind::Insert);
    let strange = named.filter(|one| is_in_part(one.kind) && evidence.part(&one.part).is_none());
    wrong.extend(strange.map(|one| format!("there is no part {}", one.part)));
    wrong
}
