//! The images of all layers of a mesh.

use super::coverage::Coverage;
use super::grid::{Layers, Pixels};
use super::image::LayerImage;
use super::sections::Sections;
use crate::mesh::TriMesh;

/// A mesh with the pixels and layers that print it.
#[derive(Debug)]
pub struct Stack {
    sections: Sections,
    /// The pixels of each layer.
    pub pixels: Pixels,
    /// The layers.
    pub layers: Layers,
}

impl Stack {
    /// Prepares the images of a closed mesh whose triangles turn outwards, and whose parts do not
    /// overlap. Where they do, a pixel is covered at most once.
    pub fn of(mesh: &TriMesh, pixels: Pixels, layers: Layers) -> Self {
        Self {
            sections: Sections::of(mesh),
            pixels,
            layers,
        }
    }

    /// Returns the image of a layer: the area of the section through its middle in each pixel.
    ///
    /// Exact to some 1e-9 of a pixel. Images may be asked for in any order and on any thread.
    pub fn image(&self, layer: u32) -> LayerImage {
        let mut coverage = Coverage::new(self.pixels);
        let height_mm = self.layers.middle_mm(layer);
        self.sections
            .outline(height_mm, |segment| coverage.add(segment));
        coverage.into_image()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mass::{Moments, moments_of_mesh};
    use crate::mesh::primitives::{ball, cuboid};

    fn stack(mesh: &TriMesh, pitch_mm: f64, layer_mm: f64) -> Stack {
        let aabb = mesh.aabb();
        Stack::of(
            mesh,
            Pixels::over(&aabb, [pitch_mm; 2]),
            Layers::up_to(&aabb, layer_mm),
        )
    }

    fn moments(stack: &Stack) -> Moments {
        let layers = 0..stack.layers.count;
        layers.fold(Moments::default(), |sum, layer| {
            let image = stack.image(layer);
            sum + image.moments(&stack.pixels, &stack.layers, layer)
        })
    }

    #[test]
    fn a_box_between_the_pixels_covers_their_exact_shares() {
        let mesh = cuboid(&Point::new(0.25, 0.5, 0.0), &Point::new(2.5, 1.75, 1.0));
        let stack = stack(&mesh, 1.0, 1.0);
        let shares: Vec<(u32, u32, u32, f64)> = stack.image(0).runs.iter().map(parts).collect();
        let expected = [
            (0, 0, 1, 0.375),
            (0, 1, 2, 0.5),
            (0, 2, 3, 0.25),
            (1, 0, 1, 0.5625),
            (1, 1, 2, 0.75),
            (1, 2, 3, 0.375),
        ];
        assert_eq!(shares, expected);
    }

    fn parts(run: &crate::raster::Run) -> (u32, u32, u32, f64) {
        (run.row, run.first, run.end, run.ratio)
    }

    #[test]
    fn images_have_the_volume_and_centre_of_a_prism_to_rounding() {
        // Turned about z, so that its walls cross pixels in every way.
        let (sin, cos) = 0.3_f64.sin_cos();
        let turned = cuboid(&Point::new(20.0, 3.0, 0.0), &Point::new(33.0, 12.0, 2.0))
            .map_vertices(|p| Point::new(cos * p.x - sin * p.y, sin * p.x + cos * p.y, p.z));
        let found = moments(&stack(&turned, 0.17, 0.25));
        let exact = moments_of_mesh(&turned);
        assert!((found.volume() / exact.volume() - 1.0).abs() < 1e-12);
        let off = found.centroid() - exact.centroid();
        // The share of a pixel says nothing of the place within it.
        assert!(off.norm() < 2e-4, "{off}");
    }

    #[test]
    fn images_of_a_ball_agree_with_it_within_their_layers() {
        let mesh = ball(&Point::new(10.0, 11.0, 8.0), 8.0, 5);
        let exact = moments_of_mesh(&mesh);
        let found = moments(&stack(&mesh, 0.1, 0.05));
        assert!((found.volume() / exact.volume() - 1.0).abs() < 1e-5);
        assert!((found.centroid() - exact.centroid()).norm() < 1e-4);
        let spread = |moments: &Moments| {
            moments
                .translated(&-moments.centroid().coords)
                .second()
                .diagonal()
        };
        let ratio = spread(&found).component_div(&spread(&exact));
        assert!((ratio.add_scalar(-1.0)).amax() < 1e-4, "{ratio}");
    }

    #[test]
    fn an_image_is_painted_in_the_nearest_grey() {
        let mesh = cuboid(&Point::new(0.25, 0.5, 0.0), &Point::new(2.5, 2.0, 1.0));
        let stack = stack(&mesh, 1.0, 1.0);
        let grey = stack.image(0).grey(&stack.pixels);
        // Shares of 3/8, 1/2 and 1/4 in the first row, of 3/4, 1 and 1/2 in the second.
        assert_eq!(grey, [96, 128, 64, 191, 255, 128]);
    }

    #[test]
    fn what_lies_outside_of_the_pixels_is_left_out_and_the_rest_stays_right() {
        let mesh = cuboid(&Point::new(-5.0, -5.0, 0.0), &Point::new(5.0, 5.0, 1.0));
        let pixels = Pixels {
            low_mm: [-2.0, -1.0],
            pitch_mm: [1.0, 1.0],
            count: [3, 2],
        };
        let layers = Layers::up_to(&mesh.aabb(), 1.0);
        let image = Stack::of(&mesh, pixels, layers).image(0);
        let area: f64 = image
            .runs
            .iter()
            .map(|run| run.ratio * f64::from(run.end - run.first))
            .sum();
        assert!((area - 6.0).abs() < 1e-12);
    }
}
