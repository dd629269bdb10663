//! The search for the fewest cuts that open every void, and for the best among them.

use std::sync::OnceLock;

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        error::{CutError, Obstacle},
        geometry::opening::Opening,
        ids::VoidId,
        planner::{
            cover::{MAX_VOIDS, VoidSet, covers_of_size, smallest_cover},
            family::{Candidate, candidates},
            score::{Burden, Scene, burden, estimate_seam_penalty, opening_penalty},
            turns::{keep_allowed, promising_first},
        },
        remark::Proof,
    },
    geom::Plane,
};

/// Numbers of candidates measured after each round; the rounds end as soon as the lower bound is
/// met. The first suffices for most models, and the last takes seconds.
const ROUNDS: [usize; 3] = [64, 512, 4096];
/// The same where seams are weighed against what stays solid. Level planes are then 2 to 4 mm apart
/// on a figure of 100 mm. With half as many, a neck between two of them is missed.
const WEIGHED_ROUNDS: [usize; 3] = [128, 512, 4096];

/// Number of planes of the smallest covers that get a full score. Each takes two or three
/// milliseconds on 100k triangles.
const SCORED_PLANES: usize = 48;
/// The same where seams are weighed: all planes of the first round, as far as covers name them.
const WEIGHED_SCORED_PLANES: usize = 128;

/// Weight of a void that two planes meet. It falls into more pieces, and a pocket may remain
/// between the planes.
const CROSSED_WEIGHT: f64 = 0.5;

/// Wall of a void over that of the largest, below which it may stay closed for a hidden seam: an
/// eighth of its volume. With more, halves of a figure stay solid; with less, a face is cut for an
/// ear.
const SMALL_VOID_RATIO: f64 = 0.25;

/// Number of smallest covers that are compared.
const COMPARED_COVERS: usize = 20_000;

/// Number of candidates measured if none of the ranked plans lets every void be cleaned, and of the
/// plans that are then looked at. An estimate of what a plan cleans takes some hundredths of a
/// second.
const FURTHER_CANDIDATES: usize = 512;
const FURTHER_PLANS: usize = 256;

/// A candidate with its measured openings.
#[derive(Debug, Clone)]
struct MeasuredPlane {
    plane: Plane,
    openings: Vec<Option<Opening>>,
    /// The voids that it opens wide enough.
    opened: VoidSet,
    /// Estimated terms of its seam; 0 if nobody looks.
    seam_penalty: f64,
}

/// Planes that together open every void, and their score.
#[derive(Debug, Clone)]
pub(crate) struct RankedPlan {
    pub(crate) planes: Vec<Plane>,
    /// The sum of the weighted terms, 0 at best.
    pub(crate) penalty: f64,
    /// The walls that it seems to leave unclean, mm², once estimated.
    pub(crate) lack_mm2: OnceLock<f64>,
}

/// The ranked plans, and the proof that no fewer cuts suffice.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    /// Plans with the same number of planes, best first.
    pub(crate) plans: Vec<RankedPlan>,
    /// The candidates in their turn.
    family: Vec<Candidate>,
    /// The voids that every plan opens.
    all: VoidSet,
    /// Number of partial choices examined in the proof.
    pub(crate) nodes: u64,
    /// True if no plan of the family has fewer cuts.
    pub(crate) is_proved: bool,
}

impl Found {
    /// Returns the number of cuts and the extent of the proof.
    pub(crate) fn proof(&self) -> Proof {
        Proof {
            cuts: self.plans.first().map_or(0, |plan| plan.planes.len()),
            family: self.family.len(),
            nodes: self.nodes,
            is_proved: self.is_proved,
        }
    }
}

