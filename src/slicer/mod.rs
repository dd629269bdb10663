//! Slicers of other makers: finding one, and asking it what a plate takes.
//!
//! * `program` finds a slicer and asks for its version and its family.
//! * `settings` holds what a slicer must know of a printer's profile.
//! * `run` runs it in a folder of its own, with limits of time and memory.
//! * `prusa`, `orca` and `cura` have a plate sliced by a slicer of their family.
//! * `reword` puts a plate into the words of the slicer that is to slice it.
//! * `estimate` reads the time and the filament from the toolpaths.

mod cura;
mod error;
mod estimate;
mod orca;
mod program;
mod prusa;
mod reword;
mod run;
mod settings;

pub use error::SlicerError;
pub use estimate::{Estimate, SlicedPlate};
pub use program::Slicer;
pub use run::{PlateFile, Scratch};
pub use settings::SliceSettings;
