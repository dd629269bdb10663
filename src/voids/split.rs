//! The separate voids of a hollowing, the largest first, without those too small to matter.

use rayon::prelude::*;

use super::inscribed::ball_fits;
use super::{VoidError, Voids};
use crate::mesh::{Solid, TriMesh, bodies, shells, winding_number};

/// Parts of less volume are rounding of the boolean engine, mm³: a cube of a hundredth of a
/// millimetre.
const NO_VOLUME_MM3: f64 = 1e-6;

/// A point is inside a surface that winds around it by more than this many turns.
const HALF_TURN: f64 = 0.5;

/// The bodies of `parts` into which a ball of `min_void_mm` fits, and what was left out.
pub(super) fn voids(parts: &TriMesh, min_void_mm: f64) -> Result<Voids, VoidError> {
    let mut sized: Vec<(f64, TriMesh)> = bodies(parts)
        .into_iter()
        .map(|body| (body.signed_volume_mm3(), body))
        .collect();
    sized.sort_by(|a, b| {
        b.0.total_cmp(&a.0)
            .then_with(|| corner(&a.1).total_cmp(&corner(&b.1)))
    });
    let kept: Vec<bool> = sized
        .par_iter()
        .map(|(volume, body)| {
            *volume > NO_VOLUME_MM3 && (min_void_mm <= 0.0 || ball_fits(body, min_void_mm / 2.0))
        })
        .collect();
    let mut voids = Voids::default();
    let mut islands: Vec<TriMesh> = Vec::new();
    for ((_, body), is_kept) in sized.into_iter().zip(kept) {
        if islands
            .iter()
            .any(|island| winding_number(island, &body.vertices()[0]).abs() > HALF_TURN)
        {
            continue;
        }
        if is_kept {
            let (body, loose) = without_islands(&body);
            voids.bodies.push(Solid::new(body)?);
            islands.extend(loose);
        } else {
            voids.refused.push(body);
        }
    }
    voids.emptied_mm3 = islands
        .iter()
        .map(|island| island.signed_volume_mm3().abs())
        .sum();
    Ok(voids)
}

/// A number by which bodies of equal volume are put in order.
fn corner(body: &TriMesh) -> f64 {
    let min = body.aabb().min;
    min.x + min.y + min.z
}

/// The body without what floats loose in it, and the surfaces of that.
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
    use crate::geom::Point;
    use crate::voids::shapes::{ball, block};

    #[test]
    fn what_floats_loose_in_a_void_is_emptied_and_counted() {
        let center = Point::new(4.0, 4.0, 4.0);
        let parts = block([0.0; 3], [8.0; 3]).joined(&ball(center, 2.0, 3).reversed());
        let voids = voids(&parts, 1.0).unwrap();
        assert_eq!(voids.bodies.len(), 1);
        assert!((voids.bodies[0].mesh().signed_volume_mm3() - 512.0).abs() < 1e-9);
        let ball_mm3 = ball(center, 2.0, 3).signed_volume_mm3();
        assert!((voids.emptied_mm3 - ball_mm3).abs() < 1e-9);
    }

    #[test]
    fn a_void_in_what_floats_loose_is_emptied_with_it() {
        let center = Point::new(4.0, 4.0, 4.0);
        let ring = ball(center, 3.0, 3)
            .reversed()
            .joined(&ball(center, 2.0, 3));
        let voids = voids(&block([0.0; 3], [8.0; 3]).joined(&ring), 1.0).unwrap();
        assert_eq!(voids.bodies.len(), 1);
        assert!((voids.bodies[0].mesh().signed_volume_mm3() - 512.0).abs() < 1e-9);
    }

    #[test]
    fn what_holds_no_ball_of_the_minimum_is_refused() {
        let parts = block([0.0; 3], [8.0; 3]).joined(&block([10.0, 0.0, 0.0], [11.0, 8.0, 8.0]));
        let voids = voids(&parts, 2.0).unwrap();
        assert_eq!((voids.bodies.len(), voids.refused.len()), (1, 1));
        assert!((voids.refused_mm3() - 64.0).abs() < 1e-9);
    }
}
