//! Fewer triangles, and none that meet or that a judge refuses: where that fails the old ones stay.

use super::crossing::crossing_triangles;
use rayon::prelude::*;

use super::decimate::{Decimation, Rules};
use crate::mesh::{MeshError, TriMesh};

/// How often what failed is locked and the rest done again, before everything is left as it was.
const ROUNDS: usize = 4;

/// Rings of neighbours locked around a triangle that failed.
const LOCKED_RINGS: usize = 2;

/// The mesh with fewer triangles by these rules, free of self-intersection; the mesh itself if that cannot be had.
pub(super) fn simplified(mesh: TriMesh, rules: Rules) -> Result<TriMesh, MeshError> {
    let mut locked = vec![false; mesh.vertices().len()];
    let mut decimation = Decimation::new(&mesh, rules);
    for _ in 0..ROUNDS {
        let (simple, names) = compacted(&mesh, decimation.run(&locked))?;
        let failed = failed_triangles(&simple, rules);
        if failed.is_empty() {
            return Ok(simple);
        }
        let corners =
            failed.into_iter().flat_map(|i| simple.triangles()[i as usize]).map(|v| names[v as usize]);
        lock(&mesh, corners, &mut locked);
    }
    Ok(mesh)
}

/// The triangles that meet others or that the rules forbid.
fn failed_triangles(mesh: &TriMesh, rules: Rules) -> Vec<u32> {
    let mut failed = crossing_triangles(mesh);
    let forbidden = (0..mesh.triangles().len() as u32).into_par_iter();
    failed.par_extend(forbidden.filter(|&i| !(rules.allows)(&mesh.corners(i as usize))));
    failed
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

/// The mesh of these triangles without the vertices that none names, and those vertices' old numbers.
fn compacted(mesh: &TriMesh, triangles: Vec<[u32; 3]>) -> Result<(TriMesh, Vec<u32>), MeshError> {
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
    let triangles = triangles.into_iter().map(|t| t.map(&mut numbered)).collect();
    let vertices = names.iter().map(|&v| mesh.vertices()[v as usize]).collect();
    Ok((TriMesh::new(vertices, triangles)?, names))
}
