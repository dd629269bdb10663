//! The kit in memory: its files, its checklist and its page.

use super::faces::faces;
use super::judge::Draft;
use super::outcome::Prepared;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::cut::CutOrder;
use crate::error::Error;
use crate::job::JobError;
use crate::kit::Kit;
use crate::page::{self, PageInputs, cup_warning, draw_figures};
use crate::run::Placed;
use crate::sheet::from_run::{Facts, checklist};
use crate::sheet::{Checklist, Timing};
use crate::verify::{CERTIFICATE_FILE, CHECKLIST_FILE, SHEET_FILE, SUMS_FILE, sums};

/// File of the uncut result in a kit.
const HOLLOWED: &str = "hollowed.stl";
/// File of the job in a kit.
const JOB: &str = "job.toml";
/// File of the cuts and pins in a kit, to edit.
const CUTS: &str = "cuts.toml";

/// Puts a judged kit together, with its job sheet.
pub fn finish(placed: &Placed, mut draft: Draft, watch: &Watch) -> Result<Prepared, Error> {
    watch.enter(Phase::Report);
    let (mut checklist, faces) = rayon::join(|| fill(placed, &draft), || faces(&draft.made, watch));
    let faces = faces?;
    let of_cuts = draw_figures(&checklist, &draft.subject(), &faces, watch)?;
    draft.pictures.extend(of_cuts);
    watch.check()?;
    let mut kit = files(placed, &draft)?;
    let hashed = |(file, bytes): (&str, &[u8])| (file.to_owned(), sha256_hex(&[bytes]));
    checklist.files = kit.files().map(hashed).collect();
    watch.check()?;
    add_papers(&mut kit, &checklist, &draft)?;
    let laps = watch.laps().into_iter();
    let laps = laps.map(|(phase, seconds)| (phase.key().to_owned(), seconds));
    checklist.timing_s = Some(Timing(laps.collect()));
    Ok(Prepared {
        kit,
        checklist,
        failure: None,
    })
}

/// Fills the checklist, but for the hashes of the kit's files and the timings.
fn fill(placed: &Placed, draft: &Draft) -> Checklist {
    let mut checklist = checklist(&Facts {
        placed,
        made: &draft.made,
        judgement: &draft.judgement,
        promised: draft.evidence.promise.promise,
    });
    checklist.warnings.extend(cup_warning(&checklist));
    checklist
}

/// Returns the kit with all files that the checklist lists.
fn files(placed: &Placed, draft: &Draft) -> Result<Kit, Error> {
    let mut kit = Kit::default();
    kit.add(HOLLOWED, draft.hollowed.clone());
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
    }
    for jig in &draft.made.jigs {
        kit.add(&jig.file, jig.bytes.clone());
    }
    for (file, bytes) in &draft.packages {
        kit.add(file, bytes.clone());
    }
    kit.add(JOB, placed.job.to_toml()?.into_bytes());
    let cuts = CutOrder {
        keep_clear: placed.job.keep_clear.clone(),
        ..CutOrder::of(&draft.made.plan)
    };
    let cuts = cuts.to_toml();
    kit.add(CUTS, cuts.map_err(JobError::from)?.into_bytes());
    for picture in &draft.pictures {
        kit.add(&picture.file, picture.bytes());
    }
    Ok(kit)
}

/// Adds the job sheet, for people and for machines, without anything that differs from run to run,
/// and the list of all hashes.
fn add_papers(kit: &mut Kit, sheet: &Checklist, draft: &Draft) -> Result<(), Error> {
    let json = sheet.to_json()?;
    let sha256 = sha256_hex(&[json.as_bytes()]);
    kit.add(CHECKLIST_FILE, json.into_bytes());
    let inputs = PageInputs {
        sheet,
        sha256: &sha256,
        pictures: &draft.pictures,
        view: Some(&draft.view),
    };
    kit.add(SHEET_FILE, page::job(&inputs).into_bytes());
    kit.add(CERTIFICATE_FILE, page::certificate(&inputs).into_bytes());
    kit.add(SUMS_FILE, sums(kit.files()).into_bytes());
    Ok(())
}
