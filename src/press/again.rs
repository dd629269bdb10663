//! Printing the papers of a written kit again, and comparing them with those that it has.

use std::path::Path;

use super::job::find_false_job;
use super::other_version::find_false_masses;
use super::pins::find_false_pins;
use super::{Drawings, Layout, PressError};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::cut::{CutError, CutOrder};
use crate::draw::PictureError;
use crate::job::Job;
use crate::sheet::Checklist;
use crate::verify::{
    Body, CHECKLIST_FILE, CUTS_FILE, Check, CheckKind, JOB_FILE, Judgement, Limit, SHEET_FILE,
    VerifyError, read_kit, verify_kit_of,
};

/// The version of this program, as it stands in a checklist.
const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The folder of the pictures in a kit.
const PICTURES: &str = "pictures/";
/// Number of bytes that are shown of the place where two papers differ.
const SHOWN_BYTES: usize = 40;

/// Judges a kit as [`verify_kit_of`] does, prints its papers again, and compares them with those
/// that it has.
///
/// If a file of the kit was changed, its papers are not printed: they would only repeat that. Nor
/// are they if a part is no solid, which cannot be drawn.
///
/// # Errors
/// As [`verify_kit_of`].
pub fn verify(
    folder: &Path,
    model: Option<&Path>,
    watch: &Watch,
) -> Result<Judgement, VerifyError> {
    let mut judgement = verify_kit_of(folder, model, watch)?;
    let is_solid = |check: &Check| check.pass || check.kind != CheckKind::BrokenSurfaces;
    if judgement.changes.is_empty() && judgement.checks.iter().all(is_solid) {
        let faults = find_false_papers(folder, watch)?;
        judgement.checks.push(papers_check(&faults));
    }
    Ok(judgement)
}

/// The faults of the papers of a kit.
struct Faults {
    /// The version of the kit, if this one cannot print its papers.
    other_version: Option<String>,
    /// The faults, a sentence each.
    words: Vec<String>,
}

impl From<Vec<String>> for Faults {
    fn from(words: Vec<String>) -> Self {
        Self {
            other_version: None,
            words,
        }
    }
}

fn papers_check(faults: &Faults) -> Check {
    let promise = match &faults.other_version {
        None => "the papers say what the checklist and the files say, but for".to_owned(),
        Some(version) => format!(
            "the job sheet of version {version}, not printed again, states each mass, but for"
        ),
    };
    let words = &faults.words;
    let limit = Limit::at_most(0.0, "");
    Check::new(CheckKind::Papers, &promise, Some(words.len() as f64), limit)
        .at((!words.is_empty()).then(|| words.join("; ")))
}

/// Finds what is false in the papers of a kit.
fn find_false_papers(folder: &Path, watch: &Watch) -> Result<Faults, VerifyError> {
    let bytes = read(folder, CHECKLIST_FILE)?;
    let sheet: Checklist = match serde_json::from_slice(&bytes) {
        Ok(sheet) => sheet,
        Err(error) => return Ok(vec![format!("{CHECKLIST_FILE} is no whole one: {error}")].into()),
    };
    if sheet.tool.version != VERSION {
        return Ok(Faults {
            words: find_false_masses(&sheet, &read_text(folder, SHEET_FILE)?),
            other_version: Some(sheet.tool.version),
        });
    }
    let again = sheet.to_json().unwrap_or_default();
    let faults = tell_difference(CHECKLIST_FILE, &bytes, again.as_bytes());
    let mut faults: Vec<String> = faults.into_iter().collect();
    match Job::from_toml(JOB_FILE, &read_text(folder, JOB_FILE)?) {
        Ok(job) => faults.extend(find_false_job(&sheet, &job)),
        Err(fault) => faults.push(fault.to_string()),
    }
    let order = match CutOrder::from_toml(CUTS_FILE, &read_text(folder, CUTS_FILE)?) {
        Ok(order) => order,
        Err(fault) => return Ok(vec![fault.to_string()].into()),
    };
    faults.extend(find_false_pins(&sheet, &order));
    match draw(folder, &sheet, &order, watch) {
        Ok(drawn) => {
            let sha256 = sha256_hex(&[&bytes]);
            faults.extend(find_other_papers(folder, &sheet, &sha256, &drawn));
        }
        Err(PressFault::Verify(error)) => return Err(error),
        Err(PressFault::Press(error)) => faults.push(error.to_string()),
    }
    Ok(faults.into())
}

