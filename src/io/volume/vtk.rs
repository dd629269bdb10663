//! Reads VTK's legacy format: unstructured grids, as text or binary, of versions to 5.1.

use super::error::VolumeError;
use super::raw::{On, Raw};
use super::source::Source;
use super::vtk_file::Vtk;

/// Returns the mesh of a file.
pub(super) fn decode(bytes: &[u8]) -> Result<(Raw, Source<'_>), VolumeError> {
    let mut vtk = Vtk::new(bytes);
    vtk.header()?;
    while !vtk.source.values.left().trim_ascii().is_empty() {
        vtk.source.values.skip_blanks();
        let at = vtk.source.values.offset();
        let word = vtk.source.text_word("a word such as POINTS")?;
        match word.to_ascii_uppercase().as_str() {
            "DATASET" => vtk.dataset()?,
            "POINTS" => vtk.points()?,
            "CELLS" => vtk.cells()?,
            "CELL_TYPES" => vtk.cell_types()?,
            "POINT_DATA" => vtk.data_of(On::Corners)?,
            "CELL_DATA" => vtk.data_of(On::Cells)?,
            word => vtk.attribute(word, at)?,
        }
    }
    Ok((vtk.raw, vtk.source))
}
