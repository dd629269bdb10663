//! The reasons why a kit is not sliced.

use std::path::PathBuf;

use super::dither::DitherError;
use crate::base::watch::Cancelled;
use crate::io::layers::ReadLayersError;
use crate::io::threemf::ThreeMfError;
use crate::job::JobError;
use crate::kit::KitError;
use crate::printer::{MaterialError, ProfileError};
use crate::slicer::SlicerError;

/// A reason why a kit is not sliced.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SliceError {
    /// The folder holds no job.
    #[error("{} is no kit: it has no job.toml; remedy: name the folder of a kit", path.display())]
    NoKit {
        /// The folder.
        path: PathBuf,
    },
    /// The kit is a telescope's.
    #[error(
        "this kit is a telescope's, which is not sliced from here yet; remedy: load its plates into the slicer"
    )]
    Telescope,
    /// The kit is that of an object on a base.
    #[error(
        "this kit is that of an object on a base, which is not sliced from here yet; remedy: load its plates into the slicer"
    )]
    Core,
    /// The job of the kit cannot be read.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The printer prints no filament.
    #[error(
        "{printer} prints no filament on a plate of known size; remedy: slice it as layer images (a png-stack), or prepare the kit for a filament printer"
    )]
    NoFilament {
        /// The name of the printer.
        printer: String,
    },
    /// The printer lays lines.
    #[error(
        "{printer} lays lines and shows no pixels; remedy: slice it as G-code, or prepare the kit for a printer of pixels"
    )]
    NoPixels {
        /// The name of the printer.
        printer: String,
    },
    /// An SL1 without the configuration of its machine.
    #[error(
        "an SL1 needs the display and the exposure of its machine; remedy: export the configuration from the slicer as .ini and give it as the profile, or ask for a png-stack"
    )]
    NoDisplay,
    /// The configuration of a machine lacks a setting.
    #[error("{} gives no usable `{key}`; remedy: export the configuration of a resin printer", path.display())]
    NoSetting {
        /// The file.
        path: PathBuf,
        /// The key.
        key: String,
    },
    /// The configuration exposes other layers.
    #[error(
        "the profile exposes layers of {exposed_mm} mm, and the kit's are {layer_mm} mm; remedy: export the configuration for layers of {layer_mm} mm"
    )]
    OtherLayers {
        /// The height of the profile's layers, mm.
        exposed_mm: f64,
        /// The height of the kit's layers, mm.
        layer_mm: f64,
    },
    /// A plate does not lie on the display.
    #[error(
        "{plate} reaches beyond the display of the profile; remedy: give the configuration of the kit's own printer"
    )]
    BeyondDisplay {
        /// The plate.
        plate: String,
    },
    /// A plate is no readable 3MF.
    #[error(transparent)]
    Plate(#[from] ThreeMfError),
    /// An image cannot be written.
    #[error("an image of a layer cannot be written")]
    Image(#[from] png::EncodingError),
    /// An archive cannot be written.
    #[error("the archive of the layers cannot be written")]
    Archive(#[from] zip::result::ZipError),
    /// The kit has no plates.
    #[error(
        "{} has no plates to slice; remedy: prepare it with parts as 3MF", path.display()
    )]
    NoPlates {
        /// The folder.
        path: PathBuf,
    },
    /// A file cannot be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A profile of the slicer is no text of settings.
    #[error(
        "{} is no profile of a slicer: {reason}; remedy: export the configuration as .ini there",
        path.display()
    )]
    NoProfile {
        /// The file.
        path: PathBuf,
        /// The fault.
        reason: String,
    },
    /// The slicer fails.
    #[error(transparent)]
    Slicer(#[from] SlicerError),
    /// A model cannot be printed in two materials as asked.
    #[error(transparent)]
    Dither(#[from] DitherError),
    /// The images that were written cannot be read.
    #[error(transparent)]
    Layers(#[from] ReadLayersError),
    /// The folder cannot be written.
    #[error(transparent)]
    Folder(#[from] KitError),
    /// The list of the slices cannot be written as JSON.
    #[error("the list of the slices cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
