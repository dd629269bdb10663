//! The list of all hashes of a kit, in the form that `sha256sum --check` reads: what holds the
//! papers themselves.

use std::collections::BTreeMap;
use std::path::Path;

use super::changes::{Change, FileChange};
use super::kit::{CHECKLIST_FILE, SHEET_FILE, SUMS_FILE, lies_within, read_file};
use super::{Promise, VerifyError};
use crate::base::digest::sha256_hex;

/// The list over these files, a line each in their order: the hash, two blanks, the path.
pub fn sums<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> String {
    files
        .into_iter()
        .map(|(file, bytes)| format!("{}  {file}\n", sha256_hex(&[bytes])))
        .collect()
}

/// What became of the papers: the checklist, the job sheet and the list itself.
///
/// The checklist has the hashes of all other files, the job sheet that of the checklist, and the
/// list all of them; any two that disagree are told.
pub fn paper_changes(folder: &Path, promise: &Promise) -> Result<Vec<FileChange>, VerifyError> {
    let changed = |file: &str, change| FileChange {
        file: file.to_owned(),
        change,
    };
    let missing = [SUMS_FILE, SHEET_FILE]
        .into_iter()
        .filter(|file| !folder.join(file).is_file());
    let mut changes: Vec<FileChange> = missing.map(|file| changed(file, Change::Missing)).collect();
    if !folder.join(SUMS_FILE).is_file() {
        return Ok(changes);
    }
    let listed = listed(&String::from_utf8_lossy(&read_file(
        &folder.join(SUMS_FILE),
    )?));
    let json = sha256_hex(&[&read_file(&folder.join(CHECKLIST_FILE))?]);
    let is_listed = listed.get(CHECKLIST_FILE) == Some(&json);
    if !is_listed {
        changes.push(changed(CHECKLIST_FILE, Change::Altered));
    }
    if folder.join(SHEET_FILE).is_file() {
        let page = read_file(&folder.join(SHEET_FILE))?;
        if listed.get(SHEET_FILE) != Some(&sha256_hex(&[&page])) {
            changes.push(changed(SHEET_FILE, Change::Altered));
        } else if is_listed && !String::from_utf8_lossy(&page).contains(&json) {
            changes.push(changed(SHEET_FILE, Change::OfAnother));
        }
    }
    if promise
        .files
        .iter()
        .any(|(file, sha256)| listed.get(file) != Some(sha256))
    {
        changes.push(changed(SUMS_FILE, Change::Altered));
    }
    Ok(changes)
}

/// The hashes of a list by path; lines that are none, or point out of the kit, are passed over.
fn listed(text: &str) -> BTreeMap<String, String> {
    let line = |line: &str| {
        let (sha256, file) = line.split_once("  ")?;
        lies_within(file).then(|| (file.to_owned(), sha256.to_owned()))
    };
    text.lines().filter_map(line).collect()
}
