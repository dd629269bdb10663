//! The planes of symmetry of a body: where a print shop would cut it first.

use crate::{
    geom::{Bvh, Plane, Point, Vector},
    mesh::TriMesh,
};

/// Vertices that are reflected, at most: they are taken evenly from all.
const SAMPLES: usize = 256;
/// How far a reflected vertex may lie off the surface, as a share of the model's diagonal. Less,
/// and a sculpted figure has no symmetry; more, and an ellipsoid has planes that it has not.
const TOLERANCE_RATIO: f64 = 0.01;

/// Those of the planes through `center` normal to `directions` in which the body that a mesh bounds
/// is its own mirror image, to a hundredth of its diagonal.
///
/// Every plane of symmetry holds the centre of mass and is normal to a principal axis, so that the
/// principal axes miss one only where two moments are equal.
pub(crate) fn mirror_planes(mesh: &TriMesh, center: &Point, directions: &[Vector]) -> Vec<Plane> {
    let bvh = Bvh::new(mesh.iter_corners());
    let farthest_mm = TOLERANCE_RATIO * mesh.aabb().size().norm();
    let samples: Vec<Point> = mesh
        .vertices()
        .iter()
        .step_by(mesh.vertices().len().div_ceil(SAMPLES).max(1))
        .copied()
        .collect();
    let is_mirror = |plane: &Plane| {
        samples.iter().all(|p| {
            let image = p - plane.normal * (2.0 * plane.distance(p));
            bvh.closest(&image, farthest_mm, &[]).is_some()
        })
    };
    directions
        .iter()
        .map(|normal| Plane::through(center, normal))
        .filter(is_mirror)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::{ball, cuboid};

    fn axes() -> [Vector; 3] {
        [0, 1, 2].map(|i| Vector::ith(i, 1.0))
    }

    #[test]
    fn a_box_is_its_own_image_in_three_planes_and_not_in_a_skew_one() {
        let mesh = cuboid(&Point::new(1.0, 2.0, 3.0), &Point::new(11.0, 8.0, 7.0));
        let center = Point::new(6.0, 5.0, 5.0);
        assert_eq!(mirror_planes(&mesh, &center, &axes()).len(), 3);
        assert!(mirror_planes(&mesh, &center, &[Vector::new(0.6, 0.8, 0.0)]).is_empty());
    }

    #[test]
    fn a_ball_with_a_bump_has_lost_the_plane_that_the_bump_is_above() {
        let bumped = ball(&Point::origin(), 10.0, 4).map_vertices(|p| {
            if p.z > 8.0 {
                p + Vector::z() * (p.z - 8.0)
            } else {
                *p
            }
        });
        let planes = mirror_planes(&bumped, &Point::origin(), &axes());
        assert_eq!(
            planes.iter().map(|plane| plane.normal).collect::<Vec<_>>(),
            axes()[..2]
        );
    }
}