/// Finds the smallest plans of the family. The body must have at least one void.
///
/// If every plane opened each void that it meets, an exact cover would give the number of cuts; it
/// is a lower bound. Candidates are then measured on their true sections, most promising first. The
/// search ends when an exact cover of the measured openings meets the bound.
pub(crate) fn smallest_plans(scene: &Scene) -> Result<Found, CutError> {
    let voids = scene.hollowed.voids.len();
    if voids > MAX_VOIDS {
        return Err(CutError::TooManyVoids {
            voids,
            limit: MAX_VOIDS,
        });
    }
    let all = needed_voids(scene);
    let watch = &scene.request.watch;
    let mut family = candidates(scene.hollowed, scene.request)?;
    let tried = family.len();
    keep_allowed(scene, &mut family)?;
    let is_free = family.len() == tried;
    let family = promising_first(scene, family, all)?;
    let met: Vec<VoidSet> = family.iter().map(|c| c.met).collect();
    let bound = smallest_cover(&met, all, watch)?;
    let (least, bound_nodes) = bound.map_or((usize::MAX, 0), |cover| (cover.at_least, cover.nodes));
    let mut measured: Vec<MeasuredPlane> = Vec::new();
    let mut best = None;
    let rounds = if scene.request.seams.are_weighed() {
        WEIGHED_ROUNDS
    } else {
        ROUNDS
    };
    for round in rounds.map(|round| round.min(family.len())) {
        measured.extend(measure_all(
            scene,
            &family[measured.len().min(round)..round],
        )?);
        let opened: Vec<VoidSet> = measured.iter().map(|e| e.opened).collect();
        best = smallest_cover(&opened, all, watch)?;
        if best
            .as_ref()
            .is_some_and(|cover| cover.chosen.len() == least)
        {
            break;
        }
    }
    let cover = best.ok_or_else(|| unopenable(scene, &measured, all, is_free))?;
    Ok(Found {
        plans: rank_covers(scene, &measured, all, &cover.chosen)?,
        nodes: cover.nodes + bound_nodes,
        is_proved: cover.chosen.len() == least
            || (measured.len() == family.len() && cover.chosen.len() == cover.at_least),
        family,
        all,
    })
}

/// Returns more plans with as few planes as the ranked ones, the one that opens the largest area
/// first: it most likely shows all. The ranked plans are not among them.
pub(crate) fn further_plans(scene: &Scene, found: &Found) -> Result<Vec<RankedPlan>, Cancelled> {
    let Some(known) = found.plans.first() else {
        return Ok(Vec::new());
    };
    let more = found.family.len().min(FURTHER_CANDIDATES);
    let measured = measure_all(scene, &found.family[..more])?;
    let opened: Vec<VoidSet> = measured.iter().map(|e| e.opened).collect();
    let size = [known.planes.len(), COMPARED_COVERS];
    let covers = covers_of_size(&opened, found.all, size, &scene.request.watch)?;
    let area_mm2 = |cover: &Vec<usize>| -> f64 {
        let openings = cover.iter().flat_map(|&i| &measured[i].openings);
        openings.flatten().map(|opening| opening.area_mm2).sum()
    };
    let mut covers: Vec<(f64, Vec<usize>)> =
        covers.into_iter().map(|c| (area_mm2(&c), c)).collect();
    covers.sort_by(|a, b| b.0.total_cmp(&a.0));
    let plans = covers.into_iter().map(|(_, cover)| RankedPlan {
        planes: cover.iter().map(|&i| measured[i].plane).collect(),
        penalty: seam_penalty(&measured, &cover),
        lack_mm2: OnceLock::new(),
    });
    let is_known = |plan: &RankedPlan| found.plans.iter().any(|other| other.planes == plan.planes);
    let fresh = plans.filter(|plan| !is_known(plan));
    Ok(fresh.take(FURTHER_PLANS).collect())
}

