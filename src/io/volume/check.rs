//! Checks what was read: one volume mesh, and one density.

use super::choice::{DataChoice, DensitySource, choose};
use super::error::{Place, VolumeError};
use super::raw::{Ignored, On, Raw, VECTORS};
use crate::tets::{Tets, TetsError, TetsParts};

/// A volume mesh that was read.
#[derive(Debug, Clone)]
pub struct Volume {
    /// The tetrahedra, in the units of the file.
    pub tets: Tets,
    /// The data that is the density; `None` for a mesh that is solid.
    pub density: Option<DensitySource>,
    /// Parts of the file that were passed over.
    pub ignored: Vec<Ignored>,
}

/// Checks the mesh and the density that is chosen; `place` tells places in the file.
pub(super) fn checked(
    raw: Raw,
    data: &DataChoice,
    place: impl Fn(usize, Option<On>) -> Place,
) -> Result<Volume, VolumeError> {
    if let Some((place, kind)) = raw.other {
        let count = raw.other_count;
        return Err(VolumeError::OtherCells { place, kind, count });
    }
    let others = raw.ignored.iter().filter(|it| it.kind != VECTORS);
    let others: Vec<String> = others
        .map(|it| format!("{} {}", it.count, it.kind))
        .collect();
    if raw.cells.is_empty() && !others.is_empty() {
        let found = others.join(", ");
        return Err(VolumeError::NoCells { found });
    }
    let chosen = choose(&raw.arrays, data)?;
    let densities = DensitySource::densities(chosen);
    let parts = TetsParts {
        vertices: raw.vertices,
        cells: raw.cells,
        densities,
    };
    let offset_of = |error: &TetsError| match (error, chosen) {
        (TetsError::Density { index, .. }, Some(array)) => {
            Some((*array.offsets.get(*index)?, Some(array.on)))
        }
        _ => Some((*raw.cell_offsets.get(error.cell()?)?, None)),
    };
    let tets = Tets::new(parts).map_err(|source| VolumeError::Mesh {
        place: offset_of(&source).map(|(offset, on)| place(offset, on)),
        source,
    })?;
    Ok(Volume {
        tets,
        density: chosen.map(DensitySource::of),
        ignored: raw.ignored,
    })
}
