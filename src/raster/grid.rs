//! The pixels and layers of a machine.

use crate::geom::Aabb;

/// The pixels of a layer, seen from above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pixels {
    /// The corner of the first pixel with the least x and y, mm.
    pub low_mm: [f64; 2],
    /// The edges of a pixel in x and y, mm.
    pub pitch_mm: [f64; 2],
    /// The number of pixels in x and y.
    pub count: [u32; 2],
}

/// The layers of a print.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// The underside of the first layer, mm.
    pub low_mm: f64,
    /// The height of a layer, mm.
    pub height_mm: f64,
    /// The number of layers.
    pub count: u32,
}

impl Pixels {
    /// Returns the fewest pixels of this pitch (mm) that cover a box. The first one starts at a
    /// multiple of the pitch, as those of a machine do.
    pub fn over(aabb: &Aabb, pitch_mm: [f64; 2]) -> Self {
        let first = [0, 1].map(|axis| (aabb.min[axis] / pitch_mm[axis]).floor());
        let end = [0, 1].map(|axis| (aabb.max[axis] / pitch_mm[axis]).ceil());
        Self {
            low_mm: [0, 1].map(|axis| first[axis] * pitch_mm[axis]),
            pitch_mm,
            count: [0, 1].map(|axis| (end[axis] - first[axis]).max(1.0) as u32),
        }
    }

    /// Returns the number of pixels of an image.
    pub fn area(&self) -> usize {
        self.count[0] as usize * self.count[1] as usize
    }
}

impl Layers {
    /// Returns the fewest layers of this height (mm) from the platform up to the top of a box.
    pub fn up_to(aabb: &Aabb, height_mm: f64) -> Self {
        // The rounding of a file must not make another layer.
        let count = (aabb.max.z / height_mm - 1e-6).ceil().max(1.0);
        Self {
            low_mm: 0.0,
            height_mm,
            count: count as u32,
        }
    }

    /// Returns the height of the middle of a layer, mm. Its section is what the layer prints.
    pub fn middle_mm(&self, layer: u32) -> f64 {
        self.low_mm + (f64::from(layer) + 0.5) * self.height_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;

    #[test]
    fn pixels_and_layers_cover_a_box_and_start_on_the_machines_own_grid() {
        let aabb = Aabb::of_points(&[Point::new(0.12, -0.3, 0.0), Point::new(1.0, 0.2, 3.0)]);
        let pixels = Pixels::over(&aabb, [0.1, 0.2]);
        assert_eq!(pixels.count, [9, 3]);
        assert!((pixels.low_mm[0] - 0.1).abs() < 1e-12 && (pixels.low_mm[1] + 0.4).abs() < 1e-12);
        assert_eq!(Layers::up_to(&aabb, 0.3).count, 10);
        assert_eq!(Layers::up_to(&aabb, 0.29).count, 11);
    }
}
