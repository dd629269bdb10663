//! The columns by their places on the grid, so that the columns of an octree's cell are found at
//! once.

use super::columns::Columns;
use super::leaf::{Leaf, MOST_LEVELS, interleave};
use crate::mass::Moments;

/// The columns in the order of a space-filling curve over (x, y), with a grid of finest cells
/// around them. A finest cell is one column wide and as high as the longer pitch.
#[derive(Debug, Clone)]
pub(super) struct Grid<'a> {
    columns: &'a Columns,
    /// Codes of the columns' places in ascending order, with each column's index.
    places: Vec<(u64, u32)>,
    lowest_mm: f64,
    height_mm: f64,
    finest_level: u32,
}

impl<'a> Grid<'a> {
    /// Returns the grid about these columns.
    pub fn of(columns: &'a Columns) -> Self {
        let range = |axis: usize| {
            let ends = (f64::INFINITY, f64::NEG_INFINITY);
            columns.centers.iter().fold(ends, |(lo, hi), center| {
                (lo.min(center[axis]), hi.max(center[axis]))
            })
        };
        let (xs, ys) = (range(0), range(1));
        let zs = columns.intervals.iter().fold(
            (f64::INFINITY, f64::NEG_INFINITY),
            |(lo, hi), [bottom, top]| (lo.min(*bottom), hi.max(*top)),
        );
        let height_mm = columns.pitch_mm[0].max(columns.pitch_mm[1]);
        let at = |value: f64, lowest: f64, pitch: f64| ((value - lowest) / pitch).round() as u32;
        let place = |(i, center): (usize, &[f64; 2])| {
            let [px, py] = columns.pitch_mm;
            (
                interleave([at(center[0], xs.0, px), at(center[1], ys.0, py), 0]),
                i as u32,
            )
        };
        let mut places: Vec<(u64, u32)> = columns.centers.iter().enumerate().map(place).collect();
        places.sort_unstable();
        let sides = [(xs, columns.pitch_mm[0]), (ys, columns.pitch_mm[1])];
        let across = sides.map(|((lo, hi), pitch)| at(hi, lo, pitch) + 1);
        let up = ((zs.1 - zs.0) / height_mm).ceil() as u32;
        let longest = across[0].max(across[1]).max(up).max(1);
        let finest_level = longest
            .next_power_of_two()
            .trailing_zeros()
            .min(MOST_LEVELS);
        Self {
            columns,
            places,
            lowest_mm: zs.0,
            height_mm,
            finest_level,
        }
    }

    /// Returns the columns.
    pub fn columns(&self) -> &'a Columns {
        self.columns
    }

    /// Returns the level of cells that are one column wide.
    pub fn finest_level(&self) -> u32 {
        self.finest_level
    }

    /// Returns the volume of a cell's box, mm³.
    pub fn box_volume_mm3(&self, leaf: &Leaf) -> f64 {
        let width = f64::from(1u32 << leaf.log_width);
        width * width * width * self.columns.pitch_mm[0] * self.columns.pitch_mm[1] * self.height_mm
    }

    /// Calls `stretch` with every stretch of a column that lies in a cell.
    pub fn visit(&self, leaf: &Leaf, mut stretch: impl FnMut(usize, [f64; 2])) {
        let [x, y, z] = leaf.corner();
        let low = self.lowest_mm + f64::from(z) * self.height_mm;
        let high = self.lowest_mm + f64::from(z + (1 << leaf.log_width)) * self.height_mm;
        // The columns under a cell have codes without the bits of z, which differ only in the bits
        // below its width.
        let first = interleave([x, y, 0]);
        let from = self.places.partition_point(|(code, _)| *code < first);
        let under = self.places[from..].iter();
        for &(_, column) in
            under.take_while(|(code, _)| (code ^ first) >> (3 * leaf.log_width) == 0)
        {
            for &[bottom, top] in self.columns.intervals_of(column as usize) {
                if bottom < high && top > low {
                    stretch(column as usize, [bottom.max(low), top.min(high)]);
                }
            }
        }
    }

    /// Returns the volume of the region in a cell, mm³.
    pub fn volume_in(&self, leaf: &Leaf) -> f64 {
        let mut length = 0.0;
        self.visit(leaf, |_, [bottom, top]| length += top - bottom);
        length * self.columns.pitch_mm[0] * self.columns.pitch_mm[1]
    }

    /// Returns the moments of the region in a cell.
    pub fn moments_in(&self, leaf: &Leaf) -> Moments {
        let mut sum = Moments::default();
        self.visit(leaf, |column, ends| {
            sum += self.columns.moments_between(column, ends)
        });
        sum * (self.columns.pitch_mm[0] * self.columns.pitch_mm[1])
    }
}
