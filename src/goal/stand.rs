//! The standing object: it rests on the hull of its lowest vertices.

use super::error::GoalError;
use super::placement::Placement;
use super::site::Site;
use super::sites::Up;
use super::support;
use crate::base::setting::{Key, Setting};
use crate::geom::Point;
use crate::geom::hull::convex_hull;

/// Vertices within this part of the height of the lowest carry the object. A scanned foot is never
/// flat. Below 0.05 % the object would stand on three vertices; above 1 % on vertices that do not
/// touch the floor.
const SUPPORT_RATIO: f64 = 0.002;

/// A support whose area is below this part of the height squared is a line or a point.
const LEAST_AREA_RATIO: f64 = 1e-9;

pub(super) fn place(site: &Site) -> Result<Placement, GoalError> {
    let reach_mm = site.lowest_mm + SUPPORT_RATIO * site.height_mm();
    let feet: Vec<[f64; 2]> = site
        .upright_vertices()
        .filter(|v| v.z <= reach_mm)
        .map(|vertex| [vertex.x, vertex.y])
        .collect();
    let vertices = feet.len();
    let hull = convex_hull(feet);
    if support::area(&hull) <= LEAST_AREA_RATIO * site.height_mm().powi(2) {
        return Err(GoalError::NoSupport {
            up: site.up,
            vertices,
            instead: Setting::new(Key::Up, Up::Natural),
        });
    }
    let [x, y] = support::middle(&hull);
    let polygon = hull
        .iter()
        .map(|corner| [corner[0] - x, corner[1] - y])
        .collect();
    let goal = site.goal_at(&Point::new(x, y, site.lowest_mm), polygon);
    Ok(Placement {
        goal,
        keeps: Vec::new(),
        warnings: Vec::new(),
        footing: None,
    })
}

#[cfg(test)]
mod tests {
    use super::super::{GoalKind, Request, place, testing::*};
    use super::*;

    #[test]
    fn a_block_stands_on_its_lower_face() {
        let placed = place(
            &block([1., 1., 5.], [5., 3., 9.]),
            1.0,
            &Request::new(GoalKind::Stand),
        )
        .unwrap();
        assert_eq!(placed.goal.frame.origin, Point::new(3., 2., 5.));
        assert!((support::area(&placed.goal.support) - 8.0).abs() < 1e-12);
    }

    #[test]
    fn a_tip_is_no_support() {
        let refused = place(&octahedron(), 1.0, &Request::new(GoalKind::Stand));
        assert!(matches!(
            refused,
            Err(GoalError::NoSupport { vertices: 1, .. })
        ));
    }
}
