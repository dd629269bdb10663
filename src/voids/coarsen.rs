//! Coarse copies of surfaces, for a search that needs no more.

use super::decimate::{Rules, Stray};
use super::error::VoidError;
use super::simplify::simplify;
use crate::base::watch::Watch;
use crate::geom::Point;
use crate::mesh::TriMesh;

/// Returns a closed surface with fewer triangles, free of self-intersection. No vertex of `mesh` is
/// farther than `stray_mm` from it.
///
/// It is for a search that decides between plans. What leaves the program is made of true surfaces.
///
/// # Errors
/// The watch was stopped.
pub fn coarsen(mesh: &TriMesh, stray_mm: f64, watch: &Watch) -> Result<TriMesh, VoidError> {
    let stray = Stray {
        outside_mm: stray_mm,
        inside_mm: stray_mm,
    };
    let allows = |_: &[Point; 3]| true;
    let rules = Rules {
        stray,
        allows: &allows,
    };
    simplify(mesh.clone(), rules, watch)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::{MeshDistance, Solid, primitives};

    #[test]
    fn a_coarse_ball_has_fewer_triangles_and_strays_by_no_more_than_asked() {
        let ball = primitives::ball(&Point::origin(), 20.0, 6);
        let coarse = coarsen(&ball, 0.1, &Watch::silent()).unwrap();
        let [many, few] = [&ball, &coarse].map(|mesh| mesh.triangles().len());
        assert!(few < many / 4, "{few} of {many}");
        let surface = MeshDistance::new(&coarse);
        let farthest = ball.vertices().iter().map(|v| surface.signed(v).abs());
        let farthest = farthest.fold(0.0, f64::max);
        assert!(farthest < 0.1 + 1e-9, "{farthest}");
        assert!(Solid::new(coarse).is_ok());
    }
}
