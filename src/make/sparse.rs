//! Writing the regions of sparse infill: their STL files in memory, read back.

use super::write::write_free_of_folds;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::geom::Vector;
use crate::io::stl;
use crate::mesh::TriMesh;
use crate::run::{Level, Placed, Voids, WrittenPart, WrittenRegion, WrittenSparse};
use crate::verify::{Pose, SPARSE_FOLDER};

/// Adds the regions of sparse infill to a part that is printed in one piece, as they lie in the
/// part's file. Parts of hollow prints stay as they are.
///
/// # Errors
/// A file does not read back, or the watch was stopped.
pub fn with_sparse(
    placed: &Placed,
    voids: &Voids,
    part: WrittenPart,
    watch: &Watch,
) -> Result<WrittenPart, Error> {
    let Some(nested) = &placed.sparse else {
        return Ok(part);
    };
    let bodies = voids.hollowed.voids.iter();
    let outermost = bodies.fold(TriMesh::default(), |all, void| all.joined(void.mesh()));
    let meshes = std::iter::once(&outermost).chain(&voids.inner);
    let levels = nested.levels.iter().zip(meshes);
    let levels = levels.filter(|(_, mesh)| !mesh.is_empty());
    let levels: Vec<(&Level, &TriMesh)> = levels.collect();
    // The shells of a wave have the same few densities again and again.
    let count_before = |index: usize| {
        let percent = |at: usize| levels[at].0.nominal_percent();
        (0..index)
            .filter(|at| percent(*at) == percent(index))
            .count()
    };
    let writer = RegionWriter {
        placed,
        pose: part.evidence().pose,
        watch,
    };
    let regions = levels.iter().enumerate().map(|(index, (level, mesh))| {
        let name = writer.name(level, count_before(index));
        writer.write(&name, level, mesh)
    });
    let regions: Vec<WrittenRegion> = regions.collect::<Result<_, Error>>()?;
    let Some(first) = regions.first() else {
        return Ok(part);
    };
    Ok(WrittenPart {
        read_back: part.read_back.clone().joined(&first.mesh.reversed()),
        sparse: Some(WrittenSparse {
            outside: part.read_back,
            regions,
        }),
        ..part
    })
}

/// Writes the regions of one part.
struct RegionWriter<'a> {
    placed: &'a Placed,
    /// The pose of the part's file.
    pose: Pose,
    watch: &'a Watch,
}

impl RegionWriter<'_> {
    /// Returns the name of a region, after some of the same density.
    fn name(&self, level: &Level, count_before: usize) -> String {
        let (model, percent) = (self.placed.name(), level.nominal_percent());
        match count_before {
            0 => format!("{model}_{percent}percent"),
            before => format!("{model}_{percent}percent_{}", before + 1),
        }
    }

    /// Writes a region that is given in the model frame.
    fn write(&self, name: &str, level: &Level, mesh: &TriMesh) -> Result<WrittenRegion, Error> {
        let scale = Vector::from(self.placed.shop.printer.print_scale_ratio());
        let laid = mesh.map_vertices(|p| self.pose.to_print(p).coords.component_mul(&scale).into());
        let bytes = write_free_of_folds(&laid, name, self.watch)?;
        let written = stl::decode(&bytes)?;
        Ok(WrittenRegion {
            level: *level,
            file: Some((format!("{SPARSE_FOLDER}{name}.stl"), bytes)),
            mesh: written.map_vertices(|p| p.coords.component_div(&scale).into()),
        })
    }
}
