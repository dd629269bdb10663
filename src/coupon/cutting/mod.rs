//! Coupons of a laser cutter and a sheet: squares that show the kerf, slots that show the fit, and
//! finger joints at four angles.

mod layout;
mod page;
mod set;

pub use page::CutCommands;
pub use set::{CutCouponError, CutCouponSet, JointTrial, Slot};

use crate::cutter::Dialect;
use crate::io::{encode_cut_svg, encode_dxf};
use crate::kit::{COUPON_FILE, Kit};

/// The drawings of the coupons.
pub const DRAWINGS: [&str; 2] = ["coupon.dxf", "coupon.svg"];

/// Makes the drawings of a set and their sheet, as a folder in memory.
///
/// # Errors
/// A gap is too narrow for the cut, the coupons do not fit the sheet on the bed, or the sizes
/// cannot be written.
pub fn cut_coupon_kit(
    set: &CutCouponSet,
    dialect: Dialect,
    commands: &CutCommands,
) -> Result<Kit, CutCouponError> {
    let drawing = layout::lay_out(set, dialect)?;
    let svg = encode_cut_svg(&drawing);
    let mut kit = Kit::default();
    let [dxf, picture] = DRAWINGS;
    kit.add(dxf, encode_dxf(&drawing).into_bytes());
    kit.add(
        COUPON_FILE,
        (serde_json::to_string_pretty(set)? + "\n").into_bytes(),
    );
    kit.add("coupon.html", page::page(set, &svg, commands).into_bytes());
    kit.add(picture, svg.into_bytes());
    Ok(kit)
}
