//! Closest points and distances of points, segments and triangles, in closed form.

use super::{Point, Vector};

/// The part of a triangle on which a closest point lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Feature {
    /// Inside the face.
    Face,
    /// Inside the edge from corner `i` to corner `i + 1`.
    Edge(u8),
    /// On corner `i`.
    Vertex(u8),
}

/// The point of a triangle closest to a query, with the part of the triangle on which it lies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrianglePoint {
    /// The closest point.
    pub point: Point,
    /// The part of the triangle on which it lies.
    pub feature: Feature,
}

/// Returns the point of the triangle nearest to `p`, by its Voronoi regions. A triangle without
/// area counts as its edges.
///
/// Accurate to a few roundings of the coordinates. Ericson, *Real-Time Collision Detection*, 2005,
/// §5.1.5.
#[inline]
pub fn closest_on_triangle(p: &Point, corners: &[Point; 3]) -> TrianglePoint {
    let [a, b, c] = corners;
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return at_vertex(corners, 0);
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return at_vertex(corners, 1);
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return at_edge(a + ab * (d1 / (d1 - d3)), 0);
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return at_vertex(corners, 2);
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return at_edge(a + ac * (d2 / (d2 - d6)), 2);
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return at_edge(b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), 1);
    }
    let sum = va + vb + vc;
    if sum > 0.0 {
        return TrianglePoint {
            point: a + ab * (vb / sum) + ac * (vc / sum),
            feature: Feature::Face,
        };
    }
    closest_on_edges(p, corners)
}

#[inline]
fn at_vertex(corners: &[Point; 3], i: u8) -> TrianglePoint {
    TrianglePoint {
        point: corners[i as usize],
        feature: Feature::Vertex(i),
    }
}

#[inline]
fn at_edge(point: Point, i: u8) -> TrianglePoint {
    TrianglePoint {
        point,
        feature: Feature::Edge(i),
    }
}

/// Returns the nearest point of the three edges: the answer for a triangle without area.
fn closest_on_edges(p: &Point, corners: &[Point; 3]) -> TrianglePoint {
    let candidate = |i: usize| {
        at_edge(
            closest_on_segment(p, &corners[i], &corners[(i + 1) % 3]),
            i as u8,
        )
    };
    let distance = |c: &TrianglePoint| (c.point - p).norm_squared();
    [candidate(1), candidate(2)]
        .into_iter()
        .fold(candidate(0), |best, other| {
            if distance(&other) < distance(&best) {
                other
            } else {
                best
            }
        })
}

/// Returns the point of the segment from `a` to `b` nearest to `p`.
#[inline]
pub fn closest_on_segment(p: &Point, a: &Point, b: &Point) -> Point {
    let ab = b - a;
    let length_squared = ab.norm_squared();
    if length_squared <= 0.0 {
        return *a;
    }
    a + ab * (ab.dot(&(p - a)) / length_squared).clamp(0.0, 1.0)
}

