//! The tubes: the radius of the body about the centre line, and the wall.

use std::f64::consts::TAU;

use super::contact::Body;
use super::motion::ShellMotion;
use super::promise::TelescopePartPromise;
use crate::geom::{Frame, Point};

/// Stations along a shell, and angles around it, at which its wall is measured.
const STATIONS: usize = 9;
const ANGLES: usize = 16;
/// Share of a step by which rays are turned about the axis, so that none meets the edges of a
/// straight tube exactly.
const ASKEW: f64 = 0.37;
/// Length that is not measured: behind the mouth, for its chamfer, and before the flange and the
/// ring, which fill the overlap, mm.
const BEHIND_MOUTH_MM: f64 = 2.0;
const BEFORE_RING_MM: f64 = 1.0;
/// By how much beyond the body a ray begins, mm.
const OUTSIDE_MM: f64 = 20.0;
/// Distance from the edge of a hole within which no wall is measured, mm.
const BESIDE_VENT_MM: f64 = 1.0;
/// Share of a hole's radius that must be free.
const CLEAR_RATIO: f64 = 0.98;
/// Step beyond a surface after which a ray goes on, mm.
const STEP_MM: f64 = 1e-4;

/// The facts about a tube.
#[derive(Debug, Clone, PartialEq)]
pub struct ShellFacts {
    /// Its id.
    pub id: String,
    /// The greatest difference of its outside from its promised body, mm.
    pub body_error_mm: f64,
    /// Its least wall, along rays to the centre line, mm.
    pub wall_mm: f64,
    /// True if a hole is promised, and something is in its way.
    pub is_vent_closed: bool,
}

/// Measures a tube that lies about a helix, beside its hole for powder.
pub(super) fn measure(shell: &ShellMotion, part: &TelescopePartPromise, body: &Body) -> ShellFacts {
    let body_mm = part.body_mm;
    let [tail, mouth] = shell.ends_mm;
    let overlap_mm = mouth - tail - shell.length_mm;
    let from = tail + overlap_mm + BEFORE_RING_MM;
    let span = mouth - BEHIND_MOUTH_MM - from;
    let mut facts = ShellFacts {
        id: shell.id.clone(),
        body_error_mm: 0.0,
        wall_mm: f64::INFINITY,
        is_vent_closed: part
            .vent_mm
            .is_some_and(|vent| is_closed(shell, vent, body_mm, body)),
    };
    for station in 0..STATIONS {
        let share = station as f64 / (STATIONS - 1) as f64;
        let frame = shell.along(from + span * share);
        for angle in 0..ANGLES {
            let turn = TAU * (angle as f64 + ASKEW) / ANGLES as f64;
            let outside = Point::new(0.0, body_mm * turn.cos(), body_mm * turn.sin());
            let outside = frame.to_model(&outside);
            let is_vented = part.vent_mm.is_some_and(|[arc_mm, radius_mm]| {
                let across = shell.along(arc_mm).to_local(&outside);
                across.x.hypot(across.y) < radius_mm + BESIDE_VENT_MM
            });
            if is_vented {
                continue;
            }
            let [radius_mm, wall_mm] = along_ray(body, &frame, turn, body_mm);
            facts.body_error_mm = facts.body_error_mm.max((radius_mm - body_mm).abs());
            facts.wall_mm = facts.wall_mm.min(wall_mm);
        }
    }
    facts
}

/// Returns whether something is in the way of a hole through both sides of a tube.
fn is_closed(shell: &ShellMotion, vent: [f64; 2], body_mm: f64, body: &Body) -> bool {
    let [arc_mm, radius_mm] = vent;
    let frame = shell.along(arc_mm);
    let reach_mm = body_mm + OUTSIDE_MM;
    let around = (0..ANGLES).map(|angle| TAU * angle as f64 / ANGLES as f64);
    let beside = around.map(|turn| {
        let radius_mm = CLEAR_RATIO * radius_mm;
        [radius_mm * turn.cos(), radius_mm * turn.sin()]
    });
    let mut rays = beside.chain([[0.0, 0.0]]);
    rays.any(|[x, y]| {
        let ends = [reach_mm, -reach_mm].map(|z| frame.to_model(&Point::new(x, y, z)));
        body.bvh().first_crossing(&ends[0], &ends[1]).is_some()
    })
}

/// Returns the radius of the outside and the wall along a ray to the centre line. A ray that meets
/// nothing tells of no wall.
fn along_ray(body: &Body, frame: &Frame, turn_rad: f64, body_mm: f64) -> [f64; 2] {
    let (sin, cos) = turn_rad.sin_cos();
    let at = |radius: f64| frame.to_model(&Point::new(0.0, radius * cos, radius * sin));
    let from_mm = body_mm + OUTSIDE_MM;
    let meet = |from_mm: f64| {
        let share = body.bvh().first_crossing(&at(from_mm), &at(0.0))?;
        Some(from_mm * (1.0 - share))
    };
    let Some(outer_mm) = meet(from_mm) else {
        return [0.0, 0.0];
    };
    let inner_mm = meet(outer_mm - STEP_MM).unwrap_or(0.0);
    [outer_mm, outer_mm - inner_mm]
}
