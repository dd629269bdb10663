//! The sizes of a printer's coupons, computed from its profile alone.

use serde::{Deserialize, Serialize};

use crate::printer::{Material, Printer};

/// Side of a density coupon, mm. Its 8 cm³ weigh some 9 g, so that a balance of 0.01 g is accurate
/// to 0.1 %. Much larger coupons take hours to print.
const DENSITY_SIDE_MM: f64 = 20.0;
/// Difference of clearance between neighbouring sockets of the comb, mm per side: it decides a fit,
/// and a calliper can measure it.
const CLEARANCE_STEP_MM: f64 = 0.05;
/// Number of steps of the comb to either side of the profile's clearance.
const CLEARANCE_STEPS: usize = 3;
/// Least diameter of the trial pin, mm: thick enough to hold and turn it.
const TRIAL_PIN_MM: f64 = 4.0;
/// Diameters of the ladder's pins over the thinnest pin of the profile.
const PIN_RATIOS: [f64; 5] = [0.5, 0.75, 1.0, 1.5, 2.0];
/// Thicknesses of the fans' walls over the thinnest wall of the profile.
const WALL_RATIOS: [f64; 6] = [0.4, 0.6, 0.8, 1.0, 1.25, 1.5];

/// A socket of the comb.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Hole {
    /// Its gap to the trial pin on each side, mm.
    pub clearance_mm: f64,
    /// Its diameter, mm.
    pub diameter_mm: f64,
}

/// The sizes of a set of coupons.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CouponSet {
    /// The printer's id.
    pub printer: String,
    /// The printer's name.
    pub printer_name: String,
    /// The material's id.
    pub material: String,
    /// The material's name.
    pub material_name: String,
    /// The profile's own density, g/cm³.
    pub profile_density_g_cm3: f64,
    /// Sides of a density coupon, in whole pixels and layers, mm.
    pub density_size_mm: [f64; 3],
    /// Volume of a density coupon, mm³.
    pub density_volume_mm3: f64,
    /// Diameter of the trial pin, mm.
    pub trial_pin_mm: f64,
    /// Length of the trial pin, mm.
    pub trial_length_mm: f64,
    /// Sockets of the comb, the tightest first.
    pub holes: Vec<Hole>,
    /// Diameters of the ladder's pins, the thinnest first, mm.
    pub pins_mm: Vec<f64>,
    /// Thicknesses along x of the walls of one fan, the thinnest first, mm.
    pub walls_x_mm: Vec<f64>,
    /// Thicknesses along y of the walls of the other fan, the thinnest first, mm.
    pub walls_y_mm: Vec<f64>,
    /// Height of a layer, mm.
    pub layer_mm: f64,
}

impl CouponSet {
    /// Computes the coupons of a printer and one of its materials.
    ///
    /// Density coupons, pins and walls are whole steps of the printer's grid. The sockets of the
    /// comb are not, as their own steps are under test.
    pub fn of(printer: &Printer, material: &Material) -> Self {
        let [x, y, z] =
            [&printer.pixel_x_mm, &printer.pixel_y_mm, &printer.layer_mm].map(|step| step.value);
        let density_size_mm = [x, y, z].map(|step| round_up(DENSITY_SIDE_MM, step));
        let trial_pin_mm = round_up(
            TRIAL_PIN_MM.max(printer.pin_min_diameter_mm.value),
            x.max(y),
        );
        let walls = |step: f64| whole_steps(&WALL_RATIOS, printer.min_wall_mm.value, step);
        Self {
            printer: printer.id.clone(),
            printer_name: printer.name.clone(),
            material: material.id.clone(),
            material_name: material.name.clone(),
            profile_density_g_cm3: material.density_g_cm3.value,
            density_size_mm,
            density_volume_mm3: density_size_mm.iter().product(),
            trial_pin_mm,
            trial_length_mm: round_up(printer.pin_length_ratio.value * trial_pin_mm, z),
            holes: holes(trial_pin_mm, printer.clearance_per_side_mm.value),
            pins_mm: whole_steps(&PIN_RATIOS, printer.pin_min_diameter_mm.value, x.max(y)),
            walls_x_mm: walls(x),
            walls_y_mm: walls(y),
            layer_mm: z,
        }
    }
}

