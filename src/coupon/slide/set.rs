//! The sizes of a slide coupon, computed from the printer's profile alone.

use serde::Serialize;

use crate::printer::{Material, Printer, Quantity};

/// Difference of clearance between neighbouring sleeves, mm on each side, as in the comb of pins.
const STEP_MM: f64 = 0.05;
/// Steps to either side of the profile's clearance.
const STEPS: usize = 2;
/// The tightest sleeve, mm on each side: with less, no process parts two prints.
const LEAST_MM: f64 = 0.05;
/// The least radius of the plunger, mm: it is held and turned by hand.
const LEAST_BODY_MM: f64 = 5.0;
/// Walls in the plunger's radius: two of them, and a bore through which it drains.
const BODY_WALLS: f64 = 4.0;
/// Length of sleeves and plungers, mm: some three diameters, so that a plunger is guided.
const LENGTH_MM: f64 = 30.0;
/// Radius of the arcs' circle, mm. A sleeve of 30 mm leans by 29° at its mouth, and needs no
/// support.
const ARC_MM: f64 = 60.0;
/// Least length of flange and lip, mm: as in a telescope.
const LEAST_FLANGE_MM: f64 = 2.0;
/// Share of a wall that a chamfer may take.
const CHAMFER_WALL_RATIO: f64 = 0.5;

/// A sleeve of one clearance.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Sleeve {
    /// Its gap to the plunger on each side, mm.
    pub clearance_mm: f64,
    /// Diameter of its lip, which guides the plunger's body, mm.
    pub lip_mm: f64,
    /// Diameter of its bore, which guides the plunger's flange, mm.
    pub bore_mm: f64,
}

/// The sizes of a slide coupon.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SlideSet {
    /// The printer's id.
    pub printer: String,
    /// The printer's name.
    pub printer_name: String,
    /// The material's id.
    pub material: String,
    /// The material's name.
    pub material_name: String,
    /// The clearance of the profile, mm on each side.
    pub profile_clearance_mm: f64,
    /// The source of that clearance.
    pub profile_source: String,
    /// Diameter of the plunger's body, mm.
    pub body_mm: f64,
    /// Diameter of its flange, mm.
    pub flange_mm: f64,
    /// Length of flange and lip, mm.
    pub flange_length_mm: f64,
    /// Wall of sleeves and plungers, mm.
    pub wall_mm: f64,
    /// Chamfer of the edges that slide, mm.
    pub chamfer_mm: f64,
    /// Length of sleeves and plungers, mm.
    pub length_mm: f64,
    /// Radius of the circle along which the arcs bend, mm.
    pub arc_mm: f64,
    /// The sleeves, the tightest first. There is a straight one and an arc of each.
    pub sleeves: Vec<Sleeve>,
    /// Height of a layer, mm.
    pub layer_mm: f64,
}

impl SlideSet {
    /// Computes the coupon of a printer and one of its materials: sleeves around the clearance with
    /// which a telescope of that material would slide.
    pub fn of(printer: &Printer, material: &Material) -> Self {
        let known = printer.slide_clearance(material);
        let known = known.unwrap_or(&printer.clearance_per_side_mm);
        let number = |quantity| printer.number(quantity).map(|number| number.value);
        let wall_mm = printer.min_wall_mm.value;
        let feature_mm = printer.min_feature_mm.value;
        let body = LEAST_BODY_MM.max(BODY_WALLS * wall_mm);
        let clearances = clearances(known.value);
        // The flange holds in the loosest sleeve as in a telescope of that clearance.
        let loosest = clearances.iter().copied().fold(0.0, f64::max);
        let flange = body + loosest + feature_mm.max(2.0 * loosest);
        let lead_mm = number(Quantity::ChamferFirstLayerMm).unwrap_or(printer.chamfer_mm.value);
        let foot_mm = number(Quantity::ElephantFootMm).unwrap_or(0.0);
        let sleeve = |clearance_mm: &f64| Sleeve {
            clearance_mm: *clearance_mm,
            lip_mm: 2.0 * (body + clearance_mm),
            bore_mm: 2.0 * (flange + clearance_mm),
        };
        Self {
            printer: printer.id.clone(),
            printer_name: printer.name.clone(),
            material: material.id.clone(),
            material_name: material.name.clone(),
            profile_clearance_mm: known.value,
            profile_source: known.provenance(),
            body_mm: 2.0 * body,
            flange_mm: 2.0 * flange,
            flange_length_mm: LEAST_FLANGE_MM.max(2.0 * feature_mm),
            wall_mm,
            chamfer_mm: lead_mm.max(foot_mm).min(CHAMFER_WALL_RATIO * wall_mm),
            length_mm: LENGTH_MM,
            arc_mm: ARC_MM,
            sleeves: clearances.iter().map(sleeve).collect(),
            layer_mm: printer.layer_mm.value,
        }
    }
}

/// Returns clearances around that of the profile, in equal steps, none below the least.
fn clearances(profile_mm: f64) -> Vec<f64> {
    let tightest = (profile_mm - STEPS as f64 * STEP_MM).max(LEAST_MM);
    let step = |i: usize| tightest + i as f64 * STEP_MM;
    // Sums of steps get digits that nobody types.
    let rounded = |mm: f64| (mm * 1e6).round() / 1e6;
    (0..=2 * STEPS).map(|i| rounded(step(i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sleeves_step_around_the_clearance_of_every_printer_and_material() {
        for printer in Printer::all().unwrap() {
            for material in &printer.materials {
                let set = SlideSet::of(&printer, material);
                assert_eq!(set.sleeves.len(), 5, "{}", printer.id);
                let near =
                    |sleeve: &Sleeve| (sleeve.clearance_mm - set.profile_clearance_mm).abs() < 1e-9;
                assert!(set.sleeves.iter().any(near), "{}: {set:?}", printer.id);
                for sleeve in &set.sleeves {
                    // The lip holds the flange, and the wall is left at its chamfers.
                    let held_mm = 0.5 * (set.flange_mm - sleeve.lip_mm);
                    assert!(
                        held_mm >= printer.min_feature_mm.value - 1e-9,
                        "{}",
                        printer.id
                    );
                    assert!(set.chamfer_mm <= 0.5 * set.wall_mm);
                    assert!(set.flange_length_mm > set.chamfer_mm, "{}", printer.id);
                }
            }
        }
    }

    #[test]
    fn a_material_with_a_clearance_of_its_own_has_sleeves_around_that() {
        let mk4 = Printer::find("prusa-mk4").unwrap();
        let of = |id: &str| SlideSet::of(&mk4, mk4.material(Some(id)).unwrap());
        assert_eq!(of("pla").profile_clearance_mm, 0.3);
        assert_eq!(of("petg").profile_clearance_mm, 0.4);
        let steps: Vec<f64> = of("pla")
            .sleeves
            .iter()
            .map(|own| own.clearance_mm)
            .collect();
        assert_eq!(steps, [0.2, 0.25, 0.3, 0.35, 0.4]);
    }
}
