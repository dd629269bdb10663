//! The kit in memory: its files, its checklist and its page.

use super::asked::Asked;
use super::error::CoreRunError;
use super::files::packages;
use super::judge::{Draft, json};
use super::outcome::Prepared;
use super::scene::pictures;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::kit::Kit;
use crate::page::{CorePage, core_job};
use crate::verify::{
    CHECKLIST_FILE, CORE_CERTIFICATE_FILE, JOB_FILE, MODEL_FILE, PANELS_FILE, SHEET_FILE,
    SUMS_FILE, sums,
};

/// The ending of drawings that the page shows.
const DRAWING: &str = ".svg";

/// Puts a judged kit together, with its page.
pub fn finish(asked: &Asked, draft: Draft, watch: &Watch) -> Result<Prepared, CoreRunError> {
    watch.enter(Phase::Report);
    let mut sheet = draft.sheet;
    let pictures = pictures(asked, &draft.made, watch)?;
    let mut kit = Kit::default();
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages(asked, &draft.made)? {
        kit.add(&file, bytes);
    }
    for (file, bytes) in &draft.drawings {
        kit.add(file, bytes.clone());
    }
    kit.add(MODEL_FILE, draft.model_stl);
    kit.add(PANELS_FILE, draft.panels_json.into_bytes());
    kit.add(CORE_CERTIFICATE_FILE, draft.certificate_json.into_bytes());
    kit.add(JOB_FILE, asked.job.to_toml()?.into_bytes());
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    watch.check()?;
    let hashed = |(file, bytes): (&str, &[u8])| (file.to_owned(), sha256_hex(&[bytes]));
    sheet.files = kit.files().map(hashed).collect();
    let text = json(CHECKLIST_FILE, &sheet)?;
    let sha256 = sha256_hex(&[text.as_bytes()]);
    kit.add(CHECKLIST_FILE, text.into_bytes());
    let drawn = draft.drawings.iter();
    let drawn = drawn.filter(|(file, _)| file.ends_with(DRAWING));
    let drawings: Vec<String> = drawn
        .map(|(_, bytes)| String::from_utf8_lossy(bytes).into_owned())
        .collect();
    let page = CorePage {
        sheet: &sheet,
        sha256: &sha256,
        pictures: &pictures,
        drawings: &drawings,
    };
    kit.add(SHEET_FILE, core_job(&page).into_bytes());
    kit.add(SUMS_FILE, sums(kit.files()).into_bytes());
    Ok(Prepared {
        kit,
        checklist: sheet,
    })
}
