//! The sections at the cuts, for the drawings of the job sheet.

use rayon::prelude::*;

use super::layout::Layout;
use crate::base::watch::{Cancelled, Watch};
use crate::cut::{Cut, CutError, Point2, Ring, Section, UncutFace, clip_to_limits};
use crate::geom::{Parting, Plane, Point, rings::thinnest};
use crate::mesh::{MeshDistance, TriMesh};
use crate::page::{CutFace, Mouth, Region};
use crate::repair::weld;
use crate::verify::{PartEvidence, PromisedVoid};

/// Distance from the middle of a region's widest disc at which its parts are looked up: inside the
/// disc, past a pin. A share of its diameter.
const BESIDE_RATIO: f64 = 0.42;
/// Directions in which that is tried.
const LOOKS: usize = 8;
/// Distance from the cut at which a part is looked up, mm: past rounding, not past a wall.
const OFF_MM: f64 = 0.02;

/// Returns the sections of the uncut body at all cuts.
///
/// # Errors
/// A section cannot be made, or the watch was stopped.
pub(super) fn faces(layout: &Layout, watch: &Watch) -> Result<Vec<CutFace>, CutError> {
    let (body, partings) = (&layout.body.welded, layout.partings);
    let solid = |part: &PartEvidence| {
        watch.check()?;
        let mesh = weld(&part.mesh.map_vertices(|p| part.pose.to_model(p)));
        Ok((part.id.clone(), MeshDistance::new(&mesh)))
    };
    let solids = layout.evidence.parts.par_iter().map(solid);
    let solids = solids.collect::<Result<Vec<(String, MeshDistance)>, Cancelled>>()?;
    let face = |(cut, parting): (&Cut, &Parting)| {
        watch.check()?;
        let plane = parting.plane;
        let section = Section::of_mesh(&clip_to_limits(parting, body)?, &plane);
        let regions = regions(&sections(body, parting, partings)?, &plane, &solids);
        let rings: Vec<Vec<[f64; 2]>> = section.rings.iter().map(flat_ring).collect();
        let uncut = layout.uncut.iter().filter(|face| face.cut == cut.id);
        let whole = uncut.map(|face| flat_point(&plane, face)).collect();
        let mouths = mouths(layout, parting, watch)?;
        // What ends where the cut ends is no wall.
        let wall = thinnest(&rings).filter(|ends| !ends.iter().any(|end| is_at_end(parting, *end)));
        Ok(CutFace {
            cut: cut.id.to_string(),
            plane,
            rings,
            wall,
            whole,
            regions,
            mouths,
        })
    };
    layout.cuts.iter().zip(partings).map(face).collect()
}

/// Returns whether a place of a cut, in the plane's coordinates, lies where it ends at another.
fn is_at_end(parting: &Parting, [x, y]: [f64; 2]) -> bool {
    let (u, v) = parting.plane.basis();
    let at = parting.plane.foot() + u * x + v * y;
    parting
        .within
        .iter()
        .any(|(other, _)| other.distance(&at).abs() < OFF_MM)
}

/// The sections of a body at a cut on either side of every other that ends there, or the one where
/// none does.
fn sections(
    body: &TriMesh,
    parting: &Parting,
    partings: &[Parting],
) -> Result<Vec<Section>, CutError> {
    let ends_here = |other: &&Parting| {
        other
            .within
            .iter()
            .any(|(plane, _)| *plane == parting.plane)
    };
    let halves = |cell: &Parting, other: &Parting| {
        [true, false].map(|is_above| {
            let within = [&cell.within[..], &[(other.plane, is_above)]].concat();
            Parting {
                within,
                ..cell.clone()
            }
        })
    };
    let cells = partings
        .iter()
        .filter(ends_here)
        .fold(vec![parting.clone()], |cells, other| {
            cells.iter().flat_map(|cell| halves(cell, other)).collect()
        });
    cells
        .iter()
        .map(|cell| Ok(Section::of_mesh(&clip_to_limits(cell, body)?, &cell.plane)))
        .collect()
}

/// Returns every two parts between which the cut passes, with a place in the material.
///
/// They are looked up beside the middle of the widest disc of each region: pins stand in the
/// middle.
fn regions(sections: &[Section], plane: &Plane, solids: &[(String, MeshDistance)]) -> Vec<Region> {
    let (u, v) = plane.basis();
    let part_at = |at: [f64; 2], off_mm: f64| {
        let point = plane.foot() + u * at[0] + v * at[1] + plane.normal * off_mm;
        solids
            .iter()
            .find(|(_, solid)| solid.signed(&point) > 0.0)
            .map(|(id, _)| id.clone())
    };
    let region = |(middle, diameter_mm): (Point2, f64)| {
        (0..LOOKS).find_map(|look| {
            let (sin, cos) = (std::f64::consts::TAU * look as f64 / LOOKS as f64).sin_cos();
            let reach_mm = BESIDE_RATIO * diameter_mm;
            let at = [middle.x + reach_mm * cos, middle.y + reach_mm * sin];
            let (below, above) = (part_at(at, -OFF_MM)?, part_at(at, OFF_MM)?);
            (below != above).then_some(Region {
                at,
                parts: [below, above],
            })
        })
    };
    let mut regions: Vec<Region> = Vec::new();
    for found in sections
        .iter()
        .flat_map(Section::largest_discs)
        .filter_map(region)
    {
        // A region that no other cut ends in is found on either side of it, or of two.
        if sections.len() == 1 || regions.iter().all(|known| known.parts != found.parts) {
            regions.push(found);
        }
    }
    regions
}

/// Returns the mouths of voids in the cut, each with the largest disc that passes.
fn mouths(layout: &Layout, parting: &Parting, watch: &Watch) -> Result<Vec<Mouth>, CutError> {
    let of_void = |(void, cavity): (&PromisedVoid, &TriMesh)| -> Result<Vec<Mouth>, CutError> {
        watch.check()?;
        let air = clip_to_limits(parting, &cavity.reversed())?;
        let discs = Section::of_mesh(&air, &parting.plane).largest_discs();
        let mouth = |(at, diameter_mm): (Point2, f64)| Mouth {
            void: void.id.clone(),
            at: [at.x, at.y],
            diameter_mm,
        };
        Ok(discs.into_iter().map(mouth).collect())
    };
    let voids = layout.evidence.promise.voids.iter();
    let of_voids = voids.zip(&layout.body.shells.inward).map(of_void);
    Ok(of_voids.collect::<Result<Vec<_>, _>>()?.concat())
}

fn flat_ring(ring: &Ring) -> Vec<[f64; 2]> {
    ring.points.iter().map(|point| [point.x, point.y]).collect()
}

fn flat_point(plane: &Plane, face: &UncutFace) -> [f64; 2] {
    let ((u, v), at) = (plane.basis(), Point::from(face.point_mm).coords);
    [u.dot(&at), v.dot(&at)]
}

#[cfg(test)]
mod tests;
