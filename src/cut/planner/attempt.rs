//! Trial sets of cuts, the access that they give to the voids, and the best among them.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        access::void_access::{VoidAccess, access, accesses, required_sight_ratio},
        error::CutError,
        geometry::tree::CutTree,
        ids::VoidId,
        planner::{score::Scene, search::RankedPlan},
    },
    geom::Plane,
    mesh::move_off_vertices,
};

/// Number of the best plans that are estimated before any extra cut is made. Two planes may leave a
/// corner out of sight, and an extra cut costs a joint. An estimate takes some hundredths of a
/// second.
const ESTIMATED_PLANS: usize = 48;
/// The same where seams are weighed: the plans that hide most come first, and lose most.
const WEIGHED_PLANS: usize = 96;
/// Number of plans estimated in parallel before the promising ones are measured.
const ESTIMATED_AT_ONCE: usize = 8;
/// Error of an estimate. A plan that seems to lack no more than this is measured.
const ESTIMATE_ERROR_RATIO: f64 = 0.01;
/// Distance of two planes at the middle of the body up to which they are much the same, in
/// diagonals. What lies nearer loses and shows the same.
const SAME_PLACE_RATIO: f64 = 0.03;
/// Cosine of the angle between two such planes up to which they are much the same: 15°.
const SAME_LIE_COSINE: f64 = 0.966;
/// Number of plans measured although they seem to lack more. Extra cuts start from the cleanest of
/// them.
const FALLBACK_PLANS: usize = 3;

/// A trial set of cuts, and the access they give to the voids.
#[derive(Clone)]
pub(crate) struct Attempt {
    pub(crate) planes: Vec<Plane>,
    pub(crate) voids: Vec<VoidAccess>,
    pub(crate) lack_mm2: f64,
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

    /// Returns the share of all walls that lacks sight; 0 without voids.
    pub(crate) fn lack_ratio(&self) -> f64 {
        let area_mm2 = self.area_mm2();
        if area_mm2 > 0.0 {
            self.lack_mm2 / area_mm2
        } else {
            0.0
        }
    }

    /// Returns the sum of [`VoidAccess::area_mm2`] over all voids, mm².
    pub(crate) fn area_mm2(&self) -> f64 {
        self.voids.iter().map(VoidAccess::area_mm2).sum()
    }

    /// Returns true if every void can be cleaned.
    pub(crate) fn is_clean(&self) -> bool {
        self.voids.iter().all(|void| void.is_clean)
    }

