//! The separate voids of a hollowing, the largest first, without those too small to matter.

use rayon::prelude::*;

use super::inscribed::ball_fits;
use super::{VoidError, Voids};
use crate::mesh::{Solid, TriMesh, bodies, shells};

/// Parts of less volume are rounding of the boolean engine, mm³: a cube of a hundredth of a millimetre.
const NO_VOLUME_MM3: f64 = 1e-6;

/// The bodies of `parts` into which a ball of `min_void_mm` fits, and what was left out.
pub(super) fn voids(parts: &TriMesh, min_void_mm: f64) -> Result<Voids, VoidError> {
    let mut sized: Vec<(f64, TriMesh)> =
        bodies(parts).into_iter().map(|body| (body.signed_volume_mm3(), body)).collect();
    sized.sort_by(|a, b| b.0.total_cmp(&a.0).then_with(|| corner(&a.1).total_cmp(&corner(&b.1))));
    let kept: Vec<bool> = sized
        .par_iter()
        .map(|(volume, body)| {
            *volume > NO_VOLUME_MM3 && (min_void_mm <= 0.0 || ball_fits(body, min_void_mm / 2.0))
        })
        .collect();
    let mut voids = Voids::default();
    for ((volume, body), is_kept) in sized.into_iter().zip(kept) {
        if is_kept {
            count_islands(&body, &mut voids);
            voids.bodies.push(Solid::new(body)?);
        } else {
            voids.dropped += 1;
            voids.dropped_mm3 += volume;
        }
    }
    Ok(voids)
}

/// A number by which bodies of equal volume are put in order.
fn corner(body: &TriMesh) -> f64 {
    let min = body.aabb().min;
    min.x + min.y + min.z
}

fn count_islands(body: &TriMesh, voids: &mut Voids) {
    for shell in shells(body) {
        let volume = shell.signed_volume_mm3();
        if volume < 0.0 {
            voids.islands += 1;
            voids.islands_mm3 -= volume;
        }
    }
}
