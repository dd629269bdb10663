//! Two materials in the pixels of a body, so that each place has a wished share of one of them.
//!
//! Every pixel gets one material, and what that is too much or too little goes on to its
//! neighbours: error diffusion (Floyd and Steinberg, Proc. SID 17, 1976), in rows that are read to
//! and fro. A quarter of each error goes up to the next layer. No error leaves the body, so the
//! sum over a body is right within a pixel or so, and its moments nearly so.

use super::grid::{Layers, Pixels};
use super::image::LayerImage;
use crate::geom::{Matrix, Vector};
use crate::mass::Moments;

/// Least share of a pixel that makes it the body's.
const BODY_SHARE: f64 = 0.5;
/// The share that stands for a pixel beside the body.
const BESIDE: f32 = -1.0;
/// Part of an error that goes up to the next layer.
const UP: f64 = 0.25;
/// Parts of the rest that go on in the row, and back, straight and on in the next row.
const WEIGHTS: [f64; 4] = [7.0, 3.0, 5.0, 1.0];

/// The material of a pixel.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// None: it lies beside the body.
    Empty,
    /// The second material.
    Second,
    /// The first material, whose shares are asked for.
    First,
}

/// Marks the pixels of a layer that are the body's: share 0 there, and −1 elsewhere.
pub fn mark_body(image: &LayerImage, pixels: &Pixels) -> Vec<f32> {
    let mut marks = vec![BESIDE; pixels.area()];
    let columns = pixels.count[0] as usize;
    for run in image.runs.iter().filter(|run| run.ratio >= BODY_SHARE) {
        let start = run.row as usize * columns;
        marks[start + run.first as usize..start + run.end as usize].fill(0.0);
    }
    marks
}

/// Error diffusion through the layers of a body, from the lowest on. It holds two layers.
#[derive(Debug)]
pub struct Diffusion {
    columns: usize,
    /// The errors that reach the pixels of this layer.
    errors: Vec<f32>,
    /// The errors that go up.
    upward: Vec<f32>,
    /// Errors of pixels that no pixel of the body follows: the next one takes them.
    loose: f64,
    layer: u32,
    layers: u32,
}

/// One row in the sense in which it is read.
struct Row<'a> {
    shares: &'a [f32],
    start: usize,
    /// Whether there is a next row.
    has_next: bool,
    is_last_layer: bool,
    is_reversed: bool,
}

impl Diffusion {
    /// Starts below the first layer.
    pub fn new(pixels: &Pixels, layers: &Layers) -> Self {
        Self {
            columns: pixels.count[0] as usize,
            errors: vec![0.0; pixels.area()],
            upward: vec![0.0; pixels.area()],
            loose: 0.0,
            layer: 0,
            layers: layers.count,
        }
    }

    /// Returns the materials of the next layer for the shares of the first material, 0 to 1 or
    /// −1 beside the body, row by row.
    pub fn layer(&mut self, shares: &[f32]) -> Vec<Cell> {
        std::mem::swap(&mut self.errors, &mut self.upward);
        self.upward.fill(0.0);
        self.layer += 1;
        let mut cells = vec![Cell::Empty; shares.len()];
        for start in (0..shares.len()).step_by(self.columns) {
            let number = start / self.columns + self.layer as usize;
            self.row(
                &Row {
                    shares,
                    start,
                    has_next: start + self.columns < shares.len(),
                    is_last_layer: self.layer == self.layers,
                    is_reversed: number.is_multiple_of(2),
                },
                &mut cells,
            );
        }
        cells
    }

    fn row(&mut self, row: &Row, cells: &mut [Cell]) {
        for step in 0..self.columns {
            let column = match row.is_reversed {
                true => self.columns - 1 - step,
                false => step,
            };
            let at = row.start + column;
            let share = row.shares[at];
            if share < 0.0 {
                self.loose += f64::from(self.errors[at]);
                continue;
            }
            let wished = f64::from(share) + f64::from(self.errors[at]) + self.loose;
            let is_first = wished >= 0.5;
            cells[at] = if is_first { Cell::First } else { Cell::Second };
            self.loose = 0.0;
            self.spread(row, column, wished - f64::from(u8::from(is_first)));
        }
    }

