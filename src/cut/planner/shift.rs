//! Cuts moved along their normals to where their seams are seen least.

use crate::{
    cut::{
        error::CutError,
        planner::{
            attempt::Attempt,
            score::{Scene, burden},
            straighten::opens_as_well,
        },
    },
    geom::Plane,
};

/// Step of the places that are tried, in diagonals: a third of what the search leaves between two
/// level planes.
const STEP_RATIO: f64 = 0.006;
/// Number of steps to each side. With six, a crease 5.4 mm away was missed on a figure of 100 mm. A
/// crease beyond is another cut's, and the search has tried it.
const STEPS: i32 = 9;
/// Number of places that are priced in full, those with the cheapest seams first.
const TRIED_PLACES: usize = 6;
/// Share of the seam's price that a place must save. Less is the noise of the samples.
const WORTH_RATIO: f64 = 0.05;

/// Moves each cut along its normal into the crease or neck beside it, if the voids open and are
/// seen as well.
///
/// The planes of the search lie some millimetres apart, and openings are scored beside seams. So
/// the best of them often lies beside the crease that a person would follow.
pub(crate) fn shift_to_creases(scene: &Scene, attempt: Attempt) -> Result<Attempt, CutError> {
    let is_looked_at = scene.request.seams.skin.is_some();
    // A part's seat orders its plane.
    if !is_looked_at || scene.hollowed.seats().next().is_some() {
        return Ok(attempt);
    }
    let mut best = attempt;
    for index in 0..best.planes.len() {
        let penalty = |plane: &Plane| burden(scene, plane).penalty(scene);
        let before = penalty(&best.planes[index]);
        let places = cheaper_places(scene, &best.planes[index]);
        for place in places.into_iter().filter(|place| penalty(place) < before) {
            let mut planes = best.planes.clone();
            planes[index] = place;
            let other = Attempt::new(scene, &planes)?;
            if opens_as_well(scene, &best, &other) {
                best = other;
                break;
            }
        }
    }
    Ok(best)
}

/// Returns the places beside a plane where its seam seems to cost less, the cheapest first.
fn cheaper_places(scene: &Scene, plane: &Plane) -> Vec<Plane> {
    let price = |plane: &Plane| scene.estimate_seam_price(plane);
    let dearest = (1.0 - WORTH_RATIO) * price(plane);
    let step_mm = STEP_RATIO * scene.diagonal_mm;
    let at = |step: i32| Plane {
        offset_mm: plane.offset_mm + f64::from(step) * step_mm,
        ..*plane
    };
    let places = (-STEPS..=STEPS).filter(|&step| step != 0).map(at);
    let priced = places.map(|place| (price(&place), place));
    let is_cheaper = |(price, place): &(f64, Plane)| *price < dearest && scene.allows(place);
    let mut cheaper: Vec<(f64, Plane)> = priced.filter(is_cheaper).collect();
    cheaper.sort_by(|a, b| a.0.total_cmp(&b.0));
    cheaper.truncate(TRIED_PLACES);
    cheaper.into_iter().map(|(_, place)| place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        base::watch::Watch,
        cut::{
            Hollowed, PlanRequest, SeamStyle, Seams,
            scenes::{cuboid, request},
        },
        geom::{Point, Vector},
        mesh::{Csg, TriMesh, primitives::ball},
    };

    /// Returns two balls of radius 10 mm, one over the other, with a hollow through both.
    fn snowman() -> Hollowed {
        let solid = |body: TriMesh| Csg::of_mesh(&body).unwrap();
        let at = |z: f64| solid(ball(&Point::new(0.0, 0.0, z), 10.0, 5));
        let outer = at(0.0).union(&at(16.0)).unwrap().to_solid().unwrap();
        Hollowed::new(outer, vec![cuboid([-3.0, -3.0, -5.0], [3.0, 3.0, 21.0])])
    }

    fn shift_from(z: f64) -> f64 {
        let body = snowman();
        let seams = Seams::look(
            SeamStyle::Hidden,
            body.outer.mesh(),
            &Vector::z(),
            &Watch::silent(),
        );
        let request = PlanRequest {
            seams: seams.unwrap(),
            ..request()
        };
        let scene = Scene::new(&body, &request).unwrap();
        let level = Plane {
            normal: Vector::z(),
            offset_mm: z,
        };
        let attempt = Attempt::new(&scene, &[level]).unwrap();
        let shifted = shift_to_creases(&scene, attempt).unwrap();
        shifted.planes[0].offset_mm
    }

    #[test]
    fn a_cut_beside_a_groove_moves_into_it() {
        let shifted = shift_from(9.3);
        assert!((shifted - 8.0).abs() < 0.5, "{shifted}");
    }

    #[test]
    fn a_cut_in_the_groove_stays() {
        let shifted = shift_from(8.0);
        assert!((shifted - 8.0).abs() < 0.3, "{shifted}");
    }
}
