//! The exact moments of many tetrahedra with densities that are linear in each.

use super::moments::Moments;
use super::of_mesh::MomentSum;
use super::tetrahedron::Tetrahedron;
use crate::geom::Point;

/// Returns the moments of tetrahedra, each with the densities at its four corners.
///
/// In closed form, with compensated sums about a point, best near the middle.
pub fn moments_of_tetrahedra(
    about: &Point,
    tetrahedra: impl IntoIterator<Item = (Tetrahedron, [f64; 4])>,
) -> Moments {
    let mut sum = MomentSum::default();
    for (Tetrahedron(corners), densities) in tetrahedra {
        let near = Tetrahedron(corners.map(|corner| corner - about.coords));
        sum.add(&near.linear(densities));
    }
    sum.total().translated(&about.coords)
}
