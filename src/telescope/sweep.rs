//! Meshes swept along helices: bodies of revolution, and sectors of rings.

use std::f64::consts::{PI, TAU};

use super::profile::Profile;
use crate::curve::Helix;
use crate::geom::{Frame, Point};
use crate::mesh::{MeshError, TriMesh};

/// The greatest distance between a swept surface and its facets, mm. Prints are coarser by far.
const CHORD_MM: f64 = 0.002;

/// Least and greatest number of facets around.
const FACETS: [f64; 2] = [32.0, 256.0];

/// Greatest length of a facet along the axis, mm.
const MAX_STEP_MM: f64 = 2.0;

/// A piece of a ring about a helix: between two radii, two angles and two arcs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sector {
    /// The inner and the outer radius, mm.
    pub radii_mm: [f64; 2],
    /// The angles from the normal towards the binormal, rad; less than a full turn apart.
    pub angles_rad: [f64; 2],
    /// The arcs, mm.
    pub arcs_mm: [f64; 2],
}

/// Sweeps a profile about a helix that begins in a frame. Facets are within 0.002 mm of it.
///
/// Bodies of like radius about one helix have like facets, so the gap between them is even.
pub fn sweep_profile(
    start: &Frame,
    helix: &Helix,
    profile: &Profile,
) -> Result<TriMesh, MeshError> {
    let radius = profile.max_radius_mm();
    let stations = profile.stations(step_mm(helix, radius));
    let facets = facets(radius);
    let ring = |[arc, radius]: &[f64; 2]| {
        let frame = start.frame_to_model(&helix.frame_at(*arc));
        let radius = *radius;
        (0..facets).map(move |i| on_ring(&frame, radius, TAU * i as f64 / facets as f64))
    };
    let mut vertices: Vec<Point> = stations.iter().flat_map(ring).collect();
    let rings = stations.len();
    let at = |ring: usize, i: usize| (ring * facets + i % facets) as u32;
    let mut triangles = Vec::new();
    for ring in 1..rings {
        for i in 0..facets {
            let [a, b] = [at(ring - 1, i), at(ring - 1, i + 1)];
            let [c, d] = [at(ring, i), at(ring, i + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    for (ring, is_end) in [(0, false), (rings - 1, true)] {
        let centre = start
            .frame_to_model(&helix.frame_at(stations[ring][0]))
            .origin;
        let hub = vertices.len() as u32;
        vertices.push(centre);
        let fan = (0..facets).map(|i| match is_end {
            true => [hub, at(ring, i), at(ring, i + 1)],
            false => [hub, at(ring, i + 1), at(ring, i)],
        });
        triangles.extend(fan);
    }
    TriMesh::new(vertices, triangles)
}

/// Sweeps a sector of a ring about a helix that begins in a frame.
pub fn sweep_sector(start: &Frame, helix: &Helix, sector: &Sector) -> Result<TriMesh, MeshError> {
    let [inner, outer] = sector.radii_mm;
    let [from, to] = sector.angles_rad;
    let [near, far] = sector.arcs_mm;
    let columns = ((facets(outer) as f64 * (to - from) / TAU).ceil() as usize).max(1);
    let rows = (((far - near) / step_mm(helix, outer)).ceil() as usize).max(1);
    // A closed strip of points around the section, swept row by row.
    let angle = |i: usize| from + (to - from) * i as f64 / columns as f64;
    let out = (0..=columns).map(|i| [outer, angle(i)]);
    let back = (0..=columns).rev().map(|i| [inner, angle(i)]);
    let strip: Vec<[f64; 2]> = out.chain(back).collect();
    let around = strip.len();
    let mut vertices = Vec::with_capacity(around * (rows + 1));
    for row in 0..=rows {
        let arc = near + (far - near) * row as f64 / rows as f64;
        let frame = start.frame_to_model(&helix.frame_at(arc));
        vertices.extend(
            strip
                .iter()
                .map(|[radius, angle]| on_ring(&frame, *radius, *angle)),
        );
    }
    let at = |row: usize, i: usize| (row * around + i % around) as u32;
    let mut triangles = Vec::new();
    for row in 1..=rows {
        for i in 0..around {
            let [a, b] = [at(row - 1, i), at(row - 1, i + 1)];
            let [c, d] = [at(row, i), at(row, i + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    for i in 0..columns {
        let opposite = around - 1 - i;
        let quad = |row: usize| {
            [
                at(row, i),
                at(row, i + 1),
                at(row, opposite - 1),
                at(row, opposite),
            ]
        };
        let [a, b, c, d] = quad(rows);
        triangles.extend([[a, b, c], [a, c, d]]);
        let [a, b, c, d] = quad(0);
        triangles.extend([[a, c, b], [a, d, c]]);
    }
    TriMesh::new(vertices, triangles)
}

fn on_ring(frame: &Frame, radius_mm: f64, angle_rad: f64) -> Point {
    let (sin, cos) = angle_rad.sin_cos();
    frame.to_model(&Point::new(0.0, radius_mm * cos, radius_mm * sin))
}

/// Returns the number of facets around, a multiple of eight.
fn facets(radius_mm: f64) -> usize {
    let angle = (1.0 - CHORD_MM / radius_mm.max(CHORD_MM)).acos();
    let [least, most] = FACETS;
    let count = (PI / angle).clamp(least, most);
    (count / 8.0).ceil() as usize * 8
}

/// Returns the length of facets along the axis.
fn step_mm(helix: &Helix, radius_mm: f64) -> f64 {
    // A point at the outside of the tube goes about a curve of at most this curvature.
    let rate = helix.curvature + radius_mm * helix.torsion.powi(2);
    let step = (8.0 * CHORD_MM / rate.max(f64::MIN_POSITIVE)).sqrt();
    step.min(MAX_STEP_MM)
}
