//! Coupons: small parts that a shop prints, weighs and tries, so that its profile says what its own
//! machine does.

mod bodies;
mod sheet;
mod sizes;

pub use sizes::{CouponSet, Hole};

use crate::io::stl;
use crate::kit::{COUPON_FILE, Kit};
use crate::mesh::{ClipError, Solid};

/// Why coupons cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CouponError {
    /// A body could not be made.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// The sizes cannot be put into JSON.
    #[error("the sizes of the coupons cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// One coupon: its file and its body, resting on z = 0, mm.
#[derive(Debug, Clone)]
pub struct Coupon {
    /// The name of its file.
    pub file: &'static str,
    /// What it is for, in a few words.
    pub purpose: &'static str,
    /// How many are printed.
    pub count: usize,
    /// Its body.
    pub solid: Solid,
}

/// The coupons of a set and their sheet, as a folder in memory.
pub fn coupon_kit(set: &CouponSet) -> Result<Kit, CouponError> {
    let coupons = bodies::coupons(set)?;
    let mut kit = Kit::default();
    for coupon in &coupons {
        kit.add(coupon.file, stl::encode(coupon.solid.mesh(), coupon.file));
    }
    kit.add(
        COUPON_FILE,
        (serde_json::to_string_pretty(set)? + "\n").into_bytes(),
    );
    kit.add("coupon.html", sheet::page(set, &coupons).into_bytes());
    Ok(kit)
}
