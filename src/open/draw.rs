//! The bodies of a solution besides its voids: pockets of ballast, and regions inside of regions.

use rayon::prelude::*;

use crate::ballast::{Load, PlacedPart, Pocket};
use crate::base::watch::Watch;
use crate::cut::{Seat, Void};
use crate::error::{CellsError, Error};
use crate::hollow::Solution;
use crate::mesh::{Solid, TriMesh};
use crate::run::{DrawnCells, Inside, Level, Nested, Placed, Voids};
use crate::voids::{self, Cavity, VoidError, without_slivers};

/// Rounds of correction with cells, over those without: each may turn some of them solid.
pub const CELL_ROUNDS: usize = 3;
/// Rounds after which cells that stay solid do so for good, or they would come and go.
pub const FREE_ROUNDS: usize = 2;

/// Draws a solution's voids, or its outermost region of infill.
pub fn draw_outermost(
    cavity: &Cavity,
    placed: &Placed,
    solution: &Solution,
    watch: &Watch,
) -> Result<voids::Voids, VoidError> {
    let sparse = placed.sparse.as_ref();
    let level = sparse.and_then(|nested| nested.levels.first());
    let body = sparse
        .zip(level)
        .and_then(|(nested, level)| nested.body(level));
    if let Some(body) = body {
        return cavity.void_bodies_within(body.mesh(), watch);
    }
    let quadric = level.map_or(solution.quadric, |level| level.quadric(&solution.quadric));
    cavity.void_bodies(&quadric, &placed.goal().frame, watch)
}

/// Draws the regions of infill inside of the outermost one, model frame.
///
/// Bodies that are too small to be printed on their own are left to the region around them. A match
/// and a field keep them, and denser cores in a region, or they would miss what they must weigh.
pub fn draw_inner(
    cavity: &Cavity,
    placed: &Placed,
    solution: &Solution,
    watch: &Watch,
) -> Result<Vec<TriMesh>, Error> {
    let Some(nested) = &placed.sparse else {
        return Ok(Vec::new());
    };
    let levels = inner_levels(nested);
    let frame = &placed.goal().frame;
    let draw = |level: &Level| {
        if let Some(body) = nested.body(level) {
            return Ok(cavity.region_within(body.mesh())?);
        }
        let quadric = level.quadric(&solution.quadric);
        if placed.keeps_small_regions() {
            return Ok(cavity.region(&quadric, frame, watch)?);
        }
        let bodies = cavity.void_bodies(&quadric, frame, watch)?.bodies;
        let join = |all: TriMesh, body: &Solid| all.joined(body.mesh());
        Ok(bodies.iter().fold(TriMesh::default(), join))
    };
    levels.par_iter().map(draw).collect()
}

fn inner_levels(nested: &Nested) -> &[Level] {
    nested.levels.get(1..).unwrap_or_default()
}

/// The cells in the place of some bodies of air.
pub struct InCells {
    /// The bodies of air.
    pub air: Vec<Solid>,
    /// The cells.
    pub cells: DrawnCells,
    /// The cells in these bodies that stay solid. They do not touch each other.
    pub solid: TriMesh,
}

/// Makes bodies of air of cells; the bodies themselves are left in a print without cells.
pub fn in_cells(placed: &Placed, bodies: Vec<Solid>, watch: &Watch) -> Result<InCells, Error> {
    let Some(inside) = &placed.cells else {
        return Ok(InCells {
            air: bodies,
            cells: DrawnCells::default(),
            solid: TriMesh::default(),
        });
    };
    let join = |all: TriMesh, body: &Solid| all.joined(body.mesh());
    let region = bodies.iter().fold(TriMesh::default(), join);
    let drawn = inside.cells.within(&region, watch);
    let drawn = drawn.map_err(CellsError::from)?;
    let mut cells = DrawnCells::default();
    let air = drawn.made.into_iter().map(|void| {
        cells.places.extend(void.places);
        cells.doors.extend(void.doors);
        void.body
    });
    Ok(InCells {
        air: air.collect(),
        cells,
        solid: drawn.solid,
    })
}

/// Returns the error that the cells that stay solid leave too little to be emptied.
pub fn too_solid(inside: &Inside) -> Error {
    let sizes = inside.cells.sizes;
    let error = CellsError::TooSolid {
        size_mm: sizes.size_mm,
        opening_mm: sizes.opening_mm,
    };
    error.into()
}

/// Returns the pockets of ballast, each with the seat of its part.
pub fn pockets(load: &Load) -> Result<Vec<Void>, Error> {
    let pocket = |(placed, pocket): (&PlacedPart, Pocket)| {
        let seat = Seat {
            center: pocket.center,
            axis: pocket.half_height_mm.map(|half| (pocket.axis, half)),
            radius_mm: pocket.radius_mm,
            opening_mm: 2.0 * placed.lump.shape.radius_mm(),
        };
        Ok(Void {
            body: Solid::new(pocket.mesh()).map_err(VoidError::from)?,
            holds: Some(seat),
        })
    };
    load.parts.iter().zip(load.pockets()).map(pocket).collect()
}

/// Returns the voids without the slivers that the rounding of a file would fold.
pub fn finish(mut voids: Voids, watch: &Watch) -> Result<Voids, Error> {
    let bodies = std::mem::take(&mut voids.hollowed.voids);
    let finish = |void: Void| {
        let body = without_slivers(&void.body, watch)?;
        Ok::<_, Error>(Void { body, ..void })
    };
    let finished = bodies.into_par_iter().map(finish);
    voids.hollowed.voids = finished.collect::<Result<_, _>>()?;
    let inner = voids.inner.into_par_iter().map(|region| {
        if region.is_empty() {
            return Ok::<_, Error>(region);
        }
        let solid = Solid::new(region).map_err(VoidError::from)?;
        Ok(without_slivers(&solid, watch)?.into_mesh())
    });
    voids.inner = inner.collect::<Result<_, _>>()?;
    Ok(voids)
}
