//! Make: the parts of a kit, written, read back and corrected until they meet the goal.

mod packages;
mod parts;
mod sparse;
mod write;

pub use packages::{Arrangement, File, Packages, packages, plates, print_settings, repack};
pub use parts::make;
pub use write::{write, write_free_of_folds};
