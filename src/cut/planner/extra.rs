//! Extra cuts, for bodies that the fewest opening cuts do not let be cleaned.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        access::void_access::{Opened, VoidAccess},
        error::CutError,
        geometry::tree::CutTree,
        ids::{CutId, VoidId},
        planner::{
            attempt::Attempt,
            score::{Scene, burden, estimate_seam_penalty},
        },
        remark::{Remark, SightGain},
        seam::skin::Skin,
    },
    geom::{Matrix, Plane, Point, Vector, orthonormal_basis},
    mass::{Body, moments_of_mesh},
    mesh::move_off_vertices,
};

/// Greatest number of cuts added for visibility. A void that still hides something is winding: more
/// cuts would leave crumbs, and keeping its end solid costs less.
const MAX_SIGHT_CUTS: usize = 3;
/// Least share of the missing sight that an extra cut must add to be worth its joint.
const WORTH_RATIO: f64 = 0.1;
/// Greatest price of an extra cut's seam, in circles about the model of average weight. A dearer
/// one mars more than what it cleans is worth: that stays solid.
const MOST_EXTRA_SEAM: f64 = 0.2;
/// Quantiles of the hidden points, along a direction, at which extra cuts are tried.
const QUANTILES: [f64; 3] = [0.2, 0.5, 0.8];
/// Cuts within this share of the best gain compete by their burden.
const NEARLY_BEST_RATIO: f64 = 0.05;
/// Number of extra cuts that are measured. Each costs a cut of a void and two passes over the
/// model.
const MEASURED_CUTS: usize = 6;
/// Adds cuts through hidden points until every void can be cleaned or no cut gains enough. Each cut
/// gets a remark in the notes.
pub(crate) fn add_extra_cuts(
    scene: &Scene,
    mut attempt: Attempt,
    notes: &mut Vec<Remark>,
) -> Result<Attempt, CutError> {
    for _ in 0..MAX_SIGHT_CUTS {
        if attempt.is_nearly_clean(scene) {
            break;
        }
        let Some(next) = add_best_cut(scene, &attempt)? else {
            break;
        };
        let gain_mm2 = attempt.lack_mm2 - next.lack_mm2;
        if !is_worth_its_seam(scene, &next, gain_mm2)
            || gain_mm2 < WORTH_RATIO * attempt.lack_mm2
            || gain_mm2 < scene.request.worth_ratio * attempt.area_mm2()
        {
            break;
        }
        notes.push(cleaning_cut(&attempt, &next));
        attempt = next;
    }
    Ok(attempt)
}

/// Returns true if an extra cut cleans more than its seam and its part cost, or nobody weighs them.
fn is_worth_its_seam(scene: &Scene, next: &Attempt, gain_mm2: f64) -> bool {
    let weight = scene.request.seams.lack_weight;
    let (Some(weight), Some(plane)) = (weight, next.planes.last()) else {
        return true;
    };
    let price = scene.request.part_weight + estimate_seam_penalty(scene, plane);
    weight * gain_mm2 >= price * next.area_mm2()
}

/// Returns the remark on an extra cut: the voids with more of the wall in sight.
fn cleaning_cut(before: &Attempt, after: &Attempt) -> Remark {
    let pairs = before.voids.iter().zip(&after.voids);
    let changed = pairs.filter(|(b, a)| a.sight_ratio > b.sight_ratio);
    let gain = |(b, a): (&VoidAccess, &VoidAccess)| SightGain {
        void: a.void,
        before_ratio: b.sight_ratio,
        after_ratio: a.sight_ratio,
    };
    Remark::CleaningCut {
        cut: CutId::of(before.planes.len()),
        gains: changed.map(gain).collect(),
    }
}

