//! The planes of symmetry of a body, where a print shop would cut it first.

use crate::{
    geom::{Plane, Point, Vector},
    mesh::Solid,
};

/// Greatest number of reflected vertices, taken at even steps from all.
const SAMPLES: usize = 256;
/// Greatest distance of a reflected vertex from the surface, as a share of the model's diagonal.
/// With less, a sculpted figure has no symmetry; with more, an ellipsoid has false planes.
const TOLERANCE_RATIO: f64 = 0.01;

/// Returns the planes of mirror symmetry among those through `center` and normal to `directions`.
/// The tolerance is 1 % of the body's diagonal.
///
/// Every plane of symmetry contains the centre of mass and is normal to a principal axis. So the
/// principal axes can miss one only if two moments are equal.
pub(crate) fn mirror_planes(model: &Solid, center: &Point, directions: &[Vector]) -> Vec<Plane> {
    let (mesh, bvh) = (model.mesh(), model.bvh());
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
    fn a_box_has_three_planes_of_symmetry_and_no_skew_one() {
        let mesh = cuboid(&Point::new(1.0, 2.0, 3.0), &Point::new(11.0, 8.0, 7.0));
        let mesh = Solid::new(mesh).unwrap();
        let center = Point::new(6.0, 5.0, 5.0);
        assert_eq!(mirror_planes(&mesh, &center, &axes()).len(), 3);
        assert!(mirror_planes(&mesh, &center, &[Vector::new(0.6, 0.8, 0.0)]).is_empty());
    }

    #[test]
    fn a_bump_takes_away_the_plane_of_symmetry_below_it() {
        let bumped = ball(&Point::origin(), 10.0, 4).map_vertices(|p| {
            if p.z > 8.0 {
                p + Vector::z() * (p.z - 8.0)
            } else {
                *p
            }
        });
        let bumped = Solid::new(bumped).unwrap();
        let planes = mirror_planes(&bumped, &Point::origin(), &axes());
        assert_eq!(
            planes.iter().map(|plane| plane.normal).collect::<Vec<_>>(),
            axes()[..2]
        );
    }
}
