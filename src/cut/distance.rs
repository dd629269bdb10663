//! The exact distance between a segment and a triangle (Ericson, "Real-Time Collision Detection", 2005, §5.1).

use crate::geom::{Aabb, Point, Vector};

/// Triangles near a cut, ready to be asked for the distance of a segment.
pub(crate) struct Surface {
    triangles: Vec<(Aabb, [Point; 3])>,
}

impl Surface {
    pub(crate) fn new(triangles: impl Iterator<Item = [Point; 3]>) -> Self {
        Self { triangles: triangles.map(|corners| (Aabb::of_points(&corners), corners)).collect() }
    }

    /// Whether every point of the surface is at least `distance_mm` from the segment.
    pub(crate) fn keeps_off(&self, segment: &[Point; 2], distance_mm: f64) -> bool {
        let reach = Aabb::of_points(segment).inflated(distance_mm);
        let near = self.triangles.iter().filter(|(aabb, _)| overlap(aabb, &reach));
        let mut squares = near.map(|(_, corners)| segment_triangle_squared(segment, corners));
        squares.all(|square| square >= distance_mm * distance_mm)
    }
}

fn overlap(a: &Aabb, b: &Aabb) -> bool {
    (0..3).all(|i| a.min[i] <= b.max[i] && b.min[i] <= a.max[i])
}

/// The squared distance between a segment and a triangle, mm².
pub(crate) fn segment_triangle_squared(segment: &[Point; 2], corners: &[Point; 3]) -> f64 {
    if pierces(segment, corners) {
        return 0.0;
    }
    let [a, b, c] = corners;
    let ends = segment.iter().map(|p| point_triangle_squared(p, corners));
    let edges = [[a, b], [b, c], [c, a]].map(|[p, q]| segments_squared(segment, &[*p, *q]));
    ends.chain(edges).fold(f64::INFINITY, f64::min)
}

/// Whether the segment passes through the triangle's inside.
fn pierces([p, q]: &[Point; 2], [a, b, c]: &[Point; 3]) -> bool {
    let normal = (b - a).cross(&(c - a));
    let (from, to) = (normal.dot(&(p - a)), normal.dot(&(q - a)));
    if from * to > 0.0 || from == to {
        return false;
    }
    let meet = p + (q - p) * (from / (from - to));
    inside(&meet, [a, b, c], &normal)
}

/// Whether the foot of `p` in the triangle's plane lies in the triangle.
fn inside(p: &Point, [a, b, c]: [&Point; 3], normal: &Vector) -> bool {
    [(a, b), (b, c), (c, a)].iter().all(|(from, to)| (*to - *from).cross(&(p - *from)).dot(normal) >= 0.0)
}

fn point_triangle_squared(p: &Point, [a, b, c]: &[Point; 3]) -> f64 {
    let normal = (b - a).cross(&(c - a));
    let square = normal.norm_squared();
    if square > 0.0 && inside(p, [a, b, c], &normal) {
        return normal.dot(&(p - a)).powi(2) / square;
    }
    let edges = [[a, b], [b, c], [c, a]];
    edges.map(|[q, r]| point_segment_squared(p, q, r)).into_iter().fold(f64::INFINITY, f64::min)
}

fn point_segment_squared(p: &Point, a: &Point, b: &Point) -> f64 {
    let (along, to_p) = (b - a, p - a);
    let square = along.norm_squared();
    let t = if square > 0.0 { (to_p.dot(&along) / square).clamp(0.0, 1.0) } else { 0.0 };
    (to_p - along * t).norm_squared()
}

/// The squared distance between two segments: inside both where their lines come nearest there, else at an end.
fn segments_squared(first: &[Point; 2], second: &[Point; 2]) -> f64 {
    let ([p, q], [r, s]) = (first, second);
    let (d, e, w) = (q - p, s - r, p - r);
    let (dd, ee, de) = (d.norm_squared(), e.norm_squared(), d.dot(&e));
    let determinant = dd * ee - de * de;
    if determinant > 0.0 {
        let t = (de * e.dot(&w) - ee * d.dot(&w)) / determinant;
        let u = (dd * e.dot(&w) - de * d.dot(&w)) / determinant;
        if (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&u) {
            return (w + d * t - e * u).norm_squared();
        }
    }
    let ends = [
        point_segment_squared(p, r, s),
        point_segment_squared(q, r, s),
        point_segment_squared(r, p, q),
        point_segment_squared(s, p, q),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point> {
        prop::array::uniform3(-1.0..1.0f64).prop_map(Point::from)
    }

    proptest! {
        #[test]
        fn no_pair_of_sampled_points_is_nearer_and_some_pair_is_about_as_near(
            segment in prop::array::uniform2(point()), corners in prop::array::uniform3(point()),
        ) {
            let n = 24;
            let mut least = f64::INFINITY;
            for i in 0..=n {
                let on = segment[0] + (segment[1] - segment[0]) * (f64::from(i) / f64::from(n));
                for j in 0..=n {
                    for k in 0..=n - j {
                        let (s, t) = (f64::from(j) / f64::from(n), f64::from(k) / f64::from(n));
                        let at = corners[0] + (corners[1] - corners[0]) * s + (corners[2] - corners[0]) * t;
                        least = least.min((at - on).norm());
                    }
                }
            }
            let exact = segment_triangle_squared(&segment, &corners).sqrt();
            // Samples miss the nearest points by at most half a step along edges of length up to 2√3, in
            // each of the three parameters.
            let step = 2.0 * 3f64.sqrt() / f64::from(n);
            prop_assert!(exact <= least + 1e-12);
            prop_assert!(exact >= least - 1.5 * step);
        }
    }

    #[test]
    fn a_segment_through_a_triangle_has_no_distance_and_one_above_it_has_its_height() {
        let corners = [Point::origin(), Point::new(4.0, 0.0, 0.0), Point::new(0.0, 4.0, 0.0)];
        let through = [Point::new(1.0, 1.0, -1.0), Point::new(1.0, 1.0, 1.0)];
        let above = [Point::new(1.0, 1.0, 0.5), Point::new(1.5, 1.0, 2.0)];
        assert_eq!(segment_triangle_squared(&through, &corners), 0.0);
        assert!((segment_triangle_squared(&above, &corners) - 0.25).abs() < 1e-15);
    }
}
