//! The radius of a body of revolution along its axis.

/// The radius along an arc as straight lines between corners. Two corners at one arc are a step.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    corners: Vec<[f64; 2]>,
}

impl Profile {
    /// Takes corners of arc and radius, mm. Arcs that go back are cut off, and corners that repeat
    /// are left out.
    pub fn new(corners: impl IntoIterator<Item = [f64; 2]>) -> Self {
        let mut kept: Vec<[f64; 2]> = Vec::new();
        for [arc, radius] in corners {
            let last = kept.last().copied();
            let arc = last.map_or(arc, |[before, _]| arc.max(before));
            if last != Some([arc, radius]) {
                kept.push([arc, radius]);
            }
        }
        Self { corners: kept }
    }

    /// Returns a disc between two arcs, with chamfers on both edges, mm.
    pub fn disc([low, high]: [f64; 2], radius_mm: f64, chamfer_mm: f64) -> Self {
        Self::new([
            [low, radius_mm - chamfer_mm],
            [low + chamfer_mm, radius_mm],
            [high - chamfer_mm, radius_mm],
            [high, radius_mm - chamfer_mm],
        ])
    }

    /// Returns the corners, arc and radius, mm.
    pub fn corners(&self) -> &[[f64; 2]] {
        &self.corners
    }

    /// Returns the greatest radius, mm.
    pub fn max_radius_mm(&self) -> f64 {
        self.corners
            .iter()
            .map(|[_, radius]| *radius)
            .fold(0.0, f64::max)
    }

    /// Returns the corners with more between them, so that no edge is longer than `step_mm`.
    pub(super) fn stations(&self, step_mm: f64) -> Vec<[f64; 2]> {
        let first = self.corners.first().copied();
        let between = self.corners.windows(2).flat_map(|pair| {
            let ([a, r], [b, s]) = (pair[0], pair[1]);
            let count = (((b - a) / step_mm).ceil() as usize).max(1);
            (1..=count).map(move |i| {
                let share = i as f64 / count as f64;
                [a + (b - a) * share, r + (s - r) * share]
            })
        });
        first.into_iter().chain(between).collect()
    }
}
