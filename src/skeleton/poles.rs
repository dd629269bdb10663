//! Poles: for each vertex of a surface the centre of the largest ball that touches it from inside.
//!
//! Balls shrink until nothing is inside them: Ma, Bae and Choi, "3D medial axis point approximation
//! using nearest neighbors and the normal field". The Visual Computer 28, 2012.

use rayon::prelude::*;

use super::surface::Surface;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, NO_HINT, Point, Vector};

/// The number of times that a ball is shrunk at most. It takes 3 to 10.
const MOST_SHRINKS: usize = 30;
/// A ball whose nearest surface is within this share of its radius touches it.
const TOUCHES_RATIO: f64 = 1e-3;

/// A ball within a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ball {
    pub center: Point,
    pub radius_mm: f64,
}

/// Returns the pole of every vertex: the largest ball that touches the surface there and holds no
/// other vertex.
///
/// A ball that holds no piece of a facet either would be nothing wherever the surface bends
/// outward.
pub(super) fn poles(surface: &Surface, watch: &Watch) -> Result<Vec<Ball>, Cancelled> {
    let points = Bvh::new(surface.at.iter().map(|at| [*at; 3]));
    let most_mm = 0.5 * points.aabb().size().norm();
    let vertices = 0..surface.at.len() as u32;
    let poles = vertices.into_par_iter().map(|v| {
        watch.check()?;
        let at = surface.place(v);
        let normal = surface.normal(v).try_normalize(0.0);
        let radius_mm = normal.map_or(0.0, |normal| shrink(&points, &at, &normal, most_mm));
        Ok(Ball {
            center: at - normal.unwrap_or_default() * radius_mm,
            radius_mm,
        })
    });
    poles.collect()
}

/// Returns the radius of the ball below a point of the surface that holds none of `points`, mm.
fn shrink(points: &Bvh, at: &Point, normal: &Vector, most_mm: f64) -> f64 {
    let (mut radius_mm, mut hint) = (most_mm, NO_HINT);
    for _ in 0..MOST_SHRINKS {
        let center = at - normal * radius_mm;
        let Some(nearest) = points.closest(&center, radius_mm * (1.0 - TOUCHES_RATIO), &[hint])
        else {
            break;
        };
        let back = at - nearest.point;
        let depth_mm = back.dot(normal);
        let smaller_mm = back.norm_squared() / (2.0 * depth_mm);
        if depth_mm <= 0.0 || smaller_mm >= radius_mm {
            break;
        }
        (radius_mm, hint) = (smaller_mm, nearest.hint);
    }
    radius_mm
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::TriMesh;
    use crate::mesh::primitives::{ball, cylinder, torus};

    fn poles(mesh: &TriMesh) -> Vec<Ball> {
        super::poles(&Surface::of(mesh), &Watch::silent()).unwrap()
    }

    #[test]
    fn the_poles_of_a_ball_lie_at_its_middle() {
        let middle = Point::new(3.0, -1.0, 2.0);
        for pole in poles(&ball(&middle, 10.0, 4)) {
            assert!((pole.center - middle).norm() < 0.5, "{pole:?}");
            assert!((pole.radius_mm - 10.0).abs() < 0.5);
        }
    }

    #[test]
    fn the_poles_of_a_ring_lie_on_the_circle_of_its_tube() {
        for pole in poles(&torus(20.0, 5.0, 96, 48)) {
            let off = pole.center.coords.xy().norm() - 20.0;
            assert!(off.hypot(pole.center.z) < 0.5, "{pole:?}");
        }
    }

    #[test]
    fn no_pole_reaches_far_out_of_a_rod() {
        // A ball passes between the corners of a polygon of 24 by 0.02 mm.
        let rod = cylinder(2.0, 30.0, 24);
        assert!(poles(&rod).iter().all(|pole| pole.radius_mm < 15.1));
    }
}
