//! Fewer cuts in place of extra ones, where a wider search finds them.

use crate::cut::{
    error::CutError,
    planner::{
        attempt::{Attempt, any_clean},
        score::{Scene, burden},
        search::{Found, further_plans},
        shift::shift_to_creases,
        straighten::straighten,
    },
};

/// Returns a plan with as few cuts as possible that lets every void be cleaned. `None` if the
/// ranked plans hold one, or if its cuts cost more than those of `full`.
///
/// On a figure such as Homer, a cut between front and back is late among the ranked plans, and
/// alone cleans all. It is sought only where nobody looks at seams. Else humpty got a seam through
/// its face, and stood less firmly by a fifth.
pub(crate) fn fewer_clean_cuts(
    scene: &Scene,
    full: &Attempt,
    found: &Found,
) -> Result<Option<Attempt>, CutError> {
    let is_fewest = found
        .plans
        .first()
        .is_some_and(|plan| plan.planes.len() == full.planes.len());
    let is_done = is_fewest && full.is_nearly_clean(scene);
    if is_done || scene.request.seams.skin.is_some() {
        return Ok(None);
    }
    let Some(clean) = any_clean(scene, &further_plans(scene, found)?)? else {
        return Ok(None);
    };
    let clean = shift_to_creases(scene, straighten(scene, clean)?)?;
    let penalty = |attempt: &Attempt| -> f64 {
        let planes = attempt.planes.iter();
        planes
            .map(|plane| burden(scene, plane).penalty(scene))
            .sum()
    };
    Ok((penalty(&clean) <= penalty(full)).then_some(clean))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{planner::search::smallest_plans, scenes::two_balls},
        geom::{Plane, Vector},
    };

    #[test]
    fn one_cut_that_shows_all_takes_the_place_of_two_and_opens_the_largest_area() {
        let (body, request) = two_balls();
        let scene = Scene::new(&body, &request).unwrap();
        let found = smallest_plans(&scene).unwrap();
        let plane = |normal: Vector, offset_mm: f64| Plane { normal, offset_mm };
        let across = [18.013, 42.013].map(|x_mm| plane(Vector::x(), x_mm));
        let two = Attempt::new(&scene, &across).unwrap();
        let one = fewer_clean_cuts(&scene, &two, &found).unwrap().unwrap();
        assert!(one.planes.len() == 1 && one.is_clean(), "{:?}", one.planes);
        // Where one cut shows all, no other is sought.
        assert!(fewer_clean_cuts(&scene, &one, &found).unwrap().is_none());
        let area_mm2 = |plane: &Plane| -> f64 {
            let openings = scene.openings(plane, 0b11).into_iter().flatten();
            openings.map(|opening| opening.area_mm2).sum()
        };
        let further = further_plans(&scene, &found).unwrap();
        let areas: Vec<f64> = further
            .iter()
            .map(|plan| area_mm2(&plan.planes[0]))
            .collect();
        assert!(
            areas.len() > 1 && areas.is_sorted_by(|a, b| a >= b),
            "{areas:?}"
        );
        let is_known = |planes: &[Plane]| found.plans.iter().any(|plan| plan.planes == planes);
        assert!(!further.iter().any(|plan| is_known(&plan.planes)));
    }
}
