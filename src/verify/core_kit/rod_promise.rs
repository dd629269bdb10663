//! The promises of rods between polyhedra.

use serde::{Deserialize, Serialize};

/// A rod that is glued into panels of two polyhedra.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RodPromise {
    /// Its name on the sheet, such as `R1`.
    pub name: String,
    /// The id of the rod from which it is cut.
    pub id: String,
    /// The numbers of its panels, from 1: the one into which it is glued first, and the one that
    /// then slides onto it.
    pub panels: [usize; 2],
    /// The ends of its axis, in the same order, mm.
    pub ends_mm: [[f64; 3]; 2],
    /// Its diameter, mm.
    pub diameter_mm: f64,
    /// Its length, mm.
    pub length_mm: f64,
    /// The length by which either end stands out of its panel inside, mm.
    pub stands_mm: f64,
    /// The length in which such rods are sold, mm.
    pub stock_mm: f64,
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
    /// Its mass, g.
    pub mass_g: f64,
    /// Its centre in the model frame, mm.
    pub center_mm: [f64; 3],
}

/// A row of the list of things to buy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BuyPromise {
    /// The id under which it is ordered.
    pub id: String,
    /// The number of pieces.
    pub count: usize,
}
