//! Reading a model from a file, in the format its content shows.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::sniff::{Format, sniff};
use super::threemf::{self, ThreeMfError};
use super::{ObjError, PlyError, StlError, obj, ply, stl};
use crate::mesh::TriMesh;

/// Why a file does not give a mesh. The message names the file, its source the place in it.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: there is no such file; check the path", path.display())]
    Missing {
        /// The path asked for.
        path: PathBuf,
    },
    /// The path is a directory.
    #[error("{}: this is a directory; name the STL, OBJ, PLY or 3MF file in it", path.display())]
    Directory {
        /// The path asked for.
        path: PathBuf,
    },
    /// The system refuses to read the file.
    #[error("{}: the file cannot be read; check its permissions and the disk", path.display())]
    Unreadable {
        /// The path asked for.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The content is not a model that can be used.
    #[error("{}: the file holds no usable model", path.display())]
    Content {
        /// The path asked for.
        path: PathBuf,
        /// What is wrong, and where.
        source: ContentError,
    },
}

/// Why the content of a file does not give a mesh.
#[derive(Debug, thiserror::Error)]
pub enum ContentError {
    /// There are no bytes.
    #[error("it is empty (0 bytes); export the model again")]
    Empty,
    /// The content is of another kind.
    #[error("it is {looks_like}, not STL, OBJ, PLY or 3MF; export the model as one of them")]
    Foreign {
        /// What the content looks like.
        looks_like: &'static str,
    },
    /// The content is STL, with a fault.
    #[error("STL: {0}")]
    Stl(#[from] StlError),
    /// The content is OBJ, with a fault.
    #[error("OBJ: {0}")]
    Obj(#[from] ObjError),
    /// The content is PLY, with a fault.
    #[error("PLY: {0}")]
    Ply(#[from] Box<PlyError>),
    /// The content is 3MF, with a fault.
    #[error("3MF: {0}")]
    ThreeMf(#[from] Box<ThreeMfError>),
}

/// The triangles of the STL (binary or ASCII), OBJ, PLY or 3MF file at `path`.
///
/// The format is told from the content, not from the name. Coordinates are taken as they stand,
/// without unit, but for 3MF, which has one: they are in mm. Every coordinate of the result is
/// finite and there is at least one triangle. The triangles of an STL file come back as a soup,
/// three vertices each: see [`crate::repair::weld`] and [`crate::repair::repair`].
pub fn read_model(path: &Path) -> Result<TriMesh, ReadError> {
    let bytes = read_bytes(path)?;
    decode_model(&bytes).map_err(|source| ReadError::Content {
        path: path.to_path_buf(),
        source,
    })
}

/// The bytes of the model file at `path`; what is no readable file is told as such.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let owned = || path.to_path_buf();
    if path.is_dir() {
        return Err(ReadError::Directory { path: owned() });
    }
    std::fs::read(path).map_err(|source| match source.kind() {
        ErrorKind::NotFound => ReadError::Missing { path: owned() },
        _ => ReadError::Unreadable {
            path: owned(),
            source,
        },
    })
}

/// The triangles in the bytes of an STL, OBJ, PLY or 3MF file; see [`read_model`].
pub fn decode_model(bytes: &[u8]) -> Result<TriMesh, ContentError> {
    match sniff(bytes) {
        Format::Empty => Err(ContentError::Empty),
        Format::Stl => Ok(stl::decode(bytes)?),
        Format::Obj => Ok(obj::decode(bytes)?),
        Format::Ply => Ok(ply::decode(bytes).map_err(Box::new)?),
        Format::ThreeMf => Ok(threemf::decode(bytes).map_err(Box::new)?),
        Format::Foreign(looks_like) => Err(ContentError::Foreign { looks_like }),
    }
}
