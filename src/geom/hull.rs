//! Convex hulls in a plane.

use robust::{Coord, orient2d};

/// Turns flatter than this part of the squared extent count as straight: a hull corner there is
/// rounding.
const STRAIGHT_RATIO: f64 = 1e-12;

/// Returns the convex hull, counterclockwise, without repeated corners and without those that are
/// straight but for rounding. Points on a line give its two ends.
///
/// Corners with the same x but for rounding are the hard case: the next one may lie before the
/// last. So the turns are exact, and what is nearly straight goes only afterwards, in the order of
/// the ring.
pub fn convex_hull(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let ring = strict_hull(points);
    if ring.len() < 3 {
        return ring;
    }
    let straight = STRAIGHT_RATIO * extent_squared(&ring);
    let area: f64 = (2..ring.len())
        .map(|k| turn(ring[0], ring[k - 1], ring[k]))
        .sum();
    if area <= straight {
        return ends(&ring);
    }
    let mut kept: Vec<[f64; 2]> = Vec::new();
    for point in ring {
        while let [.., a, b] = kept[..]
            && is_straight([a, b, point], straight)
        {
            kept.pop();
        }
        kept.push(point);
    }
    // The ring closes: the last corner may be straight, and then the first.
    while let [first, .., a, b] = kept[..]
        && is_straight([a, b, first], straight)
    {
        kept.pop();
    }
    if let [first, second, .., last] = kept[..]
        && is_straight([last, first, second], straight)
    {
        kept.remove(0);
    }
    kept
}

/// Returns the convex hull, counterclockwise, without repeated or collinear corners (Andrew,
/// "Another efficient algorithm for convex hulls in two dimensions", Inf. Process. Lett. 9, 1979).
/// Its turns are exact (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust
/// geometric predicates", DCG 18, 1997).
pub fn strict_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull = half_hull(points.iter().copied());
    hull.extend(half_hull(points.iter().rev().copied()));
    hull
}

/// Returns one side of the hull, from the first point up to but without the last.
fn half_hull(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let coord = |[x, y]: [f64; 2]| Coord { x, y };
    let mut side: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = side[..]
            && orient2d(coord(a), coord(b), coord(point)) <= 0.0
        {
            side.pop();
        }
        side.push(point);
    }
    side.pop();
    side
}

/// Returns whether the middle one of three points lies between the others but for rounding.
fn is_straight([a, b, c]: [[f64; 2]; 3], straight: f64) -> bool {
    let goes_on = (b[0] - a[0]) * (c[0] - b[0]) + (b[1] - a[1]) * (c[1] - b[1]) >= 0.0;
    goes_on && turn(a, b, c) <= straight
}

/// Returns the two points of a line that are farthest apart along its longer axis.
fn ends(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let extent = |axis: usize| {
        let all = || line.iter().map(|p| p[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    let axis = usize::from(extent(1) > extent(0));
    let by_axis = |a: &&[f64; 2], b: &&[f64; 2]| a[axis].total_cmp(&b[axis]);
    let both = [line.iter().min_by(by_axis), line.iter().max_by(by_axis)];
    both.into_iter().flatten().copied().collect()
}

/// Returns twice the signed area of the triangle abc, positive if it turns left.
pub fn turn(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

fn extent_squared(points: &[[f64; 2]]) -> f64 {
    let from_first = |p: &[f64; 2]| (p[0] - points[0][0]).powi(2) + (p[1] - points[0][1]).powi(2);
    points.iter().map(from_first).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_grid_is_its_four_corners() {
        let grid = (0..25)
            .map(|i| [f64::from(i % 5), f64::from(i / 5)])
            .collect();
        assert_eq!(convex_hull(grid), [[0., 0.], [4., 0.], [4., 4.], [0., 4.]]);
    }

    #[test]
    fn corners_one_over_the_other_but_for_rounding_are_all_found() {
        // The right side of a panel: its corners stand one over the other, to the last digit.
        let right = [
            [49.17561856947895, -49.0],
            [49.17561856947895, -39.0],
            [49.17561856947894, 39.0],
            [49.17561856947892, 49.0],
        ];
        for mirror in [1.0, -1.0] {
            let points = right.iter().chain(&[[-67.0, -18.0], [-67.0, 18.0]]);
            let hull = convex_hull(points.map(|[x, y]| [mirror * x, *y]).collect());
            assert_eq!(hull.len(), 4, "{hull:?}");
            for corner in [right[0], right[3]] {
                let corner = [mirror * corner[0], corner[1]];
                assert!(hull.contains(&corner), "{hull:?} lacks {corner:?}");
            }
        }
    }

    #[test]
    fn no_point_lies_outside_the_hull_of_a_turned_ring_with_straight_sides() {
        for turn_deg in 0..360 {
            let (sin, cos) = f64::from(turn_deg).to_radians().sin_cos();
            let side = (0..=20).map(f64::from);
            let square =
                side.flat_map(|t| [[t, 0.0], [20.0, t], [20.0 - t, 20.0], [0.0, 20.0 - t]]);
            let points: Vec<[f64; 2]> = square
                .map(|[x, y]| [x * cos - y * sin, x * sin + y * cos])
                .collect();
            let hull = convex_hull(points.clone());
            assert_eq!(hull.len(), 4, "{turn_deg}: {hull:?}");
            for k in 0..4 {
                let [a, b] = [hull[k], hull[(k + 1) % 4]];
                let least = points.iter().map(|p| turn(a, b, *p)).fold(0.0, f64::min);
                assert!(least > -1e-10, "{turn_deg}: {least}");
            }
        }
    }

    #[test]
    fn points_on_a_line_give_its_ends() {
        for step in [[1.0, 2.0], [0.0, 1.0], [1e-16, 1.0], [0.3, 0.1]] {
            let line = [3.0, 0.0, 7.0, 5.0].map(|t| [t * step[0], t * step[1]]);
            let mut hull = convex_hull(line.to_vec());
            hull.sort_by(|a, b| a[1].total_cmp(&b[1]));
            assert_eq!(hull, [line[1], line[2]]);
        }
    }
}
