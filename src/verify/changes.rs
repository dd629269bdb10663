//! What became of the files of a kit since it was made.

use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;

use super::{
    Check, CheckKind, Evidence, Fingerprint, Limit, PartEvidence, Promise, PromisedPart,
    VerifyError,
    fingerprint::Likeness,
    kit::{HOLLOWED_FILE, read_file},
    pegs::Felt,
};
use crate::base::digest::sha256_hex;

/// A file that is not as it was when the kit was made.
#[derive(Debug, Clone, PartialEq)]
pub struct FileChange {
    /// Its path in the kit.
    pub file: String,
    /// What became of it.
    pub change: Change,
}

/// What became of a file.
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// It is not there.
    Missing,
    /// It has other bytes, and no more is known of it.
    Altered,
    /// It holds no mesh; why.
    Unreadable(String),
    /// It was made for another checklist.
    OfAnother,
    /// Other bytes, the same triangles: another program saved it again.
    Resaved,
    /// The same shape, but for its coordinates' last digits or single corners.
    Touched,
    /// It holds the part of that name.
    Exchanged(String),
    /// The part, elsewhere by so many mm.
    Moved(f64),
    /// The part, turned.
    Turned,
    /// The part times that.
    Scaled(f64),
    /// The part's mirror image.
    Mirrored,
    /// Another shape, which lacks these pins of the part.
    Reshaped(Vec<String>),
}

impl fmt::Display for FileChange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let words = match &self.change {
            Change::Missing => "is missing".to_owned(),
            Change::Altered => "was changed: it has other bytes".to_owned(),
            Change::Unreadable(why) => format!("holds no mesh: {why}"),
            Change::OfAnother => "speaks of another checklist.json".to_owned(),
            Change::Resaved => "was saved again: other bytes, the same triangles".to_owned(),
            Change::Touched => {
                "was changed a little: its coordinates were rounded, or a corner moved".to_owned()
            }
            Change::Exchanged(part) => format!("was exchanged: it holds part {part}"),
            Change::Moved(mm) => format!("was moved by {mm:.3} mm"),
            Change::Turned => "was turned".to_owned(),
            Change::Scaled(ratio) => format!("was scaled to {:.3} % of its size", ratio * 100.0),
            Change::Mirrored => "was mirrored".to_owned(),
            Change::Reshaped(pins) if pins.is_empty() => "has another shape".to_owned(),
            Change::Reshaped(pins) => {
                format!("has another shape: it lacks the pins {}", pins.join(", "))
            }
        };
        write!(f, "{} {words}", self.file)
    }
}

impl FileChange {
    /// What to do about it.
    pub fn remedy(&self) -> &'static str {
        match self.change {
            Change::Missing => {
                "copy it again from where the kit was made, or make the kit again from its job.toml"
            }
            Change::Unreadable(_) => "copy it again: it was cut short or is another file",
            Change::Altered | Change::OfAnother => {
                "take the file as it was made; where it was meant to change, make the kit again from its job.toml"
            }
            Change::Resaved => "nothing of its shape was lost; print the original file to be sure",
            Change::Exchanged(_) => "give the file its own name back, or copy it again",
            Change::Scaled(_) => "print the original file again, at 100 %",
            Change::Touched
            | Change::Moved(_)
            | Change::Turned
            | Change::Mirrored
            | Change::Reshaped(_) => {
                "print the original file again; a part is turned and moved on the plate, not in its file"
            }
        }
    }

    /// Whether the shape that is judged is another for it, so that other promises fail by it.
    pub fn is_of_shape(&self) -> bool {
        match self.change {
            Change::Altered => self.file == HOLLOWED_FILE,
            Change::Missing | Change::OfAnother | Change::Resaved => false,
            _ => true,
        }
    }
}

/// The files whose bytes are not those the checklist was made for, in the checklist's order.
pub fn file_changes(folder: &Path, evidence: &Evidence) -> Result<Vec<FileChange>, VerifyError> {
    let promise = &evidence.promise;
    let found = hashes(folder, promise)?;
    let changed = |file: &str, sha256: &str| found.get(file).is_none_or(|found| found != sha256);
    let parts = promise.parts.iter().zip(&evidence.parts);
    let parts = parts.filter(|(part, _)| changed(&part.file, &part.sha256));
    let mut changes: Vec<FileChange> = parts
        .map(|(part, read)| FileChange {
            file: part.file.clone(),
            change: part_change(part, read, promise),
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

/// The hashes of the files of a kit that are there.
fn hashes(folder: &Path, promise: &Promise) -> Result<BTreeMap<String, String>, VerifyError> {
    let files = promise
        .parts
        .iter()
        .map(|part| &part.file)
        .chain(promise.files.keys());
    let mut hashes = BTreeMap::new();
    for file in files.filter(|file| folder.join(file).exists()) {
        hashes.insert(file.clone(), sha256_hex(&[&read_file(&folder.join(file))?]));
    }
    Ok(hashes)
}

/// What became of a part, by the marks that the checklist holds.
fn part_change(part: &PromisedPart, read: &PartEvidence, promise: &Promise) -> Change {
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

/// The pins of a part in the middle of which its file has no material.
fn missing_pins(part: &PromisedPart, read: &PartEvidence) -> Vec<String> {
    let felt = Felt::of(read);
    let is_gone = |pin: &&super::Peg| !felt.holds(&pin.at(pin.length_mm / 2.0));
    part.pins
        .iter()
        .filter(is_gone)
        .map(|pin| pin.id.clone())
        .collect()
}

/// The check that nothing was changed, with what became of each file that was.
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
