//! Reading a telescope's kit from its folder, and the judgement of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;

use super::checks::telescope_checks;
use super::evidence::TelescopeEvidence;
use super::facts::judge_telescope;
use super::motion::TelescopeMotion;
use super::packages::packages_check;
use super::promise::TelescopePromise;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Point, Vector};
use crate::io::{PointsError, ReadError, decode_points, read_model};
use crate::mesh::TriMesh;
use crate::verify::files::is_inside_kit;
use crate::verify::strangers::find_strangers;
use crate::verify::{
    CERTIFICATE_FILE, CHECKLIST_FILE, Change, Check, FileChange, SHEET_FILE, SUMS_FILE,
    VerifyError, files_check,
};

/// The word by which a checklist says that it is a telescope's.
const KIND: &str = "telescope";
/// The schema of a telescope's checklist and motion.
const SCHEMA: u32 = 1;
/// The motion in a kit.
pub const MOTION_FILE: &str = "motion.json";
/// The points of the curve in a kit.
pub const CURVE_FILE: &str = "curve.csv";

/// The judgement of a telescope's kit.
#[derive(Debug, Clone, PartialEq)]
pub struct TelescopeJudgement {
    /// Every promise with its verdict.
    pub checks: Vec<Check>,
    /// Files that changed since the kit was made.
    pub changes: Vec<FileChange>,
    /// Files in the kit's folder that are not on its list and cannot be printed.
    pub unlisted: Vec<String>,
}

