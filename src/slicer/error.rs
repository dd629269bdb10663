//! The reasons why a slicer gives no figures.

use crate::base::setting::{Key, Setting};
use crate::base::watch::Cancelled;
use crate::io::gcode::GcodeError;
use crate::io::threemf::{PackageError, ThreeMfError};

/// The packages of Debian that have a slicer.
const PACKAGE: &str = "apt-get install --no-install-recommends prusa-slicer, or cura-engine";

/// A reason why a slicer gives no figures.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SlicerError {
    /// The program is not there, or cannot be started.
    #[error(
        "the slicer {command} cannot be started; remedy: install one (on Debian: {PACKAGE}), or name another with `{}`",
        Setting::open(Key::Slicer)
    )]
    Absent {
        /// The command asked for.
        command: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The program is no slicer that is understood.
    #[error(
        "{command} does not name itself as PrusaSlicer, SuperSlicer, CuraEngine or OrcaSlicer; remedy: name one of these with `{}`",
        Setting::open(Key::Slicer)
    )]
    Unknown {
        /// The command asked for.
        command: String,
    },
    /// Cura's list of settings is not there.
    #[error(
        "CuraEngine needs Cura's list of settings (fdmprinter.def.json), which is not here; remedy: \
         install Cura (on Debian: apt-get install cura), or name the folder of that file in \
         CURA_ENGINE_SEARCH_PATH"
    )]
    NoDefinitions,
    /// A profile names a setting that Cura does not have.
    #[error("Cura has no setting {key}; remedy: leave it out of the profile")]
    UnknownSetting {
        /// The setting.
        key: String,
    },
    /// Cura has no such pattern of infill.
    #[error(
        "Cura has no infill like {pattern}; remedy: state another infill_pattern in the printer's \
         profile, such as gyroid"
    )]
    NoPattern {
        /// The pattern.
        pattern: String,
    },
    /// The plate cannot be read.
    #[error("{plate} cannot be taken apart")]
    Plate {
        /// The plate.
        plate: String,
        /// The fault.
        source: Box<ThreeMfError>,
    },
    /// The plate cannot be put into the words of this slicer.
    #[error("{plate} cannot be put into the words of this slicer")]
    Reworded {
        /// The plate.
        plate: String,
        /// The fault.
        source: Box<PackageError>,
    },
    /// The printer is not one whose plates this slicer slices.
    #[error(
        "{printer} prints no filament on a plate of known size, and the slicer knows only such; remedy: leave out `{}`",
        Setting::open(Key::Slicer)
    )]
    NoFilament {
        /// The name of the printer.
        printer: String,
    },
    /// The kit has no plates to slice.
    #[error(
        "STL files alone have no plates to slice; remedy: leave out `{}` or `{}`",
        Setting::open(Key::Slicer),
        Setting::open(Key::Format)
    )]
    NoPlates,
    /// The slicer wrote no toolpaths, whatever its exit code.
    #[error("{version} wrote no toolpaths for {plate}: {said}")]
    NoToolpaths {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
        /// The last line that it said.
        said: String,
    },
    /// The slicer left a layer of a part empty.
    #[error("{version} cannot print a layer of {plate}: {said}")]
    EmptyLayer {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
        /// What it said.
        said: String,
    },
    /// The slicer took another value for one that it does not know.
    #[error(
        "{version} changed a setting of {plate}: {said}; remedy: export the profile from this slicer anew, or leave it out"
    )]
    Substituted {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
        /// What it said.
        said: String,
    },
    /// The slicer took too long.
    #[error("{version} was stopped after {limit_s} s on {plate}; remedy: slice the plate by hand")]
    Slow {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
        /// The limit, s.
        limit_s: u64,
    },
    /// The slicer asked for too much memory.
    #[error(
        "{version} asked for more than {limit_gib} GiB of memory for {plate}; remedy: slice the plate by hand"
    )]
    Large {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
        /// The limit, GiB.
        limit_gib: u64,
    },
    /// The toolpaths cannot be read.
    #[error("the toolpaths of {plate} cannot be read")]
    Toolpaths {
        /// The plate.
        plate: String,
        /// The fault and its place.
        source: GcodeError,
    },
    /// The toolpaths name no print time.
    #[error("{version} names no print time for {plate}")]
    NoTime {
        /// The slicer.
        version: String,
        /// The plate.
        plate: String,
    },
    /// The folder in which it runs cannot be used.
    #[error("the folder for temporary files cannot be used; remedy: free some room there")]
    Folder(#[source] std::io::Error),
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
