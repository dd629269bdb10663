//! Untangling: makes a surface that crosses itself the boundary of the space around which it winds.
//!
//! The triangles are cut along the lines in which they cross. The pieces that separate winding
//! number 0 from 1 are kept (Zhou et al., "Mesh arrangements for solid geometry", ACM TOG 35,
//! 2016). Decisions are combinatorial or by exact predicates; only places are rounded. Where
//! a corner lies in a face, or faces in one plane, the vertices are moved aside by a hair and all
//! is tried again.

mod contacts;
mod knots;
mod layers;
mod pieces;
mod shake;

use self::contacts::Cuts;
use self::knots::tie_knots;
use self::layers::layers_in_front;
use self::pieces::Pieces;
use self::shake::shake;
use super::unstitch::unstitch;
use super::weld::{drop_unused_vertices, weld};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point};
use crate::mesh::crossings::crossing_pairs;
use crate::mesh::edges::EdgeTable;
use crate::mesh::{Csg, TriMesh};

/// Distances by which vertices are moved aside, one after the other until one does, as shares of
/// the diagonal. Below 1e-10 rounding decides as before. Above 1e-6 (0.001 mm on a metre) it would
/// be seen.
const SHAKES: [f64; 5] = [0.0, 1e-10, 1e-9, 1e-8, 1e-7];

/// Largest number of pairs of crossing triangles. A surface with more is a heap of parts rather
/// than a surface that crosses itself here and there; 100 000 take some seconds.
const MAX_PAIRS: usize = 100_000;

/// Thickness up to which slivers along the seams are closed, as a share of the longest side. On a
/// model of 100 mm it is 2e-5 mm, the least that a file in single precision keeps.
const SLIVER_RATIO: f64 = 2e-7;

/// A surface that crosses itself no more.
#[derive(Debug)]
pub(super) struct Untangled {
    /// The surface.
    pub mesh: TriMesh,
    /// Number of pairs of triangles that crossed.
    pub pairs: usize,
    /// Largest distance between the old surface, where it is not inside the new one, and the new
    /// one, measured both ways, mm.
    pub moved_mm: f64,
}

/// Untangles a closed mesh; `None` if nothing crosses, or if no attempt can be proved.
///
/// The result encloses the space in which the winding number of the old surface is 1 or more. So
/// what lies inside twice is counted once, and what is inside out goes. Takes time n log n in the
/// triangles, and more only where they cross.
///
/// # Errors
/// The watch was stopped.
pub(super) fn untangle(mesh: &TriMesh, watch: &Watch) -> Result<Option<Untangled>, Cancelled> {
    let welded = weld(mesh);
    let diagonal_mm = welded.aabb().size().norm();
    for (attempt, ratio) in SHAKES.into_iter().enumerate() {
        let trial = shake(&welded, ratio * diagonal_mm, attempt);
        let pairs = crossing_pairs(&trial, watch)?;
        if pairs.is_empty() && attempt == 0 || pairs.len() > MAX_PAIRS {
            return Ok(None);
        }
        if let Some(kept) = cut_and_keep(&trial, &pairs, watch)?
            && let Some(found) = prove(&kept.mesh, watch)?
        {
            let moved_mm = farthest_mm(&welded, &kept.outside, &found);
            return Ok(Some(Untangled {
                mesh: found,
                pairs: pairs.len(),
                moved_mm,
            }));
        }
    }
    Ok(None)
}

/// The pieces that are kept, and places of what is dropped although it lies outside of them.
struct Kept {
    mesh: TriMesh,
    outside: Vec<Point>,
}

/// Cuts the triangles along their crossings and keeps the pieces between outside and inside.
/// Returns `None` if a touch cannot be decided.
fn cut_and_keep(
    mesh: &TriMesh,
    pairs: &[[u32; 2]],
    watch: &Watch,
) -> Result<Option<Kept>, Cancelled> {
    let Some(mut cuts) = Cuts::of(mesh, pairs) else {
        return Ok(None);
    };
    watch.check()?;
    let Some(pieces) = tie_knots(mesh, &mut cuts).and_then(|()| Pieces::of(mesh, &cuts)) else {
        return Ok(None);
    };
    watch.check()?;
    let whole = TriMesh::from_parts(cuts.points, pieces.triangles.clone());
    let Some(layers) = layers_in_front(mesh, &whole, &pieces) else {
        return Ok(None);
    };
    watch.check()?;
    let kept = layers.iter().zip(whole.triangles());
    let kept = kept.filter(|(layer, _)| **layer == 0).map(|(_, t)| *t);
    let outside = layers.iter().enumerate().filter(|(_, layer)| **layer < 0);
    let outside = outside.flat_map(|(t, _)| whole.corners(t)).collect();
    let kept = TriMesh::from_parts(whole.vertices().to_vec(), kept.collect());
    Ok(Some(Kept {
        mesh: drop_unused_vertices(kept),
        outside,
    }))
}

/// Separates what only touches and closes slivers; `None` if the surface is not closed then, or
/// crosses itself still.
fn prove(mesh: &TriMesh, watch: &Watch) -> Result<Option<TriMesh>, Cancelled> {
    let Some(split) = unstitch(mesh).filter(|split| !split.is_empty()) else {
        return Ok(None);
    };
    let Ok(body) = Csg::of_mesh(&split) else {
        return Ok(None);
    };
    let smooth = body.simplify_watched(SLIVER_RATIO * split.longest_side_mm(), watch)?;
    for found in [smooth.to_mesh().ok(), Some(split)].into_iter().flatten() {
        let is_closed = EdgeTable::of(&found).bad_count() == 0;
        if is_closed && crossing_pairs(&found, watch)?.is_empty() {
            return Ok(Some(found));
        }
    }
    Ok(None)
}

/// Returns the largest distance of the new vertices from the old surface, and of the old places
/// outside from the new surface.
fn farthest_mm(old: &TriMesh, outside: &[Point], new: &TriMesh) -> f64 {
    let farthest = |places: &[Point], surface: &TriMesh| {
        let bvh = Bvh::new(surface.iter_corners());
        let distance = |p: &Point| {
            let nearest = bvh.closest(p, f64::INFINITY, &[]);
            nearest.map_or(f64::INFINITY, |nearest| nearest.distance_squared.sqrt())
        };
        places.iter().map(distance).fold(0.0, f64::max)
    };
    farthest(new.vertices(), old).max(farthest(outside, new))
}

#[cfg(test)]
mod tests;