/// A telescope's kit cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TelescopeVerifyError {
    /// A file of the kit cannot be read.
    #[error("cannot read {path}; is this the folder of a whole kit?")]
    File {
        /// The file.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A file is not one that this program writes.
    #[error("{path} is not a file this program can read; write the kit again")]
    Json {
        /// The file.
        path: PathBuf,
        /// The fault and its line.
        source: serde_json::Error,
    },
    /// A file has another schema.
    #[error(
        "{path} has schema {found}, this program reads schema {SCHEMA}; use the version that wrote it"
    )]
    Schema {
        /// The file.
        path: PathBuf,
        /// Its schema.
        found: u32,
    },
    /// Files do not belong together.
    #[error("{path} does not belong to this kit: {why}; copy the kit again")]
    Mismatch {
        /// The file.
        path: PathBuf,
        /// The reason.
        why: &'static str,
    },
    /// The points of the curve cannot be read.
    #[error("{path}: {fault}")]
    Points {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: PointsError,
    },
    /// A mesh of the kit cannot be read.
    #[error(transparent)]
    Mesh(#[from] ReadError),
    /// The checklist names a file outside the kit.
    #[error("the checklist names `{file}`, which lies outside the kit; do not trust this kit")]
    Outside {
        /// The path in the checklist.
        file: String,
    },
    /// The kit's folder cannot be read.
    #[error(transparent)]
    Folder(#[from] VerifyError),
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Returns true if the kit in a folder is a telescope's.
pub fn is_telescope(folder: &Path) -> bool {
    let bytes = std::fs::read(folder.join(CHECKLIST_FILE)).unwrap_or_default();
    let sheet: Option<Value> = serde_json::from_slice(&bytes).ok();
    sheet.is_some_and(|sheet| sheet["kind"] == KIND)
}

/// Reads every file of a telescope's kit and judges it.
///
/// # Errors
/// There is no such kit in the folder, a file of it cannot be read, or the watch was stopped.
pub fn verify_telescope(
    folder: &Path,
    watch: &Watch,
) -> Result<TelescopeJudgement, TelescopeVerifyError> {
    let evidence = read(folder)?;
    let facts = judge_telescope(&evidence, watch)?;
    let mut checks = telescope_checks(&evidence.promise, &facts);
    let mut changes = find_changes(folder, &evidence.promise.files)?;
    let listed = evidence.promise.files.keys().map(String::as_str);
    let strangers = find_strangers(folder, listed)?;
    changes.extend(strangers.changes);
    checks.push(files_check(&changes));
    checks.push(packages_check(folder, &evidence));
    Ok(TelescopeJudgement {
        checks,
        changes,
        unlisted: strangers.others,
    })
}

fn read(folder: &Path) -> Result<TelescopeEvidence, TelescopeVerifyError> {
    let promise: TelescopePromise = read_json(&folder.join(CHECKLIST_FILE))?;
    let motion: TelescopeMotion = read_json(&folder.join(MOTION_FILE))?;
    for (file, found) in [
        (CHECKLIST_FILE, promise.schema),
        (MOTION_FILE, motion.schema),
    ] {
        let path = folder.join(file);
        if found != SCHEMA {
            return Err(TelescopeVerifyError::Schema { path, found });
        }
    }
    if let Some(why) = mismatch(&promise, &motion) {
        let path = folder.join(MOTION_FILE);
        return Err(TelescopeVerifyError::Mismatch { path, why });
    }
    let named = promise.parts.iter().map(|part| &part.file);
    let named = named.chain(promise.files.keys());
    if let Some(file) = named.into_iter().find(|file| !is_inside_kit(file)) {
        return Err(TelescopeVerifyError::Outside { file: file.clone() });
    }
    let scale = promise.printer.print_scale_ratio.map(Vector::from);
    let part = |part: &super::promise::TelescopePartPromise| {
        let mesh = read_model(&folder.join(&part.file))?;
        let nominal = scale.map_or(mesh.clone(), |scale| {
            mesh.map_vertices(|p| p.coords.component_div(&scale).into())
        });
        Ok(nominal.map_vertices(|p| part.print_from_shell.to_model(p)))
    };
    let parts: Result<Vec<TriMesh>, TelescopeVerifyError> =
        promise.parts.iter().map(part).collect();
    let path = folder.join(CURVE_FILE);
    let bytes = read_file(&path)?;
    let asked =
        asked_points(&bytes).map_err(|fault| TelescopeVerifyError::Points { path, fault })?;
    Ok(TelescopeEvidence {
        parts: parts?,
        promise,
        motion,
        asked,
    })
}

/// Returns the points that were asked for: the first three columns of `curve.csv`.
pub fn asked_points(bytes: &[u8]) -> Result<Vec<Point>, PointsError> {
    let text = String::from_utf8_lossy(bytes);
    let first = |line: &str| line.split(',').take(3).collect::<Vec<_>>().join(",");
    let columns: Vec<String> = text.lines().map(first).collect();
    decode_points(columns.join("\n").as_bytes())
}

/// Returns the reason why a motion is not that of the promises.
fn mismatch(promise: &TelescopePromise, motion: &TelescopeMotion) -> Option<&'static str> {
    let shells = motion.shells.len();
    let joints = motion.joints.len();
    let states = |key: &super::motion::MotionKey| key.states.len() == joints;
    let tubes = promise.parts.iter().filter(|part| part.is_tube).count();
    let is_placed =
        |part: &super::promise::TelescopePartPromise| (1..=shells).contains(&part.shell);
    let cases = [
        (
            shells == 0 || tubes != shells,
            "it has another number of shells",
        ),
        (
            joints + 1 != shells || promise.joints.len() != joints,
            "it has another number of joints",
        ),
        (
            motion.keys.is_empty() || !motion.keys.iter().all(states),
            "its keys do not fit its joints",
        ),
        (
            !promise.parts.iter().all(is_placed),
            "a part belongs to no shell",
        ),
    ];
    cases
        .into_iter()
        .find(|(is_wrong, _)| *is_wrong)
        .map(|(_, why)| why)
}

fn read_file(path: &Path) -> Result<Vec<u8>, TelescopeVerifyError> {
    std::fs::read(path).map_err(|source| TelescopeVerifyError::File {
        path: path.to_owned(),
        source,
    })
}

fn read_json<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, TelescopeVerifyError> {
    serde_json::from_slice(&read_file(path)?).map_err(|source| TelescopeVerifyError::Json {
        path: path.to_owned(),
        source,
    })
}

/// Returns the files whose bytes are not those that the checklist lists, and the papers that do not
/// agree with it.
fn find_changes(
    folder: &Path,
    files: &BTreeMap<String, String>,
) -> Result<Vec<FileChange>, TelescopeVerifyError> {
    let mut changes = Vec::new();
    for (file, sha256) in files {
        let path = folder.join(file);
        let change = match path.is_file() {
            false => Some(Change::Missing),
            true => (sha256_hex(&[&read_file(&path)?]) != *sha256).then_some(Change::Altered),
        };
        let file = file.clone();
        changes.extend(change.map(|change| FileChange { file, change }));
    }
    let sums = folder.join(SUMS_FILE);
    let list = if sums.is_file() {
        read_file(&sums)?
    } else {
        Vec::new()
    };
    let list = String::from_utf8_lossy(&list).into_owned();
    for paper in [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE] {
        let path = folder.join(paper);
        let change = if path.is_file() {
            let line = format!("{}  {paper}\n", sha256_hex(&[&read_file(&path)?]));
            (!list.contains(&line)).then_some(Change::Altered)
        } else {
            Some(Change::Missing)
        };
        let file = paper.to_owned();
        changes.extend(change.map(|change| FileChange { file, change }));
    }
    Ok(changes)
}
