//! The residual unbalance of a rotor: static, couple, and in the planes at its two ends.

use serde::{Deserialize, Serialize};

use crate::geom::{Frame, Vector};
use crate::mass::Moments;
use crate::mesh::TriMesh;

/// The speed of a rotor, and the balance quality grade that was ordered.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RotorOrder {
    /// The service speed, rpm.
    pub speed_rpm: f64,
    /// The ISO 21940-11 balance quality grade at that speed, mm/s.
    pub grade_mm_s: f64,
}

impl RotorOrder {
    /// Returns the unbalance that the grade allows in each of two planes to a rotor of this mass
    /// (ISO 21940-11), g·mm.
    pub fn allowed_g_mm(&self, mass_g: f64) -> f64 {
        let omega_rad_s = self.speed_rpm * std::f64::consts::TAU / 60.0;
        0.5 * mass_g * self.grade_mm_s / omega_rad_s
    }
}

/// The residual unbalance of a body about its axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Unbalance {
    /// Mass times the distance of the centre of mass from the axis, g·mm.
    pub static_g_mm: f64,
    /// The couple unbalance about the centre of mass: the products of inertia with the axis, g·mm².
    pub couple_g_mm2: f64,
    /// The larger of the two unbalances in the end planes, g·mm. Together they are equivalent to
    /// the static and the couple unbalance.
    pub end_plane_g_mm: f64,
    /// The balance quality grade e·ω, mm/s (ISO 21940-11, tolerance halved between two planes).
    ///
    /// Here e is twice the larger end-plane unbalance over the mass. A purely static unbalance in
    /// the middle thus counts with its own offset.
    pub grade_mm_s: f64,
}

impl Unbalance {
    /// Returns the unbalance of a body with these moments (goal frame) and this density. The two
    /// planes lie at the given heights along z, mm.
    pub fn new(
        moments: &Moments,
        density_g_mm3: f64,
        [a, b]: [f64; 2],
        order: &RotorOrder,
    ) -> Self {
        let [volume, x, y, z, _, yz, xz, ..] = moments.0.map(|moment| moment * density_g_mm3);
        let (sum, product) = (Vector::new(x, y, 0.0), Vector::new(xz, yz, 0.0));
        let center_mm = z / volume;
        let planes = [(sum * b - product) / (b - a), (product - sum * a) / (b - a)];
        let end_plane_g_mm = planes
            .map(|plane| plane.norm())
            .into_iter()
            .fold(0.0, f64::max);
        let omega_rad_s = order.speed_rpm * std::f64::consts::TAU / 60.0;
        Self {
            static_g_mm: sum.norm(),
            couple_g_mm2: (product - sum * center_mm).norm(),
            end_plane_g_mm,
            grade_mm_s: 2.0 * end_plane_g_mm / volume * omega_rad_s,
        }
    }
}

/// Returns the lowest and the highest coordinate of a surface along the frame's axis, mm.
pub fn ends_mm(mesh: &TriMesh, frame: &Frame) -> [f64; 2] {
    let along = mesh
        .vertices()
        .iter()
        .map(|vertex| frame.to_local(vertex).z);
    along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], z| {
        [low.min(z), high.max(z)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Matrix;

    const ORDER: RotorOrder = RotorOrder {
        speed_rpm: 3000.0,
        grade_mm_s: 2.5,
    };

    /// Returns the moments of small balls with these masses and places, 1 g/mm³.
    fn balls(places: &[(f64, [f64; 3])]) -> Moments {
        let ball = |&(mass, at): &(f64, [f64; 3])| {
            Moments::from_parts(mass, &Vector::zeros(), &Matrix::zeros())
                .translated(&Vector::from(at))
        };
        places
            .iter()
            .map(ball)
            .fold(Moments::default(), |sum, ball| sum + ball)
    }

    #[test]
    fn a_grade_allows_half_of_its_unbalance_in_each_plane() {
        // G 6.3 at 3000 rpm: 20.05 µm of offset; of 100 g, 1.0027 g·mm in each of two planes.
        let order = RotorOrder {
            speed_rpm: 3000.0,
            grade_mm_s: 6.3,
        };
        assert!((order.allowed_g_mm(100.0) - 1.002_676).abs() < 1e-6);
    }

    #[test]
    fn a_disc_a_hundredth_of_a_millimetre_off_has_the_grade_of_the_standards_formula() {
        // 200 g with e = 0.01 mm: U = 2 g·mm, G = e ω = 0.01 · 100 π = 3.1416 mm/s.
        let got = Unbalance::new(
            &balls(&[(200.0, [0.006, 0.008, 0.0])]),
            1.0,
            [-5.0, 5.0],
            &ORDER,
        );
        assert!((got.static_g_mm - 2.0).abs() < 1e-12 && got.couple_g_mm2.abs() < 1e-12);
        assert!((got.grade_mm_s - std::f64::consts::PI).abs() < 1e-12);
        assert!((got.end_plane_g_mm - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_pure_couple_is_seen_though_the_centre_is_on_the_axis() {
        // 3 g at ±2 mm off the axis, 20 mm apart along it: U₁ = 3·2 = 6 g·mm in each plane, couple
        // 120 g·mm².
        let pair = balls(&[
            (3.0, [2.0, 0.0, -10.0]),
            (3.0, [-2.0, 0.0, 10.0]),
            (94.0, [0.0; 3]),
        ]);
        let got = Unbalance::new(&pair, 1.0, [-10.0, 10.0], &ORDER);
        assert!(got.static_g_mm < 1e-12 && (got.couple_g_mm2 - 120.0).abs() < 1e-12);
        assert!((got.end_plane_g_mm - 6.0).abs() < 1e-12);
        // The couple does not depend on the planes; their unbalances grow as they come closer.
        let near = Unbalance::new(&pair, 1.0, [-2.5, 2.5], &ORDER);
        assert!(
            (near.couple_g_mm2 - 120.0).abs() < 1e-12 && (near.end_plane_g_mm - 24.0).abs() < 1e-12
        );
    }
}
