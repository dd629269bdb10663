//! Points spread evenly over a surface.

use super::TriMesh;
use crate::geom::{Point, Vector};

/// A point of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// Its place, mm.
    pub at: Point,
    /// Index of the triangle that contains it.
    pub triangle: usize,
}

/// Spreads `count` points over the triangles, one for each equal share of their area, in the order
/// of the triangles.
///
/// Counting points estimates a share p of the area to about √(p(1 − p)/count), and better if the
/// share is connected.
///
/// Systematic sampling along the running sum of the areas; within a triangle the points follow the
/// R₂ sequence (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018). The
/// same triangles give the same points.
pub fn spread_points(triangles: &[[Point; 3]], count: usize) -> Vec<SurfacePoint> {
    let areas: Vec<f64> = triangles.iter().map(area_mm2).collect();
    let step = areas.iter().sum::<f64>() / count.max(1) as f64;
    if step <= 0.0 {
        return Vec::new();
    }
    let (mut points, mut passed) = (Vec::with_capacity(count), 0.0);
    for (triangle, area) in areas.iter().enumerate() {
        passed += area;
        while points.len() < count && (points.len() as f64 + 0.5) * step <= passed {
            points.push(SurfacePoint {
                at: inside(&triangles[triangle], points.len()),
                triangle,
            });
        }
    }
    points
}

/// Returns the area of a triangle, mm².
pub fn area_mm2([a, b, c]: &[Point; 3]) -> f64 {
    (b - a).cross(&(c - a)).norm() / 2.0
}

/// Returns the area of all triangles of a mesh, mm².
pub fn surface_mm2(mesh: &TriMesh) -> f64 {
    mesh.iter_corners().map(|corners| area_mm2(&corners)).sum()
}

/// Returns point `index` of the sequence, folded into the triangle.
fn inside([a, b, c]: &[Point; 3], index: usize) -> Point {
    /// The reciprocals of the plastic number and of its square. Their multiples fill a square
    /// most evenly.
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_2];
    let [u, v] = STEPS.map(|step| (0.5 + step * index as f64).fract());
    let (u, v) = if u + v > 1.0 {
        (1.0 - u, 1.0 - v)
    } else {
        (u, v)
    };
    let sides: [Vector; 2] = [b - a, c - a];
    a + sides[0] * u + sides[1] * v
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives;

    #[test]
    fn a_share_of_the_area_is_found_by_counting() {
        // The faces of this box hold 2·(12 + 20 + 15) = 94 mm²; the top one 12 of them.
        let corners: Vec<[Point; 3]> =
            primitives::cuboid(&Point::origin(), &Point::new(3.0, 4.0, 5.0))
                .iter_corners()
                .collect();
        let points = spread_points(&corners, 9400);
        assert_eq!(points.len(), 9400);
        let on_top = points.iter().filter(|p| p.at.z > 4.999).count();
        // Two triangles, each to one point more or less.
        assert!((on_top as i64 - 1200).abs() <= 2, "{on_top}");
        let left = points.iter().filter(|p| p.at.x < 1.5).count() as f64 / 9400.0;
        assert!((left - 0.5).abs() < 0.01, "{left}");
    }

    #[test]
    fn nothing_has_no_points() {
        assert!(spread_points(&[], 10).is_empty());
        assert!(spread_points(&[[Point::origin(); 3]], 10).is_empty());
    }
}
