//! The work on an object on a base, and other ways to make it.

use crate::base::numbers::measured;
use crate::sheet::core_kit::CoreSheet;
use crate::verify::FastenerKind;

/// The time that a screw takes, s: an estimate for a hand that has the next one ready.
const SCREW_S: f64 = 20.0;

/// Returns the rows of work and of other ways.
pub fn ways(sheet: &CoreSheet) -> [(&'static str, String); 2] {
    let masses = &sheet.masses;
    let grams = |g: f64| measured(g, "g");
    let of_kind = |kind: FastenerKind| sheet.fasteners.iter().filter(move |one| one.kind == kind);
    let screws = of_kind(FastenerKind::Screw).count() + of_kind(FastenerKind::Bolt).count();
    let minutes = measured((screws as f64 * SCREW_S / 60.0).ceil(), "min");
    let joins = sheet.units.len() + sheet.joins.len();
    [
        (
            "Work",
            format!(
                "{screws} screws at 20 s are about {minutes}, an estimate; then {joins} joins by \
                 glue. Printing takes what the slicer says"
            ),
        ),
        (
            "Other ways",
            format!(
                "printed solid {}; a skin of this wall without a base, in parts or in one print on \
                 a larger machine, {} by its area",
                grams(masses.if_solid_g),
                grams(masses.if_skin_g)
            ),
        ),
    ]
}
