//! `equipoise coupon`: coupons to print, weigh and try, with their sheet.

use std::io::Write;
use std::path::PathBuf;

use super::args::CouponArgs;
use super::exit::Exit;
use super::flags::{
    command_for_coupons, commands_on_coupon_sheet, commands_on_cut_coupon_sheet,
    commands_on_density_sheet, commands_on_slide_sheet,
};
use super::signals::Stop;
use super::voice::Voice;
use crate::base::watch::Watch;
use crate::coupon::{
    CouponError, CouponSet, CutCouponError, CutCouponSet, DensitySet, NoInfill, SlideSet,
    coupon_kit, cut_coupon_kit, density_kit, slide_kit,
};
use crate::cutter::{self, Cutter, StockSheet};
use crate::kit::{Existing, Kit, KitError};
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
    /// The printer has no infill to weigh.
    #[error(
        "{source}; remedy: weigh its solid coupons (`{}`)",
        command_for_coupons(id)
    )]
    NoInfill {
        /// The printer's id.
        id: String,
        /// The reason.
        source: NoInfill,
    },
    /// The profile of the cutter or the sheet cannot be used.
    #[error(transparent)]
    CutProfile(#[from] cutter::ProfileError),
    /// The coupons of the cutter cannot be made.
    #[error(transparent)]
    CutCoupon(#[from] CutCouponError),
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
    let made = match (&args.cutter, &args.sheet, &args.printer) {
        (Some(cutter), Some(sheet), _) => of_cutter(cutter, sheet)?,
        (_, _, Some(printer)) if args.density => of_infill(printer, args)?,
        (_, _, Some(printer)) if args.slide => of_slide(printer, args)?,
        (_, _, printer) => of_printer(printer.as_deref().unwrap_or_default(), args)?,
    };
    let target = args
        .out
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-coupon", made.id)));
    let existing = if args.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    let watch = Watch::silent_until(stop.flag());
    let written = made.kit.write_watched(&target, existing, &watch);
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    written?;
    if voice.json {
        writeln!(out, "{}", made.sizes)?;
    } else if !voice.manner.quiet {
        let sheet = target.join("coupon.html");
        writeln!(
            out,
            "coupons for {}; the sheet is {}",
            made.what,
            sheet.display()
        )?;
    }
    Ok(Exit::Kept)
}

/// Coupons that were made.
struct Made {
    /// The machine's id.
    id: String,
    /// The machine and its material, in words.
    what: String,
    /// The sizes as JSON.
    sizes: String,
    kit: Kit,
}

fn of_printer(printer: &str, args: &CouponArgs) -> Result<Made, CouponCommandError> {
    let printer = Printer::find(printer)?;
    let set = CouponSet::of(&printer, printer.material(args.material.as_deref())?);
    Ok(Made {
        kit: coupon_kit(&set, &commands_on_coupon_sheet(&set))?,
        what: format!("{} ({})", set.printer_name, set.material_name),
        sizes: serde_json::to_string_pretty(&set)?,
        id: printer.id,
    })
}

fn of_infill(printer: &str, args: &CouponArgs) -> Result<Made, CouponCommandError> {
    let printer = Printer::find(printer)?;
    let material = printer.material(args.material.as_deref())?;
    let no_infill = |source| CouponCommandError::NoInfill {
        id: printer.id.clone(),
        source,
    };
    let set = DensitySet::of(&printer, material).map_err(no_infill)?;
    Ok(Made {
        kit: density_kit(&set, &printer, &commands_on_density_sheet(&set))?,
        what: format!("the infill of {} ({})", set.printer_name, set.material_name),
        sizes: serde_json::to_string_pretty(&set)?,
        id: format!("{}-density", printer.id),
    })
}

fn of_slide(printer: &str, args: &CouponArgs) -> Result<Made, CouponCommandError> {
    let printer = Printer::find(printer)?;
    let set = SlideSet::of(&printer, printer.material(args.material.as_deref())?);
    Ok(Made {
        kit: slide_kit(&set, &commands_on_slide_sheet(&set))?,
        what: format!("shells of {} ({})", set.printer_name, set.material_name),
        sizes: serde_json::to_string_pretty(&set)?,
        id: format!("{}-slide", printer.id),
    })
}

fn of_cutter(cutter: &str, sheet: &str) -> Result<Made, CouponCommandError> {
    let (cutter, sheet) = (Cutter::find(cutter)?, StockSheet::find(sheet)?);
    let set = CutCouponSet::of(&cutter, &sheet)?;
    Ok(Made {
        kit: cut_coupon_kit(&set, cutter.dialect, &commands_on_cut_coupon_sheet(&set))?,
        what: format!("{} ({})", set.cutter_name, set.sheet_name),
        sizes: serde_json::to_string_pretty(&set)?,
        id: cutter.id,
    })
}
