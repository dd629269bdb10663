//! The panels as bodies: in the base, apart from each other, and with holes for their screws.

use std::f64::consts::FRAC_PI_4;

use super::evidence::CoreEvidence;
use super::hardware::misfits;
use crate::geom::{Matrix, Point, Vector};
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::{ClipError, Csg, TriMesh, ear_clip};

/// The facts about panels.
#[derive(Debug, Clone, PartialEq)]
pub struct PanelFacts {
    /// The greatest volume that two panels share, mm³.
    pub overlap_mm3: f64,
    /// The greatest height of a panel's corner over a plane of the base, or of its outer side from
    /// its own plane, mm.
    pub out_mm: f64,
    /// The greatest deviation of a panel's frame from a rigid motion.
    pub frame_error: f64,
    /// Screws without a hole in their panel, and bolts that hold nothing, in words.
    pub unscrewed: Vec<String>,
}

/// Returns the body of a panel without its holes.
pub fn panel_body(evidence: &CoreEvidence, panel: usize) -> TriMesh {
    let of = &evidence.panels.panels[panel];
    let (frame, thickness_mm) = (evidence.frame(panel), evidence.promise.sheet.thickness_mm);
    let count = of.outline_mm.len() as u32;
    let corner = |[x, y]: &[f64; 2], z: f64| frame.to_model(&Point::new(*x, *y, z));
    let top = of.outline_mm.iter().map(|at| corner(at, 0.0));
    let bottom = of.outline_mm.iter().map(|at| corner(at, -thickness_mm));
    let points: Vec<Point> = top.chain(bottom).collect();
    let ring: Vec<u32> = (0..count).collect();
    let mut triangles = ear_clip(&points, &ring);
    let below = triangles
        .iter()
        .map(|[a, b, c]| [a + count, c + count, b + count]);
    let below: Vec<[u32; 3]> = below.collect();
    triangles.extend(below);
    for from in 0..count {
        let to = (from + 1) % count;
        triangles.push([from, from + count, to + count]);
        triangles.push([from, to + count, to]);
    }
    TriMesh::new(points, triangles).unwrap_or_default()
}

/// Returns the moments of a panel with its holes: volume, mm³, and first moments.
pub fn panel_moments(evidence: &CoreEvidence, panel: usize) -> (f64, Vector) {
    let of = &evidence.panels.panels[panel];
    let frame = evidence.frame(panel);
    let thickness_mm = evidence.promise.sheet.thickness_mm;
    let whole: Moments = moments_of_mesh(&panel_body(evidence, panel));
    let holes = of.holes.iter().map(|hole| {
        let volume = FRAC_PI_4 * hole.diameter_mm.powi(2) * thickness_mm;
        let [x, y] = hole.at_mm;
        let middle = frame.to_model(&Point::new(x, y, -0.5 * thickness_mm));
        (volume, middle.coords * volume)
    });
    let start = (whole.volume(), whole.first());
    holes.fold(start, |(volume, first), (hole, own)| {
        (volume - hole, first - own)
    })
}

/// Measures the panels.
pub fn measure_panels(evidence: &CoreEvidence) -> Result<PanelFacts, ClipError> {
    let count = evidence.panels.panels.len();
    let bodies: Vec<TriMesh> = (0..count)
        .map(|panel| panel_body(evidence, panel))
        .collect();
    let bases = evidence.bases();
    let mut out_mm = off_plane_mm(evidence);
    for (panel, body) in bodies.iter().enumerate() {
        let own = evidence.base_of(&bases, panel);
        let planes = own.into_iter().flat_map(|(base, _)| &base.planes);
        let heights = planes.flat_map(|plane| body.vertices().iter().map(|p| plane.distance(p)));
        out_mm = heights.fold(out_mm, f64::max);
    }
    let mut overlap_mm3 = 0.0_f64;
    for (index, body) in bodies.iter().enumerate() {
        for other in &bodies[..index] {
            overlap_mm3 = overlap_mm3.max(shared_mm3(body, other)?);
        }
    }
    Ok(PanelFacts {
        overlap_mm3,
        out_mm,
        frame_error: frame_error(evidence),
        unscrewed: misfits(evidence),
    })
}

/// Returns the greatest distance of a panel's outer side from its plane of the base, mm.
fn off_plane_mm(evidence: &CoreEvidence) -> f64 {
    let bases = evidence.bases();
    let panels = evidence.panels.panels.iter().enumerate();
    let placed = panels.filter_map(|(index, panel)| {
        let (base, plane) = evidence.base_of(&bases, index)?;
        Some((index, panel, *base.planes.get(plane)?))
    });
    let distances = placed.flat_map(|(index, panel, plane)| {
        let frame = evidence.frame(index);
        let corners = panel.outline_mm.iter();
        corners.map(move |[x, y]| {
            plane
                .distance(&frame.to_model(&Point::new(*x, *y, 0.0)))
                .abs()
        })
    });
    distances.fold(0.0, f64::max)
}

/// Returns the greatest deviation of a panel's frame from a rigid motion.
fn frame_error(evidence: &CoreEvidence) -> f64 {
    let frames = (0..evidence.panels.panels.len()).map(|panel| evidence.frame(panel));
    let errors = frames.map(|frame| {
        let off = (frame.axes.transpose() * frame.axes - Matrix::identity()).amax();
        off.max((frame.axes.determinant() - 1.0).abs())
    });
    errors.fold(0.0, f64::max)
}

/// Returns the volume that two bodies share, mm³.
pub fn shared_mm3(a: &TriMesh, b: &TriMesh) -> Result<f64, ClipError> {
    let [one, two] = [a.aabb(), b.aabb()];
    let is_apart = (0..3).any(|k| one.min[k] >= two.max[k] || two.min[k] >= one.max[k]);
    if is_apart {
        return Ok(0.0);
    }
    let shared = Csg::of_mesh(a)?.intersect(&Csg::of_mesh(b)?)?;
    Ok(shared.to_mesh()?.signed_volume_mm3().max(0.0))
}