    /// Hands an error on to the pixels of the body that follow.
    fn spread(&mut self, row: &Row, column: usize, error: f64) {
        let sense: isize = if row.is_reversed { -1 } else { 1 };
        let beside = |by: isize| {
            let column = column.checked_add_signed(by);
            column.filter(|column| *column < self.columns)
        };
        let (ahead, behind) = (beside(sense), beside(-sense));
        let next = row.start + self.columns;
        let below = |column: Option<usize>| column.map(|it| next + it).filter(|_| row.has_next);
        let ways = [
            ahead.map(|it| row.start + it),
            below(behind),
            below(Some(column)),
            below(ahead),
        ];
        let ways = ways.map(|way| way.filter(|at| row.shares[*at] >= 0.0));
        let open = ways.iter().zip(WEIGHTS).filter(|(way, _)| way.is_some());
        let whole: f64 = open.map(|(_, weight)| weight).sum();
        let up = match (row.is_last_layer, whole > 0.0) {
            (true, true) => 0.0,
            (true, false) => {
                self.loose += error;
                return;
            }
            (false, true) => UP,
            (false, false) => 1.0,
        };
        self.upward[row.start + column] += (error * up) as f32;
        for (way, weight) in ways.into_iter().zip(WEIGHTS) {
            if let Some(at) = way {
                self.errors[at] += (error * (1.0 - up) * weight / whole) as f32;
            }
        }
    }
}

/// The pixels and layers that hold the materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The pixels of a layer.
    pub pixels: Pixels,
    /// The layers.
    pub layers: Layers,
}

impl Grid {
    /// Returns the middle of a pixel of a layer by its place in the layer, mm.
    pub fn middle_mm(&self, at: usize, layer: u32) -> [f64; 3] {
        let columns = self.pixels.count[0] as usize;
        let along = [at % columns, at / columns];
        let [x, y] = [0, 1].map(|axis| {
            self.pixels.low_mm[axis] + (along[axis] as f64 + 0.5) * self.pixels.pitch_mm[axis]
        });
        [x, y, self.layers.middle_mm(layer)]
    }

    /// Returns the volume of a pixel of a layer, mm³.
    pub fn voxel_mm3(&self) -> f64 {
        self.pixels.pitch_mm.iter().product::<f64>() * self.layers.height_mm
    }

    /// Returns the moments of those pixels of a layer that are counted, mm³ to mm⁵. Each is a box.
    pub fn moments(&self, cells: &[Cell], layer: u32, counts: impl Fn(Cell) -> bool) -> Moments {
        let columns = self.pixels.count[0] as usize;
        let [width_mm, depth_mm] = self.pixels.pitch_mm;
        let mut flat = Moments::default();
        for (row, cells) in cells.chunks_exact(columns).enumerate() {
            let (mut count, mut sum, mut squares) = (0_u64, 0_u64, 0_u64);
            let those = cells.iter().enumerate().filter(|(_, cell)| counts(**cell));
            for (column, _) in those {
                let column = column as u64;
                count += 1;
                sum += column;
                squares += column * column;
            }
            if count == 0 {
                continue;
            }
            let [left_mm, y, _] = self.middle_mm(row * columns, layer);
            let (count, sum, squares) = (count as f64, sum as f64, squares as f64);
            let x = left_mm * count + sum * width_mm;
            let xx = left_mm * left_mm * count
                + 2.0 * left_mm * width_mm * sum
                + width_mm * width_mm * (squares + count / 12.0);
            let yy = count * (y * y + depth_mm * depth_mm / 12.0);
            flat += Moments([count, x, y * count, 0.0, x * y, 0.0, 0.0, xx, yy, 0.0]);
        }
        let height_mm = self.layers.height_mm;
        let mut second: Matrix = flat.second();
        second[(2, 2)] = flat.volume() * height_mm * height_mm / 12.0;
        let level = Moments::from_parts(flat.volume(), &flat.first(), &second);
        let up = Vector::new(0.0, 0.0, self.layers.middle_mm(layer));
        level.translated(&up) * self.voxel_mm3()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Aabb, Point};
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives::ball;
    use crate::raster::Stack;

    fn grid(size_mm: [f64; 3], pitch_mm: f64) -> Grid {
        let aabb = Aabb::of_points(&[Point::origin(), Point::from(size_mm)]);
        Grid {
            pixels: Pixels::over(&aabb, [pitch_mm; 2]),
            layers: Layers::up_to(&aabb, pitch_mm),
        }
    }