/// Returns the squared distance between two segments, mm². Ericson 2005, §5.1.9.
#[inline]
pub fn segment_segment_distance_squared(p: [&Point; 2], q: [&Point; 2]) -> f64 {
    let (d1, d2, r) = (p[1] - p[0], q[1] - q[0], p[0] - q[0]);
    let (a, e) = (d1.norm_squared(), d2.norm_squared());
    if a <= 0.0 || e <= 0.0 {
        let (from, line) = if a <= 0.0 { (p[0], q) } else { (q[0], p) };
        return (closest_on_segment(from, line[0], line[1]) - from).norm_squared();
    }
    let (b, c, f) = (d1.dot(&d2), d1.dot(&r), d2.dot(&r));
    let denominator = a * e - b * b;
    let s = if denominator > 0.0 {
        ((b * f - c * e) / denominator).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let t = ((b * s + f) / e).clamp(0.0, 1.0);
    let s = ((b * t - c) / a).clamp(0.0, 1.0);
    (r + d1 * s - d2 * t).norm_squared()
}

/// Returns true if the segment from `a` to `b` passes through the triangle's plane inside it.
/// Touching counts, lying in the plane does not.
///
/// Decided exactly (Shewchuk, "Adaptive Precision Floating-Point Arithmetic", DCG 18, 1997).
fn segment_pierces(a: &Point, b: &Point, corners: &[Point; 3]) -> bool {
    let [u, v, w] = corners;
    let (from, to) = (side(u, v, w, a), side(u, v, w, b));
    if from * to > 0 || (from == 0 && to == 0) {
        return false;
    }
    let turns = [side(a, b, u, v), side(a, b, v, w), side(a, b, w, u)];
    turns.iter().all(|&turn| turn >= 0) || turns.iter().all(|&turn| turn <= 0)
}

/// Returns the side of the plane through `a`, `b` and `c` on which `d` lies: −1, 0 or 1.
#[inline]
fn side(a: &Point, b: &Point, c: &Point, d: &Point) -> i32 {
    let [a, b, c, d] = [a, b, c, d].map(|p| robust::Coord3D {
        x: p.x,
        y: p.y,
        z: p.z,
    });
    let volume = robust::orient3d(a, b, c, d);
    i32::from(volume > 0.0) - i32::from(volume < 0.0)
}

/// Returns the squared distance between the segment from `a` to `b` and the triangle, mm²; zero if
/// they meet.
pub fn segment_triangle_distance_squared(a: &Point, b: &Point, corners: &[Point; 3]) -> f64 {
    if segment_pierces(a, b, corners) {
        return 0.0;
    }
    let to_face = |p: &Point| (closest_on_triangle(p, corners).point - p).norm_squared();
    let to_edge =
        |i: usize| segment_segment_distance_squared([a, b], [&corners[i], &corners[(i + 1) % 3]]);
    (0..3)
        .map(to_edge)
        .fold(to_face(a).min(to_face(b)), f64::min)
}

/// Returns the squared distance between two triangles, mm²; zero if they meet.
///
/// Exact up to rounding: zero if an edge of one passes through the other. Otherwise the least
/// distance of the nine edge pairs and the six corner–face pairs.
pub fn triangle_triangle_distance_squared(s: &[Point; 3], t: &[Point; 3]) -> f64 {
    let edges = |k: usize| (k, (k + 1) % 3);
    if (0..3)
        .map(edges)
        .any(|(i, j)| segment_pierces(&s[i], &s[j], t) || segment_pierces(&t[i], &t[j], s))
    {
        return 0.0;
    }
    disjoint_triangles_distance_squared(s, t)
}

/// Returns the squared distance between two triangles that are known not to meet, mm².
pub fn disjoint_triangles_distance_squared(s: &[Point; 3], t: &[Point; 3]) -> f64 {
    let edges = |k: usize| (k, (k + 1) % 3);
    let mut best = f64::INFINITY;
    for (i, j) in (0..3).map(edges) {
        best = best.min((closest_on_triangle(&s[i], t).point - s[i]).norm_squared());
        best = best.min((closest_on_triangle(&t[i], s).point - t[i]).norm_squared());
        for (k, l) in (0..3).map(edges) {
            best = best.min(segment_segment_distance_squared(
                [&s[i], &s[j]],
                [&t[k], &t[l]],
            ));
        }
    }
    best
}

/// Returns a lower bound of the distance from a triangle to a convex set, mm.
///
/// The distance to a convex set is a convex function. So its tangent plane at `from` (value
/// `distance_mm`, unit gradient `gradient`) lies below it everywhere. Over the triangle, the
/// tangent plane is lowest at a corner.
#[inline]
pub fn tangent_bound(
    from: &Point,
    distance_mm: f64,
    gradient: &Vector,
    corners: &[Point; 3],
) -> f64 {
    let steps = corners.map(|corner| gradient.dot(&(corner - from)));
    distance_mm + steps[0].min(steps[1]).min(steps[2])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn point() -> impl Strategy<Value = Point> {
        prop::array::uniform3(-2.0..2.0f64).prop_map(|[x, y, z]| Point::new(x, y, z))
    }

    fn triangle() -> impl Strategy<Value = [Point; 3]> {
        prop::array::uniform3(point())
    }

    /// Returns points of a triangle on a barycentric grid of `n` steps.
    fn grid(t: &[Point; 3], n: usize) -> Vec<Point> {
        let mut points = Vec::new();
        for i in 0..=n {
            for j in 0..=n - i {
                let (u, v) = (i as f64 / n as f64, j as f64 / n as f64);
                points.push(t[0] + (t[1] - t[0]) * u + (t[2] - t[0]) * v);
            }
        }
        points
    }

    const STEPS: usize = 24;

    /// Returns the largest distance of a point of the triangle from the grid.
    fn spacing(t: &[Point; 3]) -> f64 {
        let longest = (0..3)
            .map(|i| (t[(i + 1) % 3] - t[i]).norm())
            .fold(0.0, f64::max);
        longest / STEPS as f64
    }

    proptest! {
        #[test]
        fn no_point_of_a_grid_is_nearer_than_the_closest_point(p in point(), t in triangle()) {
            let found = closest_on_triangle(&p, &t);
            let distance = (found.point - p).norm();
            let best = grid(&t, STEPS).iter().map(|g| (g - p).norm()).fold(f64::INFINITY, f64::min);
            prop_assert!(distance <= best + 1e-12);
            prop_assert!(distance >= best - spacing(&t));
        }

        #[test]
        fn triangle_distance_agrees_with_a_dense_grid(s in triangle(), t in triangle()) {
            let exact = triangle_triangle_distance_squared(&s, &t).sqrt();
            let best = grid(&s, STEPS)
                .iter()
                .map(|g| (closest_on_triangle(g, &t).point - g).norm())
                .fold(f64::INFINITY, f64::min);
            prop_assert!(exact <= best + 1e-12);
            prop_assert!(exact >= best - spacing(&s));
            let swapped = triangle_triangle_distance_squared(&t, &s).sqrt();
            prop_assert!((exact - swapped).abs() <= 1e-9);
        }

        #[test]
        fn segment_distance_agrees_with_sampling(a in point(), b in point(), t in triangle()) {
            let exact = segment_triangle_distance_squared(&a, &b, &t).sqrt();
            let best = (0..=200)
                .map(|k| a + (b - a) * (f64::from(k) / 200.0))
                .map(|p| (closest_on_triangle(&p, &t).point - p).norm())
                .fold(f64::INFINITY, f64::min);
            prop_assert!(exact <= best + 1e-12);
            prop_assert!(exact >= best - (b - a).norm() / 200.0);
        }

        #[test]
        fn the_tangent_bound_is_below_the_distance(s in triangle(), t in triangle()) {
            let center = Point::from((s[0].coords + s[1].coords + s[2].coords) / 3.0);
            let offset = center - closest_on_triangle(&center, &t).point;
            prop_assume!(offset.norm() > 1e-6);
            let bound = tangent_bound(&center, offset.norm(), &offset.normalize(), &s);
            prop_assert!(bound <= triangle_triangle_distance_squared(&s, &t).sqrt() + 1e-9);
        }
    }

    #[test]
    fn features_are_named_by_the_region_of_the_query() {
        let t = [
            Point::origin(),
            Point::new(1.0, 0.0, 0.0),
            Point::new(0.0, 1.0, 0.0),
        ];
        let feature = |x, y| closest_on_triangle(&Point::new(x, y, 1.0), &t).feature;
        assert_eq!(feature(0.25, 0.25), Feature::Face);
        assert_eq!(feature(0.5, -1.0), Feature::Edge(0));
        assert_eq!(feature(1.0, 1.0), Feature::Edge(1));
        assert_eq!(feature(-1.0, 0.5), Feature::Edge(2));
        assert_eq!(feature(-1.0, -1.0), Feature::Vertex(0));
        assert_eq!(feature(2.0, -0.5), Feature::Vertex(1));
        assert_eq!(feature(-0.5, 2.0), Feature::Vertex(2));
    }

    #[test]
    fn a_triangle_without_area_counts_as_its_longest_edge() {
        let t = [
            Point::origin(),
            Point::new(2.0, 0.0, 0.0),
            Point::new(1.0, 0.0, 0.0),
        ];
        let found = closest_on_triangle(&Point::new(1.5, 1.0, 0.0), &t);
        assert!((found.point - Point::new(1.5, 0.0, 0.0)).norm() < 1e-15);
    }

    #[test]
    fn triangles_in_one_plane_are_apart_unless_they_overlap() {
        // A plane in which rounding leaves no volume exactly zero.
        let at = |u: f64, v: f64| {
            Point::new(
                0.1 * u + 0.3 * v,
                0.7 * u - 0.2 * v,
                0.9 * u + 0.1 * v + 1.0 / 3.0,
            )
        };
        let s = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)];
        let apart = [at(3.0, 0.0), at(4.0, 0.1), at(3.0, 1.3)];
        // The nearest corners are two units of u apart. The sides between them lean by less
        // than a fifth.
        let expected = (at(3.0, 0.0) - at(1.0, 0.0)).norm();
        let found = triangle_triangle_distance_squared(&s, &apart).sqrt();
        assert!(
            found <= expected && found > 0.8 * expected,
            "{found} {expected}"
        );
        let across = [at(0.2, -1.0), at(0.4, -1.0), at(0.3, 2.0)];
        assert!(triangle_triangle_distance_squared(&s, &across) < 1e-24);
    }

    #[test]
    fn crossing_triangles_are_at_distance_zero() {
        let s = [
            Point::origin(),
            Point::new(2.0, 0.0, 0.0),
            Point::new(0.0, 2.0, 0.0),
        ];
        let t = [
            Point::new(0.5, 0.5, -1.0),
            Point::new(0.5, 0.5, 1.0),
            Point::new(5.0, 5.0, 0.5),
        ];
        assert_eq!(triangle_triangle_distance_squared(&s, &t), 0.0);
    }
}
