//! Making a kit again from its own job, and comparing every file with it.

use std::path::Path;

use super::wing::Wing;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::Job;
use crate::kit::Kit;
use crate::prepare::prepare;
use crate::verify::{Check, CheckKind, JOB_FILE, Limit, find_model};
use crate::{prepare as main_line, wing};

/// Makes the kit in `folder` again, and checks that every file of it has the same bytes.
///
/// The model is the one at `model`, or else the kit's own copy, or else the one that the job names.
///
/// # Errors
/// The job or the model cannot be read, or the run fails.
pub fn replay(folder: &Path, model: Option<&Path>, watch: &Watch) -> Result<Check, Error> {
    let mut job = Job::read(&folder.join(JOB_FILE))?;
    job.model_copy = model.map(Path::to_owned).or_else(|| find_model(folder));
    Ok(match prepare(&job, watch)? {
        main_line::Outcome::Prepared(prepared) => compare(folder, &prepared.kit),
        main_line::Outcome::Impossible(why) => check(&[why.reason]),
    })
}

/// Makes a kit of its own kind again from the copy in it, and compares it.
///
/// # Errors
/// The job or its input cannot be read, or the run fails.
pub fn replay_wing<W: Wing>(folder: &Path, watch: &Watch) -> Result<Check, W::Error> {
    let job = W::job_in(folder)?;
    Ok(match W::prepare(&job, watch)? {
        wing::Outcome::Prepared(prepared) => compare(folder, &prepared.kit),
        wing::Outcome::Impossible(why) => check(&[why.reason]),
    })
}

/// Returns the check that a folder holds the files of a kit.
fn compare(folder: &Path, kit: &Kit) -> Check {
    let is_other = |file: &str, bytes: &[u8]| {
        let found = std::fs::read(folder.join(file));
        !found.is_ok_and(|found| found == bytes)
    };
    let files = kit.files();
    let other = files.filter(|(file, bytes)| is_other(file, bytes));
    let other: Vec<String> = other.map(|(file, _)| file.to_owned()).collect();
    check(&other)
}

/// Returns the check, given what differs.
fn check(other: &[String]) -> Check {
    let check = Check::new(
        CheckKind::Replay,
        "made again from its job, the kit has the same bytes, but for files",
        Some(other.len() as f64),
        Limit::at_most(0.0, ""),
    );
    check.at((!other.is_empty()).then(|| other.join(", ")))
}
