//! Corners of the build plate that must stay free.

use serde::{Deserialize, Serialize};

use super::Sourced;

/// A corner of the plate as seen from in front of the machine: x to the right, y to the back.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Corner {
    /// x and y least.
    FrontLeft,
    /// x greatest, y least.
    FrontRight,
    /// x least, y greatest.
    BackLeft,
    /// x and y greatest.
    BackRight,
}

/// A corner of the plate that must stay free, at any height.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ExcludedCorner {
    /// The corner.
    pub corner: Corner,
    /// Its sides along x and y, mm.
    pub size_mm: Sourced<[f64; 2]>,
}

impl ExcludedCorner {
    /// True if the corner overlaps the rectangle from `low` to `high` on a plate of that size, mm.
    pub(super) fn overlaps(&self, [low, high]: [[f64; 2]; 2], plate_mm: [f64; 2]) -> bool {
        let [width, depth] = self.size_mm.value;
        let left = matches!(self.corner, Corner::FrontLeft | Corner::BackLeft);
        let front = matches!(self.corner, Corner::FrontLeft | Corner::FrontRight);
        let in_x = if left {
            low[0] < width
        } else {
            high[0] > plate_mm[0] - width
        };
        let in_y = if front {
            low[1] < depth
        } else {
            high[1] > plate_mm[1] - depth
        };
        in_x && in_y
    }
}
