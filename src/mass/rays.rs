//! Signed cones whose density is integrated along rays from the apex in closed form.

use rayon::prelude::*;

use super::cones::{Accuracy, Cones, Estimate, EstimateSum, absolute};
use super::moments::Moments;
use super::rule::{FlatNode, triangle_rule};
use super::tetrahedron::Tetrahedron;
use crate::geom::{Matrix, Vector};

/// Points a side of the coarse and the fine rule over a triangle.
const COARSE_AND_FINE: [usize; 2] = [4, 7];
/// Quarterings of a triangle after which its error is accepted.
const MOST_QUARTERINGS: usize = 12;
/// Triangles summed as one unit of work.
const BLOCK: usize = 256;

impl Cones<'_> {
    /// Returns the moments for a density whose integrals along rays from the apex are known.
    ///
    /// `integrals` gets the ray from the apex to a point of the surface, mm. It returns
    /// ∫₀¹ t²⁺ʲ f(apex + t ray) dt for j = 0, 1, 2. Only the directions are left to quadrature:
    /// spectral where the integrals are smooth over a triangle. Triangles are quartered until two
    /// rules agree. A triangle in one plane with the apex adds nothing.
    pub fn along_rays(
        &self,
        accuracy: Accuracy,
        integrals: impl Fn(&Vector) -> [f64; 3] + Sync,
    ) -> Estimate {
        let rules = COARSE_AND_FINE.map(triangle_rule);
        let triangles = self.mesh().triangles();
        let limits = self.limits(accuracy.ratio, triangles.len());
        let most = (accuracy.most_pieces / triangles.len().max(1)).max(1);
        let refine = |cone: Tetrahedron, sum: &mut EstimateSum| {
            let mut pieces = vec![cone];
            let mut left = most;
            for depth in 0..=MOST_QUARTERINGS {
                let mut open = Vec::new();
                for piece in &pieces {
                    let [coarse, fine] =
                        [0, 1].map(|which| measure(piece, &rules[which], &integrals));
                    let error = absolute(&(fine - coarse));
                    let may_open = depth < MOST_QUARTERINGS && left >= 4;
                    if may_open && limits.are_passed(piece.volume_mm3().abs(), &error) {
                        left -= 4;
                        open.extend(quarters(piece));
                    } else {
                        sum.add(&Estimate {
                            moments: fine,
                            error,
                        });
                    }
                }
                pieces = open;
            }
        };
        let block = |triangles| {
            let mut sum = EstimateSum::default();
            self.cones(triangles)
                .for_each(|cone| refine(cone, &mut sum));
            sum.total()
        };
        let blocks: Vec<Estimate> = triangles.par_chunks(BLOCK).map(block).collect();
        let mut total = EstimateSum::default();
        blocks.iter().for_each(|block| total.add(block));
        total.total().translated(&self.apex().coords)
    }
}

/// Returns the moments of a cone by a rule over its triangle.
fn measure(
    cone: &Tetrahedron,
    rule: &[FlatNode],
    integrals: &impl Fn(&Vector) -> [f64; 3],
) -> Moments {
    let [_, a, b, c] = cone.0;
    let (mut zeroth, mut first, mut second) = (0.0, Vector::zeros(), Matrix::zeros());
    for FlatNode {
        shares: [l, m],
        weight,
    } in rule
    {
        let ray = a * (1.0 - l - m) + b * *l + c * *m;
        let along = integrals(&ray);
        zeroth += weight * along[0];
        first += ray * (weight * along[1]);
        second += ray * ray.transpose() * (weight * along[2]);
    }
    let factor = 3.0 * cone.volume_mm3();
    Moments::from_parts(zeroth * factor, &(first * factor), &(second * factor))
}

/// Returns the four cones over the quarters of the triangle.
fn quarters(cone: &Tetrahedron) -> [Tetrahedron; 4] {
    let [o, a, b, c] = cone.0;
    let [ab, bc, ca] = [(a + b) * 0.5, (b + c) * 0.5, (c + a) * 0.5];
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].map(|[a, b, c]| Tetrahedron([o, a, b, c]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::ball;

    #[test]
    fn a_density_along_rays_is_the_same_as_in_place() {
        // f = 1 + |x − apex|²: along a ray of length r, ∫ t²⁺ʲ (1 + r² t²) dt in closed form.
        let mesh = ball(&Point::new(1.0, -2.0, 3.0), 6.0, 3);
        let apex = Point::new(2.0, -1.0, 0.5);
        let cones = Cones::new(&mesh, apex);
        let along = |ray: &Vector| {
            let square = ray.norm_squared();
            [3.0, 4.0, 5.0].map(|power: f64| 1.0 / power + square / (power + 2.0))
        };
        let accuracy = Accuracy {
            ratio: 1e-13,
            most_pieces: 100_000,
        };
        let got = cones.along_rays(accuracy, along);
        let want = cones.piecewise(&[], 2, |at| 1.0 + (at - apex).norm_squared());
        for (got, want) in got.moments.0.iter().zip(want.0) {
            assert!(
                (got - want).abs() < 1e-12 * want.abs().max(1e3),
                "{got} {want}"
            );
        }
    }
}
