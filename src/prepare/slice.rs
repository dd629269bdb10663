//! Slice: what a slicer says that the plates take, if one was ordered.

use std::collections::BTreeMap;

use super::load;
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::error::{Error, SlicedError};
use crate::job::{Job, PartFormat, SlicerChoice};
use crate::kit::Kit;
use crate::printer::{Plate, Printer};
use crate::sheet::{PlateTimeRow, PrintTimeRow};
use crate::slicer::{PlateFile, SliceSettings, Slicer, SlicerError};

/// Finds the slicer that a job orders, before the work begins; `None` if it orders none.
pub fn find(job: &Job, watch: &Watch) -> Result<Option<Slicer>, Error> {
    let Some(choice) = &job.slicer else {
        return Ok(None);
    };
    let printer = load::printer(job, watch)?;
    if job.format == PartFormat::Stl {
        return Err(SlicerError::NoPlates.into());
    }
    let material = printer.material(job.printer.material.as_deref())?;
    if SliceSettings::of(&printer, material).is_none() {
        let printer = printer.name.clone();
        return Err(SlicerError::NoFilament { printer }.into());
    }
    Ok(Some(Slicer::find(Some(&choice.command))?))
}

/// Finds the slicer for the rounds of a job, before the work begins; returns its command.
///
/// # Errors
/// There is none, or the kit has no plates that one slices.
pub fn find_for_rounds(job: &Job, watch: &Watch) -> Result<String, Error> {
    let printer = load::printer(job, watch)?;
    if job.format == PartFormat::Stl {
        return Err(SlicedError::NoPlates.into());
    }
    let material = printer.material(job.printer.material.as_deref())?;
    if SliceSettings::of(&printer, material).is_none() {
        let printer = printer.name.clone();
        return Err(SlicedError::NoFilament { printer }.into());
    }
    let command = job.slicer.as_ref().map(|slicer| slicer.command.as_str());
    Ok(Slicer::find(command)?.command().to_owned())
}

/// Refuses the toolpaths that a job keeps, if they are those of other plates than its kit has.
pub fn refuse_other_plates(job: &Job, kit: &Kit) -> Result<(), SlicedError> {
    let Some(sliced) = &job.toolpaths else {
        return Ok(());
    };
    let plates = kit.files().filter(|(file, _)| Plate::is_file_name(file));
    let found: BTreeMap<&str, String> = plates
        .map(|(file, bytes)| (file, sha256_hex(&[bytes])))
        .collect();
    let kept = sliced.plates.iter();
    let kept: BTreeMap<&str, String> = kept
        .map(|plate| (plate.file.as_str(), plate.sha256.clone()))
        .collect();
    match found == kept {
        true => Ok(()),
        false => Err(SlicedError::OtherPlates),
    }
}

/// Returns the job as its kit names it: with the slicer's version, and without its folder.
pub fn record(job: &Job, slicer: Option<&Slicer>) -> Job {
    let name = |slicer: &Slicer| {
        let command = slicer.command().rsplit(['/', '\\']).next();
        command.unwrap_or_default().to_owned()
    };
    let slicer = slicer.map(|slicer| SlicerChoice {
        command: name(slicer),
        version: Some(slicer.version().to_owned()),
    });
    Job {
        slicer,
        ..job.clone()
    }
}

/// Returns what the plates among the files of a kit take.
pub fn time<'a>(
    settings: &SliceSettings,
    slicer: &Slicer,
    files: impl Iterator<Item = (&'a str, &'a [u8])>,
    watch: &Watch,
) -> Result<PrintTimeRow, SlicerError> {
    let plates = files.filter(|(file, _)| Plate::is_file_name(file));
    let row = |(name, bytes)| {
        let plate = PlateFile { name, bytes };
        let taken = slicer.estimate(&plate, settings, watch)?;
        Ok(PlateTimeRow::new(name, taken.seconds, taken.filament_g))
    };
    Ok(PrintTimeRow {
        slicer: slicer.version().to_owned(),
        has_profile: false,
        plates: plates.map(row).collect::<Result<_, SlicerError>>()?,
    })
}

/// Returns what the plates of a finished kit take by the slicer that is installed here. `None` if
/// there is none, if it is of no use for the printer, or if it fails. `begin` is called before it
/// starts on the plates.
pub fn time_kit(job: &Job, kit: &Kit, watch: &Watch, begin: impl FnOnce()) -> Option<PrintTimeRow> {
    let printer = Printer::find(&job.printer.id).ok()?;
    let material = printer.material(job.printer.material.as_deref()).ok()?;
    let settings = SliceSettings::of(&printer, material)?;
    let slicer = Slicer::find(None).ok()?;
    if !kit.files().any(|(file, _)| Plate::is_file_name(file)) {
        return None;
    }
    begin();
    time(&settings, &slicer, kit.files(), watch).ok()
}
