//! Writing the region of sparse infill: its STL file in memory, read back.

use super::write::write_free_of_folds;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::geom::Vector;
use crate::io::stl;
use crate::mesh::TriMesh;
use crate::run::{Placed, Voids, WrittenPart, WrittenSparse};
use crate::verify::SPARSE_FOLDER;

/// Adds the region of sparse infill to a part that is printed in one piece, as it lies in the
/// part's file. Parts of hollow prints stay as they are.
///
/// # Errors
/// The file does not read back, or the watch was stopped.
pub fn with_sparse(
    placed: &Placed,
    voids: &Voids,
    part: WrittenPart,
    watch: &Watch,
) -> Result<WrittenPart, Error> {
    let Some(sparse) = &placed.sparse else {
        return Ok(part);
    };
    let bodies = voids.hollowed.voids.iter();
    let region = bodies.fold(TriMesh::default(), |all, void| all.joined(void.mesh()));
    if region.is_empty() {
        return Ok(part);
    }
    let scale = Vector::from(placed.shop.printer.print_scale_ratio());
    let pose = part.evidence().pose;
    let laid = region.map_vertices(|p| pose.to_print(p).coords.component_mul(&scale).into());
    let percent = sparse.nominal_percent();
    let name = format!("{}_{percent}percent", placed.name());
    let bytes = write_free_of_folds(&laid, &name, watch)?;
    let written = stl::decode(&bytes)?;
    let mesh = written.map_vertices(|p| p.coords.component_div(&scale).into());
    Ok(WrittenPart {
        read_back: part.read_back.clone().joined(&mesh.reversed()),
        sparse: Some(WrittenSparse {
            file: Some((format!("{SPARSE_FOLDER}{name}.stl"), bytes)),
            outside: part.read_back,
            region: mesh,
        }),
        ..part
    })
}
