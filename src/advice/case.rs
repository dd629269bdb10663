//! The question that is put to the advice.

use crate::goal::Request;
use crate::hollow::Fill;
use crate::mesh::Solid;

/// A model, a goal, and the limits of the printer.
#[derive(Debug, Clone, Copy)]
pub struct Case<'a> {
    /// The model, mm.
    pub solid: &'a Solid,
    /// The goal.
    pub request: Request,
    /// The printed wall, mm.
    pub wall_mm: f64,
    /// The thinnest wall the printer makes, mm.
    pub least_wall_mm: f64,
    /// The step of walls, mm: a wall is a whole multiple of it.
    pub wall_step_mm: f64,
    /// The density of the print, g/cm³.
    pub density_g_cm3: f64,
    /// The length of the longest model whose kit this printer can print, mm.
    pub greatest_size_mm: f64,
    /// The contents of the voids: a filling, or the sparse infill of a print in one piece; `None`
    /// for air.
    pub fill: Option<Fill>,
}
