//! Grows bodies on all sides, so that a void left solid stays solid with a little around it.

use super::VoidError;
use super::extract::Extractor;
use super::field::Resolution;
use super::wall_field::WallField;
use crate::base::watch::Watch;
use crate::geom::Bvh;
use crate::mesh::TriMesh;

/// Finest cell, as a share of the margin. Finer cells make triangles that nobody needs: the surface
/// only has to clear the bodies.
const FINEST_RATIO: f64 = 0.5;

/// Largest cell near the surface, as a share of the margin.
const COARSE_RATIO: f64 = 1.0;

/// Largest distance of a chord from the grown surface, as a share of the margin.
const STRAY_RATIO: f64 = 0.4;

/// Returns a body that holds the closed `bodies` and everything within about `margin_mm` of them;
/// it is exact within half the margin.
///
/// A void too small for one quadric can so be kept solid for all quadrics that differ little. The
/// margin must exceed the distance by which surfaces move when the quadric is solved for again.
pub fn grow_bodies(bodies: &TriMesh, margin_mm: f64, watch: &Watch) -> Result<TriMesh, VoidError> {
    let surface = Bvh::new(bodies.iter_corners());
    let coarse_mm = COARSE_RATIO * margin_mm;
    let field = WallField {
        surface: &surface,
        keeps: &[],
        iso_mm: -margin_mm,
        keep_margin_mm: 0.0,
        coarse_mm,
    };
    let resolution = Resolution {
        finest_mm: FINEST_RATIO * margin_mm,
        crease_mm: FINEST_RATIO * margin_mm,
        outside_mm: STRAY_RATIO * margin_mm,
        inside_mm: STRAY_RATIO * margin_mm,
    };
    let aabb = surface.aabb().inflated(2.0 * margin_mm);
    let mut extractor = Extractor::new(&field, &aabb, resolution, watch)?;
    let leaves = extractor.leaves();
    extractor.refine(leaves)?;
    extractor.mesh()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::MeshDistance;
    use crate::voids::shapes::{ball, block};

    #[test]
    fn a_grown_body_clears_the_body_by_about_the_margin() {
        let bodies =
            block([0.0; 3], [8.0, 0.2, 5.0]).joined(&ball(Point::new(4.0, 6.0, 2.0), 1.0, 3));
        let grown = grow_bodies(&bodies, 0.3, &Watch::silent()).unwrap();
        let distance = MeshDistance::new(&bodies);
        for p in grown.vertices() {
            // Vertices lie on the surface itself; triangles sag by up to four tenths.
            assert!((distance.signed(p) + 0.3).abs() < 1e-3, "{p}");
        }
        let clearance_mm = distance.min_distance_to(&grown);
        assert!(clearance_mm > 0.3 * 0.5, "{clearance_mm}");
        assert!(grown.signed_volume_mm3() > bodies.signed_volume_mm3());
    }
}
