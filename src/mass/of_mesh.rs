//! The exact moments of the region that a closed mesh bounds.

use super::moments::Moments;
use crate::geom::{Matrix, Vector};
use crate::mesh::TriMesh;

/// Returns the moments of the region bounded by `mesh`, by the divergence theorem.
///
/// Exact up to rounding for a closed, oriented mesh. Sums are compensated, so the relative error is
/// about 1e-15 for any number of triangles. Triangles turned inward subtract, so a solid with voids
/// is one mesh with the voids reversed. For an open mesh the result has no meaning.
///
/// Each triangle adds the tetrahedron that it spans with the centre of the bounding box. (Tonon,
/// "Explicit exact formulas for the 3-D tetrahedron inertia tensor", J. Math. Stat. 1, 2005.)
pub fn moments_of_mesh(mesh: &TriMesh) -> Moments {
    if mesh.triangles().is_empty() {
        return Moments::default();
    }
    let center = mesh.aabb().center();
    let mut sum = MomentSum::default();
    for corners in mesh.iter_corners() {
        sum.add_tetrahedron(corners.map(|corner| corner - center));
    }
    sum.total().translated(&center.coords)
}

/// A compensated sum of moments.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MomentSum([NeumaierSum; Moments::COUNT]);

impl MomentSum {
    /// Adds the signed moments of the tetrahedron spanned by the origin and three corners.
    #[inline]
    pub fn add_tetrahedron(&mut self, corners: [Vector; 3]) {
        for (sum, term) in self.0.iter_mut().zip(tetrahedron_moments(corners).0) {
            sum.add(term);
        }
    }

    /// Adds moments.
    #[inline]
    pub fn add(&mut self, moments: &Moments) {
        for (sum, term) in self.0.iter_mut().zip(moments.0) {
            sum.add(term);
        }
    }

    /// Returns the sum so far.
    pub fn total(&self) -> Moments {
        Moments(self.0.map(|sum| sum.total()))
    }
}

/// Returns the signed moments of the tetrahedron spanned by the origin and three corners.
#[inline]
fn tetrahedron_moments([a, b, c]: [Vector; 3]) -> Moments {
    let determinant = a.dot(&b.cross(&c));
    let sum = a + b + c;
    let squares: Matrix =
        a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose();
    Moments::from_parts(
        determinant / 6.0,
        &(sum * (determinant / 24.0)),
        &(squares * (determinant / 120.0)),
    )
}

/// A sum that carries its rounding error along (Neumaier, "Rundungsfehleranalyse einiger Verfahren
/// zur Summation endlicher Summen", ZAMM 54, 1974).
#[derive(Debug, Clone, Copy, Default)]
struct NeumaierSum {
    sum: f64,
    error: f64,
}

impl NeumaierSum {
    #[inline]
    fn add(&mut self, term: f64) {
        let next = self.sum + term;
        self.error += if self.sum.abs() >= term.abs() {
            (self.sum - next) + term
        } else {
            (term - next) + self.sum
        };
        self.sum = next;
    }

    fn total(&self) -> f64 {
        self.sum + self.error
    }
}
