//! The evenly spaced centres of columns along one axis of the goal frame.

use std::ops::Range;

/// Evenly spaced column centres along one axis: centre `i` lies at (first + i + phase) · pitch.
///
/// The lattice is tied to the origin of the goal frame, not to the model, so that two solids in one
/// frame share their columns. The phase is irrational. So a model with rational coordinates has no
/// vertex on a column. A symmetric model has no face between two columns that are its mirror
/// images.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ruler {
    first: f64,
    count: usize,
    pitch_mm: f64,
    phase: f64,
}

impl Ruler {
    /// Phase of the lattice in x, as a share of the pitch: √2 − 1.
    pub const PHASE_X: f64 = std::f64::consts::SQRT_2 - 1.0;
    /// Phase of the lattice in y, as a share of the pitch: √3 − 1, rationally independent of the
    /// one in x.
    pub const PHASE_Y: f64 = 0.732_050_807_568_877_2;

    /// Returns the centres within [low, high] mm; the ruler is empty if the interval is.
    pub fn covering([low_mm, high_mm]: [f64; 2], pitch_mm: f64, phase: f64) -> Self {
        let first = (low_mm / pitch_mm - phase).ceil();
        let last = (high_mm / pitch_mm - phase).floor();
        let count = (last - first + 1.0).max(0.0) as usize;
        Self {
            first,
            count,
            pitch_mm,
            phase,
        }
    }

    /// Returns the number of centres.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Returns the position of centre `index`, mm.
    #[inline]
    pub fn at(&self, index: usize) -> f64 {
        (self.first + index as f64 + self.phase) * self.pitch_mm
    }

    /// Returns the number of centres below `position_mm`: the index of the first one that is not
    /// (within rounding).
    ///
    /// It depends on nothing but the position and never decreases with it. So the crossings of a
    /// closed mesh balance.
    #[inline]
    pub fn index_at_or_after(&self, position_mm: f64) -> usize {
        let index = (position_mm / self.pitch_mm - self.phase).ceil() - self.first;
        (index.max(0.0) as usize).min(self.count)
    }

    /// Returns the indices of the centres in [low, high) mm.
    #[inline]
    pub fn range(&self, [low_mm, high_mm]: [f64; 2]) -> Range<usize> {
        self.index_at_or_after(low_mm)..self.index_at_or_after(high_mm)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_centres_are_those_of_the_lattice_within_the_interval() {
        let ruler = Ruler::covering([-1.0, 2.0], 0.5, 0.25);
        let centers: Vec<f64> = (0..ruler.len()).map(|i| ruler.at(i)).collect();
        assert_eq!(centers, [-0.875, -0.375, 0.125, 0.625, 1.125, 1.625]);
        assert_eq!(Ruler::covering([0.2, 0.6], 1.0, 0.0).len(), 0);
        assert_eq!(Ruler::covering([1.0, -1.0], 0.1, 0.0).len(), 0);
    }

    #[test]
    fn a_range_holds_the_centres_from_low_up_to_high() {
        let ruler = Ruler::covering([0.0, 10.0], 1.0, 0.5);
        assert_eq!(ruler.range([1.5, 3.5]), 1..3);
        assert_eq!(ruler.range([-5.0, 99.0]), 0..10);
        assert!(ruler.range([3.0, 2.0]).is_empty());
    }
}
