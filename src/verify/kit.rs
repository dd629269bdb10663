//! Judging a kit from its folder: every file is read again, hashed, and measured.

use std::path::{Component, Path, PathBuf};

use super::{Check, Evidence, Judgement, Limit, PartEvidence, Promise, SCHEMA, judge};
use crate::digest::sha256_hex;
use crate::geom::Vector;
use crate::io::{ReadError, read_model};
use crate::mesh::TriMesh;

/// The checklist of a kit.
pub const CHECKLIST_FILE: &str = "checklist.json";
/// The uncut result of a kit.
pub const HOLLOWED_FILE: &str = "hollowed.stl";

/// Why a kit could not be judged at all.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// A file of the kit cannot be read.
    #[error("cannot read {path}; is this the folder of a whole kit?")]
    File {
        /// Which file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// The checklist is not what this program writes.
    #[error("{path} is not a checklist this program can read; write the kit again with `equipoise prepare`")]
    Checklist {
        /// Which file.
        path: PathBuf,
        /// Where it goes wrong.
        source: serde_json::Error,
    },
    /// The checklist is of another version.
    #[error("{path} has schema {found}, this program reads schema {SCHEMA}; use the version that wrote it")]
    Schema {
        /// Which file.
        path: PathBuf,
        /// Its schema.
        found: u64,
    },
    /// The checklist names a file outside the kit.
    #[error("the checklist names `{file}`, which lies outside the kit; do not trust this kit")]
    Outside {
        /// The path as it stands in the checklist.
        file: String,
    },
    /// A mesh of the kit cannot be read.
    #[error("{path} holds no mesh")]
    Mesh {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        source: ReadError,
    },
}

/// Reads every file of the kit in `folder` and judges it, without the solver: the checklist supplies the goal and the
/// promises, the meshes everything else.
pub fn verify_kit(folder: &Path) -> Result<Judgement, VerifyError> {
    let promise = read_promise(folder)?;
    let changed = changed_files(folder, &promise)?;
    let hollowed = read_mesh(&folder.join(HOLLOWED_FILE))?;
    let parts = promise.parts.iter().map(|part| {
        let mesh = read_mesh(&folder.join(&part.file))?;
        let mesh = of_nominal_size(mesh, promise.printer.print_scale_ratio);
        Ok(PartEvidence { id: part.id.clone(), mesh, pose: part.print_from_model })
    });
    let evidence = Evidence { hollowed, parts: parts.collect::<Result<_, _>>()?, promise };
    let mut judgement = judge(&evidence);
    judgement.checks.push(files_check(&changed));
    Ok(judgement)
}

/// The promises in the checklist of a kit.
pub fn read_promise(folder: &Path) -> Result<Promise, VerifyError> {
    let path = folder.join(CHECKLIST_FILE);
    let bytes = read_file(&path)?;
    let schema = serde_json::from_slice(&bytes).map(|value: serde_json::Value| value["schema"].as_u64());
    match schema {
        Ok(Some(found)) if found != u64::from(SCHEMA) => Err(VerifyError::Schema { path, found }),
        _ => serde_json::from_slice(&bytes).map_err(|source| VerifyError::Checklist { path, source }),
    }
}

/// The files whose bytes are not those the checklist was made for.
fn changed_files(folder: &Path, promise: &Promise) -> Result<Vec<String>, VerifyError> {
    let parts = promise.parts.iter().map(|part| (&part.file, &part.sha256));
    let mut changed = Vec::new();
    for (file, sha256) in parts.chain(&promise.files) {
        if !lies_within(file) {
            return Err(VerifyError::Outside { file: file.clone() });
        }
        if sha256_hex(&[&read_file(&folder.join(file))?]) != *sha256 {
            changed.push(file.clone());
        }
    }
    Ok(changed)
}

fn files_check(changed: &[String]) -> Check {
    let promise = "every file is the one the checklist was made for";
    Check::new("changed files", promise, Some(changed.len() as f64), Limit::at_most(0.0, ""))
        .at((!changed.is_empty()).then(|| changed.join("; ")))
}

/// Whether a relative path stays below the folder it is joined to.
fn lies_within(file: &str) -> bool {
    !file.is_empty() && Path::new(file).components().all(|part| matches!(part, Component::Normal(_)))
}

fn read_file(path: &Path) -> Result<Vec<u8>, VerifyError> {
    std::fs::read(path).map_err(|source| VerifyError::File { path: path.to_owned(), source })
}

/// The mesh of a part before it was scaled for the printer.
fn of_nominal_size(mesh: TriMesh, scale_ratio: Option<[f64; 3]>) -> TriMesh {
    match scale_ratio.map(Vector::from) {
        Some(scale) => mesh.map_vertices(|p| p.coords.component_div(&scale).into()),
        None => mesh,
    }
}

fn read_mesh(path: &Path) -> Result<TriMesh, VerifyError> {
    read_model(path).map_err(|source| VerifyError::Mesh { path: path.to_owned(), source })
}
