//! The comparison of a kit's files with the hashes and fingerprints of its checklist.

use std::collections::BTreeMap;
use std::path::Path;

use super::fingerprint::Likeness;
use super::part_probe::PartProbe;
use super::reading::read_file;
use super::{
    Change, Check, CheckKind, Evidence, FileChange, Fingerprint, Limit, PartEvidence, Promise,
    PromisedPart, VerifyError,
};
use crate::base::digest::sha256_hex;

/// Returns the files whose bytes differ from the hashes of the checklist: first the parts, then the
/// others, each in the checklist's order.
///
/// # Errors
///
/// If a file of the kit cannot be read.
pub fn find_changes(folder: &Path, evidence: &Evidence) -> Result<Vec<FileChange>, VerifyError> {
    let promise = &evidence.promise;
    let found = hash_files(folder, promise)?;
    let changed = |file: &str, sha256: &str| found.get(file).is_none_or(|found| found != sha256);
    let parts = promise.parts.iter().zip(&evidence.parts);
    let parts = parts.filter(|(part, _)| changed(&part.file, &part.sha256));
    let mut changes: Vec<FileChange> = parts
        .map(|(part, read)| FileChange {
            file: part.file.clone(),
            change: diagnose(part, read, promise),
        })
        .collect();
    let is_part = |file: &str| promise.parts.iter().any(|part| part.file == file);
    let others = promise
        .files
        .iter()
        .filter(|(file, sha256)| !is_part(file) && changed(file, sha256));
    changes.extend(others.map(|(file, _)| {
        let change = if found.contains_key(file) {
            Change::Altered
        } else {
            Change::Missing
        };
        FileChange {
            file: file.clone(),
            change,
        }
    }));
    Ok(changes)
}

/// Returns the hashes of the kit's files by path; missing files are skipped.
fn hash_files(folder: &Path, promise: &Promise) -> Result<BTreeMap<String, String>, VerifyError> {
    let files = promise
        .parts
        .iter()
        .map(|part| &part.file)
        .chain(promise.files.keys());
    let mut hashes = BTreeMap::new();
    for file in files.filter(|file| folder.join(file).is_file()) {
        hashes.insert(file.clone(), sha256_hex(&[&read_file(&folder.join(file))?]));
    }
    Ok(hashes)
}

/// Recognises the change of a part by the fingerprints of the checklist.
fn diagnose(part: &PromisedPart, read: &PartEvidence, promise: &Promise) -> Change {
    let Some(fingerprint) = &part.fingerprint else {
        return Change::Altered;
    };
    let found = Fingerprint::of(&read.mesh);
    let likeness = fingerprint.likeness(&found);
    let is_it = |other: &&PromisedPart| {
        other
            .fingerprint
            .as_ref()
            .is_some_and(|fingerprint| fingerprint.triangles_sha256 == found.triangles_sha256)
    };
    match promise.parts.iter().find(is_it) {
        Some(other) if likeness != Likeness::Same => return Change::Exchanged(other.id.clone()),
        _ => {}
    }
    match likeness {
        Likeness::Same => Change::Resaved,
        Likeness::Near => Change::Touched,
        Likeness::Moved(mm) => Change::Moved(mm),
        Likeness::Turned => Change::Turned,
        Likeness::Scaled(ratio) => Change::Scaled(ratio),
        Likeness::Mirrored => Change::Mirrored,
        Likeness::Other => Change::Reshaped(missing_pins(part, read)),
    }
}

/// Returns the pins of a part without material at their middles in its file.
fn missing_pins(part: &PromisedPart, read: &PartEvidence) -> Vec<String> {
    let probe = PartProbe::new(read);
    let is_missing = |pin: &&super::Peg| !probe.contains(&pin.at(pin.length_mm / 2.0));
    part.pins
        .iter()
        .filter(is_missing)
        .map(|pin| pin.id.clone())
        .collect()
}

/// Checks that no file was changed; the detail lists the changes.
pub fn files_check(changes: &[FileChange]) -> Check {
    let words: Vec<String> = changes.iter().map(FileChange::to_string).collect();
    let promise = "every file is the one the checklist was made for";
    Check::new(
        CheckKind::ChangedFiles,
        promise,
        Some(changes.len() as f64),
        Limit::at_most(0.0, ""),
    )
    .at((!words.is_empty()).then(|| words.join("; ")))
}
