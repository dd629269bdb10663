//! The names of the files of a kit, and the paths that stay inside it.

use std::fs;
use std::path::{Component, Path};

use crate::base::digest::sha256_hex;

/// The checklist of a kit.
pub const CHECKLIST_FILE: &str = "checklist.json";
/// The job sheet for people.
pub const SHEET_FILE: &str = "job.html";
/// The certificate, for people.
pub const CERTIFICATE_FILE: &str = "certificate.html";
/// The hashes of all files of a kit except itself.
pub const SUMS_FILE: &str = "SHA256SUMS";
/// The job of a kit, which makes it again.
pub const JOB_FILE: &str = "job.toml";
/// The cuts and pins of a kit, to edit.
pub const CUTS_FILE: &str = "cuts.toml";
/// The field of densities of a kit, if it was ordered as a file.
pub const FIELD_FILE: &str = "field.toml";
/// The folder of the copy of the model in a kit.
pub const MODEL_FOLDER: &str = "model/";
/// The folder of the regions of sparse infill in a kit.
pub const SPARSE_FOLDER: &str = "modifiers/";
/// The uncut result of a kit.
pub const HOLLOWED_FILE: &str = "hollowed.stl";

/// Returns true if a relative path stays below the folder it is joined to.
pub(super) fn is_inside_kit(file: &str) -> bool {
    !file.is_empty()
        && Path::new(file)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
}

/// Returns true if the list of a kit in this folder names its checklist, with another hash than
/// that of these bytes. `None` stands for a checklist that cannot be read.
pub(super) fn is_checklist_damaged(folder: &Path, bytes: Option<&[u8]>) -> bool {
    let Ok(list) = fs::read(folder.join(SUMS_FILE)) else {
        return false;
    };
    let listed = String::from_utf8_lossy(&list);
    let line = listed
        .lines()
        .find_map(|line| line.strip_suffix(CHECKLIST_FILE)?.strip_suffix("  "));
    line.is_some_and(|sha256| bytes.is_none_or(|bytes| sha256_hex(&[bytes]) != sha256))
}
