//! The list of all hashes of a kit, in the format of `sha256sum --check`. It seals the papers,
//! which the checklist cannot.

use std::collections::BTreeMap;
use std::path::Path;

use super::files::{CERTIFICATE_FILE, CHECKLIST_FILE, SHEET_FILE, SUMS_FILE, is_inside_kit};
use super::reading::read_file;
use super::{Change, FileChange, Promise, VerifyError};
use crate::base::digest::sha256_hex;

/// Number of digits of a hash in hex.
const HASH_DIGITS: usize = 64;

/// Returns the list of these files, in their order. Each line has the hash, two blanks and the
/// path.
pub fn sums<'a>(files: impl IntoIterator<Item = (&'a str, &'a [u8])>) -> String {
    files
        .into_iter()
        .map(|(file, bytes)| format!("{}  {file}\n", sha256_hex(&[bytes])))
        .collect()
}

/// Returns the changes of the papers: the checklist, the pages for people and the list itself.
///
/// The checklist has the hashes of all other files, the pages that of the checklist, and the
/// list all of them. Any two that disagree are reported.
///
/// # Errors
///
/// If a paper cannot be read.
pub fn find_paper_changes(
    folder: &Path,
    promise: &Promise,
) -> Result<Vec<FileChange>, VerifyError> {
    let changed = |file: &str, change| FileChange {
        file: file.to_owned(),
        change,
    };
    let missing = [SUMS_FILE, SHEET_FILE, CERTIFICATE_FILE]
        .into_iter()
        .filter(|file| !folder.join(file).is_file());
    let mut changes: Vec<FileChange> = missing.map(|file| changed(file, Change::Missing)).collect();
    if !folder.join(SUMS_FILE).is_file() {
        return Ok(changes);
    }
    let list = read_file(&folder.join(SUMS_FILE))?;
    let Some(listed) = parse_sums(&list) else {
        changes.push(changed(SUMS_FILE, Change::Altered));
        return Ok(changes);
    };
    let json = sha256_hex(&[&read_file(&folder.join(CHECKLIST_FILE))?]);
    let is_listed = listed.get(CHECKLIST_FILE) == Some(&json);
    if !is_listed {
        changes.push(changed(CHECKLIST_FILE, Change::Altered));
    }
    for paper in [SHEET_FILE, CERTIFICATE_FILE] {
        if !folder.join(paper).is_file() {
            continue;
        }
        let page = read_file(&folder.join(paper))?;
        if listed.get(paper) != Some(&sha256_hex(&[&page])) {
            changes.push(changed(paper, Change::Altered));
        } else if is_listed && !String::from_utf8_lossy(&page).contains(&json) {
            changes.push(changed(paper, Change::OfAnother));
        }
    }
    let papers = [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE];
    let is_whole = promise
        .files
        .iter()
        .all(|(file, sha256)| listed.get(file) == Some(sha256))
        && listed.len() == promise.files.len() + papers.len();
    if !is_whole {
        changes.push(changed(SUMS_FILE, Change::Altered));
    }
    Ok(changes)
}

/// Returns the hashes of a list by path. `None` unless each line is as [`sums`] writes it, for a
/// file inside the kit, once each.
fn parse_sums(list: &[u8]) -> Option<BTreeMap<String, String>> {
    let text = std::str::from_utf8(list).ok()?;
    let mut listed = BTreeMap::new();
    for line in text.split_inclusive('\n') {
        let (sha256, file) = line.strip_suffix('\n')?.split_once("  ")?;
        let is_hash = sha256.len() == HASH_DIGITS
            && sha256
                .bytes()
                .all(|digit| matches!(digit, b'0'..=b'9' | b'a'..=b'f'));
        let is_new = listed.insert(file.to_owned(), sha256.to_owned()).is_none();
        let is_plain = !file.chars().any(char::is_control);
        if !(is_hash && is_new && is_plain && is_inside_kit(file)) {
            return None;
        }
    }
    Some(listed)
}
