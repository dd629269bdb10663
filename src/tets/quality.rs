//! The shapes of the tetrahedra of a mesh.

use super::faces::FACES;
use super::volume::Tets;
use crate::geom::Vector;
use crate::mass::Tetrahedron;

/// Dihedral angle below which a tetrahedron is a sliver, °; likewise above 180° less as much.
pub const SLIVER_DEG: f64 = 5.0;

/// The shapes of the tetrahedra of a mesh. Cells are numbered from 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Quality {
    /// The least angle between two faces of a tetrahedron, °; 70.5 in a regular one.
    pub least_angle_deg: f64,
    /// The tetrahedron with it.
    pub least_angle_cell: usize,
    /// The greatest such angle, °.
    pub greatest_angle_deg: f64,
    /// The least radius ratio: three times the radius of the inscribed ball over that of the
    /// circumscribed one. It is 1 in a regular tetrahedron and near 0 in a flat one.
    pub worst_radius_ratio: f64,
    /// The tetrahedron with it.
    pub worst_radius_cell: usize,
    /// Number of slivers: with an angle below [`SLIVER_DEG`] or above 180° less as much.
    pub slivers: usize,
    /// Length of the shortest edge, mm.
    pub shortest_edge_mm: f64,
    /// Length of the longest edge, mm.
    pub longest_edge_mm: f64,
}

impl Quality {
    /// Measures every tetrahedron.
    pub fn of(tets: &Tets) -> Self {
        let mut quality = Self {
            least_angle_deg: f64::INFINITY,
            least_angle_cell: 0,
            greatest_angle_deg: 0.0,
            worst_radius_ratio: f64::INFINITY,
            worst_radius_cell: 0,
            slivers: 0,
            shortest_edge_mm: f64::INFINITY,
            longest_edge_mm: 0.0,
        };
        for cell in 0..tets.cells().len() {
            quality.add(cell, &tets.tetrahedron(cell));
        }
        quality
    }

    fn add(&mut self, cell: usize, tetrahedron: &Tetrahedron) {
        let (least, greatest) = angles_deg(tetrahedron);
        if least < self.least_angle_deg {
            (self.least_angle_deg, self.least_angle_cell) = (least, cell);
        }
        self.greatest_angle_deg = self.greatest_angle_deg.max(greatest);
        let is_sliver = least < SLIVER_DEG || greatest > 180.0 - SLIVER_DEG;
        self.slivers += usize::from(is_sliver);
        let ratio = radius_ratio(tetrahedron);
        if ratio < self.worst_radius_ratio {
            (self.worst_radius_ratio, self.worst_radius_cell) = (ratio, cell);
        }
        for length_mm in edges_mm(tetrahedron).as_flattened() {
            self.shortest_edge_mm = self.shortest_edge_mm.min(*length_mm);
            self.longest_edge_mm = self.longest_edge_mm.max(*length_mm);
        }
    }
}

/// Returns the least and the greatest angle between two faces, °.
fn angles_deg(tetrahedron: &Tetrahedron) -> (f64, f64) {
    let normals = normals(tetrahedron);
    let (mut least, mut greatest) = (180.0_f64, 0.0_f64);
    for (i, one) in normals.iter().enumerate() {
        for other in &normals[..i] {
            // The angle inside is what is left between the outer normals, to 180°.
            let angle = one.cross(other).norm().atan2(-one.dot(other)).to_degrees();
            least = least.min(angle);
            greatest = greatest.max(angle);
        }
    }
    (least, greatest)
}

/// Returns the outer normals of the faces, each as long as twice the area of its face.
fn normals(Tetrahedron(corners): &Tetrahedron) -> [Vector; 4] {
    FACES.map(|face| {
        let [a, b, c] = face.map(|corner| corners[corner]);
        (b - a).cross(&(c - a))
    })
}

/// Returns three times the radius of the inscribed ball over that of the circumscribed one.
fn radius_ratio(tetrahedron: &Tetrahedron) -> f64 {
    let volume = tetrahedron.volume_mm3();
    let areas: f64 = normals(tetrahedron).iter().map(|n| 0.5 * n.norm()).sum();
    let inscribed = 3.0 * volume / areas;
    // By the products of opposite edges (Crelle).
    let [p, q, r] = edges_mm(tetrahedron).map(|[one, other]| one * other);
    let square = (p + q + r) * (p + q - r) * (p - q + r) * (q + r - p);
    let circumscribed = square.max(0.0).sqrt() / (24.0 * volume);
    3.0 * inscribed / circumscribed
}

/// Returns the lengths of the three pairs of opposite edges, mm.
fn edges_mm(Tetrahedron([a, b, c, d]): &Tetrahedron) -> [[f64; 2]; 3] {
    let pairs = [[(a, b), (c, d)], [(a, c), (b, d)], [(a, d), (b, c)]];
    pairs.map(|pair| pair.map(|(from, to)| (from - to).norm()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron(corners: [[f64; 3]; 4]) -> Tetrahedron {
        Tetrahedron(corners.map(Vector::from))
    }

    #[test]
    fn a_regular_tetrahedron_has_the_best_shape() {
        let regular = tetrahedron([[1., 1., 1.], [1., -1., -1.], [-1., 1., -1.], [-1., -1., 1.]]);
        let (least, greatest) = angles_deg(&regular);
        let exact = (1.0_f64 / 3.0).acos().to_degrees();
        assert!((least - exact).abs() < 1e-12 && (greatest - exact).abs() < 1e-12);
        assert!((radius_ratio(&regular) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_corner_of_a_cube_has_the_angles_of_its_textbook() {
        let corner = tetrahedron([[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]);
        let (least, greatest) = angles_deg(&corner);
        let exact = 2.0_f64.sqrt().atan().to_degrees();
        assert!((least - exact).abs() < 1e-12 && (greatest - 90.0).abs() < 1e-12);
        // r = 1/(3 + √3), R = √3/2.
        let exact = 3.0 / (3.0 + 3.0_f64.sqrt()) / (3.0_f64.sqrt() / 2.0);
        assert!((radius_ratio(&corner) - exact).abs() < 1e-12);
    }

    #[test]
    fn a_tetrahedron_that_is_nearly_a_square_is_a_sliver() {
        let flat = tetrahedron([[0., 0., 0.], [1., 0., 0.01], [1., 1., 0.], [0., 1., 0.01]]);
        let (least, greatest) = angles_deg(&flat);
        assert!(least < SLIVER_DEG && greatest > 175.0 && radius_ratio(&flat).abs() < 0.05);
    }
}
