//! The kit in memory: its files, its checklist and its page.

use super::judge::Draft;
use super::outcome::Prepared;
use super::slice;
use crate::base::digest::sha256_hex;
use crate::base::watch::{Phase, Watch};
use crate::cut::CutOrder;
use crate::error::Error;
use crate::io::read_bytes;
use crate::job::{FieldOrder, Job, JobError, Like, ModelChoice};
use crate::kit::Kit;
use crate::page::cup_warning;
use crate::press::Drawings;
use crate::run::Placed;
use crate::sheet::from_run::{Facts, checklist};
use crate::sheet::{Checklist, Timing};
use crate::slicer::{SliceSettings, Slicer};
use crate::verify::{
    CHECKLIST_FILE, CUTS_FILE, FIELD_FILE, HOLLOWED_FILE, JOB_FILE, MODEL_FOLDER, SUMS_FILE, sums,
};

/// Puts a judged kit together, with its job sheet.
///
/// `slicer` tells what the plates take.
pub fn finish(
    placed: &Placed,
    draft: &Draft,
    slicer: Option<&Slicer>,
    watch: &Watch,
) -> Result<Prepared, Error> {
    watch.enter(Phase::Report);
    let mut checklist = fill(placed, draft);
    let mut drawings = draft.drawings.clone();
    draft
        .layout()
        .draw_figures(&checklist, &mut drawings, watch)?;
    watch.check()?;
    let mut kit = files(placed, draft, slicer)?;
    for picture in &drawings.pictures {
        kit.add(&picture.file, picture.bytes());
    }
    slice::refuse_other_plates(&placed.job, &kit)?;
    let settings = SliceSettings::of(&placed.shop.printer, &placed.shop.material);
    if let (Some(slicer), Some(settings)) = (slicer, settings) {
        checklist.print_time = Some(slice::time(&settings, slicer, kit.files(), watch)?);
    }
    let hashed = |(file, bytes): (&str, &[u8])| (file.to_owned(), sha256_hex(&[bytes]));
    checklist.files = kit.files().map(hashed).collect();
    watch.check()?;
    add_papers(&mut kit, &checklist, &drawings)?;
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
        plates: &draft.packages.plates,
    });
    checklist.warnings.extend(cup_warning(&checklist));
    checklist
}

/// Returns the kit with all files that the checklist lists.
fn files(placed: &Placed, draft: &Draft, slicer: Option<&Slicer>) -> Result<Kit, Error> {
    let mut kit = Kit::default();
    kit.add(HOLLOWED_FILE, draft.hollowed.clone());
    for part in &draft.made.parts {
        kit.add(&part.file, part.bytes.clone());
        let regions = part.sparse.iter().flat_map(|sparse| &sparse.regions);
        for (file, bytes) in regions.filter_map(|region| region.file.as_ref()) {
            kit.add(file, bytes.clone());
        }
    }
    for jig in &draft.made.jigs {
        kit.add(&jig.file, jig.bytes.clone());
    }
    for (file, bytes) in &draft.packages.files {
        kit.add(file, bytes.clone());
    }
    // Where the model lay is nobody's business, and no reason for other bytes.
    let job = slice::record(&placed.job, slicer);
    let job = Job {
        model: job.model.without_folder(),
        like: job.like.as_ref().map(Like::without_folder),
        ..job
    };
    kit.add(JOB_FILE, job.to_toml()?.into_bytes());
    let field = placed.job.field.as_ref().and_then(FieldOrder::file_text);
    if let Some(text) = field {
        kit.add(FIELD_FILE, text.as_bytes().to_vec());
    }
    let cuts = CutOrder {
        keep_clear: placed.job.keep_clear.clone(),
        ..CutOrder::of(&draft.made.plan)
    };
    let cuts = cuts.to_toml();
    kit.add(CUTS_FILE, cuts.map_err(JobError::from)?.into_bytes());
    if !placed.job.no_model {
        let (file, bytes) = model_copy(placed)?;
        kit.add(&file, bytes);
    }
    Ok(kit)
}

/// Returns the copy of the model that goes into the kit, with its path there.
fn model_copy(placed: &Placed) -> Result<(String, Vec<u8>), Error> {
    let bytes = read_bytes(placed.job.model_file())?;
    // A model that was changed during the run is not the one that the kit was made of.
    placed.job.clone().bind_to(&bytes)?;
    let copy = ModelChoice::copy_name(&placed.job.model.path, &placed.name());
    Ok((format!("{MODEL_FOLDER}{copy}"), bytes))
}

/// Adds the job sheet, for people and for machines, without anything that differs from run to run,
/// and the list of all hashes.
fn add_papers(kit: &mut Kit, sheet: &Checklist, drawings: &Drawings) -> Result<(), Error> {
    let json = sheet.to_json()?;
    let sha256 = sha256_hex(&[json.as_bytes()]);
    kit.add(CHECKLIST_FILE, json.into_bytes());
    for (file, page) in drawings.print(sheet, &sha256) {
        kit.add(file, page.into_bytes());
    }
    kit.add(SUMS_FILE, sums(kit.files()).into_bytes());
    Ok(())
}
