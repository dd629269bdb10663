//! Making a kit again from its own job, and comparing every file with it.

use std::path::Path;

use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::Job;
use crate::kit::Kit;
use crate::prepare::{Outcome, prepare};
use crate::verify::{Check, CheckKind, JOB_FILE, Limit, find_model};

/// Makes the kit in `folder` again, and checks that every file of it has the same bytes.
///
/// The model is the one at `model`, or else the kit's own copy, or else the one that the job names.
///
/// # Errors
/// The job or the model cannot be read, or the run fails.
pub fn replay(folder: &Path, model: Option<&Path>, watch: &Watch) -> Result<Check, Error> {
    let mut job = Job::read(&folder.join(JOB_FILE))?;
    job.model_copy = model.map(Path::to_owned).or_else(|| find_model(folder));
    let other = match prepare(&job, watch)? {
        Outcome::Prepared(prepared) => find_other_files(folder, &prepared.kit),
        Outcome::Impossible(why) => vec![why.reason],
    };
    let check = Check::new(
        CheckKind::Replay,
        "made again from its job, the kit has the same bytes, but for files",
        Some(other.len() as f64),
        Limit::at_most(0.0, ""),
    );
    Ok(check.at((!other.is_empty()).then(|| other.join(", "))))
}

/// Returns the files that differ from those of a kit, by their names.
fn find_other_files(folder: &Path, kit: &Kit) -> Vec<String> {
    let is_other = |file: &str, bytes: &[u8]| {
        let found = std::fs::read(folder.join(file));
        !found.is_ok_and(|found| found == bytes)
    };
    let files = kit.files();
    let other = files.filter(|(file, bytes)| is_other(file, bytes));
    other.map(|(file, _)| file.to_owned()).collect()
}
