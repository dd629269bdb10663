//! The judge of the line: it sees what is written, and nothing of how it was made.

use super::asked::Asked;
use super::error::TelescopeRunError;
use super::files::curve_csv;
use super::made::Made;
use super::motion_file::motion;
use super::posing::ChainPoses;
use super::sheet::checklist;
use crate::base::watch::{Phase, Watch};
use crate::io::PointsError;
use crate::sheet::Verdict;
use crate::sheet::telescope::TelescopeSheet;
use crate::verify::{
    TelescopeEvidence, TelescopeMotion, TelescopePromise, asked_points, judge_telescope,
    telescope_checks,
};
use crate::wing::{Unwritable, json, read_back};

/// A telescope that was judged.
pub struct Draft {
    pub made: Made,
    pub poses: ChainPoses,
    pub sheet: TelescopeSheet,
    pub motion_json: String,
    pub curve_csv: String,
}

/// Returns the texts of files.
pub fn texts(files: Vec<(String, String)>) -> Vec<String> {
    files.into_iter().map(|(_, text)| text).collect()
}

/// Judges what is written, from the texts of its files.
pub fn draft(
    asked: &Asked,
    made: Made,
    poses: ChainPoses,
    watch: &Watch,
) -> Result<Draft, TelescopeRunError> {
    watch.enter(Phase::Verify);
    let mut sheet = checklist(asked, &made);
    sheet.poses = poses.written().rows();
    let motion = TelescopeMotion {
        poses: poses.written().motions(),
        ..motion(&made)
    };
    let motion_json = json("motion.json", &motion)?;
    let curve_csv = curve_csv(asked, &made);
    let promise: TelescopePromise = read_back("checklist.json", &json("checklist.json", &sheet)?)?;
    let points = asked_points(curve_csv.as_bytes());
    let evidence = TelescopeEvidence {
        motion: read_back("motion.json", &motion_json)?,
        pose_files: texts(poses.written().files()),
        parts: made.parts.iter().map(|part| part.in_shell()).collect(),
        printed: made
            .parts
            .iter()
            .map(|part| part.read_back.clone())
            .collect(),
        asked: points.map_err(|error: PointsError| Unwritable::new("curve.csv", &error))?,
        promise,
    };
    let facts = judge_telescope(&evidence, watch)?;
    sheet.checks = telescope_checks(&evidence.promise, &facts);
    sheet.verdict = Verdict::of(&sheet.checks);
    Ok(Draft {
        made,
        poses,
        sheet,
        motion_json,
        curve_csv,
    })
}
