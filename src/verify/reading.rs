//! Reading a kit from its folder: the checklist and the meshes, nothing else.

use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde_json::Value;

use super::files::{CHECKLIST_FILE, HOLLOWED_FILE, MODEL_FOLDER, is_inside_kit};
use super::{Evidence, InfillOrder, PartEvidence, Pose, Promise, SCHEMA, VerifyError};
use crate::geom::Vector;
use crate::io::read_model;
use crate::mesh::TriMesh;

/// Returns the copy of the model or curve in a kit of any kind; `None` if it has none, or no
/// checklist.
pub fn find_model(folder: &Path) -> Option<PathBuf> {
    let bytes = std::fs::read(folder.join(CHECKLIST_FILE)).ok()?;
    let sheet: Value = serde_json::from_slice(&bytes).ok()?;
    let mut files = sheet["files"].as_object()?.keys();
    let file = files.find(|file| file.starts_with(MODEL_FOLDER) && is_inside_kit(file))?;
    Some(folder.join(file)).filter(|path| path.is_file())
}

/// Reads the promises and the meshes of the kit in a folder.
///
/// # Errors
///
/// As [`read_promise`], or if a mesh is missing or cannot be read.
pub fn read_kit(folder: &Path) -> Result<Evidence, VerifyError> {
    read_evidence(folder, read_promise(folder)?)
}

/// Reads the meshes of a kit with these promises. The parts are returned in nominal size.
pub(super) fn read_evidence(folder: &Path, promise: Promise) -> Result<Evidence, VerifyError> {
    check_files(folder, &promise)?;
    let read = |id: &str, file: &str, pose: Pose| {
        let mesh = read_mesh(&folder.join(file))?;
        Ok(PartEvidence {
            id: id.to_owned(),
            mesh: undo_print_scale(mesh, promise.printer.print_scale_ratio),
            inner: Vec::new(),
            pose,
        })
    };
    let regions = promise.infill.iter().flat_map(InfillOrder::files);
    let regions: Vec<&String> = regions.collect();
    let parts = promise.parts.par_iter();
    let parts = parts.map(|part| {
        let whole = read(&part.id, &part.file, part.print_from_model)?;
        // The one part that is printed with sparse infill has its outermost regions as cavities.
        let read = |file: &&String| Ok(read(&part.id, file, part.print_from_model)?.mesh);
        let regions = regions.iter().map(read);
        let mut regions = regions
            .collect::<Result<Vec<_>, VerifyError>>()?
            .into_iter();
        let Some(outermost) = regions.next() else {
            return Ok(whole);
        };
        Ok(PartEvidence {
            mesh: whole.mesh.joined(&outermost.reversed()),
            inner: regions.collect(),
            ..whole
        })
    });
    let jigs = promise.jigs.par_iter();
    let jigs = jigs.map(|jig| read(&jig.id, &jig.file, jig.print_from_model));
    // Every file is read before the first error is taken: which one it is depends on no thread.
    let (hollowed, (parts, jigs)) = rayon::join(
        || read_mesh(&folder.join(HOLLOWED_FILE)),
        || rayon::join(|| parts.collect::<Vec<_>>(), || jigs.collect::<Vec<_>>()),
    );
    Ok(Evidence {
        hollowed: hollowed?,
        parts: parts.into_iter().collect::<Result<_, VerifyError>>()?,
        jigs: jigs.into_iter().collect::<Result<_, VerifyError>>()?,
        promise,
    })
}

/// Reads the promises from the checklist of a kit.
///
/// # Errors
///
/// If the checklist cannot be read, is not one, or has another schema.
pub fn read_promise(folder: &Path) -> Result<Promise, VerifyError> {
    read_checklist(folder).map(|(promise, _)| promise)
}

/// Reads the promises, and the whole checklist as it is.
pub(super) fn read_checklist(folder: &Path) -> Result<(Promise, Value), VerifyError> {
    let path = folder.join(CHECKLIST_FILE);
    let bytes = read_file(&path)?;
    let sheet: Result<Value, _> = serde_json::from_slice(&bytes);
    match sheet.as_ref().map(|sheet| sheet["schema"].as_u64()) {
        Ok(Some(found)) if found != u64::from(SCHEMA) => {
            return Err(VerifyError::Schema { path, found });
        }
        _ => {}
    }
    let read = sheet.and_then(|sheet| Ok((serde_json::from_slice(&bytes)?, sheet)));
    read.map_err(|source| VerifyError::Checklist { path, source })
}

/// Refuses a kit that names files outside of it, or that lacks a mesh.
fn check_files(folder: &Path, promise: &Promise) -> Result<(), VerifyError> {
    let parts = || {
        let jigs = promise.jigs.iter().map(|jig| &jig.file);
        let regions = promise.infill.iter().flat_map(InfillOrder::files);
        let parts = promise.parts.iter().map(|part| &part.file);
        parts.chain(jigs).chain(regions)
    };
    if let Some(file) = parts()
        .chain(promise.files.keys())
        .find(|file| !is_inside_kit(file))
    {
        return Err(VerifyError::Outside { file: file.clone() });
    }
    let hollowed = HOLLOWED_FILE.to_owned();
    let missing = parts()
        .chain([&hollowed])
        .filter(|file| !folder.join(file).is_file());
    let files: Vec<String> = missing.cloned().collect();
    if files.is_empty() {
        Ok(())
    } else {
        Err(VerifyError::Missing {
            folder: folder.to_owned(),
            files,
        })
    }
}

/// Reads the bytes of a file.
pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, VerifyError> {
    std::fs::read(path).map_err(|source| VerifyError::File {
        path: path.to_owned(),
        source,
    })
}

/// Returns the mesh of a part in nominal size, before it was scaled for the printer.
pub(super) fn undo_print_scale(mesh: TriMesh, scale_ratio: Option<[f64; 3]>) -> TriMesh {
    match scale_ratio.map(Vector::from) {
        Some(scale) => mesh.map_vertices(|p| p.coords.component_div(&scale).into()),
        None => mesh,
    }
}

/// Reads a mesh, in the units of its file.
pub(super) fn read_mesh(path: &Path) -> Result<TriMesh, VerifyError> {
    read_model(path).map_err(|source| VerifyError::Mesh {
        path: path.to_owned(),
        source,
    })
}