    /// Returns true if no void lacks more than the planner's margin of sight. Keeping that much
    /// solid costs less than a joint.
    pub(crate) fn is_nearly_clean(&self, scene: &Scene) -> bool {
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
    pub(crate) fn with(&self, scene: &Scene, plane: Plane) -> Result<Self, CutError> {
        let planes = [&self.planes[..], &[plane]].concat();
        let voids = update_accesses(scene, &self.voids, &CutTree::everywhere(&planes), &[plane])?;
        Ok(Self::of(scene, planes, voids))
    }

    /// Estimates the lack with one more cut, mm². Only the voids that it meets change.
    pub(crate) fn estimate_lack_mm2(&self, scene: &Scene, plane: Plane) -> Result<f64, Cancelled> {
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

/// Returns the first of the plans with which every void can be cleaned, or else the cleanest. If
/// the request weighs what stays unclean against seams, it returns the best in both together.
pub(crate) fn cleanest(scene: &Scene, plans: &[RankedPlan]) -> Result<Attempt, CutError> {
    match scene.request.seams.lack_weight {
        Some(weight) => best_seen(scene, plans, weight),
        None => first_clean(scene, &plans[..plans.len().min(ESTIMATED_PLANS)]),
    }
}

/// Returns whether a plan is much the same as one that was tried.
fn is_tried(scene: &Scene, plan: &RankedPlan) -> bool {
    let center = scene.hollowed.outer.mesh().aabb().center();
    let reach_mm = SAME_PLACE_RATIO * scene.diagonal_mm;
    let is_near = |a: &Plane, b: &Plane| {
        let turn = a.normal.dot(&b.normal);
        let apart_mm = a.distance(&center) - turn.signum() * b.distance(&center);
        turn.abs() > SAME_LIE_COSINE && apart_mm.abs() < reach_mm
    };
    let mut tried = scene.request.seams.tried.iter();
    tried.any(|known| {
        let has = |plane: &Plane| known.iter().any(|other| is_near(plane, other));
        known.len() == plan.planes.len() && plan.planes.iter().all(has)
    })
}

/// Returns whether a plan's seams seem to cost as much as the request's dearest.
fn is_dear(scene: &Scene, plan: &RankedPlan) -> bool {
    let prices = plan.planes.iter();
    let price: f64 = prices.map(|plane| scene.estimate_seam_price(plane)).sum();
    let dearest = scene.request.seams.dearest_ratio;
    dearest.is_some_and(|dearest| price >= dearest)
}

/// Returns the plan with the least sum of its score and of what it leaves unclean.
///
/// Estimates the plans in their order, until their scores alone are no better. Then it measures the
/// best of them.
fn best_seen(scene: &Scene, plans: &[RankedPlan], weight: f64) -> Result<Attempt, CutError> {
    let areas_mm2 = scene.wall_areas_mm2();
    let whole_mm2: f64 = areas_mm2.iter().sum();
    let estimate = |plan: &RankedPlan| {
        let lack_mm2 = match plan.lack_mm2.get() {
            Some(known) => *known,
            None => estimate_plan_lack_mm2(scene, &plan.planes, &areas_mm2)?,
        };
        let lack_mm2 = plan.lack_mm2.get_or_init(|| lack_mm2);
        Ok(plan.penalty + weight * lack_mm2 / whole_mm2)
    };
    let fresh = plans
        .iter()
        .filter(|plan| !(is_tried(scene, plan) || is_dear(scene, plan)));
    let plans: Vec<&RankedPlan> = fresh.take(WEIGHED_PLANS).collect();
    let mut rated: Vec<(f64, &RankedPlan)> = Vec::new();
    let mut best = f64::INFINITY;
    for some in plans.chunks(ESTIMATED_AT_ONCE) {
        if some[0].penalty >= best {
            break;
        }
        let sums = some.par_iter().map(|plan| estimate(plan));
        let sums = sums.collect::<Result<Vec<f64>, Cancelled>>()?;
        best = sums.iter().copied().fold(best, f64::min);
        rated.extend(sums.into_iter().zip(some.iter().copied()));
    }
    rated.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut measured: Vec<(f64, Attempt)> = Vec::new();
    for (_, plan) in rated.into_iter().take(FALLBACK_PLANS) {
        let attempt = Attempt::new(scene, &plan.planes)?;
        measured.push((plan.penalty + weight * attempt.lack_ratio(), attempt));
    }
    let best = measured.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    best.map_or_else(|| Attempt::new(scene, &[]), |(_, attempt)| Ok(attempt))
}

/// Estimates the walls that some cuts leave unclean, mm². `areas_mm2` are those of the voids.
fn estimate_plan_lack_mm2(
    scene: &Scene,
    planes: &[Plane],
    areas_mm2: &[f64],
) -> Result<f64, Cancelled> {
    let mut voids = areas_mm2.iter().enumerate();
    voids.try_fold(0.0, |sum, (void, area_mm2)| {
        let lack_ratio = estimate_lack_ratio(scene, VoidId::of(void), planes)?;
        Ok(sum + area_mm2 * lack_ratio)
    })
}

/// Returns the first of the plans with which every void can be cleaned, or else the cleanest.
///
/// Estimates all plans and measures those that seem clean, in their order. Then it measures the
/// most promising of the others.
fn first_clean(scene: &Scene, plans: &[RankedPlan]) -> Result<Attempt, CutError> {
    let estimate = |plan: &RankedPlan| {
        let mut voids = (0..scene.chambers.len()).map(VoidId::of);
        voids.try_fold(0.0, |worst: f64, void| {
            Ok(worst.max(estimate_lack_ratio(scene, void, &plan.planes)?))
        })
    };
    let mut attempts = Attempts { scene, best: None };
    let mut others: Vec<(f64, &[Plane])> = Vec::new();
    for some in plans.chunks(ESTIMATED_AT_ONCE) {
        let lacks = some.par_iter().map(estimate);
        let lacks = lacks.collect::<Result<Vec<f64>, Cancelled>>()?;
        for (lack, plan) in lacks.into_iter().zip(some) {
            if lack > ESTIMATE_ERROR_RATIO {
                others.push((lack, &plan.planes));
            } else if let Some(clean) = attempts.measure(&plan.planes)? {
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

/// Returns the first of some plans with which every void can be cleaned, as far as estimates tell;
/// `None` if none is clean.
pub(crate) fn any_clean(scene: &Scene, plans: &[RankedPlan]) -> Result<Option<Attempt>, CutError> {
    let attempt = first_clean(scene, plans)?;
    Ok(attempt.is_clean().then_some(attempt))
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