/// Returns the voids that every plan opens: all of them, but where seams are weighed against what
/// stays solid. Small voids may then stay closed, to be kept solid. Else one that only a plane
/// through a face opens, in an ear, would order that face cut.
fn needed_voids(scene: &Scene) -> VoidSet {
    let voids = &scene.hollowed.voids;
    let all = VoidSet::MAX >> (MAX_VOIDS - voids.len());
    if !scene.request.seams.are_weighed() {
        return all;
    }
    let areas_mm2 = scene.wall_areas_mm2();
    let largest_mm2 = areas_mm2.iter().copied().fold(0.0, f64::max);
    let is_needed = |void: &usize| {
        voids[*void].holds.is_some() || areas_mm2[*void] >= SMALL_VOID_RATIO * largest_mm2
    };
    let needed = (0..voids.len()).filter(is_needed);
    needed.fold(0, |set, void| set | 1 << void)
}

/// Measures the openings of candidates on their sections.
fn measure_all(scene: &Scene, family: &[Candidate]) -> Result<Vec<MeasuredPlane>, Cancelled> {
    let measured = family.par_iter().map(|candidate| measure(scene, candidate));
    measured.collect()
}

/// Measures the candidate's openings on its sections.
fn measure(scene: &Scene, candidate: &Candidate) -> Result<MeasuredPlane, Cancelled> {
    scene.request.watch.check()?;
    let openings = scene.openings(&candidate.plane, candidate.met);
    let enough = |void: usize, o: &Option<Opening>| {
        o.is_some_and(|o| o.diameter_mm >= needed_mm(scene, void))
    };
    let opened = openings
        .iter()
        .enumerate()
        .filter(|(i, o)| enough(*i, o))
        .fold(0, |set, (i, _)| set | 1 << i);
    Ok(MeasuredPlane {
        plane: candidate.plane,
        openings,
        opened,
        seam_penalty: estimate_seam_penalty(scene, &candidate.plane),
    })
}

/// Returns the covers as small as `known`, best first, or only `known` if the search finds no
/// others.
fn rank_covers(
    scene: &Scene,
    measured: &[MeasuredPlane],
    all: VoidSet,
    known: &[usize],
) -> Result<Vec<RankedPlan>, Cancelled> {
    let opened: Vec<VoidSet> = measured.iter().map(|e| e.opened).collect();
    let size = [known.len(), COMPARED_COVERS];
    let mut covers = covers_of_size(&opened, all, size, &scene.request.watch)?;
    if covers.is_empty() {
        covers.push(known.to_vec());
    }
    let covers = most_promising(scene, measured, all, covers);
    let burdens = burdens_of(scene, measured, &covers)?;
    let penalty = |cover: &[usize]| {
        let cuts = cover.iter().map(|&i| burdens[i].map(|b| b.penalty(scene)));
        cuts.sum::<Option<f64>>()
    };
    let mut scored: Vec<(f64, Vec<usize>)> = covers
        .into_iter()
        .filter_map(|(opening, c)| Some((penalty(&c)? + opening, c)))
        .collect();
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    let plan = |(penalty, cover): &(f64, Vec<usize>)| RankedPlan {
        planes: cover.iter().map(|&i| measured[i].plane).collect(),
        penalty: *penalty,
        lack_mm2: OnceLock::new(),
    };
    Ok(scored.iter().map(plan).collect())
}

/// Returns the estimated terms of all seams of a cover.
fn seam_penalty(measured: &[MeasuredPlane], cover: &[usize]) -> f64 {
    cover.iter().map(|&i| measured[i].seam_penalty).sum()
}

/// Sorts covers by promise. Returns each with the terms of its openings.
fn most_promising(
    scene: &Scene,
    measured: &[MeasuredPlane],
    all: VoidSet,
    covers: Vec<Vec<usize>>,
) -> Vec<(f64, Vec<usize>)> {
    let voids = scene.hollowed.voids.len();
    // A seat's opening is wide enough or not; more width is of no use.
    let holds_nothing = |&void: &usize| scene.hollowed.voids[void].holds.is_none();
    let needed = (0..voids).filter(|void| all >> void & 1 == 1);
    let empty: Vec<usize> = needed.filter(holds_nothing).collect();
    let opening_score = |cover: &Vec<usize>| {
        opening_penalty(scene, openings_mm(measured, cover, &empty))
            + CROSSED_WEIGHT * count_crossed(measured, cover, voids)
    };
    let mut covers: Vec<(f64, Vec<usize>)> =
        covers.into_iter().map(|c| (opening_score(&c), c)).collect();
    let promise = |(opening, cover): &(f64, Vec<usize>)| opening + seam_penalty(measured, cover);
    covers.sort_by(|a, b| promise(a).total_cmp(&promise(b)));
    covers
}

