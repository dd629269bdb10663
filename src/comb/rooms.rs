//! The voids of cells: each cell drawn in from its walls, and from the skin of the model.

use rayon::prelude::*;

use crate::base::watch::Watch;
use crate::cells::{BodyError, Cell, Chain, Polytope, Room, bodies};
use crate::mesh::{self, MeshDistance, TriMesh};

/// Volume below which a part of a void is rounding, mm³: a cube of a tenth of a millimetre.
const LEAST_MM3: f64 = 1e-3;
/// Size of the blocks in which the room inside the skin is divided, in mean sizes of a cell.
const BLOCK_RATIO: f64 = 1.0;

/// A void, one body of air.
pub(super) struct Void {
    /// The cell in which it lies.
    pub cell: usize,
    /// The surface, outward.
    pub mesh: TriMesh,
    /// Its distances.
    pub distance: MeshDistance,
    /// The volume, mm³.
    pub volume_mm3: f64,
}

/// The voids of all cells, and the polytopes in which they lie.
pub(super) struct Voids {
    /// The voids, by their cells.
    pub all: Vec<Void>,
    /// The cells, drawn in from their walls.
    pub drawn_in: Vec<Polytope>,
}

/// Returns the voids inside the skin, whose inner surface is `cavity`.
pub(super) fn voids(
    cells: &[Cell],
    cavity: &TriMesh,
    wall_mm: f64,
    watch: &Watch,
) -> Result<Voids, BodyError> {
    if cavity.is_empty() {
        return Ok(Voids {
            all: Vec::new(),
            drawn_in: vec![Polytope::default(); cells.len()],
        });
    }
    let triangles: Vec<_> = cavity.iter_corners().collect();
    let mean_mm = (cavity.signed_volume_mm3() / cells.len().max(1) as f64).cbrt();
    let room = Room::of_triangles(&triangles, BLOCK_RATIO * mean_mm);
    let drawn = cells.par_iter().map(|cell| {
        let polytope = cell.polytope.drawn_in(0.5 * wall_mm);
        let part = match polytope.faces() {
            [] => Chain::default(),
            _ => room.within(&polytope),
        };
        // What lies outside of the room is no cell of it.
        match part.is_empty() {
            true => Cell {
                polytope: Polytope::default(),
                part,
            },
            false => Cell { polytope, part },
        }
    });
    let drawn: Vec<Cell> = drawn.collect();
    let meshes = bodies(&drawn, cavity, watch)?;
    let parts = meshes.par_iter().enumerate().flat_map_iter(|(cell, body)| {
        let parts = mesh::bodies(&body.mesh()).into_iter();
        parts.filter_map(move |mesh| {
            let volume_mm3 = mesh.signed_volume_mm3();
            (volume_mm3 > LEAST_MM3).then(|| Void {
                cell,
                distance: MeshDistance::new(&mesh),
                mesh,
                volume_mm3,
            })
        })
    });
    Ok(Voids {
        all: parts.collect(),
        drawn_in: drawn.into_iter().map(|cell| cell.polytope).collect(),
    })
}