/// Adds the cut that is best for the void that lacks the most. Returns `None` if there is no void
/// or no cut to try.
fn add_best_cut(scene: &Scene, attempt: &Attempt) -> Result<Option<Attempt>, CutError> {
    let lack = |void: &&VoidAccess| void.lack_mm2(scene.request);
    let Some(worst) = attempt
        .voids
        .iter()
        .max_by(|a, b| lack(a).total_cmp(&lack(b)))
    else {
        return Ok(None);
    };
    let tree = CutTree::everywhere(&attempt.planes);
    let hidden = Opened::new(&scene.chambers, worst.void, &tree, scene.request).hidden()?;
    let mut planes = planes_through(scene, worst.void, &hidden);
    planes.retain(|plane| scene.allows(plane) && is_hidden(scene, plane));
    let estimated = planes
        .par_iter()
        .map(|plane| Ok((attempt.estimate_lack_mm2(scene, *plane)?, *plane)));
    let mut estimated = estimated.collect::<Result<Vec<(f64, Plane)>, Cancelled>>()?;
    estimated.sort_by(|a, b| a.0.total_cmp(&b.0));
    estimated.truncate(MEASURED_CUTS);
    let more = estimated
        .par_iter()
        .map(|(_, plane)| attempt.with(scene, move_off_vertices(&scene.material, plane)));
    let mut more = more.collect::<Result<Vec<Attempt>, _>>()?;
    more.sort_by(|a, b| a.lack_mm2.total_cmp(&b.lack_mm2));
    let Some(least_mm2) = more.first().map(|best| best.lack_mm2) else {
        return Ok(None);
    };
    let enough_mm2 = least_mm2 + NEARLY_BEST_RATIO * (attempt.lack_mm2 - least_mm2);
    let near = more
        .into_iter()
        .take_while(|next| next.lack_mm2 <= enough_mm2);
    let penalty = |next: &Attempt| {
        next.planes
            .last()
            .map_or(0.0, |plane| burden(scene, plane).penalty(scene))
    };
    let scored = near.map(|next| (penalty(&next), next));
    Ok(scored
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, next)| next))
}

/// Returns true if a plane's seam costs no more than an extra cut may, or nobody weighs it.
fn is_hidden(scene: &Scene, plane: &Plane) -> bool {
    let seams = &scene.request.seams;
    let look = |skin: &Skin| skin.estimate_ratio(plane) + skin.slant_price(plane);
    let is_dear = |skin: &Skin| look(skin) > MOST_EXTRA_SEAM;
    seams.lack_weight.is_none() || !seams.skin.as_deref().is_some_and(is_dear)
}

/// Returns planes through hidden points of a void, normal to the axes of the model, the goal, the
/// void and the points.
fn planes_through(scene: &Scene, void: VoidId, hidden: &[Point]) -> Vec<Plane> {
    let axis = scene.request.axis.direction.normalize();
    let (u, v) = orthonormal_basis(&axis);
    let mut normals = vec![Vector::x(), Vector::y(), Vector::z(), axis, u, v];
    if let Some(up) = scene.request.seams.up() {
        let (side, front) = orthonormal_basis(&up);
        normals.extend([up, side, front]);
    }
    let own = Body::new(
        &moments_of_mesh(scene.hollowed.voids[void.index()].mesh()),
        1.0,
    )
    .principal()
    .axes;
    normals.extend((0..3).map(|i| own.column(i).into_owned()));
    normals.extend(axes_of(hidden));
    let at = |normal: &Vector| {
        let mut heights: Vec<f64> = hidden.iter().map(|p| normal.dot(&p.coords)).collect();
        heights.sort_by(f64::total_cmp);
        let place = |share: f64| {
            heights
                .get((share * heights.len() as f64) as usize)
                .copied()
        };
        let normal = *normal;
        QUANTILES
            .map(place)
            .into_iter()
            .flatten()
            .map(move |offset_mm| Plane { normal, offset_mm })
    };
    normals.iter().flat_map(at).collect::<Vec<_>>()
}

/// Returns the principal axes of a set of points.
fn axes_of(points: &[Point]) -> Vec<Vector> {
    let count = points.len().max(1) as f64;
    let middle = points.iter().fold(Vector::zeros(), |sum, p| sum + p.coords) / count;
    let spread = points.iter().fold(Matrix::zeros(), |sum, p| {
        let aside = p.coords - middle;
        sum + aside * aside.transpose()
    });
    let axes = spread.symmetric_eigen().eigenvectors;
    let axes = (0..3).map(|i| axes.column(i).into_owned());
    axes.filter(|axis| (axis.norm() - 1.0).abs() < f64::EPSILON.sqrt())
        .collect()
}
