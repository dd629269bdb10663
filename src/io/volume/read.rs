//! Reads a volume mesh from a file; the content decides between `.msh` and `.vtk`.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::super::read::{ReadError, read_bytes};
use super::check::{Volume, checked};
use super::choice::DataChoice;
use super::error::VolumeError;
use super::{msh, tetgen, vtk};
use crate::tets::TetsError;

/// The first bytes of a Gmsh file.
const MSH: &[u8] = b"$MeshFormat";
/// The first bytes of a legacy VTK file.
const VTK: &[u8] = b"# vtk DataFile";
/// The endings of the names of volume meshes.
const ENDINGS: [&str; 4] = ["msh", "vtk", "node", "ele"];
/// The endings of TetGen's two files.
const PAIR: [&str; 2] = ["node", "ele"];

/// A reason why a file gives no volume mesh.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadVolumeError {
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// Of TetGen's two files one is not there.
    #[error(
        "{}: TetGen writes two files, and {} is not beside it; remedy: put both into one folder",
        path.display(), other.display()
    )]
    Alone {
        /// The file asked for.
        path: PathBuf,
        /// The file that is missing.
        other: PathBuf,
    },
    /// The content is no volume mesh.
    #[error("{}: the file holds no usable volume mesh", path.display())]
    Content {
        /// The path asked for.
        path: PathBuf,
        /// The fault and its place.
        source: Box<VolumeError>,
    },
}

/// Returns true for the name of a volume mesh: `.msh`, `.vtk`, `.node` or `.ele`.
pub fn is_volume_name(path: &Path) -> bool {
    ending(path).is_some_and(|ending| ENDINGS.contains(&ending.as_str()))
}

fn ending(path: &Path) -> Option<String> {
    let ending = path.extension().and_then(OsStr::to_str)?;
    Some(ending.to_ascii_lowercase())
}

/// Reads the volume mesh at `path`. Of TetGen's two files either one is named.
///
/// # Errors
/// The file, or its place, that cannot be read.
pub fn read_volume(path: &Path, data: &DataChoice) -> Result<Volume, ReadVolumeError> {
    let content = |path: &Path, source| ReadVolumeError::Content {
        path: path.to_owned(),
        source: Box::new(source),
    };
    let own = ending(path).unwrap_or_default();
    if !PAIR.contains(&own.as_str()) {
        let bytes = read_bytes(path)?;
        return decode_volume(&bytes, data).map_err(|source| content(path, source));
    }
    let bytes = read_bytes(path)?;
    let [node, ele] = PAIR;
    let other = path.with_extension(if own == node { ele } else { node });
    if !other.is_file() {
        let path = path.to_owned();
        return Err(ReadVolumeError::Alone { path, other });
    }
    let others = read_bytes(&other)?;
    let (files, bytes) = if own == node {
        ([path, other.as_path()], [&bytes[..], &others[..]])
    } else {
        ([other.as_path(), path], [&others[..], &bytes[..]])
    };
    decode_tetgen(bytes, data).map_err(|(file, source)| content(files[file], source))
}

/// Returns the volume mesh in the bytes of a `.msh` or a legacy `.vtk` file.
///
/// # Errors
/// The fault with its place.
pub fn decode_volume(bytes: &[u8], data: &DataChoice) -> Result<Volume, VolumeError> {
    let (raw, source) = if bytes.starts_with(MSH) {
        msh::decode(bytes)?
    } else if bytes.starts_with(VTK) {
        vtk::decode(bytes)?
    } else {
        return Err(VolumeError::Foreign);
    };
    checked(raw, data, |offset, _| source.place(offset))
}

/// Returns true for a fault in the file of the nodes.
fn is_of_nodes(error: &VolumeError) -> bool {
    let VolumeError::Mesh { source, .. } = error else {
        return false;
    };
    matches!(source, TetsError::Density { what: "corner", .. })
}

/// Returns the volume mesh in the bytes of TetGen's two files, first the nodes, then the cells.
///
/// # Errors
/// The file at fault, 0 or 1, and the fault with its place.
pub fn decode_tetgen(bytes: [&[u8]; 2], data: &DataChoice) -> Result<Volume, (usize, VolumeError)> {
    let (raw, tables) = tetgen::decode(bytes)?;
    let checked = checked(raw, data, |offset, on| tetgen::place(&tables, offset, on));
    checked.map_err(|error| (usize::from(!is_of_nodes(&error)), error))
}
