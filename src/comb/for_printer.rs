//! The order of a model of cells for a printer.

use super::build::CombOrder;
use crate::printer::{Printer, Undrainable};
use crate::voids::CavitySpec;

impl CombOrder {
    /// Returns the order for walls and a skin of this thickness, with openings of the least width
    /// that the printer's process empties.
    ///
    /// # Errors
    /// No hole empties a void of this process.
    pub fn for_printer(printer: &Printer, wall_mm: f64) -> Result<Self, Undrainable> {
        let need = printer.drain_need(None)?;
        Ok(Self {
            wall_mm,
            skin_mm: wall_mm,
            tolerance_mm: CavitySpec::for_printer(printer, wall_mm, &[]).tolerance_mm,
            opening_mm: need.diameter_mm,
            holes: need.count,
        })
    }

    /// Returns the least size of a cube whose sides hold an opening, mm.
    pub fn least_size_mm(&self) -> f64 {
        self.wall_mm + 2.0 * self.room_mm()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn openings_are_those_of_the_process_and_filament_has_none() {
        let of = |id: &str| CombOrder::for_printer(&Printer::find(id).unwrap(), 1.0);
        let resin = of("formlabs-form4").unwrap();
        assert_eq!((resin.opening_mm, resin.holes), (3.5, 2));
        let powder = of("formlabs-fuse1").unwrap();
        assert_eq!((powder.opening_mm, powder.holes), (5.0, 1));
        // An opening of 5 mm, its corners and a margin, and a wall.
        assert!(
            (powder.least_size_mm() - 6.54).abs() < 0.02,
            "{}",
            powder.least_size_mm()
        );
        assert_eq!(of("prusa-mk4"), Err(Undrainable::Filament));
        assert_eq!(of("objet-connex350"), Err(Undrainable::Gel));
    }
}
