//! Convex hulls in a plane.

/// Turns flatter than this part of the squared extent count as straight: a hull corner there is
/// rounding.
const STRAIGHT_RATIO: f64 = 1e-12;

/// Returns the convex hull, counterclockwise, without repeated or collinear corners (Andrew,
/// "Another efficient algorithm for convex hulls in two dimensions", Inf. Process. Lett. 9, 1979).
pub fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let straight = STRAIGHT_RATIO * extent_squared(&points);
    let mut hull = half_hull(points.iter().copied(), straight);
    hull.extend(half_hull(points.iter().rev().copied(), straight));
    hull
}

/// Returns one side of the hull, from the first point up to but without the last.
fn half_hull(points: impl Iterator<Item = [f64; 2]>, straight: f64) -> Vec<[f64; 2]> {
    let mut side: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while let [.., a, b] = side[..]
            && turn(a, b, point) <= straight
        {
            side.pop();
        }
        side.push(point);
    }
    side.pop();
    side
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
}
