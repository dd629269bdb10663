//! The support polygon of a standing object, and the tilt at which it topples.

use crate::geom::{Frame, Point};
use crate::mesh::TriMesh;

/// Vertices within this share of the height from the lowest one touch the ground. With less, a
/// slightly uneven foot carries nothing; with more, a rounded edge counts as foot.
pub const SUPPORT_BAND_RATIO: f64 = 0.002;

/// The support polygon of a body in the goal frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// The corners (x, y), counter-clockwise, convex, mm.
    pub corners_mm: Vec<[f64; 2]>,
    /// The height of the ground, z of the lowest vertex, mm.
    pub ground_mm: f64,
}

impl Support {
    /// Returns the convex hull of the vertices that touch the ground when z of `frame` is up. The
    /// mesh is in the model frame.
    pub fn of_mesh(mesh: &TriMesh, frame: &Frame) -> Self {
        let local: Vec<Point> = mesh.vertices().iter().map(|p| frame.to_local(p)).collect();
        let ground_mm = local.iter().map(|p| p.z).fold(f64::INFINITY, f64::min);
        let top_mm = local.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        let band_mm = SUPPORT_BAND_RATIO * (top_mm - ground_mm);
        let feet = local
            .iter()
            .filter(|p| p.z <= ground_mm + band_mm)
            .map(|p| [p.x, p.y])
            .collect();
        Self {
            corners_mm: convex_hull(feet),
            ground_mm,
        }
    }

    /// Returns the tilt at which a body with this centre of mass (goal frame) topples over its
    /// nearest edge, in radians. Negative if it does not stand at all.
    ///
    /// Quasi-static: it topples when the centre is over the edge, tan(tilt) = distance to the edge
    /// / height (Prévost et al. 2013).
    pub fn toppling_angle(&self, center: &Point) -> f64 {
        let height = center.z - self.ground_mm;
        match self.corners_mm.as_slice() {
            [] => f64::NAN,
            &[[x, y]] => (-(center.x - x).hypot(center.y - y)).atan2(height),
            corners => edges(corners)
                .map(|(from, to)| distance_left_of(from, to, [center.x, center.y]).atan2(height))
                .fold(f64::INFINITY, f64::min),
        }
    }
}

/// Returns the edges of a closed polygon.
fn edges(corners: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> + '_ {
    corners
        .iter()
        .zip(corners.iter().cycle().skip(1))
        .map(|(&from, &to)| (from, to))
}

/// Returns the distance of `point` to the left of the line from → to.
fn distance_left_of(from: [f64; 2], to: [f64; 2], point: [f64; 2]) -> f64 {
    cross(from, to, point) / (to[0] - from[0]).hypot(to[1] - from[1])
}

/// Returns twice the signed area of the triangle a, b, c: positive if it turns left.
fn cross(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns the corners of the convex hull, counter-clockwise (Andrew, "Another efficient algorithm
/// for convex hulls in two dimensions", IPL 9, 1979).
fn convex_hull(mut points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let mut hull = half_hull(points.iter().copied());
    hull.extend(half_hull(points.iter().rev().copied()));
    hull
}

/// Returns the lower hull of points sorted by x, without its last corner.
fn half_hull(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut chain: Vec<[f64; 2]> = Vec::new();
    for point in points {
        while chain.len() > 1 && cross(chain[chain.len() - 2], chain[chain.len() - 1], point) <= 0.0
        {
            chain.pop();
        }
        chain.push(point);
    }
    chain.pop();
    chain
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::test_meshes::block;

    fn standing_block() -> Support {
        Support::of_mesh(
            &block(Point::origin(), [4.0, 2.0, 10.0]),
            &Frame::identity(),
        )
    }

    #[test]
    fn a_block_stands_on_its_four_lower_corners() {
        let support = standing_block();
        assert_eq!(
            support.corners_mm,
            vec![[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [0.0, 2.0]]
        );
        assert_eq!(support.ground_mm, 0.0);
    }

    #[test]
    fn a_block_topples_over_its_shorter_side_at_the_angle_of_its_diagonal() {
        let angle = standing_block().toppling_angle(&Point::new(2.0, 1.0, 5.0));
        assert!((angle - (1.0_f64 / 5.0).atan()).abs() < 1e-15);
    }

    #[test]
    fn a_centre_beside_the_foot_gives_a_negative_angle() {
        let angle = standing_block().toppling_angle(&Point::new(5.0, 1.0, 5.0));
        assert!((angle + (1.0_f64 / 5.0).atan()).abs() < 1e-15);
    }

    #[test]
    fn nothing_stands_on_a_point_or_an_edge_unless_exactly_above_it() {
        let point = Support {
            corners_mm: vec![[0.0, 0.0]],
            ground_mm: 0.0,
        };
        assert!(point.toppling_angle(&Point::new(0.3, 0.4, 1.0)) < 0.0);
        let edge = Support {
            corners_mm: vec![[0.0, 0.0], [1.0, 0.0]],
            ground_mm: 0.0,
        };
        assert!(edge.toppling_angle(&Point::new(0.5, 0.1, 1.0)) < 0.0);
        assert!(edge.toppling_angle(&Point::new(0.5, -0.1, 1.0)) < 0.0);
    }

    #[test]
    fn the_hull_drops_points_inside_and_on_its_edges() {
        let points = vec![
            [0.0, 0.0],
            [2.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [2.0, 2.0],
            [0.0, 2.0],
            [0.0, 0.0],
        ];
        assert_eq!(
            convex_hull(points),
            vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]
        );
    }
}
