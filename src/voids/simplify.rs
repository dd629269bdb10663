//! Fewer triangles, and none that meet or that a judge refuses: where that fails the old ones stay.

use super::crossing::crossing_triangles;
use super::decimate::{Stray, decimated};
use crate::mesh::{MeshError, TriMesh};

/// How often what failed is locked and the rest done again, before everything is left as it was.
const ROUNDS: usize = 4;

/// Rings of neighbours locked around a triangle that failed.
const LOCKED_RINGS: usize = 2;

/// The mesh with fewer triangles within `stray`, free of self-intersection, none of them among those that `refused`
/// names; the mesh itself if that cannot be had.
pub(super) fn simplified(
    mesh: TriMesh,
    stray: Stray,
    refused: impl Fn(&TriMesh) -> Vec<usize>,
) -> Result<TriMesh, MeshError> {
    let mut locked = vec![false; mesh.vertices().len()];
    for _ in 0..ROUNDS {
        let (simple, names) = compacted(&mesh, decimated(&mesh, stray, &locked))?;
        let mut failed: Vec<usize> = crossing_triangles(&simple).into_iter().map(|i| i as usize).collect();
        failed.extend(refused(&simple));
        if failed.is_empty() {
            return Ok(simple);
        }
        let corners = failed.into_iter().flat_map(|i| simple.triangles()[i]).map(|v| names[v as usize]);
        lock(&mesh, corners, &mut locked);
    }
    Ok(mesh)
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
