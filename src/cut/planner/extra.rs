//! Extra cuts, for bodies that the fewest opening cuts do not let be cleaned.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        access::void_access::{Opened, VoidAccess, access, accesses, required_sight_ratio},
        error::CutError,
        geometry::tree::CutTree,
        ids::{CutId, VoidId},
        planner::score::{Scene, burden},
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
/// Number of the best plans that are estimated before any extra cut is made. Two planes may leave a
/// corner out of sight, and an extra cut costs a joint. An estimate takes some hundredths of a
/// second.
const ESTIMATED_PLANS: usize = 48;
/// Number of plans estimated in parallel before the promising ones are measured.
const ESTIMATED_AT_ONCE: usize = 8;
/// Error of an estimate. A plan that seems to lack no more than this is measured.
const ESTIMATE_ERROR_RATIO: f64 = 0.01;
/// Number of plans measured although they seem to lack more. Extra cuts start from the cleanest of
/// them.
const FALLBACK_PLANS: usize = 3;

/// A trial set of cuts, and the access they give to the voids.
#[derive(Clone)]
pub(crate) struct Attempt {
    pub(crate) planes: Vec<Plane>,
    pub(crate) voids: Vec<VoidAccess>,
    lack_mm2: f64,
}

impl Attempt {
    pub(crate) fn new(scene: &Scene, planes: &[Plane]) -> Result<Self, CutError> {
        let planes: Vec<Plane> = planes
            .iter()
            .map(|plane| move_off_vertices(&scene.material, plane))
            .collect();
        let voids = accesses(
            &scene.chambers,
            &CutTree::everywhere(&planes),
            scene.request,
        )?;
        Ok(Self::of(scene, planes, voids))
    }

    fn of(scene: &Scene, planes: Vec<Plane>, voids: Vec<VoidAccess>) -> Self {
        let lack_mm2 = voids.iter().map(|void| void.lack_mm2(scene.request)).sum();
        Self {
            planes,
            voids,
            lack_mm2,
        }
    }

    /// Returns the sum of [`VoidAccess::area_mm2`] over all voids, mm².
    fn area_mm2(&self) -> f64 {
        self.voids.iter().map(VoidAccess::area_mm2).sum()
    }

    /// Returns true if every void can be cleaned.
    pub(crate) fn is_clean(&self) -> bool {
        self.voids.iter().all(|void| void.is_clean)
    }

    /// Returns true if no void lacks more than the planner's margin of sight. Keeping that much
    /// solid costs less than a joint.
    fn is_nearly_clean(&self, scene: &Scene) -> bool {
        let margin = scene.request.cleaning.sight_ratio..required_sight_ratio(scene.request);
        self.voids
            .iter()
            .all(|void| void.is_clean || margin.contains(&void.sight_ratio))
    }

    /// Returns the cleaner of two attempts, or the first if they are equal.
    fn or_cleaner(self, other: Self) -> Self {
        if other.lack_mm2 < self.lack_mm2 {
            other
        } else {
            self
        }
    }

    /// Returns these cuts with one more. Voids that it does not meet keep their access.
    fn with(&self, scene: &Scene, plane: Plane) -> Result<Self, CutError> {
        let planes = [&self.planes[..], &[plane]].concat();
        let voids = update_accesses(scene, &self.voids, &CutTree::everywhere(&planes), &[plane])?;
        Ok(Self::of(scene, planes, voids))
    }

    /// Estimates the lack with one more cut, mm². Only the voids that it meets change.
    fn estimate_lack_mm2(&self, scene: &Scene, plane: Plane) -> Result<f64, Cancelled> {
        let planes = [&self.planes[..], &[plane]].concat();
        let lack_mm2 = |before: &VoidAccess| {
            Ok(if meets(scene, before.void, &plane) {
                before.area_mm2() * estimate_lack_ratio(scene, before.void, &planes)?
            } else {
                before.lack_mm2(scene.request)
            })
        };
        self.voids.iter().map(lack_mm2).sum()
    }
}

