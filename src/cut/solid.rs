//! What a plan keeps solid of the interior.

use serde::{Deserialize, Serialize};

use crate::geom::{Aabb, Point};

/// A part of the interior that is not emptied: what of it hangs together with a point within a box
/// of the model frame.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidEnd {
    /// A point in it or at its wall, mm.
    pub at_mm: [f64; 3],
    /// The least corner of the box, mm.
    pub low_mm: [f64; 3],
    /// The greatest corner of the box, mm.
    pub high_mm: [f64; 3],
}

impl SolidEnd {
    pub(crate) fn new(at: &Point, aabb: &Aabb) -> Self {
        Self {
            at_mm: (*at).into(),
            low_mm: aabb.min.into(),
            high_mm: aabb.max.into(),
        }
    }

    /// The box.
    pub fn aabb(&self) -> Aabb {
        Aabb {
            min: self.low_mm.into(),
            max: self.high_mm.into(),
        }
    }

    /// Whether the point lies in a box that has a volume.
    pub(crate) fn is_sound(&self) -> bool {
        let sides = self.low_mm.iter().zip(self.high_mm).zip(self.at_mm);
        sides.into_iter().all(|((&low, high), at)| {
            [low, high, at].iter().all(|number| number.is_finite())
                && low < high
                && (low..=high).contains(&at)
        })
    }
}
