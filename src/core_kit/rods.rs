//! The rods between polyhedra: what is cut, glued and bought.

use std::f64::consts::{FRAC_PI_4, PI};

use super::asked::Asked;
use super::hardware::wood_film;
use super::made::Made;
use crate::base::units::MM3_PER_CM3;
use crate::cladding::{Rod, STAND_MM};
use crate::geom::Point;
use crate::sheet::core_kit::BuyRow;
use crate::verify::{GluePromise, RodPromise};

/// The width of a saw's cut, mm.
const SAW_MM: f64 = 2.0;

/// Returns the name of a rod.
pub fn rod_id(index: usize) -> String {
    format!("R{}", index + 1)
}

/// Returns the end of a rod that is glued in first: that in the polyhedron which stands when the
/// two come together.
pub fn standing_end(made: &Made, rod: &Rod) -> usize {
    let built = &made.built;
    let [a, b] = built.plan.connections[rod.connection].polyhedra;
    let mut joins = built.shell.assembly.joins.iter();
    usize::from(joins.any(|join| join.moving.contains(&a) && join.standing.contains(&b)))
}

/// Returns all rods in their places, with their masses.
pub fn rods(made: &Made) -> Vec<RodPromise> {
    let rods = made.built.rods.iter().enumerate();
    let promises = rods.map(|(index, rod)| {
        let kit = &rod.kit;
        let stock_mm3 = FRAC_PI_4 * kit.diameter_mm.powi(2) * kit.stock_mm;
        let length_mm = rod.length_mm();
        let first = standing_end(made, rod);
        let [near, far] = [first, 1 - first];
        RodPromise {
            name: rod_id(index),
            id: kit.rod.id.clone(),
            panels: [near, far].map(|end| rod.panels[end] + 1),
            ends_mm: [near, far].map(|end| rod.ends[end].into()),
            diameter_mm: kit.diameter_mm,
            length_mm,
            stands_mm: STAND_MM,
            stock_mm: kit.stock_mm,
            density_g_cm3: kit.rod.mass_g / stock_mm3 * MM3_PER_CM3,
            mass_g: kit.rod.mass_g * length_mm / kit.stock_mm,
            center_mm: nalgebra::center(&rod.ends[0], &rod.ends[1]).into(),
        }
    });
    promises.collect()
}

/// Returns the films of glue about rods in their panels.
pub fn about_rods(asked: &Asked, made: &Made) -> Vec<GluePromise> {
    let panels = &made.built.shell.panels.panels;
    let rods = made.built.rods.iter().enumerate();
    let films = rods.flat_map(|(index, rod)| {
        [0, 1].map(|side| {
            let panel = rod.panels[side];
            let area_mm2 = PI * rod.kit.diameter_mm * asked.panels.sheet_mm;
            let middle: Point = panels[panel].at(rod.at_mm[side], 0.5);
            let joint = format!("rod {} and panel {}", rod_id(index), panel + 1);
            wood_film(joint, area_mm2, middle)
        })
    });
    films.collect()
}

/// Returns the rods to buy, by the length in which they are sold.
pub fn buy_rods(made: &Made) -> Vec<BuyRow> {
    let mut rows: Vec<BuyRow> = Vec::new();
    for rod in &made.built.rods {
        let of = &rod.kit.rod;
        if rows.iter().all(|row| row.id != of.id) {
            let own = made.built.rods.iter();
            let own: Vec<&Rod> = own.filter(|other| other.kit.rod.id == of.id).collect();
            rows.push(BuyRow {
                id: of.id.clone(),
                name: of.name.clone(),
                count: count(&own, rod.kit.stock_mm),
            });
        }
    }
    rows
}

/// Returns the number of rods as sold from which some are sawn: the longest first, each from the
/// first that has enough left.
fn count(rods: &[&Rod], stock_mm: f64) -> usize {
    let mut lengths: Vec<f64> = rods.iter().map(|rod| rod.length_mm()).collect();
    lengths.sort_by(|a, b| b.total_cmp(a));
    let mut left: Vec<f64> = Vec::new();
    for length_mm in lengths {
        match left.iter_mut().find(|left| **left >= length_mm) {
            Some(left) => *left -= length_mm + SAW_MM,
            None => left.push(stock_mm - length_mm - SAW_MM),
        }
    }
    left.len()
}
