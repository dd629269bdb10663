//! The names of the files of a kit, and the paths that stay inside it.

use std::path::{Component, Path};

/// The checklist of a kit.
pub const CHECKLIST_FILE: &str = "checklist.json";
/// The job sheet for people.
pub const SHEET_FILE: &str = "job.html";
/// The certificate, for people.
pub const CERTIFICATE_FILE: &str = "certificate.html";
/// The hashes of all files of a kit except itself.
pub const SUMS_FILE: &str = "SHA256SUMS";
/// The uncut result of a kit.
pub const HOLLOWED_FILE: &str = "hollowed.stl";

/// Returns true if a relative path stays below the folder it is joined to.
pub(super) fn is_inside_kit(file: &str) -> bool {
    !file.is_empty()
        && Path::new(file)
            .components()
            .all(|part| matches!(part, Component::Normal(_)))
}
