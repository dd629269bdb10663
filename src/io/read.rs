//! Reads a model from a file in any format; the content decides which.

use std::ffi::OsStr;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use super::sniff::{Format, sniff};
use super::threemf::{self, ThreeMfError};
use super::{ObjError, PlyError, StlError, obj, ply, stl};
use crate::base::toml_text::nearest_name;
use crate::mesh::TriMesh;

/// The reason that a file gives no mesh. The message names the file, its source the place in it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// There is no such file.
    #[error("{}: there is no such file; {}", path.display(), missing_words(near.as_deref()))]
    Missing {
        /// The path asked for.
        path: PathBuf,
        /// A file with a name so near that it may be meant; `None` if there is none.
        near: Option<PathBuf>,
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
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The content is not a model that can be used.
    #[error("{}: the file holds no usable model", path.display())]
    Content {
        /// The path asked for.
        path: PathBuf,
        /// The fault and its place.
        source: ContentError,
    },
}

/// The reason that the content of a file gives no mesh.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ContentError {
    /// There are no bytes.
    #[error("it is empty (0 bytes); export the model again")]
    Empty,
    /// The content is of another kind.
    #[error("it is {looks_like}, not STL, OBJ, PLY or 3MF; export the model as one of them")]
    Foreign {
        /// The kind of file that the content looks like.
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

/// Reads the STL (binary or ASCII), OBJ, PLY or 3MF file at `path` and returns its triangles.
///
/// The content decides the format, not the name. 3MF files have a unit: their coordinates come back
/// in mm. Those of all other formats have none and come back as written. Every coordinate is finite
/// and there is at least one triangle. An STL file gives a soup, three vertices for each triangle:
/// see [`crate::repair::weld`] and [`crate::repair::repair`].
pub fn read_model(path: &Path) -> Result<TriMesh, ReadError> {
    let bytes = read_bytes(path)?;
    decode_model(&bytes).map_err(|source| ReadError::Content {
        path: path.to_path_buf(),
        source,
    })
}

/// Reads the bytes of the model file at `path`.
///
/// Errors tell a missing file, a directory and an unreadable file apart.
pub fn read_bytes(path: &Path) -> Result<Vec<u8>, ReadError> {
    let owned = || path.to_path_buf();
    if path.is_dir() {
        return Err(ReadError::Directory { path: owned() });
    }
    std::fs::read(path).map_err(|source| match source.kind() {
        ErrorKind::NotFound => ReadError::Missing {
            path: owned(),
            near: file_near(path),
        },
        _ => ReadError::Unreadable {
            path: owned(),
            source,
        },
    })
}

/// Returns a file beside a path that is none, with the same ending and nearly the same name.
pub fn file_near(path: &Path) -> Option<PathBuf> {
    let stem = path.file_stem()?.to_str()?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let files = std::fs::read_dir(folder).ok()?.flatten();
    let files = files.map(|entry| PathBuf::from(entry.file_name()));
    let mut stems: Vec<String> = files
        .filter(|file| file.extension() == path.extension())
        .filter_map(|file| Some(file.file_stem()?.to_str()?.to_owned()))
        .collect();
    stems.sort();
    let near = nearest_name(stem, stems.iter().map(String::as_str))?;
    let name = match path.extension().and_then(OsStr::to_str) {
        Some(ending) => format!("{near}.{ending}"),
        None => near.to_owned(),
    };
    Some(path.with_file_name(name)).filter(|file| file.is_file())
}

/// Returns what to do about a file that is not there.
fn missing_words(near: Option<&Path>) -> String {
    let meant = near.map(|file| format!("did you mean {}?", file.display()));
    meant.unwrap_or_else(|| "check the path".to_owned())
}

/// Returns the triangles in the bytes of an STL, OBJ, PLY or 3MF file; see [`read_model`].
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_misspelt_model_is_told_which_file_was_meant() {
        let folder = tempfile::tempdir().unwrap();
        let humpty = folder.path().join("humpty.obj");
        for name in ["humpty.obj", "elephant.obj", "humpti.stl"] {
            std::fs::write(folder.path().join(name), "x").unwrap();
        }
        let wrong = folder.path().join("humty.obj");
        let error = read_model(&wrong).unwrap_err().to_string();
        let meant = format!("did you mean {}?", humpty.display());
        assert!(error.ends_with(&meant), "{error}");
        assert_eq!(file_near(&folder.path().join("bunny.obj")), None);
    }
}
