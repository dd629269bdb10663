//! What a printer can make and of what: profiles as TOML data, every number with its source.
//!
//! A printer's profile inherits from one process at most (`inherits = "polyjet"`); a process inherits from nothing. What neither
//! says is an error for the numbers every print needs, and simply unset for the build volume.

mod error;
mod layer;
mod library;
mod machine;
mod material;
mod profile;
mod quantity;
mod resolve;
mod sourced;
mod wall;

pub use error::{Fault, Faults, Problem, ProfileError};
pub use machine::{Grid, PrintPose, Printer, Support, Tolerance};
pub use material::{Material, MaterialError};
pub use quantity::Quantity;
pub use sourced::{Sourced, Sure};
pub use wall::{WallChoice, WallError};
