//! The cavity that a printer can make of a model.

use super::CavitySpec;
use crate::printer::Printer;
use crate::shell::Keep;

/// The surface of a void may lie this share of a pixel from the true one.
const SURFACE_TOLERANCE_PIXELS: f64 = 0.5;
/// Least tolerance of the surface, mm: below it triangles grow without any printer showing it.
const FINEST_SURFACE_TOLERANCE_MM: f64 = 0.02;

impl<'a> CavitySpec<'a> {
    /// Returns the specification of a cavity behind walls of `wall_mm`, in the printer's
    /// resolution and with its least opening.
    ///
    /// `keeps` are the places around which more than the wall stays solid.
    pub fn for_printer(printer: &Printer, wall_mm: f64, keeps: &'a [Keep]) -> Self {
        let pixel_mm = printer.pixel_x_mm.value.min(printer.pixel_y_mm.value);
        Self {
            wall_mm,
            tolerance_mm: (SURFACE_TOLERANCE_PIXELS * pixel_mm).max(FINEST_SURFACE_TOLERANCE_MM),
            keeps,
            min_void_mm: printer.min_opening_mm.value,
        }
    }
}
