//! Triangulation of polygons by ear clipping.

use robust::{Coord, orient2d};

use crate::geom::{Plane, Point, Vector};

/// Cuts a polygon of n corners, given by their indices, into n − 2 triangles of the same
/// orientation.
///
/// Clips ears in the polygon's own plane (Meisters, "Polygons have ears", Amer. Math. Monthly 82,
/// 1975), so concave polygons come out right. Every corner stays a corner, even on a straight side:
/// the neighbouring faces may use it. If the polygon crosses itself or has no area, what is left at
/// some point becomes a fan. Linear time for convex polygons, quadratic for most, cubic at worst.
pub(crate) fn ear_clip(vertices: &[Point], face: &[u32]) -> Vec<[u32; 3]> {
    let mut ring = face.to_vec();
    let mut triangles = Vec::with_capacity(face.len().saturating_sub(2));
    if ring.len() > 3 {
        let flat = flatten(vertices, face);
        let mut reflex = reflex_corners(&flat);
        let mut places: Vec<usize> = (0..face.len()).collect();
        while let Some(ear) = next_ear(&flat, &places, &reflex) {
            let [before, at, after] = around(places.len(), ear).map(|i| face[places[i]]);
            triangles.push([before, at, after]);
            let cut = places.remove(ear);
            reflex.retain(|&corner| corner != cut);
        }
        ring = places.iter().map(|&i| face[i]).collect();
    }
    triangles.extend((2..ring.len()).map(|i| [ring[0], ring[i - 1], ring[i]]));
    triangles
}

/// Projects the corners along the polygon's normal (Newell's: a sum over all sides).
fn flatten(vertices: &[Point], face: &[u32]) -> Vec<Coord<f64>> {
    let corner = |i: usize| vertices[face[i % face.len()] as usize];
    let first = corner(0);
    let normal: Vector = (0..face.len())
        .map(|i| (corner(i) - first).cross(&(corner(i + 1) - first)))
        .sum();
    let (u, v) = Plane::through(&first, &normal).basis();
    let flat = |i: usize| {
        let arm = corner(i) - first;
        Coord {
            x: u.dot(&arm),
            y: v.dot(&arm),
        }
    };
    (0..face.len()).map(flat).collect()
}

/// The places before, at and after `i` in a ring of `n`.
fn around(n: usize, i: usize) -> [usize; 3] {
    [(i + n - 1) % n, i, (i + 1) % n]
}

/// Returns the corners that are not convex. Only they can lie in an ear, and clipping makes no new
/// ones.
fn reflex_corners(flat: &[Coord<f64>]) -> Vec<usize> {
    let is_convex = |i: usize| {
        let [a, b, c] = around(flat.len(), i).map(|i| flat[i]);
        orient2d(a, b, c) > 0.0
    };
    (0..flat.len()).filter(|&i| !is_convex(i)).collect()
}

/// Returns the first ear of a ring of more than three corners; `None` if there is none.
fn next_ear(flat: &[Coord<f64>], places: &[usize], reflex: &[usize]) -> Option<usize> {
    let n = places.len();
    if n <= 3 {
        return None;
    }
    (0..n).find(|&i| {
        let [a, b, c] = around(n, i).map(|i| flat[places[i]]);
        orient2d(a, b, c) > 0.0 && !reflex.iter().any(|&corner| blocks(flat[corner], [a, b, c]))
    })
}

/// Returns true if `p` lies in the triangle or on its boundary, but not at a corner.
fn blocks(p: Coord<f64>, [a, b, c]: [Coord<f64>; 3]) -> bool {
    p != a
        && p != b
        && p != c
        && [(a, b), (b, c), (c, a)]
            .iter()
            .all(|&(from, to)| orient2d(from, to, p) >= 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(flat: &[(f64, f64)]) -> Vec<Point> {
        // A tilted plane, so that no coordinate can simply be dropped.
        flat.iter()
            .map(|&(x, y)| Point::new(x, y, 0.5 * x - 0.25 * y))
            .collect()
    }

    /// The signed areas of the triangles, seen from above.
    fn areas(vertices: &[Point], triangles: &[[u32; 3]]) -> Vec<f64> {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            ((b - a).cross(&(c - a))).z / 2.0
        };
        triangles.iter().map(area).collect()
    }

    #[test]
    fn a_concave_polygon_is_covered_once() {
        let arrow = points(&[(0.0, 0.0), (4.0, -3.0), (1.0, 0.0), (4.0, 3.0)]);
        for start in 0..4 {
            let face: Vec<u32> = (0..4).map(|i| (i + start) % 4).collect();
            let areas = areas(&arrow, &ear_clip(&arrow, &face));
            assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
            assert!((areas.iter().sum::<f64>() - 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_comb_with_many_teeth_is_covered_once() {
        let mut outline = vec![(0.0, 0.0), (20.0, 0.0)];
        outline.extend((0..10).rev().flat_map(|i| {
            let x = 2.0 * f64::from(i);
            [(x + 2.0, 5.0), (x + 1.0, 1.0)]
        }));
        outline.push((0.0, 5.0));
        let comb = points(&outline);
        let face: Vec<u32> = (0..comb.len() as u32).collect();
        let triangles = ear_clip(&comb, &face);
        let areas = areas(&comb, &triangles);
        assert_eq!(triangles.len(), comb.len() - 2);
        assert!(areas.iter().all(|&a| a > 0.0));
        // Twenty by five, less ten notches two wide and four deep that run to a point.
        assert!((areas.iter().sum::<f64>() - (100.0 - 40.0)).abs() < 1e-9);
    }

    #[test]
    fn stars_of_all_shapes_are_covered_once() {
        for seed in 0..50 {
            let n = 5 + seed % 40;
            let spike = |i: usize| 1.0 + ((i * i * 7 + i * seed * 13) % 11) as f64;
            let turn = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
            let star = points(
                &(0..n)
                    .map(|i| (spike(i) * turn(i).cos(), spike(i) * turn(i).sin()))
                    .collect::<Vec<_>>(),
            );
            let face: Vec<u32> = (0..n as u32).collect();
            let areas = areas(&star, &ear_clip(&star, &face));
            let whole: f64 = (0..n)
                .map(|i| spike(i) * spike((i + 1) % n) * turn(1).sin() / 2.0)
                .sum();
            assert!(
                areas.len() == n - 2 && areas.iter().all(|&a| a >= 0.0),
                "{seed}"
            );
            assert!(
                (areas.iter().sum::<f64>() / whole - 1.0).abs() < 1e-12,
                "{seed}"
            );
        }
    }

    #[test]
    fn a_corner_on_a_straight_side_stays_a_corner() {
        let square = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]);
        let triangles = ear_clip(&square, &[0, 1, 2, 3, 4]);
        let areas = areas(&square, &triangles);
        assert_eq!(triangles.len(), 3);
        assert!(areas.iter().all(|&a| a > 0.0) && (areas.iter().sum::<f64>() - 4.0).abs() < 1e-12);
    }

    #[test]
    fn polygons_without_area_and_short_ones_give_what_they_can() {
        let line = points(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (3.0, 0.0)]);
        assert_eq!(ear_clip(&line, &[0, 1, 2, 3]).len(), 2);
        assert_eq!(ear_clip(&line, &[2, 1, 0]), [[2, 1, 0]]);
        assert!(ear_clip(&line, &[0, 1]).is_empty());
        assert_eq!(ear_clip(&line, &[1, 1, 1, 1, 1]).len(), 3);
    }
}
