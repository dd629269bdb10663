//! Junctures that are pieces of a model: what lies on its surface, what of it is lost, and the wall
//! around every root.

use std::collections::BTreeMap;

use rayon::prelude::*;

use super::divided::Joints;
use super::juncture::in_model;
use super::network::NetworkEvidence;
use super::network_ends::Ends;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Point;
use crate::mesh::union_find::UnionFind;
use crate::mesh::{MeshDistance, TriMesh};
use crate::repair::weld;
use crate::verify::cover::{Lie, Sheet, Sheets, Whose};

/// The facts about junctures that are pieces of a model.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFacts {
    /// Junctures with triangles that lie neither on the model, nor in a cut, a bore or a peg.
    pub off: Vec<String>,
    /// Places of the model that no juncture has, though no limb replaces them.
    pub lost: Vec<String>,
    /// The least wall around a root in its juncture, mm, with the name of the limb.
    pub wall: Option<(f64, String)>,
}

/// Where limbs end and cuts run in the junctures.
pub(super) struct Made<'a> {
    pub ends: Vec<Ends<'a>>,
    /// The cuts of every juncture; `None` if it is in one part.
    pub joints: Vec<Option<Joints<'a>>>,
}

/// Measures the junctures against the model; `None` if the kit has none.
pub(super) fn measure_model(
    evidence: &NetworkEvidence,
    made: &Made,
    watch: &Watch,
) -> Result<Option<ModelFacts>, Cancelled> {
    let Some(model) = &evidence.model else {
        return Ok(None);
    };
    let model = weld(model);
    let ends = &made.ends;
    watch.check()?;
    let off = off_model(evidence, &model, made);
    watch.check()?;
    let lost = lost(evidence, &model, ends);
    watch.check()?;
    let distance = MeshDistance::new(&model);
    let walls = ends.iter().zip(&evidence.promise.limbs);
    let walls = walls.map(|(ends, limb)| (ends.wall_mm(&distance), limb.id.clone()));
    Ok(Some(ModelFacts {
        off,
        lost,
        wall: walls.min_by(|a, b| a.0.total_cmp(&b.0)),
    }))
}

fn sheets_of<'a>(meshes: impl Iterator<Item = &'a TriMesh>) -> Sheets {
    let whose = Whose::Any;
    let corners = meshes.flat_map(TriMesh::iter_corners);
    Sheets::new(corners.map(|corners| Sheet { corners, whose }).collect())
}

/// Returns the parts of junctures that are off the model, each with a place.
fn off_model(evidence: &NetworkEvidence, model: &TriMesh, made: &Made) -> Vec<String> {
    let sheets = sheets_of([model].into_iter());
    let mut found = Vec::new();
    for (index, own) in evidence.promise.junctures.iter().enumerate() {
        let joints = made.joints[index].as_ref();
        let pieces = own.parts.iter().zip(&evidence.junctures[index]);
        for (part, (promise, read)) in pieces.enumerate() {
            let is_made = |corners: &[Point; 3]| {
                let mut limbs = evidence.promise.limbs.iter().zip(&made.ends);
                let is_end = limbs.any(|(limb, ends)| {
                    let as_root = limb.from == index + 1 && ends.is_in_root(corners);
                    as_root || (limb.to == index + 1 && ends.is_on_last(corners))
                });
                is_end || joints.is_some_and(|joints| joints.holds(part, corners))
            };
            let corners: Vec<[Point; 3]> = in_model(read).iter_corners().collect();
            let off = corners.par_iter().map(|corners| {
                if is_made(corners) {
                    return None;
                }
                match sheets.lie(corners, None) {
                    Lie::On(_) => None,
                    Lie::Off(at) => Some(at),
                }
            });
            let off: Vec<Point> = off.collect::<Vec<_>>().into_iter().flatten().collect();
            found.extend(off.first().map(|first| {
                let (count, at) = (off.len(), place(first));
                format!("{} in {count} triangles, the first at {at}", promise.id)
            }));
        }
    }
    found
}

/// Returns the patches of the model that are lost, each with a place.
///
/// A limb replaces one band of the model, from its root's mouth to its last one. Every patch that
/// no juncture has must be the band of a limb of its own: that nearest to the root's mouth.
fn lost(evidence: &NetworkEvidence, model: &TriMesh, ends: &[Ends]) -> Vec<String> {
    let whole = evidence.whole_junctures();
    let sheets = sheets_of(whole.iter());
    let bare = model.triangles().par_iter().enumerate();
    let bare = bare.map(|(index, triangle)| {
        let lies = sheets.lie(&model.corners(index), None);
        matches!(lies, Lie::Off(_)).then_some(*triangle)
    });
    let bare: Vec<[u32; 3]> = bare.collect::<Vec<_>>().into_iter().flatten().collect();
    let mut sets = UnionFind::new(model.vertices().len());
    for [a, b, c] in &bare {
        sets.merge(*a, *b);
        sets.merge(*b, *c);
    }
    let mut patches: BTreeMap<u32, Vec<Point>> = BTreeMap::new();
    for vertex in bare.iter().flatten() {
        let patch = patches.entry(sets.root(*vertex)).or_default();
        patch.push(model.vertices()[*vertex as usize]);
    }
    let mut patches: Vec<Option<Vec<Point>>> = patches.into_values().map(Some).collect();
    for ends in ends {
        let bands = patches.iter().enumerate().filter_map(|(index, patch)| {
            let patch = patch.as_ref().filter(|patch| ends.reaches_both(patch))?;
            Some((index, ends.mouth_gap_mm(patch)))
        });
        if let Some((band, _)) = bands.min_by(|a, b| a.1.total_cmp(&b.1)) {
            patches[band] = None;
        }
    }
    let lost = patches.into_iter().flatten();
    lost.map(|patch| format!("{} corners around {}", patch.len(), place(&patch[0])))
        .collect()
}

fn place(p: &Point) -> String {
    format!("{:.1},{:.1},{:.1} mm", p.x, p.y, p.z)
}
