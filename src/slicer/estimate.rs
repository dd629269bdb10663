//! The time and the filament of a plate, as a slicer states them.

use std::io::BufReader;

use super::error::SlicerError;
use super::program::Slicer;
use super::run::PlateFile;
use super::settings::SliceSettings;
use crate::base::watch::Watch;
use crate::io::gcode::{Options, read_text};

/// What a slicer says that a plate takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// Time of the print, s.
    pub seconds: f64,
    /// Filament of all that is printed, supports included, g; `None` if it is not stated.
    pub filament_g: Option<f64>,
}

impl Slicer {
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
        let read = read_text(BufReader::new(written), &Options::default(), watch);
        let toolpath = read.map_err(|source| SlicerError::Toolpaths {
            plate: plate.name.to_owned(),
            source,
        })?;
        let facts = &toolpath.facts;
        let seconds = facts.print_time_s.ok_or_else(|| SlicerError::NoTime {
            version: self.version().to_owned(),
            plate: plate.name.to_owned(),
        })?;
        let filament_g: f64 = facts.filament_used_g.iter().sum();
        Ok(Estimate {
            seconds,
            filament_g: (filament_g > 0.0).then_some(filament_g),
        })
    }
}
