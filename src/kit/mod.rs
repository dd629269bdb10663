//! The kit as files in memory, and the folder they are written to.

mod folder;

pub use folder::{COUPON_FILE, Existing, Kit, KitError};