/// Returns sockets around the profile's clearance, in equal steps, none tighter than the pin.
fn holes(pin_mm: f64, clearance_mm: f64) -> Vec<Hole> {
    let tightest = (clearance_mm - CLEARANCE_STEPS as f64 * CLEARANCE_STEP_MM).max(0.0);
    let hole = |step: usize| {
        let clearance_mm = tightest + step as f64 * CLEARANCE_STEP_MM;
        Hole {
            clearance_mm,
            diameter_mm: pin_mm + 2.0 * clearance_mm,
        }
    };
    (0..=2 * CLEARANCE_STEPS).map(hole).collect()
}

/// Rounds a length up to whole steps, mm.
fn round_up(length_mm: f64, step_mm: f64) -> f64 {
    // Rounding errors must not add a step to a length of whole steps.
    const SLACK: f64 = 1e-9;
    (length_mm / step_mm - SLACK).ceil().max(1.0) * step_mm
}

/// Rounds multiples of a length to whole steps, mm, each once, the smallest first.
fn whole_steps(ratios: &[f64], length_mm: f64, step_mm: f64) -> Vec<f64> {
    let mut steps: Vec<u32> = ratios
        .iter()
        .map(|ratio| (ratio * length_mm / step_mm).round().max(1.0) as u32)
        .collect();
    steps.dedup();
    steps
        .into_iter()
        .map(|steps| f64::from(steps) * step_mm)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coupons_lie_on_the_grid_and_the_comb_steps_around_the_clearance() {
        for printer in Printer::all().unwrap() {
            let set = CouponSet::of(&printer, printer.material(None).unwrap());
            let is_whole =
                |length: f64, step: f64| (length / step - (length / step).round()).abs() < 1e-6;
            let steps = [
                printer.pixel_x_mm.value,
                printer.pixel_y_mm.value,
                printer.layer_mm.value,
            ];
            for (side, step) in set.density_size_mm.into_iter().zip(steps) {
                assert!(is_whole(side, step), "{}", printer.id);
            }
            assert!(
                set.walls_x_mm.iter().all(|wall| is_whole(*wall, steps[0])),
                "{}",
                printer.id
            );
            assert!(
                set.walls_y_mm.iter().all(|wall| is_whole(*wall, steps[1])),
                "{}",
                printer.id
            );
            assert!(set.holes.len() == 7 && set.holes[0].clearance_mm >= 0.0);
            for pair in set.holes.windows(2) {
                assert!((pair[1].clearance_mm - pair[0].clearance_mm - 0.05).abs() < 1e-12);
                assert!((pair[1].diameter_mm - pair[0].diameter_mm - 0.1).abs() < 1e-12);
            }
            let nominal = printer.clearance_per_side_mm.value;
            assert!(
                set.holes
                    .iter()
                    .any(|hole| (hole.clearance_mm - nominal).abs() < 1e-12),
                "{}",
                printer.id
            );
            assert!(
                set.pins_mm.is_sorted() && set.walls_x_mm.len() >= 2,
                "{}: {set:?}",
                printer.id
            );
        }
    }

    #[test]
    fn every_number_of_filament_lines_is_given_once() {
        let mk4 = Printer::find("prusa-mk4").unwrap();
        let set = CouponSet::of(&mk4, mk4.material(None).unwrap());
        // The walls of 0.32 to 1.2 mm are 1, 1, 1, 2, 2 and 3 lines of 0.45 mm.
        assert_eq!(set.walls_x_mm.len(), 3);
        assert!((set.walls_x_mm[2] - 1.35).abs() < 1e-12);
    }
}
