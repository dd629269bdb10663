//! The gap between strands of a tube about a curve.

use std::f64::consts::FRAC_PI_2;

use crate::geom::Point;

/// Returns the least gap between strands of the tube about samples of a curve, mm.
///
/// It is negative if they overlap, and infinite if no two are far enough apart along the curve.
///
/// `radius_mm` is the tube's radius at each sample. Two samples are on different strands if the
/// arc between them is longer than π/2 of both radii: nearer ones belong to one bend. The error is
/// at most one spacing of the samples.
pub fn least_gap_mm(points: &[Point], radius_mm: &[f64]) -> f64 {
    let arcs = arc_lengths(points);
    let strands: Vec<_> = points.iter().zip(radius_mm).zip(&arcs).collect();
    let mut least = f64::INFINITY;
    for (i, ((p, r), arc)) in strands.iter().enumerate() {
        for ((q, s), other) in &strands[..i] {
            if *arc - *other > FRAC_PI_2 * (*r + *s) {
                least = least.min((*p - *q).norm() - (*r + *s));
            }
        }
    }
    least
}

/// Returns the arc length from the first point to each.
fn arc_lengths(points: &[Point]) -> Vec<f64> {
    let steps = points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
    let sums = steps.scan(0.0, |sum, step| {
        *sum += step;
        Some(*sum)
    });
    [0.0].into_iter().chain(sums).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn the_turns_of_a_helix_are_apart_by_its_pitch_less_the_tube() {
        let at = |i: u32| {
            let angle = TAU * f64::from(i) / 200.0;
            Point::new(30.0 * angle.cos(), 30.0 * angle.sin(), 12.0 * angle / TAU)
        };
        let points: Vec<Point> = (0..=600).map(at).collect();
        let gap = least_gap_mm(&points, &[5.0; 601]);
        assert!((gap - 2.0).abs() < 0.05, "{gap}");
    }

    #[test]
    fn a_line_has_one_strand_and_nothing_near_it() {
        let points = [0.0, 10.0, 20.0].map(|x| Point::new(x, 0.0, 0.0));
        let gap = least_gap_mm(&points, &[1.0; 3]);
        assert_eq!(gap, 8.0);
        assert_eq!(least_gap_mm(&points[..1], &[1.0]), f64::INFINITY);
    }
}