/// Returns the pages and pictures of a kit that differ from those that were printed again, a
/// sentence each.
fn find_other_papers(
    folder: &Path,
    sheet: &Checklist,
    sha256: &str,
    drawn: &Drawings,
) -> Vec<String> {
    let pictures = drawn.pictures.iter();
    let pictures = pictures.map(|picture| (picture.file.as_str(), picture.bytes()));
    let pages = drawn.print(sheet, sha256).into_iter();
    let papers = pages.map(|(file, page)| (file, page.into_bytes()));
    let other = papers
        .chain(pictures)
        .filter_map(|(file, again)| match read(folder, file) {
            Ok(found) => tell_difference(file, &found, &again),
            Err(_) => Some(format!("{file} is missing")),
        });
    let is_strange = |file: &&String| {
        let mut drawn = drawn.pictures.iter();
        file.starts_with(PICTURES) && !drawn.any(|picture| picture.file == **file)
    };
    let strange = sheet.files.keys().filter(is_strange);
    let strange = strange.map(|file| format!("{file} is no picture of this kit"));
    other.chain(strange).collect()
}

fn read(folder: &Path, file: &str) -> Result<Vec<u8>, VerifyError> {
    let path = folder.join(file);
    std::fs::read(&path).map_err(|source| VerifyError::File { path, source })
}

fn read_text(folder: &Path, file: &str) -> Result<String, VerifyError> {
    Ok(String::from_utf8_lossy(&read(folder, file)?).into_owned())
}

/// A reason why the papers of a written kit cannot be printed again.
#[derive(Debug)]
enum PressFault {
    /// The kit cannot be read, or the watch was stopped.
    Verify(VerifyError),
    /// A picture cannot be drawn.
    Press(PressError),
}

impl<E: Into<PressError>> From<E> for PressFault {
    fn from(error: E) -> Self {
        match error.into() {
            PressError::Section(CutError::Cancelled(stopped))
            | PressError::Picture(PictureError::Cancelled(stopped)) => Self::Verify(stopped.into()),
            error => Self::Press(error),
        }
    }
}

/// Draws the pictures of a written kit again.
fn draw(
    folder: &Path,
    sheet: &Checklist,
    order: &CutOrder,
    watch: &Watch,
) -> Result<Drawings, PressFault> {
    let evidence = read_kit(folder).map_err(PressFault::Verify)?;
    let body = Body::of(&evidence.hollowed);
    let layout = Layout {
        evidence: &evidence,
        body: &body,
        cuts: &order.cuts,
        partings: &order.partings()?,
        uncut: &order.uncut,
    };
    let mut drawings = layout.draw_parts(watch)?;
    layout.draw_figures(sheet, &mut drawings, watch)?;
    Ok(drawings)
}

/// Tells the first place where a paper differs from the one that was printed again; `None` if it
/// does not.
fn tell_difference(file: &str, found: &[u8], again: &[u8]) -> Option<String> {
    if found == again {
        return None;
    }
    let mut pairs = found.iter().zip(again);
    let at = pairs.position(|(a, b)| a != b);
    let at = at.unwrap_or(found.len().min(again.len()));
    let around = |bytes: &[u8]| {
        let from = at.saturating_sub(SHOWN_BYTES / 2);
        let to = (at + SHOWN_BYTES / 2).min(bytes.len());
        let text = String::from_utf8_lossy(bytes.get(from..to).unwrap_or_default()).into_owned();
        text.escape_debug().to_string()
    };
    let [found, again] = [found, again].map(around);
    Some(format!(
        "{file} has \u{201c}{found}\u{201d} where \u{201c}{again}\u{201d} belongs"
    ))
}
