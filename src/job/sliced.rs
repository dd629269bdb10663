//! The rounds in which a graded kit was sliced, and its toolpaths weighed.

use serde::{Deserialize, Serialize};

/// A round in which a kit was sliced.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlicedRound {
    /// The distance between the centre of its toolpaths and the promised one, mm.
    pub miss_mm: f64,
    /// The moments of what its toolpaths lay beyond the written parts, in the model frame, mm³ to
    /// mm⁵. They are those of 1, x, y, z, xy, yz, xz, x², y² and z².
    pub beyond: [f64; 10],
}
