//! Reading a telescope's kit from its folder, and the judgement of it.

use std::path::PathBuf;

use super::checks::telescope_checks;
use super::evidence::TelescopeEvidence;
use super::facts::judge_telescope;
use super::motion::{MotionKey, TelescopeMotion};
use super::packages::packages_check;
use super::pose::PosePromise;
use super::promise::{TelescopePartPromise, TelescopePromise};
use super::scene::scene_check;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Point, Vector};
use crate::io::{PointsError, decode_points, read_model};
use crate::mesh::TriMesh;
use crate::verify::kit_folder::{KitFolder, all_inside_kit};
use crate::verify::{CERTIFICATE_FILE, CHECKLIST_FILE, KindJudgement, KitFolderError, SHEET_FILE};

/// The motion in a kit.
pub const MOTION_FILE: &str = "motion.json";
/// The points of the curve in a kit.
pub const CURVE_FILE: &str = "curve.csv";

/// A telescope's kit cannot be judged at all.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TelescopeVerifyError {
    /// The kit cannot be read.
    #[error(transparent)]
    Folder(#[from] KitFolderError),
    /// The points of the curve cannot be read.
    #[error("{path}: {fault}")]
    Points {
        /// The file.
        path: PathBuf,
        /// The fault.
        fault: PointsError,
    },
    /// The caller stopped the judge.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Reads every file of a telescope's kit and judges it.
///
/// # Errors
/// There is no such kit in the folder, a file of it cannot be read, or the watch was stopped.
pub(super) fn verify_curve(
    folder: &KitFolder,
    watch: &Watch,
) -> Result<KindJudgement, TelescopeVerifyError> {
    let evidence = read(folder)?;
    let facts = judge_telescope(&evidence, watch)?;
    let checks = telescope_checks(&evidence.promise, &facts);
    let papers = [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE];
    let mut judgement = folder.judgement(checks, &evidence.promise.files, &papers)?;
    judgement.checks.push(packages_check(folder, &evidence));
    judgement.checks.push(scene_check(folder, &evidence));
    Ok(judgement)
}

fn read(folder: &KitFolder) -> Result<TelescopeEvidence, TelescopeVerifyError> {
    let promise = folder.list::<TelescopePromise>(CHECKLIST_FILE)?;
    let motion = folder.list::<TelescopeMotion>(MOTION_FILE)?;
    if let Some(why) = mismatch(&promise, &motion) {
        return Err(folder.mismatch(MOTION_FILE, why).into());
    }
    let named = promise.parts.iter().map(|part| &part.file);
    let poses = promise.poses.iter().map(|pose| &pose.file);
    all_inside_kit(named.chain(promise.files.keys()).chain(poses))?;
    let printed = read_parts(folder, &promise);
    let asked = asked_points(&folder.bytes(CURVE_FILE)?);
    let asked = asked.map_err(|fault| TelescopeVerifyError::Points {
        path: folder.path.join(CURVE_FILE),
        fault,
    })?;
    let printed = printed?;
    Ok(TelescopeEvidence {
        parts: TelescopeEvidence::in_shells(&promise, &printed),
        printed,
        pose_files: pose_files(folder, &promise.poses)?,
        promise,
        motion,
        asked,
    })
}

/// Reads the files of poses.
pub(super) fn pose_files(
    folder: &KitFolder,
    poses: &[PosePromise],
) -> Result<Vec<String>, KitFolderError> {
    let text = |pose: &PosePromise| {
        let bytes = folder.bytes(&pose.file)?;
        Ok(String::from_utf8_lossy(&bytes).into_owned())
    };
    poses.iter().map(text).collect()
}

/// Reads the parts of a telescope, each in print pose and its own size.
pub(super) fn read_parts(
    folder: &KitFolder,
    promise: &TelescopePromise,
) -> Result<Vec<TriMesh>, KitFolderError> {
    let scale = promise.printer.print_scale_ratio.map(Vector::from);
    let part = |part: &TelescopePartPromise| read_nominal(folder, &part.file, scale);
    promise.parts.iter().map(part).collect()
}

/// Reads a part as it is printed, without the scale of the print.
pub(super) fn read_nominal(
    folder: &KitFolder,
    file: &str,
    scale: Option<Vector>,
) -> Result<TriMesh, KitFolderError> {
    let mesh = read_model(&folder.path.join(file))?;
    Ok(match scale {
        Some(scale) => mesh.map_vertices(|p| p.coords.component_div(&scale).into()),
        None => mesh,
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
pub(super) fn mismatch(
    promise: &TelescopePromise,
    motion: &TelescopeMotion,
) -> Option<&'static str> {
    let shells = motion.shells.len();
    let joints = motion.joints.len();
    let states = |key: &MotionKey| key.states.len() == joints;
    let tubes = promise.parts.iter().filter(|part| part.is_tube).count();
    let is_placed = |part: &TelescopePartPromise| (1..=shells).contains(&part.shell);
    let ends = motion.keys.first().zip(motion.keys.last());
    let opens = ends.is_some_and(|(first, last)| motion.opens(&first.states, &last.states));
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
            joints > 0 && (motion.keys.len() < 2 || !opens),
            "its keys do not go from all in to all out",
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
