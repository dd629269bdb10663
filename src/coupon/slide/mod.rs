//! The slide coupon: sleeves and arcs with stepped clearances, and a plunger to try in each.
//!
//! A sleeve is the mouth of a telescope's shell: a bore, and a lip that stops a flange. The plunger
//! is the shell that slides in it. All sleeves take the same plunger, so that the clearance is the
//! only difference. Arcs are bent as shells are: they slide along their own circle.

mod bodies;
mod page;
mod set;

pub use page::SlideCommands;
pub use set::{Sleeve, SlideSet};

use super::CouponError;
use crate::io::stl;
use crate::kit::{COUPON_FILE, Kit};

/// Makes the parts of a slide coupon and their sheet, as a folder in memory.
///
/// # Errors
/// A body cannot be made.
pub fn slide_kit(set: &SlideSet, commands: &SlideCommands) -> Result<Kit, CouponError> {
    let coupons = bodies::make_slides(set)?;
    let mut kit = Kit::default();
    for coupon in &coupons {
        kit.add(coupon.file, stl::encode(coupon.solid.mesh(), coupon.file));
    }
    let sizes = serde_json::to_string_pretty(set)? + "\n";
    kit.add(COUPON_FILE, sizes.into_bytes());
    let page = page::page(set, &coupons, commands);
    kit.add("coupon.html", page.into_bytes());
    Ok(kit)
}
