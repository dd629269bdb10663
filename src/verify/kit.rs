//! Judging a kit from its folder: every file is read again, hashed and measured.

use std::path::Path;

use super::body::Body;
use super::bound::{bound_check, measure_bound};
use super::changes::{files_check, find_changes};
use super::judge::judge_body;
use super::model::model_check;
use super::packages::packages_check;
use super::reading::{find_model, read_checklist, read_evidence};
use super::seal::find_paper_changes;
use super::sheet::{find_misstatements, sheet_check};
use super::strangers::find_strangers;
use super::{Judgement, VerifyError};
use crate::base::watch::Watch;

/// Reads every file of the kit in `folder` and judges it, without the solver. The checklist
/// supplies the goal and the promises, the meshes everything else.
///
/// # Errors
///
/// If there is no kit in the folder, if one of its files cannot be read, or if the watch was
/// stopped.
pub fn verify_kit(folder: &Path, watch: &Watch) -> Result<Judgement, VerifyError> {
    verify_kit_of(folder, None, watch)
}

/// Judges a kit as [`verify_kit`] does, and holds its outside against the model in this file, or
/// else against its own copy of the model.
///
/// # Errors
///
/// As [`verify_kit`], or if the model cannot be read.
pub fn verify_kit_of(
    folder: &Path,
    model: Option<&Path>,
    watch: &Watch,
) -> Result<Judgement, VerifyError> {
    let (promise, sheet) = read_checklist(folder)?;
    let evidence = read_evidence(folder, promise)?;
    let promise = &evidence.promise;
    let changes = || {
        let papers = find_paper_changes(folder, promise);
        Ok([find_changes(folder, &evidence)?, papers?].concat())
    };
    let beside = || rayon::join(changes, || packages_check(folder, &evidence));
    let body = Body::of(&evidence.hollowed);
    let measured = || {
        rayon::join(
            || judge_body(&evidence, &body, watch),
            || measure_bound(&evidence, &body, watch),
        )
    };
    let ((judgement, bound), (changes, packages)) = rayon::join(measured, beside);
    let mut judgement: Judgement = judgement?;
    let misstated = find_misstatements(&sheet, &evidence, &judgement);
    let changes: Result<_, VerifyError> = changes;
    judgement.changes = changes?;
    let parts = promise.parts.iter().map(|part| part.file.as_str());
    let jigs = promise.jigs.iter().map(|jig| jig.file.as_str());
    let others = promise.files.keys().map(String::as_str);
    let strangers = find_strangers(folder, parts.chain(jigs).chain(others))?;
    judgement.changes.extend(strangers.changes);
    judgement.unlisted = strangers.others;
    // The kit's own list has the checks of its making: the bound is proved again only here.
    judgement.checks.extend(bound_check(&evidence, bound?));
    judgement.checks.push(sheet_check(&misstated));
    judgement.checks.push(files_check(&judgement.changes));
    judgement.checks.extend(packages?);
    if let Some(model) = model.map(Path::to_owned).or_else(|| find_model(folder)) {
        judgement
            .checks
            .push(model_check(&model, &sheet, &evidence, watch)?);
    }
    Ok(judgement)
}
