//! Flat faces and the films of glue between them.

use serde::{Deserialize, Serialize};

use super::moments::Moments;
use crate::geom::{Matrix, Point, Vector};

/// A flat region by its area, centre and second moments. They determine all mass properties of a
/// thin film on it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FlatFace {
    /// Area, mm².
    pub area_mm2: f64,
    /// Centroid, model frame, mm.
    pub center_mm: [f64; 3],
    /// ∫ (x − centre)(x − centre)ᵀ over the area, mm⁴.
    pub squares_mm4: [[f64; 3]; 3],
}

impl FlatFace {
    /// Returns the face that these triangles cover. Each has a sign: −1 if it is subtracted.
    ///
    /// Closed form: over a triangle of area A with corners v and their sum s, ∫ x xᵀ = A (Σ v vᵀ +
    /// s sᵀ)/12.
    pub fn of_triangles(triangles: impl IntoIterator<Item = ([Point; 3], f64)>) -> Self {
        let (mut area, mut first, mut second) = (0.0, Vector::zeros(), Matrix::zeros());
        for (corners, sign) in triangles {
            let part = sign
                * (corners[1] - corners[0])
                    .cross(&(corners[2] - corners[0]))
                    .norm()
                / 2.0;
            let sum: Vector = corners.iter().map(|p| p.coords).sum();
            let squares: Matrix = corners
                .iter()
                .map(|p| p.coords * p.coords.transpose())
                .sum();
            area += part;
            first += sum * (part / 3.0);
            second += (squares + sum * sum.transpose()) * (part / 12.0);
        }
        if area <= 0.0 {
            return Self::default();
        }
        let center = first / area;
        let squares = second - center * center.transpose() * area;
        Self {
            area_mm2: area,
            center_mm: center.into(),
            squares_mm4: squares.into(),
        }
    }

    /// Returns the moments of a film of this thickness on the face, model frame. The film counts as
    /// a sheet, so thickness²/12 is missing in its second moment across.
    pub fn film(&self, thickness_mm: f64) -> Moments {
        let squares = Matrix::from(self.squares_mm4) * thickness_mm;
        let about_center =
            Moments::from_parts(self.area_mm2 * thickness_mm, &Vector::zeros(), &squares);
        about_center.translated(&Vector::from(self.center_mm))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn a_film_is_a_thin_box_less_its_holes() {
        let square = |low: [f64; 2], high: [f64; 2], sign: f64| {
            let [a, b, c, d] = [[low[0], low[1]], [high[0], low[1]], high, [low[0], high[1]]]
                .map(|[x, y]| Point::new(x, y, 3.0));
            [([a, b, c], sign), ([a, c, d], sign)]
        };
        let face = FlatFace::of_triangles(
            square([1.0, 2.0], [7.0, 5.0], 1.0)
                .into_iter()
                .chain(square([2.0, 3.0], [4.0, 4.0], -1.0)),
        );
        assert!((face.area_mm2 - 16.0).abs() < 1e-12);
        let t = 1e-3;
        let thin = |low: [f64; 2], high: [f64; 2]| {
            moments_of_mesh(&cuboid(
                &Point::new(low[0], low[1], 3.0 - t / 2.0),
                &Point::new(high[0], high[1], 3.0 + t / 2.0),
            ))
        };
        let solid = thin([1.0, 2.0], [7.0, 5.0]) - thin([2.0, 3.0], [4.0, 4.0]);
        for (film, solid) in face.film(t).0.into_iter().zip(solid.0) {
            // The sheet has no thickness, so 16 t · t²/12 = 1.3e-9 mm⁵ is missing across.
            assert!((film - solid).abs() < 2e-9, "{film} {solid}");
        }
        assert_eq!(FlatFace::of_triangles([]), FlatFace::default());
    }
}
