//! Slanted cuts turned level or upright, where that costs next to nothing.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        planner::{
            attempt::Attempt,
            score::{Scene, burden},
        },
    },
    geom::Plane,
};

/// Cosine of the greatest turn that makes a cut level or upright: 30°. A cut turned farther is
/// another one, and the search has tried it.
const LEAST_TURN_COSINE: f64 = 0.866;
/// Share of all walls that may go out of sight for it. With more, voids become solid for a look;
/// with less, the noise of the samples decides.
const STRAIGHT_WORTH_RATIO: f64 = 0.01;

/// Turns each slanted cut level or upright about its middle, if the voids open and are seen as
/// well.
///
/// The family of planes holds few upright ones. So the best of it often lean a little, for nothing.
pub(crate) fn straighten(scene: &Scene, attempt: Attempt) -> Result<Attempt, CutError> {
    let mut best = attempt;
    for index in 0..best.planes.len() {
        let Some(straight) = turn_straight(scene, &best.planes[index]) else {
            continue;
        };
        let mut planes = best.planes.clone();
        planes[index] = straight;
        let other = Attempt::new(scene, &planes)?;
        let price = |attempt: &Attempt| burden(scene, &attempt.planes[index]).penalty(scene);
        if opens_as_well(scene, &best, &other) && price(&other) <= price(&best) {
            best = other;
        }
    }
    Ok(best)
}

/// Returns the level or upright plane nearest to a slanted one; `None` if it is not slanted, if
/// that is too far a turn, or if a seam may not run there. A part's seat orders its plane.
fn turn_straight(scene: &Scene, plane: &Plane) -> Option<Plane> {
    let skin = scene.request.seams.skin.as_ref()?;
    let holds_part = scene.hollowed.seats().next().is_some();
    if holds_part || skin.slant_price(plane) == 0.0 {
        return None;
    }
    let up = skin.up();
    let rise = plane.normal.dot(&up);
    let normal = if rise.abs() > std::f64::consts::FRAC_1_SQRT_2 {
        up * rise.signum()
    } else {
        (plane.normal - up * rise).normalize()
    };
    let center = scene.hollowed.outer.mesh().aabb().center();
    let middle = center - plane.normal * plane.distance(&center);
    let straight = Plane::through(&middle, &normal);
    let is_near = normal.dot(&plane.normal) >= LEAST_TURN_COSINE;
    (is_near && scene.allows(&straight)).then_some(straight)
}

/// Returns whether an attempt opens and cleans what another one does, and leaves hardly more out of
/// sight.
pub(crate) fn opens_as_well(scene: &Scene, before: &Attempt, after: &Attempt) -> bool {
    let is_open = |void: &VoidAccess| void.opening_mm >= scene.request.min_opening_mm;
    let mut pairs = before.voids.iter().zip(&after.voids);
    let spare_mm2 = STRAIGHT_WORTH_RATIO * before.area_mm2();
    pairs.all(|(old, new)| is_open(new) || !is_open(old))
        && (after.is_nearly_clean(scene) || !before.is_nearly_clean(scene))
        && after.lack_mm2 <= before.lack_mm2 + spare_mm2
}
