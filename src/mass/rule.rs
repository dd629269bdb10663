//! Quadrature rules for tetrahedra and triangles: products of Gauss–Jacobi rules.

use nalgebra::DMatrix;

/// Points of a Gauss rule on a side of the cone beyond which rounding gains on accuracy.
const MAX_POINTS: usize = 24;

/// A point of a rule on a tetrahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Node {
    /// Barycentric shares of the second, third and fourth corner.
    pub shares: [f64; 3],
    /// Weight, as a share of the tetrahedron's volume.
    pub weight: f64,
}

/// The conical product rule of n³ points on a tetrahedron.
///
/// Exact for polynomials of degree 2n − 1 (Stroud, "Approximate Calculation of Multiple Integrals",
/// 1971, §2.5). All points lie inside and all weights are positive.
#[derive(Debug, Clone, PartialEq)]
pub struct ConeRule(Vec<Node>);

impl ConeRule {
    /// Returns the rule with `points` points a side, at least 1 and at most 24.
    pub fn new(points: usize) -> Self {
        let points = points.clamp(1, MAX_POINTS);
        let [flat, one, two] = [0, 1, 2].map(|power| gauss_jacobi(points, power));
        let mut nodes = Vec::with_capacity(points.pow(3));
        for [t, weight_t] in &two {
            for [u, weight_u] in &one {
                for [v, weight_v] in &flat {
                    nodes.push(Node {
                        shares: [t * (1.0 - u), t * u * (1.0 - v), t * u * v],
                        weight: 6.0 * weight_t * weight_u * weight_v,
                    });
                }
            }
        }
        Self(nodes)
    }

    /// Returns the smallest rule that is exact for polynomials of this degree, up to degree 47.
    pub fn of_degree(degree: usize) -> Self {
        Self::new((degree + 2) / 2)
    }

    /// Returns the points.
    pub fn nodes(&self) -> &[Node] {
        &self.0
    }
}

/// A point of a rule on a triangle: barycentric shares of the second and third corner, and the
/// weight as a share of the area.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FlatNode {
    pub shares: [f64; 2],
    pub weight: f64,
}

/// Returns the conical product rule of n² points on a triangle, exact to degree 2n − 1.
pub(super) fn triangle_rule(points: usize) -> Vec<FlatNode> {
    let [flat, one] = [0, 1].map(|power| gauss_jacobi(points, power));
    let pairs = one.iter().flat_map(|u| flat.iter().map(move |v| [*u, *v]));
    let node = |[[u, weight_u], [v, weight_v]]: [[f64; 2]; 2]| FlatNode {
        shares: [u * (1.0 - v), u * v],
        weight: 2.0 * weight_u * weight_v,
    };
    pairs.map(node).collect()
}

/// Returns the `points` nodes and weights of ∫₀¹ tᵖ f(t) dt with p = `power`, ascending: exact to
/// degree 2 · `points` − 1.
///
/// By the eigenvalues of the Jacobi matrix (Golub, Welsch, "Calculation of Gauss Quadrature Rules",
/// Math. Comp. 23, 1969). Right to about 1e-15.
pub fn gauss_jacobi(points: usize, power: u32) -> Vec<[f64; 2]> {
    let b = f64::from(power);
    let matrix = DMatrix::from_fn(points, points, |i, j| match i.abs_diff(j) {
        0 if i == 0 => b / (b + 2.0),
        0 => b * b / ((2.0 * i as f64 + b) * (2.0 * i as f64 + b + 2.0)),
        1 => side_entry(i.max(j) as f64, b),
        _ => 0.0,
    });
    let eigen = matrix.symmetric_eigen();
    let mut nodes: Vec<[f64; 2]> = (0..points)
        .map(|i| {
            let first = eigen.eigenvectors[(0, i)];
            let weight = first * first / (b + 1.0);
            [0.5 + 0.5 * eigen.eigenvalues[i], weight]
        })
        .collect();
    nodes.sort_by(|one, other| one[0].total_cmp(&other[0]));
    nodes
}

/// Returns the n-th entry beside the diagonal of the Jacobi matrix of the weight (1 + x)ᵇ.
fn side_entry(n: f64, b: f64) -> f64 {
    let sum = 2.0 * n + b;
    let square = 4.0 * n * n * (n + b) * (n + b) / (sum * sum * (sum + 1.0) * (sum - 1.0));
    square.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rules_integrate_powers_to_their_degree() {
        for power in 0..3 {
            for points in 1..=12 {
                let rule = gauss_jacobi(points, power);
                for degree in 0..2 * points as i32 {
                    let sum: f64 = rule.iter().map(|[t, w]| w * t.powi(degree)).sum();
                    let exact = 1.0 / f64::from(power as i32 + degree + 1);
                    assert!((sum - exact).abs() < 2e-14, "{power} {points} {degree}");
                }
            }
        }
    }

    #[test]
    fn the_cone_rules_integrate_monomials_in_barycentric_shares() {
        // ∫ λᵃ μᵇ νᶜ = 6 V a! b! c! / (3 + a + b + c)!
        let factorial = |n: usize| (1..=n).product::<usize>() as f64;
        for degree in 0..9 {
            let rule = ConeRule::of_degree(degree);
            for a in 0..=degree {
                for b in 0..=degree - a {
                    let c = degree - a - b;
                    let term = |node: &Node| {
                        let [l, m, n] = node.shares;
                        node.weight * l.powi(a as i32) * m.powi(b as i32) * n.powi(c as i32)
                    };
                    let sum: f64 = rule.nodes().iter().map(term).sum();
                    let exact =
                        6.0 * factorial(a) * factorial(b) * factorial(c) / factorial(3 + degree);
                    assert!((sum - exact).abs() < 1e-14, "{a} {b} {c}");
                }
            }
        }
    }
}
