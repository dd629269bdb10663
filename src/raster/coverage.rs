//! The exact area of an outline in each pixel, row by row.
//!
//! The share of a pixel is an integral over the outline. Each of its pieces covers all that lies to
//! its right, up or down by its sign. So a piece changes the share of the pixels that it crosses,
//! and of all that follow in their rows. The changes are kept alone, and summed along the row.
//! This is the way in which fonts are drawn (Levien, "font-rs", 2016), in double precision.

use super::grid::Pixels;
use super::image::{LayerImage, Run};
use super::sections::Segment;

/// Shares nearer than this to nothing or to all are that. The sums round to some 1e-14.
const ROUNDING: f64 = 1e-9;

/// The change of the share from a column of a row on.
#[derive(Debug, Clone, Copy)]
struct Change {
    row: u32,
    column: u32,
    by: f64,
}

/// The changes of the shares in one layer.
#[derive(Debug)]
pub(super) struct Coverage {
    pixels: Pixels,
    changes: Vec<Change>,
}

impl Coverage {
    /// Starts with nothing covered.
    pub(super) fn new(pixels: Pixels) -> Self {
        Self {
            pixels,
            changes: Vec::new(),
        }
    }

    /// Adds a piece of the outline, mm. What lies outside of the pixels is left out.
    pub(super) fn add(&mut self, segment: Segment) {
        let Pixels {
            low_mm, pitch_mm, ..
        } = self.pixels;
        let [from, to] =
            segment.map(|end| [0, 1].map(|axis| (end[axis] - low_mm[axis]) / pitch_mm[axis]));
        let rise = to[1] - from[1];
        if rise == 0.0 {
            return;
        }
        let slope = (to[0] - from[0]) / rise;
        let (low, high) = (from[1].min(to[1]), from[1].max(to[1]));
        let rows = f64::from(self.pixels.count[1]);
        let last = high.min(rows).ceil() as u32;
        for row in low.max(0.0) as u32..last {
            let bottom = low.max(f64::from(row));
            let top = high.min(f64::from(row) + 1.0);
            if top > bottom {
                let across = [bottom, top].map(|y| from[0] + (y - from[1]) * slope);
                self.add_in_row(row, across, (top - bottom) * -rise.signum());
            }
        }
    }

    /// Adds a piece within a row, from one place across to another, that covers this height of the
    /// row to its right.
    fn add_in_row(&mut self, row: u32, across: [f64; 2], height: f64) {
        let columns = f64::from(self.pixels.count[0]);
        let (left, right) = (across[0].min(across[1]), across[0].max(across[1]));
        let length = right - left;
        // What lies left of the pixels covers whole rows, what lies right of them nothing.
        let share_of = |low: f64, high: f64| {
            if length > 0.0 {
                (high - low).max(0.0) / length * height
            } else {
                height
            }
        };
        if left < 0.0 {
            self.change(row, 0, share_of(left, right.min(0.0)));
            if right <= 0.0 {
                return;
            }
        }
        let first = left.max(0.0) as u32;
        let end = right.min(columns).ceil().max(f64::from(first) + 1.0) as u32;
        for column in first..end.min(self.pixels.count[0]) {
            let low = left.max(f64::from(column));
            let high = right.min(f64::from(column) + 1.0);
            let by = share_of(low, high);
            let to_right = 1.0 - (0.5 * (low + high) - f64::from(column));
            self.change(row, column, by * to_right);
            self.change(row, column + 1, by * (1.0 - to_right));
        }
    }

    fn change(&mut self, row: u32, column: u32, by: f64) {
        if by != 0.0 {
            self.changes.push(Change { row, column, by });
        }
    }

    /// Returns the covered pixels as runs, from the first row on.
    pub(super) fn into_image(mut self) -> LayerImage {
        // Equal places stay in order, so that sums do not depend on the sort.
        self.changes
            .sort_by_key(|change| (change.row, change.column));
        let mut runs: Vec<Run> = Vec::new();
        let mut at = 0;
        while let Some(&Change { row, .. }) = self.changes.get(at) {
            let mut share = 0.0;
            while let Some(&Change { column, .. }) =
                self.changes.get(at).filter(|change| change.row == row)
            {
                let is_here = |change: &&Change| change.row == row && change.column == column;
                while let Some(change) = self.changes.get(at).filter(is_here) {
                    share += change.by;
                    at += 1;
                }
                let next = self.changes.get(at).filter(|change| change.row == row);
                let end = next.map_or(self.pixels.count[0], |change| change.column);
                let ratio = snapped(share);
                if ratio > 0.0 && end > column {
                    runs.push(Run {
                        row,
                        first: column,
                        end,
                        ratio,
                    });
                }
            }
        }
        LayerImage { runs }
    }
}

/// Returns a share without its rounding, between 0 and 1.
fn snapped(share: f64) -> f64 {
    if share < ROUNDING {
        0.0
    } else if share > 1.0 - ROUNDING {
        1.0
    } else {
        share
    }
}
