//! The faults of a file of layer images.

use std::path::PathBuf;

use crate::base::watch::Cancelled;

/// A reason why layer images cannot be weighed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LayersError {
    /// The archive cannot be unpacked.
    #[error("{part}: {reason}; remedy: export the file again")]
    Package {
        /// The part of the archive.
        part: String,
        /// The fault.
        reason: String,
    },
    /// A setting is missing, or is no number that makes sense.
    #[error("{part} gives no usable `{key}`; remedy: export the file again")]
    Setting {
        /// The part of the archive.
        part: String,
        /// The key.
        key: String,
    },
    /// An image is none in grey.
    #[error("{part} is no image in grey: {reason}; remedy: export the file again")]
    Image {
        /// The image.
        part: String,
        /// The fault.
        reason: String,
    },
    /// An image has another size than the display.
    #[error(
        "{part} has {} × {} pixels, and {} × {} are stated; remedy: export the file again",
        found[0], found[1], wanted[0], wanted[1]
    )]
    Size {
        /// The image.
        part: String,
        /// Its columns and rows.
        found: [u32; 2],
        /// Those of the display.
        wanted: [u32; 2],
    },
    /// There are no images.
    #[error("it holds no layer; remedy: slice the plate again")]
    NoLayer,
    /// The numbers of the layers have a gap, or are not as many as stated.
    #[error("layer {layer} is missing, or is there twice; remedy: export the file again")]
    MissingLayer {
        /// Its number in the file.
        layer: usize,
    },
    /// There are more layers than any print has.
    #[error("it holds more than {most} layers; remedy: slice in thicker layers")]
    TooMany {
        /// The greatest number.
        most: usize,
    },
    /// A file cannot be read.
    #[error("{part} cannot be read; remedy: copy the whole folder again")]
    Unreadable {
        /// The file.
        part: String,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// The run was stopped.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A file of layer images that cannot be weighed.
#[derive(Debug, thiserror::Error)]
#[error("{}: {source}", path.display())]
pub struct ReadLayersError {
    /// The file.
    pub path: PathBuf,
    /// The fault.
    pub source: LayersError,
}

/// Returns the fault of a part of an archive.
pub(super) fn package_fault(part: &str, reason: impl ToString) -> LayersError {
    LayersError::Package {
        part: part.to_owned(),
        reason: reason.to_string(),
    }
}

/// Returns the fault of a setting.
pub(super) fn setting_fault(part: &str, key: &str) -> LayersError {
    LayersError::Setting {
        part: part.to_owned(),
        key: key.to_owned(),
    }
}
