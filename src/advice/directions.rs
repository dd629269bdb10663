//! Directions over the sphere: an even lattice of them, and how they are told apart and printed.

use crate::geom::Vector;

/// Decimals of a printed direction: 0.004°, which moves nothing on a model of a metre by a tenth of
/// a millimetre.
const DECIMALS: i32 = 4;

/// So many directions spread evenly over the sphere, along a spiral whose turns are the golden
/// section apart (Vogel, "A better way to construct the sunflower head", Math. Biosci. 44, 1979, on
/// the sphere).
pub(super) fn lattice(count: usize) -> Vec<Vector> {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let direction = |i: usize| {
        let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
        let (sin, cos) = (std::f64::consts::TAU * (i as f64 / golden).fract()).sin_cos();
        let across = (1.0 - z * z).sqrt();
        Vector::new(across * cos, across * sin, z)
    };
    (0..count).map(direction).collect()
}

/// Whether a unit direction is further from each of the known ones than the angle of this cosine.
pub(super) fn is_new(known: &[Vector], direction: &Vector, cosine: f64) -> bool {
    known.iter().all(|other| other.dot(direction) < cosine)
}

/// The directions without those nearer to an earlier one than the angle of this cosine.
pub(super) fn distinct(directions: Vec<Vector>, cosine: f64) -> Vec<Vector> {
    let mut kept: Vec<Vector> = Vec::new();
    for direction in directions {
        if is_new(&kept, &direction, cosine) {
            kept.push(direction);
        }
    }
    kept
}

/// A unit direction to the decimals it is printed with; of length one to the same.
pub(super) fn rounded_direction(direction: &Vector) -> Vector {
    rounded((*direction).into(), DECIMALS).into()
}

/// Three numbers to so many decimals, without a negative zero.
pub(super) fn rounded(numbers: [f64; 3], decimals: i32) -> [f64; 3] {
    let unit = 10f64.powi(decimals);
    numbers.map(|number| (number * unit).round() / unit + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_direction_has_one_of_the_lattice_near_it() {
        // 200 discs that cover the sphere without overlap would each have the radius acos(1 −
        // 2/200) = 8.1°.
        let known = lattice(200);
        let limit = (2.0 * 8.1_f64).to_radians().cos();
        assert!(
            known
                .iter()
                .all(|direction| (direction.norm() - 1.0).abs() < 1e-14)
        );
        assert!(
            lattice(3001)
                .iter()
                .all(|direction| !is_new(&known, direction, limit))
        );
    }

    #[test]
    fn a_rounded_direction_has_no_negative_zero_and_stays_within_its_decimals() {
        let rounded = rounded_direction(&Vector::new(-1e-6, 0.6, -0.8));
        assert!(rounded.x == 0.0 && rounded.x.is_sign_positive());
        assert!((rounded - Vector::new(0.0, 0.6, -0.8)).norm() < 1e-4);
    }
}
