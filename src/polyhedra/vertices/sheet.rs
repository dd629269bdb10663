//! The rectangle of a sheet into which every face must go: a penalty for what stands out.

use crate::geom::{Point, Vector};

/// Step of differences, over the scale.
const STEP_RATIO: f64 = 1e-6;
/// Length by which rounding may make a face larger than the sheet, mm.
const ROUNDING_MM: f64 = 1e-6;

/// The usable rectangle of a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sheet {
    /// Its sides, mm.
    pub room_mm: [f64; 2],
}

impl Sheet {
    /// Returns true if a face fits. `normal` is that of its plane.
    pub fn holds(&self, face: &[Point], normal: &Vector) -> bool {
        self.excess_mm2(face, normal) <= ROUNDING_MM * ROUNDING_MM
    }

    /// Returns the squares of the lengths by which a face stands out of the sheet, mm². It lies in
    /// the best of those turns in which an edge is parallel to the sheet's.
    fn excess_mm2(&self, face: &[Point], normal: &Vector) -> f64 {
        let [short, long] = sorted(self.room_mm);
        let ways = (0..face.len()).filter_map(|k| {
            let along = (face[(k + 1) % face.len()] - face[k]).try_normalize(0.0)?;
            let sides = [along, normal.cross(&along)].map(|way| extent_mm(face, &way));
            let [low, high] = sorted(sides);
            Some((low - short).max(0.0).powi(2) + (high - long).max(0.0).powi(2))
        });
        ways.reduce(f64::min).unwrap_or(0.0)
    }

    /// Returns the penalty of a face, and its gradient at each of its corners. The normal counts as
    /// fixed, and lengths are over a scale.
    pub fn penalty(&self, face: &[Point], normal: &Vector, scale_mm: f64) -> (f64, Vec<Vector>) {
        let mut own = face.to_vec();
        let unit_mm2 = scale_mm * scale_mm;
        let energy = self.excess_mm2(&own, normal) / unit_mm2;
        let mut gradient = vec![Vector::zeros(); own.len()];
        if energy <= 0.0 {
            return (0.0, gradient);
        }
        let step_mm = STEP_RATIO * scale_mm;
        for place in 0..own.len() {
            for axis in 0..3 {
                let value = own[place][axis];
                let [low, high] = [-step_mm, step_mm].map(|step_mm| {
                    own[place][axis] = value + step_mm;
                    self.excess_mm2(&own, normal) / unit_mm2
                });
                own[place][axis] = value;
                gradient[place][axis] = (high - low) / (2.0 * step_mm);
            }
        }
        (energy, gradient)
    }
}

fn sorted([a, b]: [f64; 2]) -> [f64; 2] {
    [a.min(b), a.max(b)]
}

/// Returns the extent of points along a direction, mm.
fn extent_mm(points: &[Point], along: &Vector) -> f64 {
    let places = points.iter().map(|p| along.dot(&p.coords));
    let [low, high] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    });
    high - low
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_face_fits_a_sheet_in_its_best_turn_and_is_pulled_in_where_it_stands_out() {
        let turn = 0.4_f64;
        let at = |x: f64, y: f64| {
            let (sine, cosine) = turn.sin_cos();
            Point::new(x * cosine - y * sine, x * sine + y * cosine, 7.0)
        };
        let face = [at(0.0, 0.0), at(40.0, 0.0), at(40.0, 90.0), at(0.0, 90.0)];
        let up = Vector::z();
        let sheet = |x: f64, y: f64| Sheet { room_mm: [x, y] };
        assert!(sheet(90.0, 40.0).holds(&face, &up) && sheet(40.0, 90.0).holds(&face, &up));
        assert!(!sheet(89.0, 40.0).holds(&face, &up) && !sheet(90.0, 39.0).holds(&face, &up));
        let (energy, gradient) = sheet(80.0, 40.0).penalty(&face, &up, 10.0);
        assert!((energy - 1.0).abs() < 1e-9, "{energy}");
        // The far corners are pulled back along the long side, the others the other way.
        let long = at(0.0, 1.0) - at(0.0, 0.0);
        let pulls: Vec<f64> = gradient.iter().map(|slope| slope.dot(&long)).collect();
        assert!(
            pulls[2] + pulls[3] > 0.1 && pulls[0] + pulls[1] < -0.1,
            "{pulls:?}"
        );
        let (none, gradient) = sheet(90.1, 40.1).penalty(&face, &up, 10.0);
        assert!(none == 0.0 && gradient.iter().all(|slope| *slope == Vector::zeros()));
    }
}
