//! The density coupon of a filament printer: round blocks of every infill, to be weighed.
//!
//! Walls, the ends of lines at them and solid print weigh too. So each infill has a small and a
//! large block without lids. What grows with their area is the core's; what grows with their girth
//! is the rest. Walls stay, since lines that end in the air come off.
//!
//! They are round so that their walls cross the waves of an infill in all directions. Square
//! blocks have walls at one phase of a wave, and gave densities 3 to 9 % off.

mod page;
mod plates;
mod set;
mod weighed;

pub use page::DensityCommands;
pub use set::{Block, DensitySet, NoInfill};
pub use weighed::{WeighError, WeighedInfill};

use super::CouponError;
use crate::kit::{COUPON_FILE, Kit};
use crate::printer::Printer;

/// Makes the plates of a density coupon and their sheet, as a folder in memory.
///
/// # Errors
/// A body or a package cannot be made.
pub fn density_kit(
    set: &DensitySet,
    printer: &Printer,
    commands: &DensityCommands,
) -> Result<Kit, CouponError> {
    let plates = plates::plates(set, printer)?;
    let mut kit = Kit::default();
    for plate in &plates {
        kit.add(&plate.file, plate.bytes.clone());
    }
    kit.add(
        COUPON_FILE,
        (serde_json::to_string_pretty(set)? + "\n").into_bytes(),
    );
    let page = page::page(set, &plates, commands);
    kit.add("coupon.html", page.into_bytes());
    Ok(kit)
}
