//! Reduces triangles, and leaves the old ones wherever the new ones would meet or break a rule.

use rayon::prelude::*;

use super::crossing::find_crossings_among;
use super::decimate::{Decimation, Rules};
use super::error::VoidError;
use super::runs::flat_map_in_runs;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{MeshError, TriMesh};

/// Number of times the failures are locked and the rest is tried again, before the mesh is left as
/// it was.
const ROUNDS: usize = 8;

/// Rings of neighbours locked around a triangle that failed.
const LOCKED_RINGS: usize = 2;

/// Returns the mesh with fewer triangles by these rules, free of self-intersection. Returns the
/// mesh itself if triangles still fail after the last round.
pub(super) fn simplify(mesh: TriMesh, rules: Rules, watch: &Watch) -> Result<TriMesh, VoidError> {
    let mut locked = vec![false; mesh.vertices().len()];
    let mut decimation = Decimation::new(&mesh, rules);
    let mut passed = Passed::default();
    for _ in 0..ROUNDS {
        let (simple, names) = compact(&mesh, decimation.run(&locked, watch)?)?;
        let failed = passed.find_failures(&simple, &names, rules, watch)?;
        if failed.is_empty() {
            return Ok(simple);
        }
        let corners = failed
            .into_iter()
            .flat_map(|i| simple.triangles()[i as usize])
            .map(|v| names[v as usize]);
        lock(&mesh, corners, &mut locked);
    }
    Ok(mesh)
}

/// The triangles that meet no other and are allowed, by the old numbers of their corners, in
/// ascending order.
#[derive(Default)]
struct Passed(Vec<[u32; 3]>);

impl Passed {
    /// Returns the triangles that meet others or that the rules forbid. Only triangles that have
    /// not passed before are tested, with all that they meet.
    fn find_failures(
        &mut self,
        mesh: &TriMesh,
        names: &[u32],
        rules: Rules,
        watch: &Watch,
    ) -> Result<Vec<u32>, Cancelled> {
        let named = |t: &[u32; 3]| t.map(|v| names[v as usize]);
        let is_new: Vec<bool> = mesh
            .triangles()
            .par_iter()
            .map(|t| self.0.binary_search(&named(t)).is_err())
            .collect();
        let mut failed = find_crossings_among(mesh, &is_new, watch)?;
        let forbidden = |i: usize| {
            let is_forbidden = is_new[i] && !(rules.allows)(&mesh.corners(i));
            is_forbidden.then_some(i as u32)
        };
        failed.extend(flat_map_in_runs(is_new.len(), watch, forbidden)?);
        let mut has_failed = vec![false; is_new.len()];
        failed.iter().for_each(|&i| has_failed[i as usize] = true);
        self.0 = mesh
            .triangles()
            .iter()
            .zip(has_failed)
            .filter(|(_, bad)| !bad)
            .map(|(t, _)| named(t))
            .collect();
        self.0.par_sort_unstable();
        Ok(failed)
    }
}

/// Locks these vertices and those around them.
fn lock(mesh: &TriMesh, seeds: impl Iterator<Item = u32>, locked: &mut [bool]) {
    seeds.for_each(|v| locked[v as usize] = true);
    for _ in 0..LOCKED_RINGS {
        let near: Vec<u32> = mesh
            .triangles()
            .iter()
            .filter(|t| t.iter().any(|&v| locked[v as usize]))
            .flatten()
            .copied()
            .collect();
        near.into_iter().for_each(|v| locked[v as usize] = true);
    }
}

/// Returns the mesh of these triangles without unused vertices, and the old number of each vertex
/// that is left.
fn compact(mesh: &TriMesh, triangles: Vec<[u32; 3]>) -> Result<(TriMesh, Vec<u32>), MeshError> {
    let mut number = vec![u32::MAX; mesh.vertices().len()];
    let mut names = Vec::new();
    let mut numbered = |v: u32| {
        let new = &mut number[v as usize];
        if *new == u32::MAX {
            *new = names.len() as u32;
            names.push(v);
        }
        *new
    };
    let triangles = triangles
        .into_iter()
        .map(|t| t.map(&mut numbered))
        .collect();
    let vertices = names.iter().map(|&v| mesh.vertices()[v as usize]).collect();
    Ok((TriMesh::new(vertices, triangles)?, names))
}
