//! The work on an object on a base, and other ways to make it.

use crate::base::numbers::measured;
use crate::base::units::show_minutes;
use crate::sheet::core_kit::CoreSheet;
use crate::verify::FastenerKind;

/// The time that a screw takes, s: an estimate for a hand that has the next one ready.
const SCREW_S: f64 = 20.0;
/// Seconds in a minute, and minutes to which long times are rounded up.
const S_PER_MIN: f64 = 60.0;
const STEP_MIN: f64 = 5.0;

/// Returns the rows of work and of other ways.
pub fn ways(sheet: &CoreSheet) -> Vec<(&'static str, String)> {
    let masses = &sheet.masses;
    let estimates = &sheet.estimates;
    let of_kind = |kind: FastenerKind| sheet.fasteners.iter().filter(move |one| one.kind == kind);
    let screws = of_kind(FastenerKind::Screw).count() + of_kind(FastenerKind::Bolt).count();
    let minutes = measured((screws as f64 * SCREW_S / S_PER_MIN).ceil(), "min");
    let joins = sheet.units.len() + sheet.joins.len();
    let printing = match estimates.print_s {
        Some(time_s) => format!(
            "Printing takes {} by the printer's profile, an estimate without support; a slicer \
             knows better",
            about(time_s)
        ),
        None => "Printing takes what the slicer says: the printer's profile has no flow".to_owned(),
    };
    let cutting = match estimates.cut_s {
        Some(time_s) => format!("Cutting takes {}, an estimate", about(time_s)),
        None => "The cutter's profile has no speed, so that cutting has no estimate".to_owned(),
    };
    let other = |mass_g: f64, time_s: Option<f64>| match time_s {
        Some(time_s) => format!("{} and {}", measured(mass_g, "g"), about(time_s)),
        None => measured(mass_g, "g"),
    };
    let mut rows = vec![
        (
            "Work",
            format!(
                "{screws} screws at 20 s are about {minutes}, an estimate; then {joins} joins by \
                 glue. {printing}. {cutting}"
            ),
        ),
        (
            "Other ways",
            format!(
                "printed solid {}; a skin of this wall without a base, in parts or in one print on \
                 a larger machine, {} by its area",
                other(masses.if_solid_g, estimates.if_solid_s),
                other(masses.if_skin_g, estimates.if_skin_s)
            ),
        ),
    ];
    if let Some(price) = estimates.sheets_price {
        let words = format!(
            "the sheets {price:.2} in the shop's currency, by their profile; filament, machines \
             and work by your own rates"
        );
        rows.push(("Price", words));
    }
    rows
}

/// Words an estimated time, rounded up to five minutes.
fn about(time_s: f64) -> String {
    let minutes = (time_s / S_PER_MIN / STEP_MIN).ceil() * STEP_MIN;
    format!("about {}", show_minutes(minutes as u32))
}
