//! The time and the filament of a plate, as a slicer states them.

use std::fs::File;
use std::io::{BufReader, Read};

use super::error::SlicerError;
use super::program::{Family, Slicer};
use super::run::{PlateFile, Scratch, Work};
use super::settings::SliceSettings;
use super::{cura, orca, prusa};
use crate::base::watch::Watch;
use crate::io::gcode::{Options, Toolpath, read_text};

/// What a slicer says that a plate takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Time of the print, s.
    pub seconds: f64,
    /// Filament of all that is printed, supports included, g; `None` if it is not stated.
    pub filament_g: Option<f64>,
}

/// A sliced plate.
#[derive(Debug, Clone, PartialEq)]
pub struct SlicedPlate {
    /// Its toolpaths, as the slicer wrote them.
    pub bytes: Vec<u8>,
    /// The material that they lay down.
    pub read: Toolpath,
    /// Their time and filament, as the slicer states them.
    pub estimate: Estimate,
}

impl Slicer {
    /// Slices a plate, and returns its toolpaths with what they take.
    ///
    /// # Errors
    /// As for [`Slicer::estimate`].
    pub fn toolpaths(
        &self,
        plate: &PlateFile,
        settings: &SliceSettings,
        watch: &Watch,
    ) -> Result<SlicedPlate, SlicerError> {
        let mut written = self.slice(plate, settings, watch)?;
        let mut bytes = Vec::new();
        written
            .read_to_end(&mut bytes)
            .map_err(SlicerError::Folder)?;
        let read = read_plate(plate, bytes.as_slice(), watch)?;
        let estimate = self.estimate_of(plate, &read, settings)?;
        Ok(SlicedPlate {
            bytes,
            read,
            estimate,
        })
    }

    /// Slices a plate, and returns what it takes.
    ///
    /// # Errors
    /// The slicer writes no toolpaths, leaves a layer empty or takes too long, or the watch was
    /// stopped.
    pub fn estimate(
        &self,
        plate: &PlateFile,
        settings: &SliceSettings,
        watch: &Watch,
    ) -> Result<Estimate, SlicerError> {
        let written = self.slice(plate, settings, watch)?;
        let read = read_plate(plate, written, watch)?;
        self.estimate_of(plate, &read, settings)
    }

    /// Slices a plate in a folder of its own.
    fn slice(
        &self,
        plate: &PlateFile,
        settings: &SliceSettings,
        watch: &Watch,
    ) -> Result<File, SlicerError> {
        let folder = Scratch::new().map_err(SlicerError::Folder)?;
        let work = Work {
            slicer: self,
            plate,
            settings,
            folder: folder.path(),
        };
        match self.family() {
            Family::Prusa => prusa::slice(&work, watch),
            Family::Orca => orca::slice(&work, watch),
            Family::Cura => cura::slice(&work, watch),
        }
    }

    fn estimate_of(
        &self,
        plate: &PlateFile,
        read: &Toolpath,
        settings: &SliceSettings,
    ) -> Result<Estimate, SlicerError> {
        let facts = &read.facts;
        let seconds = facts.print_time_s.ok_or_else(|| SlicerError::NoTime {
            version: self.version().to_owned(),
            plate: plate.name.to_owned(),
        })?;
        let stated_g: f64 = facts.filament_used_g.iter().sum();
        // Cura states lengths.
        let length_mm: f64 = facts.filament_used_mm.iter().sum();
        let filament_g = match stated_g > 0.0 {
            true => stated_g,
            false => settings.filament_g(length_mm),
        };
        Ok(Estimate {
            seconds,
            filament_g: (filament_g > 0.0).then_some(filament_g),
        })
    }
}

/// Reads the toolpaths of a plate.
fn read_plate(
    plate: &PlateFile,
    written: impl Read,
    watch: &Watch,
) -> Result<Toolpath, SlicerError> {
    let read = read_text(BufReader::new(written), &Options::default(), watch);
    read.map_err(|source| SlicerError::Toolpaths {
        plate: plate.name.to_owned(),
        source,
    })
}
