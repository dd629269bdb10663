//! Voids that hold a part: a cut must open them so that the part can be inserted.

use crate::geom::{Plane, Point, Vector};

/// A void that holds a part, a ball or a cylinder about an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Seat {
    /// Its centre, model frame, mm.
    pub center: Point,
    /// The unit axis of a cylinder and half its height, mm; `None` for a ball.
    pub axis: Option<(Vector, f64)>,
    /// The radius of the void, mm.
    pub radius_mm: f64,
    /// The diameter of the part, mm: a disc that must pass through the opening.
    pub opening_mm: f64,
}

impl Seat {
    /// Returns whether a plane opens the void so that the part goes in. A ball must be cut near
    /// enough to its middle. A cylinder must be cut through its side all around, so that the part
    /// slides out along the axis.
    pub(crate) fn is_opened_by(&self, plane: &Plane) -> bool {
        let distance_mm = plane.distance(&self.center).abs();
        let Some((axis, half_mm)) = self.axis else {
            let slack2 = self.radius_mm * self.radius_mm - self.opening_mm * self.opening_mm / 4.0;
            return distance_mm * distance_mm <= slack2;
        };
        // The plane meets the axis at distance/cos. Over the radius its slope takes it higher and
        // lower by radius·sin/cos.
        let cos = plane.normal.dot(&axis).abs();
        let sin = (1.0 - cos * cos).max(0.0).sqrt();
        distance_mm + self.opening_mm / 2.0 * sin <= half_mm * cos
    }

    /// Returns the height of its centre along a direction, mm.
    pub(crate) fn height_mm(&self, normal: &Vector) -> f64 {
        normal.dot(&self.center.coords)
    }
}

/// Returns normals of planes that pass through the centres of several seats, and of planes across
/// the seats' axes.
pub(crate) fn normals(seats: &[&Seat]) -> Vec<Vector> {
    let axes = seats
        .iter()
        .filter_map(|seat| seat.axis.map(|(axis, _)| axis));
    let mut normals: Vec<Vector> = axes.collect();
    for (i, a) in seats.iter().enumerate() {
        for (j, b) in seats.iter().enumerate().skip(i + 1) {
            let along = b.center - a.center;
            normals.extend([0, 1, 2].map(|axis| along.cross(&Vector::ith(axis, 1.0))));
            normals.extend(
                seats[j + 1..]
                    .iter()
                    .map(|c| along.cross(&(c.center - a.center))),
            );
        }
    }
    let is_direction = |normal: &Vector| normal.norm() > LEAST_NORMAL_MM;
    normals
        .into_iter()
        .filter(is_direction)
        .map(|normal| normal.normalize())
        .collect()
}

/// Length below which a normal is rounding, mm or mm²: seats in one place or on one line.
const LEAST_NORMAL_MM: f64 = 1e-6;

#[cfg(test)]
mod tests {
    use super::*;

    fn plane(normal: Vector, offset_mm: f64) -> Plane {
        Plane {
            normal: normal.normalize(),
            offset_mm,
        }
    }

    #[test]
    fn a_ball_goes_in_through_an_opening_as_wide_as_itself() {
        let seat = Seat {
            center: Point::origin(),
            axis: None,
            radius_mm: 2.1,
            opening_mm: 4.0,
        };
        // The opening at distance t has the radius √(2.1² − t²), which is 2 at 0.64.
        assert!(
            seat.is_opened_by(&plane(Vector::x(), 0.63))
                && !seat.is_opened_by(&plane(Vector::x(), 0.65))
        );
    }

    #[test]
    fn a_coin_goes_in_through_a_cut_across_its_axis_only() {
        let axis = Some((Vector::z(), 1.0));
        let seat = Seat {
            center: Point::new(0.0, 0.0, 5.0),
            axis,
            radius_mm: 8.2,
            opening_mm: 16.0,
        };
        assert!(
            seat.is_opened_by(&plane(Vector::z(), 5.5))
                && !seat.is_opened_by(&plane(Vector::z(), 6.1))
        );
        assert!(!seat.is_opened_by(&plane(Vector::x(), 0.0)));
        // With a slope of 1 in 16, the plane rises by half a millimetre over the coin.
        assert!(seat.is_opened_by(&plane(Vector::new(1.0, 0.0, 16.0), 5.0)));
        assert!(!seat.is_opened_by(&plane(Vector::new(1.0, 0.0, 7.0), 5.0 * 7.0 / 50f64.sqrt())));
    }

    #[test]
    fn one_plane_passes_through_any_three_seats() {
        let at = |x, y, z| Seat {
            center: Point::new(x, y, z),
            axis: None,
            radius_mm: 1.1,
            opening_mm: 2.0,
        };
        let seats = [at(1.0, 0.0, 3.0), at(-4.0, 2.0, 1.0), at(0.5, 9.0, -2.0)];
        let passes = |normal: &Vector| {
            let heights = seats.iter().map(|seat| seat.height_mm(normal));
            heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min) < 1e-9
        };
        assert!(normals(&seats.each_ref()).iter().any(passes));
    }
}
