//! Slice: what a slicer says that the plates take, if one was ordered.

use crate::base::watch::Watch;
use crate::error::Error;
use crate::job::{Job, PartFormat, SlicerChoice};
use crate::kit::Kit;
use crate::printer::{Plate, Printer};
use crate::sheet::{PlateTimeRow, PrintTimeRow};
use crate::slicer::{PlateFile, SliceSettings, Slicer, SlicerError};

/// Finds the slicer that a job orders, before the work begins; `None` if it orders none.
pub fn find(job: &Job, printer: &Printer) -> Result<Option<Slicer>, Error> {
    let Some(choice) = &job.slicer else {
        return Ok(None);
    };
    if job.format == PartFormat::Stl {
        return Err(SlicerError::NoPlates.into());
    }
    let material = printer.material(job.printer.material.as_deref())?;
    if SliceSettings::of(printer, material).is_none() {
        let printer = printer.name.clone();
        return Err(SlicerError::NoFilament { printer }.into());
    }
    Ok(Some(Slicer::find(Some(&choice.command))?))
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
