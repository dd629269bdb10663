//! Splits the air of a hollowing into separate voids, and leaves those solid that are too small.

use rayon::prelude::*;

use super::error::VoidError;
use super::inscribed::ball_fits;
use crate::base::watch::{Cancelled, Watch};
use crate::mesh::{Solid, TriMesh, bodies, shells, winding_number};

/// The voids of a hollowing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Voids {
    /// The voids as disjoint bodies of air, in descending order of volume.
    pub bodies: Vec<Solid>,
    /// The voids left solid because no ball of the minimum diameter fits into them, as bodies of
    /// air, in descending order of volume.
    pub too_small: Vec<TriMesh>,
    /// Volume of the material that would have floated loose in the voids and was emptied too, mm³.
    pub loose_mm3: f64,
}

impl Voids {
    /// Returns the volume of the voids that are left solid because they are too small, mm³.
    pub fn too_small_mm3(&self) -> f64 {
        self.too_small.iter().map(TriMesh::signed_volume_mm3).sum()
    }
}

/// Volume below which a part is rounding of the boolean engine, mm³: a cube of a hundredth of a
/// millimetre.
const NO_VOLUME_MM3: f64 = 1e-6;

/// Winding number above which a point counts as inside.
const HALF_TURN: f64 = 0.5;

/// Splits `parts` into bodies and sorts out those into which no ball of `min_void_mm` fits.
pub(super) fn split_into_voids(
    parts: &TriMesh,
    min_void_mm: f64,
    watch: &Watch,
) -> Result<Voids, VoidError> {
    let mut by_volume: Vec<(f64, TriMesh)> = bodies(parts)
        .into_iter()
        .map(|body| (body.signed_volume_mm3(), body))
        .collect();
    by_volume.sort_by(|a, b| {
        b.0.total_cmp(&a.0)
            .then_with(|| tie_breaker(&a.1).total_cmp(&tie_breaker(&b.1)))
    });
    let fits_ball = |body: &TriMesh| ball_fits(body, min_void_mm / 2.0, watch);
    let is_large_enough = |(volume, body): &(f64, TriMesh)| {
        Ok(*volume > NO_VOLUME_MM3 && (min_void_mm <= 0.0 || fits_ball(body)?))
    };
    let is_large_enough = by_volume.par_iter().map(is_large_enough);
    let is_large_enough = is_large_enough.collect::<Result<Vec<bool>, Cancelled>>()?;
    let mut voids = Voids::default();
    let mut islands: Vec<TriMesh> = Vec::new();
    for ((_, body), is_large_enough) in by_volume.into_iter().zip(is_large_enough) {
        if islands
            .iter()
            .any(|island| winding_number(island, &body.vertices()[0]).abs() > HALF_TURN)
        {
            continue;
        }
        if is_large_enough {
            let (body, loose) = without_islands(&body);
            voids.bodies.push(Solid::new(body)?);
            islands.extend(loose);
        } else {
            voids.too_small.push(body);
        }
    }
    voids.loose_mm3 = islands
        .iter()
        .map(|island| island.signed_volume_mm3().abs())
        .sum();
    Ok(voids)
}

/// Returns a number that orders bodies of equal volume: the sum of the coordinates of the box's
/// lowest corner.
fn tie_breaker(body: &TriMesh) -> f64 {
    let min = body.aabb().min;
    min.x + min.y + min.z
}

/// Returns the body without the islands that float loose in it, and the islands' surfaces.
fn without_islands(body: &TriMesh) -> (TriMesh, Vec<TriMesh>) {
    let (outward, inward): (Vec<_>, Vec<_>) = shells(body)
        .into_iter()
        .partition(|shell| shell.signed_volume_mm3() > 0.0);
    (
        outward
            .into_iter()
            .fold(TriMesh::default(), |hull, shell| hull.joined(&shell)),
        inward,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split_into_voids(parts: &TriMesh, min_void_mm: f64) -> Voids {
        super::split_into_voids(parts, min_void_mm, &Watch::silent()).unwrap()
    }
    use crate::geom::Point;
    use crate::voids::shapes::{ball, block};

    #[test]
    fn an_island_loose_in_a_void_is_emptied_and_counted() {
        let center = Point::new(4.0, 4.0, 4.0);
        let parts = block([0.0; 3], [8.0; 3]).joined(&ball(center, 2.0, 3).reversed());
        let voids = split_into_voids(&parts, 1.0);
        assert_eq!(voids.bodies.len(), 1);
        assert!((voids.bodies[0].mesh().signed_volume_mm3() - 512.0).abs() < 1e-9);
        let ball_mm3 = ball(center, 2.0, 3).signed_volume_mm3();
        assert!((voids.loose_mm3 - ball_mm3).abs() < 1e-9);
    }

    #[test]
    fn a_void_in_a_loose_island_is_emptied_with_it() {
        let center = Point::new(4.0, 4.0, 4.0);
        let ring = ball(center, 3.0, 3)
            .reversed()
            .joined(&ball(center, 2.0, 3));
        let voids = split_into_voids(&block([0.0; 3], [8.0; 3]).joined(&ring), 1.0);
        assert_eq!(voids.bodies.len(), 1);
        assert!((voids.bodies[0].mesh().signed_volume_mm3() - 512.0).abs() < 1e-9);
    }

    #[test]
    fn a_void_that_holds_no_ball_of_the_minimum_is_left_solid() {
        let parts = block([0.0; 3], [8.0; 3]).joined(&block([10.0, 0.0, 0.0], [11.0, 8.0, 8.0]));
        let voids = split_into_voids(&parts, 2.0);
        assert_eq!((voids.bodies.len(), voids.too_small.len()), (1, 1));
        assert!((voids.too_small_mm3() - 64.0).abs() < 1e-9);
    }
}
