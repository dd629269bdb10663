//! The image of a layer, as runs of pixels with one share.

use super::grid::{Layers, Pixels};
use crate::geom::{Matrix, Vector};
use crate::mass::Moments;

/// The grey of a pixel that is whole.
const WHITE: f64 = 255.0;

/// Pixels of a row that lie side by side and are covered by the same share.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Run {
    /// The row, from the least y.
    pub row: u32,
    /// The first column, from the least x.
    pub first: u32,
    /// The column behind the last one.
    pub end: u32,
    /// The share of each pixel that is covered, above 0 and at most 1.
    pub ratio: f64,
}

/// The image of a layer: its covered pixels, row by row and from left to right.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LayerImage {
    /// The runs.
    pub runs: Vec<Run>,
}

impl LayerImage {
    /// Paints the image in grey, a byte a pixel, rows from the least y on. White is covered.
    ///
    /// Each share is rounded to 1/255.
    pub fn grey(&self, pixels: &Pixels) -> Vec<u8> {
        let mut grey = vec![0; pixels.area()];
        let columns = pixels.count[0] as usize;
        for run in &self.runs {
            let start = run.row as usize * columns;
            grey[start + run.first as usize..start + run.end as usize]
                .fill((run.ratio * WHITE).round() as u8);
        }
        grey
    }

    /// Returns the moments of what a layer hardens, mm³ to mm⁵. Each pixel is a box of its share.
    pub fn moments(&self, pixels: &Pixels, layers: &Layers, layer: u32) -> Moments {
        let sum = |sum: Moments, run: &Run| sum + run.moments(pixels);
        let flat = self.runs.iter().fold(Moments::default(), sum);
        raised(&flat, layers, layer)
    }
}

impl Run {
    /// Returns the moments of the run at height 0, of a layer without height: mm² to mm⁴.
    ///
    /// A share says nothing of the place within its pixel. So the second moments are those of boxes
    /// less a sixth of a pixel squared, which makes the sum over a body right: Sheppard's
    /// correction (Proc. London Math. Soc. 29, 1898).
    pub fn moments(&self, pixels: &Pixels) -> Moments {
        let [width_mm, depth_mm] = pixels.pitch_mm;
        let length_mm = f64::from(self.end - self.first) * width_mm;
        let middle = 0.5 * (f64::from(self.first) + f64::from(self.end));
        let x = pixels.low_mm[0] + middle * width_mm;
        let y = pixels.low_mm[1] + (f64::from(self.row) + 0.5) * depth_mm;
        let area_mm2 = self.ratio * length_mm * depth_mm;
        let mut moments = Moments(Moments::monomials(x, y, 0.0)) * area_mm2;
        moments.0[7] += area_mm2 * (length_mm * length_mm / 12.0 - width_mm * width_mm / 6.0);
        moments.0[8] -= area_mm2 * depth_mm * depth_mm / 12.0;
        moments
    }
}

/// Returns the moments of a layer from those of its section.
fn raised(flat: &Moments, layers: &Layers, layer: u32) -> Moments {
    let height_mm = layers.height_mm;
    let mut second: Matrix = flat.second() * height_mm;
    second[(2, 2)] = flat.volume() * height_mm.powi(3) / 12.0;
    let solid = Moments::from_parts(
        flat.volume() * height_mm,
        &(flat.first() * height_mm),
        &second,
    );
    solid.translated(&Vector::new(0.0, 0.0, layers.middle_mm(layer)))
}
