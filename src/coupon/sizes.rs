//! The sizes of a printer's coupons, from its profile alone.

use serde::{Deserialize, Serialize};

use crate::printer::{Material, Printer};

/// The side of a density coupon, mm: 8 cm³ weigh some 9 g, so that a balance of 0.01 g reads to a
/// thousandth; much larger ones take hours to print.
const DENSITY_SIDE_MM: f64 = 20.0;
/// From one socket of the comb to the next, mm a side: what the issue of a fit turns on, and what a
/// calliper can tell.
const CLEARANCE_STEP_MM: f64 = 0.05;
/// How many steps the comb goes to either side of the profile's clearance.
const CLEARANCE_STEPS: usize = 3;
/// The pin that is tried in the comb, mm: stout enough to be held and turned.
const TRIAL_PIN_MM: f64 = 4.0;
/// Pins of the ladder over the thinnest of the profile.
const PIN_RATIOS: [f64; 5] = [0.5, 0.75, 1.0, 1.5, 2.0];
/// Walls of the fans over the thinnest of the profile.
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
    /// Its name.
    pub printer_name: String,
    /// The material's id.
    pub material: String,
    /// Its name.
    pub material_name: String,
    /// The profile's own density, g/cm³.
    pub profile_density_g_cm3: f64,
    /// The sides of a density coupon, whole pixels and layers, mm.
    pub density_size_mm: [f64; 3],
    /// Its volume, mm³.
    pub density_volume_mm3: f64,
    /// The pin that is tried in the comb, mm.
    pub trial_pin_mm: f64,
    /// How far it stands out, mm.
    pub trial_length_mm: f64,
    /// The comb's sockets, the tightest first.
    pub holes: Vec<Hole>,
    /// The pins of the ladder, the thinnest first, mm.
    pub pins_mm: Vec<f64>,
    /// The walls of the fan along x, the thinnest first, mm: thick along x.
    pub walls_x_mm: Vec<f64>,
    /// The walls of the fan along y, mm.
    pub walls_y_mm: Vec<f64>,
    /// The height of a layer, mm.
    pub layer_mm: f64,
}

impl CouponSet {
    /// The coupons of a printer and one of its materials. Density coupons, pins and walls are whole
    /// steps of its grid; the comb's sockets are not, since their steps are what is tried.
    pub fn of(printer: &Printer, material: &Material) -> Self {
        let [x, y, z] =
            [&printer.pixel_x_mm, &printer.pixel_y_mm, &printer.layer_mm].map(|step| step.value);
        let density_size_mm = [x, y, z].map(|step| up_to_step(DENSITY_SIDE_MM, step));
        let trial_pin_mm = up_to_step(
            TRIAL_PIN_MM.max(printer.pin_min_diameter_mm.value),
            x.max(y),
        );
        let walls = |step: f64| whole(&WALL_RATIOS, printer.min_wall_mm.value, step);
        Self {
            printer: printer.id.clone(),
            printer_name: printer.name.clone(),
            material: material.id.clone(),
            material_name: material.name.clone(),
            profile_density_g_cm3: material.density_g_cm3.value,
            density_size_mm,
            density_volume_mm3: density_size_mm.iter().product(),
            trial_pin_mm,
            trial_length_mm: up_to_step(printer.pin_length_ratio.value * trial_pin_mm, z),
            holes: holes(trial_pin_mm, printer.clearance_per_side_mm.value),
            pins_mm: whole(&PIN_RATIOS, printer.pin_min_diameter_mm.value, x.max(y)),
            walls_x_mm: walls(x),
            walls_y_mm: walls(y),
            layer_mm: z,
        }
    }
}

/// The sockets about the profile's clearance, in equal steps, none tighter than the pin.
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

/// The least whole number of steps that is not below a length, mm.
fn up_to_step(length_mm: f64, step_mm: f64) -> f64 {
    // A length of whole steps must not climb one because of rounding.
    const SLACK: f64 = 1e-9;
    (length_mm / step_mm - SLACK).ceil().max(1.0) * step_mm
}

/// The shares of a length, to the nearest whole step, each once, the smallest first.
fn whole(ratios: &[f64], length_mm: f64, step_mm: f64) -> Vec<f64> {
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
    fn coupons_of_every_shipped_printer_lie_on_its_grid_and_the_comb_goes_in_steps_about_its_clearance()
     {
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
    fn lines_of_filament_give_each_number_of_them_once() {
        let mk4 = Printer::find("prusa-mk4").unwrap();
        let set = CouponSet::of(&mk4, mk4.material(None).unwrap());
        // 0.32, 0.48, 0.64, 0.8, 1.0 and 1.2 mm are 1, 1, 1, 2, 2 and 3 lines of 0.45 mm.
        assert_eq!(set.walls_x_mm.len(), 3);
        assert!((set.walls_x_mm[2] - 1.35).abs() < 1e-12);
    }
}
