//! What a slicer lays beyond the written parts, as a kit declares it.

use serde::{Deserialize, Serialize};

/// What a slicer lays beyond the written parts of a hollow kit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LaidOrder {
    /// Its moments in the model frame, mm³ to mm⁵. They are those of 1, x, y, z, xy, yz, xz, x², y²
    /// and z².
    pub beyond: [f64; 10],
    /// The distances between the centre of the toolpaths and the promised one, round by round, mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub misses_mm: Vec<f64>,
}
