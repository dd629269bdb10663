//! The search for the fewest cuts that open every void, and for the best among them.

use rayon::prelude::*;

use crate::{
    cut::{
        error::{CutError, Obstacle},
        geometry::opening::Opening,
        ids::VoidId,
        planner::{
            cover::{MAX_VOIDS, VoidSet, covers_of_size, greedy_cover, smallest_cover},
            family::{Candidate, candidates},
            score::{AMPLE_OPENING_RATIO, Burden, Scene, burden, opening_penalty},
        },
        remark::Proof,
    },
    geom::Plane,
};

/// How many candidates are looked at exactly, in rounds that end as soon as the lower bound is met.
/// The first suffices for most models; the last takes seconds.
const ROUNDS: [usize; 3] = [64, 512, 4096];

/// How many planes of the smallest covers are judged in full: two or three milliseconds each on
/// 100k triangles.
const JUDGED_PLANES: usize = 48;

/// Weight of a void that two planes meet: it falls into more pieces, and a pocket may stay between
/// the planes.
const CROSSED_WEIGHT: f64 = 0.5;

/// How many smallest covers are compared.
const COMPARED_COVERS: usize = 20_000;

/// A candidate with what it really opens.
#[derive(Debug, Clone)]
struct Exact {
    plane: Plane,
    openings: Vec<Option<Opening>>,
    /// The voids it opens wide enough.
    opened: VoidSet,
}

/// The ranked plans, and how sure it is that fewer cuts do not do.
#[derive(Debug, Clone)]
pub(crate) struct Found {
    /// Plans of equally few planes, the best first.
    pub(crate) plans: Vec<Vec<Plane>>,
    /// How many candidates the family holds.
    pub(crate) family: usize,
    /// How many partial choices the proof went through.
    pub(crate) nodes: u64,
    /// Whether no plan of the family has fewer cuts.
    pub(crate) is_proved: bool,
}

impl Found {
    /// The number of cuts, and how it was proved.
    pub(crate) fn proof(&self) -> Proof {
        Proof {
            cuts: self.plans.first().map_or(0, Vec::len),
            family: self.family,
            nodes: self.nodes,
            is_proved: self.is_proved,
        }
    }
}

/// The smallest plans from the family. At least one void is required.
///
/// Counting a void as opened by every plane that meets it gives a lower bound by exact cover.
/// Candidates are then measured on their true sections, the most promising first, until an exact
/// cover of what they really open meets the bound.
pub(crate) fn smallest_plans(scene: &Scene) -> Result<Found, CutError> {
    let voids = scene.hollowed.voids.len();
    if voids > MAX_VOIDS {
        return Err(CutError::TooManyVoids {
            voids,
            limit: MAX_VOIDS,
        });
    }
    let all = VoidSet::MAX >> (MAX_VOIDS - voids);
    let family = promising_first(
        candidates(scene.hollowed, scene.request),
        all,
        ample_guess_mm(scene),
    );
    let bound = smallest_cover(&family.iter().map(|c| c.met).collect::<Vec<_>>(), all);
    let (least, bound_nodes) = bound.map_or((usize::MAX, 0), |cover| (cover.at_least, cover.nodes));
    let mut exact: Vec<Exact> = Vec::new();
    let mut best = None;
    for round in ROUNDS.map(|round| round.min(family.len())) {
        let fresh = &family[exact.len().min(round)..round];
        exact.par_extend(fresh.par_iter().map(|candidate| measured(scene, candidate)));
        best = smallest_cover(&exact.iter().map(|e| e.opened).collect::<Vec<_>>(), all);
        if best
            .as_ref()
            .is_some_and(|cover| cover.chosen.len() == least)
        {
            break;
        }
    }
    let cover = best.ok_or_else(|| unopenable(scene, &exact))?;
    Ok(Found {
        plans: ranked(scene, &exact, &cover.chosen),
        family: family.len(),
        nodes: cover.nodes + bound_nodes,
        is_proved: cover.chosen.len() == least
            || (exact.len() == family.len() && cover.chosen.len() == cover.at_least),
    })
}

