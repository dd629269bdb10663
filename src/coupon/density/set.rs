//! The blocks of a density coupon, computed from the printer's profile alone.

use serde::Serialize;

use crate::base::units::MM3_PER_CM3;
use crate::printer::{InfillPattern, Material, Printer, Quantity};

/// Infills of the blocks, per cent of solid print: those of the shipped table.
const PERCENTS: [f64; 7] = [10.0, 15.0, 20.0, 30.0, 50.0, 70.0, 90.0];
/// Solid print, per cent.
pub(super) const SOLID_PERCENT: f64 = 100.0;
/// Diameters of the small and the large blocks, mm. A balance of 0.01 g is then right to 0.4 % of
/// an infill of 15 %. The set weighs some 120 g.
const DIAMETERS_MM: [f64; 2] = [20.0, 40.0];
/// Height of the blocks, mm: two waves or more of an infill of 15 % on top of each other.
const HEIGHT_MM: f64 = 20.0;
/// Sides of the polygons that stand for circles.
pub(super) const SIDES: u32 = 96;

/// A printer that prints solid.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{printer} prints solid: it has no infill to weigh")]
pub struct NoInfill {
    /// The name of the printer.
    pub printer: String,
}

/// A block of one infill.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Block {
    /// Its name, as slicers show it: `15percent-large`.
    pub name: String,
    /// Its infill, per cent of solid print.
    pub percent: f64,
    /// Its diameter, mm.
    pub diameter_mm: f64,
    /// Its mass by the profile, g.
    pub expected_g: f64,
}

/// The blocks of a density coupon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DensitySet {
    /// The printer's id.
    pub printer: String,
    /// The printer's name.
    pub printer_name: String,
    /// The material's id.
    pub material: String,
    /// The material's name.
    pub material_name: String,
    /// The pattern of the infill, in the words of slicers.
    pub pattern: String,
    /// Diameters of the small and the large blocks, mm.
    pub diameters_mm: [f64; 2],
    /// Height of each block, mm.
    pub height_mm: f64,
    /// Height of a layer, mm.
    pub layer_mm: f64,
    /// Width of a line, mm.
    pub line_mm: f64,
    /// Thickness of the wall around the infill, mm: what its lines lay, as solid print.
    pub wall_mm: f64,
    /// The blocks, the sparsest first; the solid one is last.
    pub blocks: Vec<Block>,
}

impl DensitySet {
    /// Computes the blocks of a printer and one of its materials. Every infill from the printer's
    /// least one on has a small and a large block, and solid print a small one.
    ///
    /// # Errors
    /// The printer has no infill.
    pub fn of(printer: &Printer, material: &Material) -> Result<Self, NoInfill> {
        let none = || NoInfill {
            printer: printer.name.clone(),
        };
        let infill = printer.infill.as_ref().ok_or_else(none)?;
        let least = printer
            .number(Quantity::LeastInfillRatio)
            .ok_or_else(none)?;
        let (line_mm, layer_mm) = (printer.pixel_x_mm.value, printer.layer_mm.value);
        let mut set = Self {
            printer: printer.id.clone(),
            printer_name: printer.name.clone(),
            material: material.id.clone(),
            material_name: material.name.clone(),
            pattern: infill.pattern.clone(),
            diameters_mm: DIAMETERS_MM,
            height_mm: (HEIGHT_MM / layer_mm).round() * layer_mm,
            layer_mm,
            line_mm,
            wall_mm: printer.walls().perimeters as f64 * spacing_mm(line_mm, layer_mm),
            blocks: Vec::new(),
        };
        let least_percent = (least.value * SOLID_PERCENT * 1e6).round() / 1e6;
        let denser = PERCENTS.iter().copied();
        let denser = denser.filter(|percent| *percent > least_percent);
        for percent in std::iter::once(least_percent).chain(denser) {
            set.add(percent, infill, material);
        }
        set.add(SOLID_PERCENT, infill, material);
        Ok(set)
    }

    /// Adds the blocks of an infill: of solid print the small one alone.
    fn add(&mut self, percent: f64, infill: &InfillPattern, material: &Material) {
        let laid_ratio = infill.laid_ratio(percent / SOLID_PERCENT);
        let sizes = ["small", "large"].into_iter().zip(self.diameters_mm);
        let count = if percent < SOLID_PERCENT { 2 } else { 1 };
        for (size, diameter_mm) in sizes.take(count) {
            let core_mm2 = area_mm2(self.core_mm(diameter_mm));
            let laid_mm2 = area_mm2(diameter_mm) - core_mm2 * (1.0 - laid_ratio);
            let volume_mm3 = laid_mm2 * self.height_mm;
            self.blocks.push(Block {
                name: format!("{percent}percent-{size}"),
                percent,
                diameter_mm,
                expected_g: volume_mm3 * material.density_g_cm3.value / MM3_PER_CM3,
            });
        }
    }

    /// Returns the diameter within the walls of a block, mm.
    pub(super) fn core_mm(&self, diameter_mm: f64) -> f64 {
        diameter_mm - 2.0 * self.wall_mm
    }

    /// Returns the infills of the blocks, per cent, the sparsest first and solid print last.
    pub fn percents(&self) -> Vec<f64> {
        let mut all: Vec<f64> = self.blocks.iter().map(|block| block.percent).collect();
        all.dedup();
        all
    }
}

/// Returns the distance of the lines of solid print, mm. Lines have round sides, and slicers lay
/// them so near that the gaps between these are filled.
fn spacing_mm(line_mm: f64, layer_mm: f64) -> f64 {
    line_mm - layer_mm * (1.0 - std::f64::consts::FRAC_PI_4)
}

/// Returns the area of a block's section, mm², by its diameter.
pub(super) fn area_mm2(diameter_mm: f64) -> f64 {
    circle_ratio() * diameter_mm * diameter_mm
}

/// Returns the area of a block's section over its diameter squared.
pub(super) fn circle_ratio() -> f64 {
    let sides = f64::from(SIDES);
    sides / 8.0 * (std::f64::consts::TAU / sides).sin()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_filament_printer_has_blocks_from_its_least_infill_on_and_the_others_have_none() {
        for printer in Printer::all().unwrap() {
            let found = DensitySet::of(&printer, printer.material(None).unwrap());
            let Some(infill) = &printer.infill else {
                assert!(found.is_err(), "{}", printer.id);
                continue;
            };
            let set = found.unwrap();
            assert_eq!(set.percents(), [15.0, 20.0, 30.0, 50.0, 70.0, 90.0, 100.0]);
            assert_eq!(set.blocks.len(), 13);
            assert_eq!(set.pattern, infill.pattern);
            let layers = set.height_mm / set.layer_mm;
            assert!((layers - layers.round()).abs() < 1e-9, "{}", printer.id);
        }
    }

    #[test]
    fn blocks_that_are_denser_are_heavier_and_the_set_is_no_more_than_a_night_of_printing() {
        let printer = Printer::find("prusa-mk4").unwrap();
        let set = DensitySet::of(&printer, printer.material(None).unwrap()).unwrap();
        for size in ["small", "large"] {
            let those = set.blocks.iter().filter(|it| it.name.ends_with(size));
            let masses: Vec<f64> = those.map(|block| block.expected_g).collect();
            assert!(masses.is_sorted(), "{masses:?}");
        }
        let all_g: f64 = set.blocks.iter().map(|block| block.expected_g).sum();
        assert!((110.0..140.0).contains(&all_g), "{all_g}");
    }
}
