//! Judging a kit from its folder: every file is read again, hashed, and measured.

use std::path::{Component, Path, PathBuf};

use serde_json::Value;

use super::{
    Change, Evidence, FileChange, Judgement, PartEvidence, Promise, SCHEMA,
    changes::{file_changes, files_check},
    judge,
    packages::packages_check,
    seal::paper_changes,
    sheet::{misstatements, sheet_check},
};
use crate::geom::Vector;
use crate::io::{ReadError, read_model};
use crate::mesh::TriMesh;

/// The checklist of a kit.
pub const CHECKLIST_FILE: &str = "checklist.json";
/// The job sheet for people.
pub const SHEET_FILE: &str = "checklist.html";
/// The hashes of all files of a kit but itself.
pub const SUMS_FILE: &str = "SHA256SUMS";
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
    #[error(
        "{path} is not a checklist this program can read; write the kit again with `equipoise prepare`"
    )]
    Checklist {
        /// Which file.
        path: PathBuf,
        /// Where it goes wrong.
        source: serde_json::Error,
    },
    /// The checklist is of another version.
    #[error(
        "{path} has schema {found}, this program reads schema {SCHEMA}; use the version that wrote it"
    )]
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
    /// Meshes that the judgement rests on are not there.
    #[error(
        "{} missing from {folder}: {}; remedy: copy the kit again, or make it again with equipoise prepare --job {folder}/job.toml",
        if files.len() == 1 { "a file is" } else { "files are" },
        files.join(", "),
        folder = folder.display()
    )]
    Missing {
        /// The folder of the kit.
        folder: PathBuf,
        /// The files, by their paths in it.
        files: Vec<String>,
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

impl VerifyError {
    /// What became of files without which a kit cannot be measured: its promises are broken all the
    /// same. Nothing where there is no kit to be judged in `folder`.
    pub fn changes(&self, folder: &Path) -> Vec<FileChange> {
        match self {
            Self::Missing { files, .. } => files
                .iter()
                .map(|file| FileChange {
                    file: file.clone(),
                    change: Change::Missing,
                })
                .collect(),
            Self::Mesh { path, source } => {
                let causes =
                    std::iter::successors(Some(source as &dyn std::error::Error), |e| e.source());
                let why = causes.last().map(ToString::to_string).unwrap_or_default();
                let file = path
                    .strip_prefix(folder)
                    .unwrap_or(path)
                    .display()
                    .to_string();
                vec![FileChange {
                    file,
                    change: Change::Unreadable(why),
                }]
            }
            _ => Vec::new(),
        }
    }
}

/// Reads every file of the kit in `folder` and judges it, without the solver: the checklist
/// supplies the goal and the promises, the meshes everything else.
pub fn verify_kit(folder: &Path) -> Result<Judgement, VerifyError> {
    let (promise, sheet) = read_checklist(folder)?;
    check_files(folder, &promise)?;
    let hollowed = read_mesh(&folder.join(HOLLOWED_FILE))?;
    let parts = promise.parts.iter().map(|part| {
        let mesh = read_mesh(&folder.join(&part.file))?;
        let mesh = of_nominal_size(mesh, promise.printer.print_scale_ratio);
        Ok(PartEvidence {
            id: part.id.clone(),
            mesh,
            pose: part.print_from_model,
        })
    });
    let evidence = Evidence {
        hollowed,
        parts: parts.collect::<Result<_, _>>()?,
        promise,
    };
    let mut judgement = judge(&evidence);
    let misstated = misstatements(&sheet, &evidence, &judgement);
    judgement.changes = file_changes(folder, &evidence)?;
    judgement
        .changes
        .extend(paper_changes(folder, &evidence.promise)?);
    judgement.checks.push(sheet_check(&misstated));
    judgement.checks.push(files_check(&judgement.changes));
    judgement.checks.extend(packages_check(folder, &evidence)?);
    Ok(judgement)
}

/// The promises in the checklist of a kit.
pub fn read_promise(folder: &Path) -> Result<Promise, VerifyError> {
    read_checklist(folder).map(|(promise, _)| promise)
}

/// The promises, and the whole checklist as it stands.
fn read_checklist(folder: &Path) -> Result<(Promise, Value), VerifyError> {
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

/// Refuses a kit that names files outside of it, or that lacks a mesh to be judged.
fn check_files(folder: &Path, promise: &Promise) -> Result<(), VerifyError> {
    let parts = || promise.parts.iter().map(|part| &part.file);
    if let Some(file) = parts()
        .chain(promise.files.keys())
        .find(|file| !lies_within(file))
    {
        return Err(VerifyError::Outside { file: file.clone() });
    }
    let hollowed = HOLLOWED_FILE.to_owned();
    let missing = parts()
        .chain([&hollowed])
        .filter(|file| !folder.join(file).exists());
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

/// Whether a relative path stays below the folder it is joined to.
pub(super) fn lies_within(file: &str) -> bool {
    !file.is_empty()
        && Path::new(file)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
}

pub(super) fn read_file(path: &Path) -> Result<Vec<u8>, VerifyError> {
    std::fs::read(path).map_err(|source| VerifyError::File {
        path: path.to_owned(),
        source,
    })
}

/// The mesh of a part before it was scaled for the printer.
pub(super) fn of_nominal_size(mesh: TriMesh, scale_ratio: Option<[f64; 3]>) -> TriMesh {
    match scale_ratio.map(Vector::from) {
        Some(scale) => mesh.map_vertices(|p| p.coords.component_div(&scale).into()),
        None => mesh,
    }
}

fn read_mesh(path: &Path) -> Result<TriMesh, VerifyError> {
    read_model(path).map_err(|source| VerifyError::Mesh {
        path: path.to_owned(),
        source,
    })
}