/// Counts the voids that more than one of the cover's planes meet.
fn count_crossed(measured: &[MeasuredPlane], cover: &[usize], voids: usize) -> f64 {
    let meeting = |void: usize| {
        cover
            .iter()
            .filter(|&&i| measured[i].openings[void].is_some())
            .count()
    };
    (0..voids).filter(|&void| meeting(void) > 1).count() as f64
}

/// Scores the first [`SCORED_PLANES`] planes that the covers name, in the covers' order; more where
/// seams are weighed.
fn burdens_of(
    scene: &Scene,
    measured: &[MeasuredPlane],
    covers: &[(f64, Vec<usize>)],
) -> Result<Vec<Option<Burden>>, Cancelled> {
    let limit = if scene.request.seams.are_weighed() {
        WEIGHED_SCORED_PLANES
    } else {
        SCORED_PLANES
    };
    let mut named: Vec<usize> = Vec::new();
    for (_, cover) in covers {
        let fresh: Vec<usize> = cover
            .iter()
            .copied()
            .filter(|i| !named.contains(i))
            .collect();
        if named.len() + fresh.len() > limit && !named.is_empty() {
            break;
        }
        named.extend(fresh);
    }
    let score = |&i: &usize| {
        scene.request.watch.check()?;
        Ok((i, burden(scene, &measured[i].plane)))
    };
    let scored = named.par_iter().map(score);
    let scored = scored.collect::<Result<Vec<(usize, Burden)>, Cancelled>>()?;
    let mut burdens = vec![None; measured.len()];
    for (i, burden) in scored {
        burdens[i] = Some(burden);
    }
    Ok(burdens)
}

/// Returns the widest opening of each void by the cover's planes, mm.
fn openings_mm<'a>(
    measured: &'a [MeasuredPlane],
    cover: &'a [usize],
    voids: &'a [usize],
) -> impl Iterator<Item = f64> + 'a {
    let planes = move || cover.iter().map(|&i| &measured[i]);
    voids.iter().map(move |&void| widest_mm(planes(), void))
}

/// Returns the widest opening of a void by some planes, mm.
fn widest_mm<'a>(planes: impl Iterator<Item = &'a MeasuredPlane>, void: usize) -> f64 {
    planes
        .filter_map(|e| e.openings[void])
        .map(|o| o.diameter_mm)
        .fold(0.0, f64::max)
}

/// Returns the obstacle with the voids that none of the planes opens wide enough.
fn unopenable(scene: &Scene, measured: &[MeasuredPlane], all: VoidSet, is_free: bool) -> Obstacle {
    let widest = |&void: &usize| widest_mm(measured.iter(), void);
    let is_closed = |&void: &usize| all >> void & 1 == 1 && widest(&void) < needed_mm(scene, void);
    let voids: Vec<usize> = (0..scene.hollowed.voids.len()).filter(is_closed).collect();
    let needed_mm = voids
        .first()
        .map_or(scene.request.min_opening_mm, |&void| needed_mm(scene, void));
    let widest_mm = voids.iter().map(widest).fold(f64::INFINITY, f64::min);
    Obstacle::Unopenable {
        voids: voids.into_iter().map(VoidId::of).collect(),
        widest_mm: if widest_mm.is_finite() {
            widest_mm
        } else {
            0.0
        },
        needed_mm,
        is_free,
    }
}

/// Returns the diameter of the disc that must pass through the opening of a void, mm.
fn needed_mm(scene: &Scene, void: usize) -> f64 {
    scene.hollowed.voids[void].least_opening_mm(scene.request)
}
