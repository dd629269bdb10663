//! The kit as files in memory, and the folder they are written to.

mod error;
mod folder;
mod staging;

pub use error::KitError;
pub use folder::{CELLS_FILE, COUPON_FILE, Existing, Kit, KitWriter, PLANS_FILE, SLICES_FILE};
