//! The centripetal Catmull–Rom spline through points.

use crate::geom::Point;

/// Edges that stand for the spline between two points: the sagitta of an edge is then 1/256 of that
/// of the whole.
const EDGES: usize = 16;

/// Points of the spline through all of the points, which are checked. The ends are continued by
/// mirror images of their neighbours.
pub(super) fn through(points: &[Point]) -> Vec<Point> {
    let last = points.len() - 1;
    let before = points[0] + (points[0] - points[1]);
    let after = points[last] + (points[last] - points[last - 1]);
    let control = |i: usize| match i {
        0 => before,
        i if i > last + 1 => after,
        i => points[i - 1],
    };
    let spans = (0..last).flat_map(|i| {
        let corners = [control(i), control(i + 1), control(i + 2), control(i + 3)];
        (0..EDGES).map(move |step| span_point(&corners, step as f64 / EDGES as f64))
    });
    spans.chain([points[last]]).collect()
}

/// Returns the point at a share of the span between the second and the third point.
///
/// Barry and Goldman, "A recursive evaluation algorithm for a class of Catmull-Rom splines", 1988.
fn span_point(p: &[Point; 4], share: f64) -> Point {
    // Centripetal: knots apart by the square root of the distance.
    let gap = |i: usize| (p[i + 1] - p[i]).norm().sqrt();
    let knots = [0.0, gap(0), gap(0) + gap(1), gap(0) + gap(1) + gap(2)];
    let at = knots[1] + share * (knots[2] - knots[1]);
    let mix = |a: Point, b: Point, from: f64, to: f64| a + (b - a) * ((at - from) / (to - from));
    let [a, b, c] = [0, 1, 2].map(|i| mix(p[i], p[i + 1], knots[i], knots[i + 1]));
    let left = mix(a, b, knots[0], knots[2]);
    let right = mix(b, c, knots[1], knots[3]);
    mix(left, right, knots[1], knots[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spline_passes_through_every_point() {
        let points: Vec<Point> = (0..7)
            .map(|i| {
                let t = f64::from(i);
                Point::new(t * t, (1.3 * t).sin(), 0.2 * t)
            })
            .collect();
        let spline = through(&points);
        assert_eq!(spline.len(), 6 * EDGES + 1);
        for (i, point) in points.iter().enumerate() {
            assert!((spline[i * EDGES] - point).norm() < 1e-12);
        }
    }

    #[test]
    fn the_spline_through_a_circle_is_nearly_round() {
        let points: Vec<Point> = (0..=24)
            .map(|i| {
                let angle = f64::from(i) * 15f64.to_radians();
                Point::new(angle.cos(), angle.sin(), 0.0)
            })
            .collect();
        let inner = &through(&points)[EDGES..23 * EDGES];
        let off = inner.iter().map(|p| (p.coords.norm() - 1.0).abs());
        assert!(off.fold(0.0, f64::max) < 3e-4);
    }

    #[test]
    fn points_on_a_line_keep_the_line() {
        let points = [0.0, 1.0, 10.0, 11.0].map(|x| Point::new(x, 2.0 * x, 0.0));
        assert!(
            through(&points)
                .iter()
                .all(|p| (p.y - 2.0 * p.x).abs() < 1e-12)
        );
    }
}
