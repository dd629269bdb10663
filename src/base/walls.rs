//! The lines and layers that slicers lay solid around what they fill.

/// The lines and layers that slicers lay solid around what they fill.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Walls {
    /// Number of lines along a wall.
    pub perimeters: usize,
    /// Number of solid layers over and under sparse infill.
    pub solid_layers: usize,
    /// Share of a line by which infill reaches into the walls, as PrusaSlicer reckons it.
    pub overlap_ratio: f64,
}

impl Default for Walls {
    /// Returns what PrusaSlicer lays if nothing is said.
    fn default() -> Self {
        Self {
            perimeters: 2,
            solid_layers: 3,
            overlap_ratio: 0.25,
        }
    }
}
