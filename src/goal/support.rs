//! Convex polygons in the floor plane: their areas, middles and edges.

use crate::geom::hull::turn;

/// Returns the area of a convex polygon, mm²; zero for a segment or a point.
pub(super) fn area(polygon: &[[f64; 2]]) -> f64 {
    fan(polygon).map(|(twice_area, _)| 0.5 * twice_area).sum()
}

/// Returns the centroid of a convex polygon's area, the middle of a segment, or the point itself;
/// the origin for no points.
pub(super) fn middle(polygon: &[[f64; 2]]) -> [f64; 2] {
    if polygon.len() < 3 {
        let count = polygon.len().max(1) as f64;
        return [0, 1].map(|axis| polygon.iter().map(|corner| corner[axis]).sum::<f64>() / count);
    }
    let twice_area: f64 = fan(polygon).map(|(twice_area, _)| twice_area).sum();
    [0, 1].map(|axis| {
        fan(polygon)
            .map(|(twice, centroid)| twice * centroid[axis])
            .sum::<f64>()
            / twice_area
    })
}

/// Returns twice the area and the centroid of each triangle of the fan from the first corner.
fn fan(polygon: &[[f64; 2]]) -> impl Iterator<Item = (f64, [f64; 2])> + '_ {
    polygon.windows(2).skip(1).map(|pair| {
        let (a, [b, c]) = (polygon[0], [pair[0], pair[1]]);
        (
            turn(a, b, c),
            [0, 1].map(|axis| (a[axis] + b[axis] + c[axis]) / 3.0),
        )
    })
}

/// Returns the edges of a convex counterclockwise polygon as (inward unit normal, offset): inside
/// is normal·p ≥ offset.
pub(crate) fn edges(polygon: &[[f64; 2]]) -> Vec<([f64; 2], f64)> {
    let next = polygon.iter().cycle().skip(1);
    let pairs = polygon.iter().zip(next);
    pairs
        .map(|(a, b)| {
            let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
            let length = dx.hypot(dy);
            let normal = [-dy / length, dx / length];
            (normal, normal[0] * a[0] + normal[1] * a[1])
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::hull::convex_hull;

    #[test]
    fn points_on_a_line_hull_to_a_segment_without_area() {
        let hull = convex_hull((0..7).map(|i| [f64::from(i), 2.0 * f64::from(i)]).collect());
        assert_eq!(hull, [[0., 0.], [6., 12.]]);
        assert_eq!((area(&hull), middle(&hull)), (0.0, [3., 6.]));
    }

    #[test]
    fn a_trapezoid_has_its_closed_form_middle() {
        // Parallel sides 6 and 2, height 3: the centroid stands at 3/3 · (6 + 2·2)/(6 + 2) = 1.25
        // above the longer.
        let polygon = [[0., 0.], [6., 0.], [4., 3.], [2., 3.]];
        assert!((area(&polygon) - 12.0).abs() < 1e-14);
        assert!((middle(&polygon)[0] - 3.0).abs() < 1e-14);
        assert!((middle(&polygon)[1] - 1.25).abs() < 1e-14);
    }

    #[test]
    fn every_edge_has_the_middle_on_its_inner_side() {
        let polygon = convex_hull(vec![[0., 0.], [5., -1.], [7., 3.], [2., 6.], [-1., 2.]]);
        let center = middle(&polygon);
        assert_eq!(edges(&polygon).len(), 5);
        assert!(
            edges(&polygon)
                .iter()
                .all(|(n, d)| n[0] * center[0] + n[1] * center[1] > *d)
        );
    }
}
