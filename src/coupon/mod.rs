//! Coupons: small parts that a shop makes, measures and tries in order to calibrate the profile of
//! its printer or its laser cutter.

mod bodies;
mod cutting;
mod density;
mod sheet;
mod sizes;
mod slide;

pub use bodies::Coupon;
pub use cutting::{
    CutCommands, CutCouponError, CutCouponSet, DRAWINGS, JointTrial, Slot, cut_coupon_kit,
};
pub use density::{
    Block, DensityCommands, DensitySet, NoInfill, WeighError, WeighedInfill, density_kit,
};
pub use sheet::Commands;
pub use sizes::{CouponSet, Hole};
pub use slide::{Sleeve, SlideCommands, SlideSet, slide_kit};

use crate::io::stl;
use crate::io::threemf::PackageError;
use crate::kit::{COUPON_FILE, Kit};
use crate::mesh::ClipError;

/// An error in making coupons.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CouponError {
    /// A body could not be made.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// A plate could not be put together.
    #[error(transparent)]
    Package(#[from] PackageError),
    /// The sizes cannot be written as JSON.
    #[error("the sizes of the coupons cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Makes the coupons of a set and their sheet, as a folder in memory.
pub fn coupon_kit(set: &CouponSet, commands: &Commands) -> Result<Kit, CouponError> {
    let coupons = bodies::make_coupons(set)?;
    let mut kit = Kit::default();
    for coupon in &coupons {
        kit.add(coupon.file, stl::encode(coupon.solid.mesh(), coupon.file));
    }
    kit.add(
        COUPON_FILE,
        (serde_json::to_string_pretty(set)? + "\n").into_bytes(),
    );
    kit.add(
        "coupon.html",
        sheet::page(set, &coupons, commands).into_bytes(),
    );
    Ok(kit)
}
