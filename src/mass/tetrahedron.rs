//! The moments of a tetrahedron whose density is known: in closed form if it is linear.

use super::moments::Moments;
use super::rule::ConeRule;
use crate::geom::{Matrix, Vector};

/// A tetrahedron, by its four corners in mm.
///
/// Its volume is positive if the last three corners, seen from the first, turn counterclockwise
/// outward. Otherwise it is negative, and so are its moments: that is how cones add up to a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tetrahedron(pub [Vector; 4]);

impl Tetrahedron {
    /// Returns the signed volume, mm³.
    #[inline]
    pub fn volume_mm3(&self) -> f64 {
        let [o, a, b, c] = self.0;
        (a - o).dot(&(b - o).cross(&(c - o))) / 6.0
    }

    /// Returns the signed moments with the density linear between its values at the corners.
    ///
    /// Exact up to rounding, and finite for a tetrahedron without mass. Zeroth and first moments
    /// are eq. 1 and 2 of Bukenberger and Lensch, "Tetrahedra of Varying Density and Their
    /// Applications", The Visual Computer 37, 2021. The second moments follow likewise from
    /// ∫ Π λᵢ^aᵢ = 6V Π aᵢ! / (3 + Σ aᵢ)!.
    #[inline]
    pub fn linear(&self, densities: [f64; 4]) -> Moments {
        let corners = &self.0;
        let volume = self.volume_mm3();
        let density: f64 = densities.iter().sum();
        let sum: Vector = corners.iter().sum();
        let mut weighted = Vector::zeros();
        let mut squares = Matrix::zeros();
        let mut weighted_squares = Matrix::zeros();
        for (corner, d) in corners.iter().zip(densities) {
            let square = corner * corner.transpose();
            weighted += corner * d;
            squares += square;
            weighted_squares += square * d;
        }
        let mixed = sum * weighted.transpose();
        let second = (sum * sum.transpose() + squares) * density
            + mixed
            + mixed.transpose()
            + weighted_squares * 2.0;
        Moments::from_parts(
            volume * density / 4.0,
            &((sum * density + weighted) * (volume / 20.0)),
            &(second * (volume / 120.0)),
        )
    }

    /// Returns the signed moments by a quadrature rule: exact for a density of degree p if the rule
    /// is exact to degree p + 2.
    pub fn by_rule(&self, rule: &ConeRule, density: impl Fn(&Vector) -> f64) -> Moments {
        let [o, a, b, c] = self.0;
        let volume = self.volume_mm3();
        let mut sum = Moments::default();
        for node in rule.nodes() {
            let [l, m, n] = node.shares;
            let at = o * (1.0 - l - m - n) + a * l + b * m + c * n;
            let weight = density(&at) * node.weight * volume;
            sum += Moments(Moments::monomials(at.x, at.y, at.z)) * weight;
        }
        sum
    }

    /// Returns the two halves on either side of the middle of the longest edge; both keep the sign.
    pub fn halves(&self) -> [Self; 2] {
        const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];
        let length = |edge: &[usize; 2]| (self.0[edge[0]] - self.0[edge[1]]).norm_squared();
        let mut longest = EDGES[0];
        for edge in EDGES {
            if length(&edge) > length(&longest) {
                longest = edge;
            }
        }
        let [i, j] = longest;
        let middle = (self.0[i] + self.0[j]) * 0.5;
        let (mut one, mut other) = (*self, *self);
        one.0[j] = middle;
        other.0[i] = middle;
        [one, other]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::random::Random;

    fn random_tetrahedron(random: &mut Random) -> Tetrahedron {
        Tetrahedron([0; 4].map(|_| Vector::from_fn(|_, _| 20.0 * random.between(0.0, 1.0) - 10.0)))
    }

    #[test]
    fn ten_thousand_random_tetrahedra_have_the_moments_that_gauss_finds() {
        // Linear density: the second moments are of degree 3, and 2 points a side reach it.
        let rule = ConeRule::of_degree(3);
        let mut random = Random::new(7);
        for _ in 0..10_000 {
            let tetrahedron = random_tetrahedron(&mut random);
            let slope = Vector::from_fn(|_, _| random.between(0.0, 1.0) - 0.5);
            let density = |at: &Vector| 0.5 + slope.dot(at);
            let exact = tetrahedron.linear(tetrahedron.0.map(|corner| density(&corner)));
            let gauss = tetrahedron.by_rule(&rule, density);
            // The scale of each moment: volume × the largest density × size^degree.
            let volume = tetrahedron.volume_mm3().abs();
            for (index, (exact, gauss)) in exact.0.iter().zip(gauss.0).enumerate() {
                let degree = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2][index];
                let scale = volume * 10.0 * 10f64.powi(degree);
                assert!(
                    (exact - gauss).abs() <= 1e-12 * scale,
                    "{index}: {exact} {gauss}"
                );
            }
        }
    }

    #[test]
    fn a_massless_tetrahedron_has_finite_moments() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let tetrahedron = Tetrahedron(corners.map(Vector::from));
        assert_eq!(tetrahedron.linear([0.0; 4]), Moments::default());
        let balanced = tetrahedron.linear([1.0, -1.0, 0.0, 0.0]);
        assert!(balanced.volume() == 0.0 && balanced.0.iter().all(|m| m.is_finite()));
    }

    #[test]
    fn halves_keep_the_moments_and_the_sign() {
        let mut random = Random::new(11);
        for _ in 0..100 {
            let tetrahedron = random_tetrahedron(&mut random);
            let [one, other] = tetrahedron.halves();
            let whole = tetrahedron.linear([1.0; 4]);
            let both = one.linear([1.0; 4]) + other.linear([1.0; 4]);
            for (whole, both) in whole.0.iter().zip(both.0) {
                assert!((whole - both).abs() < 1e-9, "{whole} {both}");
            }
            assert!(one.volume_mm3() * tetrahedron.volume_mm3() > 0.0);
        }
    }
}
