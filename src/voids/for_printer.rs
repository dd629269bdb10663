//! The specification of a cavity for a printer.

use super::offset::CavitySpec;
use crate::printer::Printer;
use crate::shell::Keep;

/// Tolerance of a void's surface, as a share of a pixel.
const SURFACE_TOLERANCE_PIXELS: f64 = 0.5;
/// Least tolerance of the surface, mm. A finer one adds triangles that no printer can show.
const FINEST_SURFACE_TOLERANCE_MM: f64 = 0.02;
/// Least tolerance of the surface, as a share of the wall and at most in mm. The wall comes out
/// thicker by a part of it.
const SURFACE_TOLERANCE_WALLS: f64 = 0.04;
const MOST_SURFACE_TOLERANCE_MM: f64 = 0.04;
/// Least tolerance on a quadric, as a share of the wall and at most in mm. No wall depends on it.
/// The figure falls by the square of the error only, as the optimum is flat.
const QUADRIC_TOLERANCE_WALLS: f64 = 0.1;
const MOST_QUADRIC_TOLERANCE_MM: f64 = 0.1;

impl<'a> CavitySpec<'a> {
    /// Returns the specification of a cavity behind walls of `wall_mm`, at the printer's resolution
    /// and with its minimum opening.
    ///
    /// `keeps` are the regions besides the wall that stay solid.
    pub fn for_printer(printer: &Printer, wall_mm: f64, keeps: &'a [Keep]) -> Self {
        let pixel_mm = printer.pixel_x_mm.value.min(printer.pixel_y_mm.value);
        let tolerance_mm = (SURFACE_TOLERANCE_PIXELS * pixel_mm)
            .max(FINEST_SURFACE_TOLERANCE_MM)
            .max(MOST_SURFACE_TOLERANCE_MM.min(SURFACE_TOLERANCE_WALLS * wall_mm));
        let quadric_mm = MOST_QUADRIC_TOLERANCE_MM.min(QUADRIC_TOLERANCE_WALLS * wall_mm);
        Self {
            wall_mm,
            tolerance_mm,
            quadric_tolerance_mm: tolerance_mm.max(quadric_mm),
            keeps,
            min_void_mm: printer.min_opening_mm.value,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surfaces_are_as_fine_as_the_wall_asks_and_never_coarser_for_a_thick_one() {
        let printer = Printer::find("objet-connex350").unwrap();
        let tolerances = |wall_mm: f64| {
            let spec = CavitySpec::for_printer(&printer, wall_mm, &[]);
            [spec.tolerance_mm, spec.quadric_tolerance_mm]
        };
        // Half a pixel of 25.4 / 600 mm is finer than a 25th of most walls.
        let half_pixel_mm = 0.5 * 25.4 / 600.0;
        for (wall_mm, expected) in [
            (0.2, [half_pixel_mm; 2]),
            (0.8, [0.032, 0.08]),
            (1.0, [0.04, 0.1]),
            (5.0, [0.04, 0.1]),
        ] {
            let [wall, quadric] = tolerances(wall_mm);
            let off = (wall - expected[0])
                .abs()
                .max((quadric - expected[1]).abs());
            assert!(off < 1e-12, "{wall_mm}: {wall} {quadric}");
        }
    }
}
