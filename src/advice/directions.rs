//! Directions over the sphere: an even lattice, distinct directions, and their printed decimals.

use crate::geom::Vector;
use crate::goal::{Request, Up};

/// The decimals of a printed direction: 0.004°, less than a tenth of a millimetre on a model of a
/// metre.
const DECIMALS: i32 = 4;

/// Returns `count` directions spread evenly over the sphere, along a spiral that turns by the
/// golden section. Source: Vogel, "A better way to construct the sunflower head", Math. Biosci. 44,
/// 1979, here on the sphere.
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

/// Returns true if a unit direction is further from each known one than the angle of this cosine.
pub(super) fn is_new(known: &[Vector], direction: &Vector, cosine: f64) -> bool {
    known.iter().all(|other| other.dot(direction) < cosine)
}

/// Removes the directions that are nearer to an earlier one than the angle of this cosine.
pub(super) fn distinct(directions: Vec<Vector>, cosine: f64) -> Vec<Vector> {
    let mut kept: Vec<Vector> = Vec::new();
    for direction in directions {
        if is_new(&kept, &direction, cosine) {
            kept.push(direction);
        }
    }
    kept
}

/// Rounds a unit direction to the decimals it is printed with. Its length stays one to these
/// decimals.
pub(super) fn round_direction(direction: &Vector) -> Vector {
    round_to((*direction).into(), DECIMALS).into()
}

/// Rounds three numbers to this many decimals, without a negative zero.
pub(super) fn round_to(numbers: [f64; 3], decimals: i32) -> [f64; 3] {
    let unit = 10f64.powi(decimals);
    numbers.map(|number| (number * unit).round() / unit + 0.0)
}

/// The angle up to which two axes are one, degrees. Rounding of printed directions turns them by
/// less than 0.01°, and nobody sets a model up so exactly.
const SAME_AXIS_DEG: f64 = 0.05;

/// Returns true if an axis this far from another, degrees, is not the same.
pub(super) fn is_turned(off_deg: f64) -> bool {
    off_deg > SAME_AXIS_DEG
}

/// A direction this near to a coordinate axis is named by it: cos 10°.
const ALONG_COSINE: f64 = 0.985;

/// Returns the name of the coordinate axis that a unit direction is near, such as "+x"; `None` if
/// it is near none.
fn name_of_axis(unit: &Vector) -> Option<String> {
    let largest = unit.iamax();
    let sign = if unit[largest] > 0.0 { '+' } else { '−' };
    let is_near = unit[largest].abs() >= ALONG_COSINE;
    is_near.then(|| format!("{sign}{}", ["x", "y", "z"][largest]))
}

/// Returns a word such as "nearly +z" for a direction near a coordinate axis, but not on it.
/// `None` for any other. Nobody sees from cosines where a direction points.
pub(super) fn nearly_words(direction: &Vector) -> Option<String> {
    let unit = direction.normalize();
    let is_on = unit.iter().filter(|part| **part != 0.0).count() == 1;
    let name = name_of_axis(&unit).filter(|_| !is_on);
    name.map(|name| format!("nearly {name}"))
}

/// Returns a word such as "+x", or the unit vector.
pub(super) fn direction_words(direction: &Vector) -> String {
    let unit = direction.normalize();
    name_of_axis(&unit).unwrap_or_else(|| format!("({:.2}, {:.2}, {:.2})", unit.x, unit.y, unit.z))
}

/// Returns the request with this axis.
pub(super) fn with_axis(request: &Request, axis: &Vector) -> Request {
    Request {
        up: Up::Along((*axis).into()),
        ..*request
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_near_an_axis_is_named_by_it() {
        assert_eq!(direction_words(&Vector::new(0.1, -3.0, 0.1)), "−y");
        assert_eq!(
            direction_words(&Vector::new(3.0, 0.0, 4.0)),
            "(0.60, 0.00, 0.80)"
        );
        let nearly = Vector::new(0.0583, 0.0832, 0.9948);
        assert_eq!(nearly_words(&nearly).as_deref(), Some("nearly +z"));
        assert_eq!(nearly_words(&Vector::z()), None);
        assert_eq!(nearly_words(&Vector::new(3.0, 0.0, 4.0)), None);
    }

    #[test]
    fn a_printed_direction_is_not_turned_from_itself() {
        let exact = Vector::new(-0.851_93, 0.123_45, 0.508_9).normalize();
        let off_deg = round_direction(&exact).angle(&exact).to_degrees();
        assert!(off_deg > 0.0 && !is_turned(off_deg), "{off_deg}");
        assert!(is_turned(0.1));
    }

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
        let rounded = round_direction(&Vector::new(-1e-6, 0.6, -0.8));
        assert!(rounded.x == 0.0 && rounded.x.is_sign_positive());
        assert!((rounded - Vector::new(0.0, 0.6, -0.8)).norm() < 1e-4);
    }
}