    /// Returns the moments of the first material in a box with these shares.
    fn dithered(grid: &Grid, share: impl Fn([f64; 3]) -> f32) -> Moments {
        let mut diffusion = Diffusion::new(&grid.pixels, &grid.layers);
        let layers = (0..grid.layers.count).map(|layer| {
            let places = 0..grid.pixels.area();
            let shares = places.map(|at| share(grid.middle_mm(at, layer)));
            let cells = diffusion.layer(&shares.collect::<Vec<f32>>());
            grid.moments(&cells, layer, |cell| cell == Cell::First)
        });
        layers.fold(Moments::default(), |sum, layer| sum + layer)
    }

    #[test]
    fn the_sum_of_any_shares_is_right_within_a_pixel() {
        let grid = grid([7.0, 5.0, 6.0], 0.1);
        for share in [0.0, 0.003, 0.25, 0.5, 0.77, 1.0] {
            let count = dithered(&grid, |_| share).volume() / grid.voxel_mm3();
            let wished = f64::from(share) * 70.0 * 50.0 * 60.0;
            assert!((count - wished).abs() < 1.5, "{share}: {count} of {wished}");
        }
    }

    #[test]
    fn no_error_leaves_a_body_with_holes_and_overhangs() {
        let grid = grid([6.0, 6.0, 6.0], 0.1);
        // A ball with a bore: rows and layers begin and end anywhere.
        let is_body = |[x, y, z]: [f64; 3]| {
            let (x, y, z) = (x - 3.0, y - 3.0, z - 3.0);
            x * x + y * y + z * z < 8.9 && x * x + z * z > 0.6
        };
        let share = |at: [f64; 3]| if is_body(at) { 0.37 } else { BESIDE };
        let body = (0..60)
            .flat_map(|layer| (0..3600).map(move |at| (layer, at)))
            .filter(|(layer, at)| is_body(grid.middle_mm(*at, *layer)))
            .count();
        let count = dithered(&grid, share).volume() / grid.voxel_mm3();
        let wished = f64::from(0.37_f32) * body as f64;
        assert!((count - wished).abs() < 1.5, "{count} of {wished}");
    }

    #[test]
    fn a_ramp_keeps_its_centre_and_its_second_moments() {
        let grid = grid([8.0, 6.0, 5.0], 0.05);
        let found = dithered(&grid, |[x, _, _]| (0.1 + 0.1 * x) as f32);
        // ∫ (0.1 + 0.1 x) over the box, and its first and second moments.
        let volume = 30.0 * (0.8 + 3.2);
        assert!((found.volume() / volume - 1.0).abs() < 1e-5);
        let x = 30.0 * (0.1 * 32.0 + 0.1 * 512.0 / 3.0) / volume;
        let off = found.centroid() - Point::new(x, 3.0, 2.5);
        assert!(off.norm() < 1e-3, "{off}");
        let xx = 30.0 * (0.1 * 512.0 / 3.0 + 0.1 * 1024.0);
        assert!((found.second()[(0, 0)] / xx - 1.0).abs() < 2e-4);
    }

    #[test]
    fn moments_of_marked_pixels_are_those_of_the_body() {
        let mesh = ball(&Point::new(5.0, 4.5, 4.0), 4.0, 5);
        let aabb = mesh.aabb();
        let grid = Grid {
            pixels: Pixels::over(&aabb, [0.08, 0.05]),
            layers: Layers::up_to(&aabb, 0.05),
        };
        let stack = Stack::of(&mesh, grid.pixels, grid.layers);
        let layers = (0..grid.layers.count).map(|layer| {
            let marks = mark_body(&stack.image(layer), &grid.pixels);
            let marks = marks.iter().map(|mark| match *mark < 0.0 {
                true => Cell::Empty,
                false => Cell::Second,
            });
            let cells: Vec<Cell> = marks.collect();
            grid.moments(&cells, layer, |cell| cell != Cell::Empty)
        });
        let found = layers.fold(Moments::default(), |sum, layer| sum + layer);
        let exact = moments_of_mesh(&mesh);
        assert!((found.volume() / exact.volume() - 1.0).abs() < 3e-4);
        assert!((found.centroid() - exact.centroid()).norm() < 1e-3);
        let ratio = found.second().trace() / exact.second().trace();
        assert!((ratio - 1.0).abs() < 3e-4, "{ratio}");
    }
}
