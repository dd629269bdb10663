//! Points on the outside of a body, as densely as a judge of jigs looks at them.

use crate::geom::{Point, play::Spot};

/// Distance of the sections of a body over the joint, mm.
const SECTION_MM: f64 = 0.1;

/// Distance of the points in a section, mm.
const SPACING_MM: f64 = 0.15;

/// Returns points within the triangles of a surface (in a view along a joint's normal) between two
/// heights over the joint, mm. They lie in sections [`SECTION_MM`] apart.
///
/// Points along the sides of the triangles alone miss places that a jig meets first.
pub(super) fn points_in_sections(surface: &[[Point; 3]], [low, high]: [f64; 2]) -> Vec<Spot> {
    let mut points = Vec::new();
    for corners in surface {
        let heights = corners.each_ref().map(|p| p.y);
        let least = heights.into_iter().fold(f64::INFINITY, f64::min).max(low);
        let most = heights.into_iter().fold(f64::NEG_INFINITY, f64::max);
        let most = most.min(high);
        let first = (least / SECTION_MM).ceil() as i64;
        for level in first..=(most / SECTION_MM).floor() as i64 {
            let [from, to] = match section(corners, SECTION_MM * level as f64) {
                Some(ends) => ends,
                None => continue,
            };
            let count = ((to - from).norm() / SPACING_MM).ceil().max(1.0);
            let point = |step: usize| from + (to - from) * (step as f64 / count);
            points.extend((0..=count as usize).map(point));
        }
    }
    points
}

/// Returns the ends of a triangle's section at a height; `None` if it lies on one side of it.
fn section(corners: &[Point; 3], height: f64) -> Option<[Spot; 2]> {
    let sides = [[0, 1], [1, 2], [2, 0]].map(|side| side.map(|end| &corners[end]));
    let mut crossings = sides.into_iter().filter_map(|[a, b]| {
        let [at_a, at_b] = [a.y - height, b.y - height];
        ((at_a < 0.0) != (at_b < 0.0)).then(|| {
            let p = a + (b - a) * (at_a / (at_a - at_b));
            Spot::new(p.x, p.z)
        })
    });
    Some([crossings.next()?, crossings.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_within_triangles_and_not_on_their_sides_alone() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0]].map(|[x, y]| Point::new(x, y, x + y));
        let points = points_in_sections(&[corners], [1.0, 3.0]);
        let inside = points
            .iter()
            .filter(|p| p.x > 1e-9 && p.y > p.x + 1e-9 && p.y < 10.0 - 1e-9);
        assert!(inside.count() > 500);
        // Seen along y, the height over the joint is z - x.
        let heights = points.iter().map(|p| p.y - p.x);
        for height in heights {
            assert!((1.0 - 1e-9..3.0 + 1e-9).contains(&height), "{height}");
            let steps = height / SECTION_MM;
            assert!((steps - steps.round()).abs() < 1e-9, "{height}");
        }
    }

    #[test]
    fn a_triangle_between_two_sections_has_no_points() {
        let corners = [[0.0, 0.02], [10.0, 0.03], [0.0, 0.08]].map(|[x, y]| Point::new(x, y, 0.0));
        assert_eq!(points_in_sections(&[corners], [-1.0, 1.0]), vec![]);
    }
}