/// The family with the most promising planes first: those that can take part in a smallest cover,
/// in turn one for each set of voids met; among planes that meet the same voids the best offset of
/// each direction, then the second best, and so on, each by the opening guessed. Guesses above
/// `ample_mm` are equal, so that the axes, which lead the family, come before skew directions that
/// are no better.
fn promising_first(family: Vec<Candidate>, all: VoidSet, ample_mm: f64) -> Vec<Candidate> {
    let classes = classes(&family, all);
    let class_of = |c: &Candidate| {
        classes
            .binary_search_by_key(&c.met, |&(met, _)| met)
            .unwrap_or_default()
    };
    let least = classes
        .iter()
        .map(|&(_, rest)| rest)
        .min()
        .unwrap_or_default();
    let mut places: Vec<(usize, Candidate)> = Vec::with_capacity(family.len());
    for row in family.chunk_by(|a, b| a.met == b.met && a.plane.normal == b.plane.normal) {
        let mut row = row.to_vec();
        row.sort_by(|a, b| b.guess_mm.total_cmp(&a.guess_mm));
        places.extend(row.into_iter().enumerate());
    }
    let capped = |c: &Candidate| c.guess_mm.min(ample_mm);
    places.sort_by(|(i, a), (j, b)| i.cmp(j).then(capped(b).total_cmp(&capped(a))));
    let mut taken = vec![0; classes.len()];
    let mut turns: Vec<((bool, usize), Candidate)> = Vec::with_capacity(places.len());
    for (_, candidate) in places {
        let class = class_of(&candidate);
        taken[class] += 1;
        turns.push(((classes[class].1 > least, taken[class]), candidate));
    }
    turns.sort_by_key(|&(turn, _)| turn);
    turns.into_iter().map(|(_, candidate)| candidate).collect()
}

/// A guessed opening above which a plane need not be wider, mm; twice what scores count, as guesses
/// err.
fn ample_guess_mm(scene: &Scene) -> f64 {
    2.0 * AMPLE_OPENING_RATIO * scene.request.min_opening_mm
}

/// The different sets of voids met, ascending, each with how many further planes open the rest by
/// greedy choice.
fn classes(family: &[Candidate], all: VoidSet) -> Vec<(VoidSet, usize)> {
    let mut sets: Vec<VoidSet> = family.iter().map(|c| c.met).collect();
    sets.sort_unstable();
    sets.dedup();
    let rest =
        |set: VoidSet| greedy_cover(&sets, all & !set).map_or(usize::MAX, |chosen| chosen.len());
    sets.par_iter().map(|&set| (set, rest(set))).collect()
}

/// What the candidate opens, measured on its sections.
fn measured(scene: &Scene, candidate: &Candidate) -> Exact {
    let openings = scene.openings(&candidate.plane, candidate.met);
    let enough = |void: usize, o: &Option<Opening>| {
        o.is_some_and(|o| o.diameter_mm >= needed_mm(scene, void))
    };
    let opened = openings
        .iter()
        .enumerate()
        .filter(|(i, o)| enough(*i, o))
        .fold(0, |set, (i, _)| set | 1 << i);
    Exact {
        plane: candidate.plane,
        openings,
        opened,
    }
}

