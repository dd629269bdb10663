//! Make: the parts of a kit, written, read back and corrected until they meet the goal.

mod packages;
mod parts;
mod write;

pub use packages::{File, packages, repack};
pub use parts::make;
pub use write::write;
