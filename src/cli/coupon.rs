//! `equipoise coupon`: coupons to print, weigh and try, with their sheet.

use std::io::Write;
use std::path::PathBuf;

use super::args::CouponArgs;
use super::exit::Exit;
use super::flags::commands_on_coupon_sheet;
use super::signals::Stop;
use super::voice::Voice;
use crate::base::watch::Watch;
use crate::coupon::{CouponError, CouponSet, coupon_kit};
use crate::kit::{Existing, KitError};
use crate::printer::{MaterialError, Printer, ProfileError};

/// A reason why no coupons were written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CouponCommandError {
    /// The printer's profile cannot be used.
    #[error(transparent)]
    Profile(#[from] ProfileError),
    /// The printer has no such material.
    #[error(transparent)]
    Material(#[from] MaterialError),
    /// The coupons cannot be made.
    #[error(transparent)]
    Coupon(#[from] CouponError),
    /// The coupons cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// The sizes cannot be put into JSON.
    #[error("the sizes cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
}

/// Writes the coupons of a printer, unless `stop` is pressed before; says on `out` where.
pub fn coupon(
    args: &CouponArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, CouponCommandError> {
    let printer = Printer::find(&args.printer)?;
    let set = CouponSet::of(&printer, printer.material(args.material.as_deref())?);
    let target = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-coupon", printer.id)));
    let existing = if args.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let watch = Watch::silent_until(stop.flag());
    let kit = coupon_kit(&set, &commands_on_coupon_sheet(&set))?;
    let written = kit.write_watched(&target, existing, &watch);
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    written?;
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&set)?)?;
    } else if !voice.manner.quiet {
        writeln!(
            out,
            "coupons for {} ({}); the sheet is {}",
            set.printer_name,
            set.material_name,
            target.join("coupon.html").display()
        )?;
    }
    Ok(Exit::Kept)
}