/// The covers as small as `known`, the best first; `known` alone where the search for others ends
/// empty.
fn ranked(scene: &Scene, exact: &[Exact], known: &[usize]) -> Vec<Vec<Plane>> {
    let voids = scene.hollowed.voids.len();
    let all = VoidSet::MAX >> (MAX_VOIDS - voids);
    let opened: Vec<VoidSet> = exact.iter().map(|e| e.opened).collect();
    let mut covers = covers_of_size(&opened, all, [known.len(), COMPARED_COVERS]);
    if covers.is_empty() {
        covers.push(known.to_vec());
    }
    // A seat's opening is wide enough or not; more of it is of no use.
    let holds_nothing = |&void: &usize| scene.hollowed.voids[void].holds.is_none();
    let empty: Vec<usize> = (0..voids).filter(holds_nothing).collect();
    let by_opening = |cover: &Vec<usize>| {
        opening_penalty(scene, openings_mm(exact, cover, &empty))
            + CROSSED_WEIGHT * crossed(exact, cover, voids)
    };
    let mut covers: Vec<(f64, Vec<usize>)> =
        covers.into_iter().map(|c| (by_opening(&c), c)).collect();
    covers.sort_by(|a, b| a.0.total_cmp(&b.0));
    let burdens = burdens_of(scene, exact, &covers);
    let penalty = |cover: &[usize]| {
        let cuts = cover.iter().map(|&i| burdens[i].map(|b| b.penalty(scene)));
        cuts.sum::<Option<f64>>()
    };
    let mut scored: Vec<(f64, Vec<usize>)> = covers
        .into_iter()
        .filter_map(|(opening, c)| Some((penalty(&c)? + opening, c)))
        .collect();
    scored.sort_by(|a, b| a.0.total_cmp(&b.0));
    scored
        .iter()
        .map(|(_, cover)| cover.iter().map(|&i| exact[i].plane).collect())
        .collect()
}

/// How many voids more than one of the cover's planes meet.
fn crossed(exact: &[Exact], cover: &[usize], voids: usize) -> f64 {
    let meeting = |void: usize| {
        cover
            .iter()
            .filter(|&&i| exact[i].openings[void].is_some())
            .count()
    };
    (0..voids).filter(|&void| meeting(void) > 1).count() as f64
}

/// The burdens of the first [`JUDGED_PLANES`] planes that the covers name, in the covers' order.
fn burdens_of(scene: &Scene, exact: &[Exact], covers: &[(f64, Vec<usize>)]) -> Vec<Option<Burden>> {
    let mut named: Vec<usize> = Vec::new();
    for (_, cover) in covers {
        let fresh: Vec<usize> = cover
            .iter()
            .copied()
            .filter(|i| !named.contains(i))
            .collect();
        if named.len() + fresh.len() > JUDGED_PLANES && !named.is_empty() {
            break;
        }
        named.extend(fresh);
    }
    let judged: Vec<(usize, Burden)> = named
        .par_iter()
        .map(|&i| (i, burden(scene, &exact[i].plane)))
        .collect();
    let mut burdens = vec![None; exact.len()];
    for (i, burden) in judged {
        burdens[i] = Some(burden);
    }
    burdens
}

/// For each of the voids the widest of its openings by the cover's planes, mm.
fn openings_mm<'a>(
    exact: &'a [Exact],
    cover: &'a [usize],
    voids: &'a [usize],
) -> impl Iterator<Item = f64> + 'a {
    let planes = move || cover.iter().map(|&i| &exact[i]);
    voids.iter().map(move |&void| widest_mm(planes(), void))
}

/// The widest opening of a void by some planes, mm.
fn widest_mm<'a>(planes: impl Iterator<Item = &'a Exact>, void: usize) -> f64 {
    planes
        .filter_map(|e| e.openings[void])
        .map(|o| o.diameter_mm)
        .fold(0.0, f64::max)
}

/// Which voids none of the planes opens wide enough.
fn unopenable(scene: &Scene, exact: &[Exact]) -> Obstacle {
    let widest = |&void: &usize| widest_mm(exact.iter(), void);
    let is_closed = |&void: &usize| widest(&void) < needed_mm(scene, void);
    let voids: Vec<usize> = (0..scene.hollowed.voids.len()).filter(is_closed).collect();
    let needed_mm = voids
        .first()
        .map_or(scene.request.min_opening_mm, |&void| needed_mm(scene, void));
    let widest_mm = voids.iter().map(widest).fold(f64::INFINITY, f64::min);
    Obstacle::Unopenable {
        voids: voids.into_iter().map(VoidId::of).collect(),
        widest_mm,
        needed_mm,
    }
}

/// Diameter of the disc that must pass through the opening of a void, mm.
fn needed_mm(scene: &Scene, void: usize) -> f64 {
    scene.hollowed.voids[void].least_opening_mm(scene.request)
}
