//! The specification of a cavity for a printer.

use super::offset::CavitySpec;
use crate::printer::Printer;
use crate::shell::Keep;

/// Tolerance of a void's surface, as a share of a pixel.
const SURFACE_TOLERANCE_PIXELS: f64 = 0.5;
/// Least tolerance of the surface, mm. A finer one adds triangles that no printer can show.
const FINEST_SURFACE_TOLERANCE_MM: f64 = 0.02;

impl<'a> CavitySpec<'a> {
    /// Returns the specification of a cavity behind walls of `wall_mm`, at the printer's resolution
    /// and with its minimum opening.
    ///
    /// `keeps` are the regions besides the wall that stay solid.
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
