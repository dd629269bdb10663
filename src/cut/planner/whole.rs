//! Plans without parts below the least.

use crate::{
    cut::{
        error::CutError,
        planner::{attempt::Attempt, layout::Layout, score::Scene},
    },
    geom::Plane,
};

/// Number of plans that are cut if the best leaves a part below the least. Each takes some tenths
/// of a second.
const COMPARED_FOR_SIZE: usize = 6;

/// Share of all walls that a plan may leave unclean for it, beyond the other. With no limit, whole
/// figures stayed solid for the sake of two hands.
const WHOLE_LACK_RATIO: f64 = 0.1;

/// Returns the first layout of some plans that has no part below the least; `None` if there is none
/// among the first. It leaves hardly more of the walls unclean than the given share. Ends of voids
/// that it leaves unclean are for the caller to keep solid.
pub(crate) fn whole_parts(
    scene: &Scene,
    plans: impl Iterator<Item = Vec<Plane>>,
    lack_ratio: f64,
) -> Result<Option<Layout>, CutError> {
    for planes in plans.take(COMPARED_FOR_SIZE) {
        let attempt = Attempt::new(scene, &planes)?;
        if attempt.lack_ratio() > lack_ratio + WHOLE_LACK_RATIO {
            continue;
        }
        let layout = Layout::new(scene, attempt.planes, attempt.voids)?;
        if layout.count_small(scene) == 0 {
            return Ok(Some(layout));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{cut::scenes::two_balls, geom::Vector};

    #[test]
    fn a_plan_that_leaves_most_of_a_void_unclean_is_not_taken_for_its_whole_parts() {
        // A cut across the bar opens one of two balls; a cut along it opens both.
        let (body, request) = two_balls();
        let scene = Scene::new(&body, &request).unwrap();
        let across = |offset_mm: f64| {
            vec![Plane {
                normal: Vector::x(),
                offset_mm,
            }]
        };
        let lengthwise = vec![Plane {
            normal: Vector::z(),
            offset_mm: 15.013,
        }];
        let is_taken = |planes: &[Vec<Plane>], lack_ratio: f64| {
            let layout = whole_parts(&scene, planes.iter().cloned(), lack_ratio).unwrap();
            layout.map(|layout| layout.tree.planes[0].normal)
        };
        // One ball of two stays closed.
        let one = across(18.013);
        assert_eq!(is_taken(std::slice::from_ref(&one), 0.0), None);
        assert_eq!(is_taken(std::slice::from_ref(&one), 0.9), Some(Vector::x()));
        assert_eq!(is_taken(&[one, lengthwise], 0.0), Some(Vector::z()));
    }
}
