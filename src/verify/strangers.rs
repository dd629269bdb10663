//! What lies in the folder of a kit and is not on its list: files of others, and links.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::files::{CERTIFICATE_FILE, CHECKLIST_FILE, SHEET_FILE, SUMS_FILE};
use super::{Change, FileChange, VerifyError};

/// The endings of files that somebody could print by mistake.
const PRINTABLE: [&str; 10] = [
    "3mf", "amf", "bgcode", "g", "gco", "gcode", "obj", "ply", "stl", "x3g",
];
/// Greatest depth of folders, and greatest number of entries, that are looked at. A kit has two
/// levels and far fewer files.
const MAX_DEPTH: usize = 16;
const MAX_ENTRIES: usize = 100_000;

/// What is not on the list of a kit.
#[derive(Debug, Default)]
pub(super) struct Strangers {
    /// Files that could be printed, and links: they break a promise.
    pub(super) changes: Vec<FileChange>,
    /// Other files, by their paths.
    pub(super) others: Vec<String>,
}

/// Finds what is in a kit's folder, neither listed nor one of its papers, in the order of the
/// paths. Links are not followed.
///
/// # Errors
/// A folder of the kit cannot be read.
pub(super) fn find_strangers<'a>(
    folder: &Path,
    listed: impl Iterator<Item = &'a str>,
) -> Result<Strangers, VerifyError> {
    let papers = [CHECKLIST_FILE, SHEET_FILE, CERTIFICATE_FILE, SUMS_FILE];
    let listed: BTreeSet<&str> = listed.chain(papers).collect();
    let mut found = Strangers::default();
    let mut entries = 0;
    let mut folders = vec![(String::new(), 0)];
    while let Some((below, depth)) = folders.pop() {
        for entry in list_folder(&folder.join(&below))? {
            entries += 1;
            let name = entry.file_name().unwrap_or_default().to_string_lossy();
            let path = if below.is_empty() {
                name.into_owned()
            } else {
                format!("{below}/{name}")
            };
            let kind = fs::symlink_metadata(&entry).map(|facts| facts.file_type());
            let change = |change| FileChange {
                file: path.clone(),
                change,
            };
            match kind {
                Ok(kind) if kind.is_symlink() => found.changes.push(change(Change::Link)),
                Ok(kind) if kind.is_dir() && depth < MAX_DEPTH && entries < MAX_ENTRIES => {
                    folders.push((path, depth + 1));
                }
                _ if listed.contains(path.as_str()) => {}
                _ if is_printable(&path) => found.changes.push(change(Change::Unlisted)),
                _ => found.others.push(path),
            }
        }
    }
    found.changes.sort_by(|a, b| a.file.cmp(&b.file));
    found.others.sort();
    Ok(found)
}

/// Returns the entries of a folder.
fn list_folder(folder: &Path) -> Result<Vec<PathBuf>, VerifyError> {
    let entries = fs::read_dir(folder).and_then(|entries| {
        let paths = entries.map(|entry| entry.map(|entry| entry.path()));
        paths.collect::<Result<Vec<PathBuf>, std::io::Error>>()
    });
    entries.map_err(|source| VerifyError::File {
        path: folder.to_owned(),
        source,
    })
}

/// Returns true if a file could be printed, by the ending of its name.
fn is_printable(path: &str) -> bool {
    let ending = Path::new(path).extension().unwrap_or_default();
    PRINTABLE.contains(&ending.to_string_lossy().to_lowercase().as_str())
}
