//! The kit in memory: its files, its checklist and its pages.

use super::asked::Asked;
use super::error::TelescopeRunError;
use super::files::{packages, telescope_toml};
use super::judge::{Draft, json};
use super::outcome::Prepared;
use super::scene::pictures;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::kit::Kit;
use crate::page::{TelescopePage, telescope_certificate, telescope_job};
use crate::verify::{
    CERTIFICATE_FILE, CHECKLIST_FILE, CURVE_FILE, MOTION_FILE, SHEET_FILE, SUMS_FILE, sums,
};

/// File of the job in a kit.
const JOB: &str = "job.toml";
/// File of the telescope as plain data in a kit.
const TELESCOPE: &str = "telescope.toml";

/// Puts a judged kit together, with its pages.
pub fn finish(asked: &Asked, draft: Draft, watch: &Watch) -> Result<Prepared, TelescopeRunError> {
    watch.enter(Phase::Report);
    let mut sheet = draft.sheet;
    let pictures = pictures(&draft.made, watch)?;
    let mut kit = Kit::default();
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for (file, bytes) in packages(asked, &draft.made)? {
        kit.add(&file, bytes);
    }
    kit.add(MOTION_FILE, draft.motion_json.into_bytes());
    kit.add(CURVE_FILE, draft.curve_csv.into_bytes());
    kit.add(TELESCOPE, telescope_toml(&sheet)?.into_bytes());
    let mut job = asked.job.clone();
    job.curve.sha256.clone_from(&asked.sha256);
    kit.add(JOB, job.to_toml()?.into_bytes());
    for picture in &pictures {
        kit.add(&picture.file, picture.bytes());
    }
    watch.check()?;
    let hashed = |(file, bytes): (&str, &[u8])| (file.to_owned(), sha256_hex(&[bytes]));
    sheet.files = kit.files().map(hashed).collect();
    let text = json(CHECKLIST_FILE, &sheet)?;
    let sha256 = sha256_hex(&[text.as_bytes()]);
    kit.add(CHECKLIST_FILE, text.into_bytes());
    let page = TelescopePage {
        sheet: &sheet,
        sha256: &sha256,
        pictures: &pictures,
    };
    kit.add(SHEET_FILE, telescope_job(&page).into_bytes());
    kit.add(CERTIFICATE_FILE, telescope_certificate(&page).into_bytes());
    kit.add(SUMS_FILE, sums(kit.files()).into_bytes());
    Ok(Prepared {
        kit,
        checklist: sheet,
    })
}
