//! The order in which the planes of the family are measured: the most promising first.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::planner::{
        cover::{VoidSet, greedy_cover},
        family::Candidate,
        score::{AMPLE_OPENING_RATIO, Scene, estimate_seam_penalty, shortfall},
    },
};

/// Keeps the planes whose seams may run where they do.
pub(crate) fn keep_allowed(scene: &Scene, family: &mut Vec<Candidate>) -> Result<(), Cancelled> {
    let seams = &scene.request.seams;
    if seams.keep_clear.is_empty() && !seams.only_level {
        return Ok(());
    }
    let allows = |candidate: &Candidate| {
        scene.request.watch.check()?;
        Ok(scene.allows(&candidate.plane).then_some(*candidate))
    };
    let kept = family.par_iter().map(allows);
    let kept = kept.collect::<Result<Vec<Option<Candidate>>, Cancelled>>()?;
    *family = kept.into_iter().flatten().collect();
    Ok(())
}

/// A plane of the family in its turn.
struct Turn {
    candidate: Candidate,
    /// True if it is in no smallest cover.
    is_late: bool,
    /// The promise of its opening and its seam, 0 at best.
    penalty: f64,
}

/// Sorts the family by promise. If somebody looks at seams, they take turns with openings. The
/// planes measured first then hold the widest as well as the best hidden ones.
pub(crate) fn promising_first(
    scene: &Scene,
    family: Vec<Candidate>,
    all: VoidSet,
) -> Result<Vec<Candidate>, Cancelled> {
    let mut wide = widest_first(scene, family, all)?;
    if scene.request.seams.skin.is_some() {
        let ample_mm = ample_guess_mm(scene);
        wide.par_iter_mut().try_for_each(|turn| {
            scene.request.watch.check()?;
            let Candidate {
                plane, guess_mm, ..
            } = turn.candidate;
            turn.penalty = shortfall(guess_mm, ample_mm) + estimate_seam_penalty(scene, &plane);
            Ok(())
        })?;
    }
    let mut hidden: Vec<usize> = (0..wide.len()).collect();
    let by_promise = |i: &usize, j: &usize| {
        let (a, b) = (&wide[*i], &wide[*j]);
        a.is_late
            .cmp(&b.is_late)
            .then(a.penalty.total_cmp(&b.penalty))
    };
    if scene.request.seams.skin.is_some() {
        hidden.sort_by(by_promise);
    }
    let level = level_turns(scene, &wide);
    let mut is_taken = vec![false; wide.len()];
    let turns = (0..wide.len()).flat_map(|turn| {
        let level = level.get(turn).copied();
        [Some(hidden[turn]), level, Some(turn)]
    });
    let turns = turns.flatten();
    let fresh = turns.filter(|&index| !std::mem::replace(&mut is_taken[index], true));
    Ok(fresh.map(|index| wide[index].candidate).collect())
}

/// Returns the places of the level planes, spread over the height at any moment: each next one lies
/// in the widest gap so far. Empty unless seams are weighed against what stays unclean.
///
/// The best hidden planes crowd about ear tips and feet, where seams are short and most of a void
/// stays unseen. A level cut at the waist is what a person would try. Where every void must be
/// clean, they would take the turns of planes that open more.
fn level_turns(scene: &Scene, wide: &[Turn]) -> Vec<usize> {
    let seams = &scene.request.seams;
    let Some(up) = seams.lack_weight.and(seams.up()) else {
        return Vec::new();
    };
    let is_level = |&place: &usize| {
        let turn = &wide[place];
        !turn.is_late && turn.candidate.plane.normal == up
    };
    let mut level: Vec<usize> = (0..wide.len()).filter(is_level).collect();
    let offset_mm = |place: &usize| wide[*place].candidate.plane.offset_mm;
    level.sort_by(|a, b| offset_mm(a).total_cmp(&offset_mm(b)));
    if level.is_empty() {
        return level;
    }
    let bits = usize::BITS - level.len().leading_zeros();
    let places = (0..1_usize << bits).map(|index| index.reverse_bits() >> (usize::BITS - bits));
    places
        .filter_map(|place| level.get(place).copied())
        .collect()
}

/// Sorts the family by its openings. Planes that can be part of a smallest cover come first, one
/// for each set of voids in turn. Among planes that meet the same voids, the best offset of each
/// direction comes first, then the second best, and so on. Offsets are compared by their estimated
/// openings. Ample estimates count as equal. So the axes, which lead the family, precede skew
/// directions that are no better.
fn widest_first(
    scene: &Scene,
    family: Vec<Candidate>,
    all: VoidSet,
) -> Result<Vec<Turn>, Cancelled> {
    let classes = classes(scene, &family, all)?;
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
    let ample_mm = ample_guess_mm(scene);
    let capped = |c: &Candidate| c.guess_mm.min(ample_mm);
    places.sort_by(|(i, a), (j, b)| i.cmp(j).then(capped(b).total_cmp(&capped(a))));
    let mut counts = vec![0; classes.len()];
    let mut turns: Vec<((bool, usize), Candidate)> = Vec::with_capacity(places.len());
    for (_, candidate) in places {
        let class = class_of(&candidate);
        counts[class] += 1;
        turns.push(((classes[class].1 > least, counts[class]), candidate));
    }
    turns.sort_by_key(|&(turn, _)| turn);
    let turn = |((is_late, _), candidate)| Turn {
        candidate,
        is_late,
        penalty: 0.0,
    };
    Ok(turns.into_iter().map(turn).collect())
}

/// Returns the estimated opening above which a wider one is no better, mm. It is twice the limit of
/// the score, because estimates err.
fn ample_guess_mm(scene: &Scene) -> f64 {
    2.0 * AMPLE_OPENING_RATIO * scene.request.min_opening_mm
}

/// Returns the distinct sets of voids met, in ascending order. Each comes with the number of
/// further planes that open the rest by greedy choice.
fn classes(
    scene: &Scene,
    family: &[Candidate],
    all: VoidSet,
) -> Result<Vec<(VoidSet, usize)>, Cancelled> {
    let mut sets: Vec<VoidSet> = family.iter().map(|c| c.met).collect();
    sets.sort_unstable();
    sets.dedup();
    let rest =
        |set: VoidSet| greedy_cover(&sets, all & !set).map_or(usize::MAX, |chosen| chosen.len());
    let class = |&set: &VoidSet| {
        scene.request.watch.check()?;
        Ok((set, rest(set)))
    };
    sets.par_iter().map(class).collect()
}