/// Updates the access to the voids after some planes have changed. Only the voids that meet one of
/// these planes are measured again.
pub(crate) fn update_accesses(
    scene: &Scene,
    before: &[VoidAccess],
    tree: &CutTree,
    changed: &[Plane],
) -> Result<Vec<VoidAccess>, CutError> {
    let again = |known: &VoidAccess| {
        if changed.iter().any(|plane| meets(scene, known.void, plane)) {
            access(&scene.chambers, known.void, tree, scene.request)
        } else {
            Ok(known.clone())
        }
    };
    before.iter().map(again).collect()
}

/// Returns true if a plane passes through a void.
fn meets(scene: &Scene, void: VoidId, plane: &Plane) -> bool {
    plane.passes_through(scene.hollowed.voids[void.index()].mesh().vertices())
}

/// Estimates the share of a void's wall that lacks sight with these cuts; 0 if no sight is
/// required.
fn estimate_lack_ratio(scene: &Scene, void: VoidId, planes: &[Plane]) -> Result<f64, Cancelled> {
    let required = required_sight_ratio(scene.request);
    if required == 0.0 {
        return Ok(0.0);
    }
    let (chamber, tree) = (&scene.chambers[void.index()], CutTree::everywhere(planes));
    let seen = chamber.estimate_sight_ratio(&tree, scene.request)?;
    Ok((required - seen).max(0.0))
}

/// Returns the first of the plans with which every void can be cleaned, or else the cleanest.
///
/// Estimates all plans and measures those that seem clean, in their order. Then it measures the
/// most promising of the others.
pub(crate) fn cleanest(scene: &Scene, plans: &[Vec<Plane>]) -> Result<Attempt, CutError> {
    let estimate = |planes: &Vec<Plane>| {
        let mut voids = (0..scene.chambers.len()).map(VoidId::of);
        voids.try_fold(0.0, |worst: f64, void| {
            Ok(worst.max(estimate_lack_ratio(scene, void, planes)?))
        })
    };
    let mut attempts = Attempts { scene, best: None };
    let mut others: Vec<(f64, &Vec<Plane>)> = Vec::new();
    for some in plans[..plans.len().min(ESTIMATED_PLANS)].chunks(ESTIMATED_AT_ONCE) {
        let lacks = some.par_iter().map(estimate);
        let lacks = lacks.collect::<Result<Vec<f64>, Cancelled>>()?;
        for (lack, planes) in lacks.into_iter().zip(some) {
            if lack > ESTIMATE_ERROR_RATIO {
                others.push((lack, planes));
            } else if let Some(clean) = attempts.measure(planes)? {
                return Ok(clean);
            }
        }
    }
    others.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, planes) in others.into_iter().take(FALLBACK_PLANS) {
        if let Some(clean) = attempts.measure(planes)? {
            return Ok(clean);
        }
    }
    attempts.best.map_or_else(|| Attempt::new(scene, &[]), Ok)
}

/// A series of plans that are measured one after another.
struct Attempts<'a> {
    scene: &'a Scene<'a>,
    /// The cleanest plan so far.
    best: Option<Attempt>,
}

impl Attempts<'_> {
    /// Measures a plan. Returns it if every void is clean, and otherwise remembers it if it is the
    /// cleanest.
    fn measure(&mut self, planes: &[Plane]) -> Result<Option<Attempt>, CutError> {
        let attempt = Attempt::new(self.scene, planes)?;
        if attempt.is_clean() {
            return Ok(Some(attempt));
        }
        self.best = Some(match self.best.take() {
            Some(best) => best.or_cleaner(attempt),
            None => attempt,
        });
        Ok(None)
    }
}

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
        if gain_mm2 < WORTH_RATIO * attempt.lack_mm2
            || gain_mm2 < scene.request.worth_ratio * attempt.area_mm2()
        {
            break;
        }
        notes.push(cleaning_cut(&attempt, &next));
        attempt = next;
    }
    Ok(attempt)
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

/// Returns true if a plane's seam costs no more than an extra cut may, as far as it is estimated.
fn is_hidden(scene: &Scene, plane: &Plane) -> bool {
    let seams = &scene.request.seams;
    let most_ratio = seams.most_ratio.unwrap_or(f64::INFINITY);
    let most_ratio = most_ratio.min(MOST_EXTRA_SEAM);
    let look = |skin: &Skin| skin.estimate_ratio(plane) + skin.slant_price(plane);
    seams
        .skin
        .as_deref()
        .is_none_or(|skin| look(skin) <= most_ratio)
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
