//! Slicers of other makers: finding one, and asking it what a plate takes.
//!
//! * `program` finds a slicer and asks for its version.
//! * `settings` words a printer's profile as a slicer's settings.
//! * `run` runs it in a folder of its own, with limits of time and memory.
//! * `estimate` reads the time and the filament from the toolpaths.

mod error;
mod estimate;
mod program;
mod run;
mod settings;

pub use error::SlicerError;
pub use estimate::{Estimate, SlicedPlate};
pub use program::Slicer;
pub use run::{PlateFile, Scratch};
pub use settings::SliceSettings;
