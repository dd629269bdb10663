//! Cells inside of a piece as the kit states them.

use serde::{Deserialize, Serialize};

/// The cells inside of a piece as the kit states them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CellsOrder {
    /// The size of a cell, mm: there are as many as cubes of this side fill the inside.
    pub size_mm: f64,
    /// The wall between two cells, mm.
    pub wall_mm: f64,
    /// The free diameter of the openings in these walls, mm.
    pub opening_mm: f64,
    /// The density with which the goal was solved where cells are, over that of solid print.
    pub density_ratio: f64,
    /// The volume of all cells with their openings, which drains, mm³.
    pub drained_mm3: f64,
    /// A place inside of each cell, model frame, mm.
    pub places_mm: Vec<[f64; 3]>,
    /// The ends of the axis of each opening, model frame, mm.
    pub openings_mm: Vec<[[f64; 3]; 2]>,
}
