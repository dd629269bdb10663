//! Sets of places of pins with bosses that hold a joint: pairs, or three where no pair does.

use crate::cut::{
    geometry::chart::Point2,
    joints::{
        boss_places::{Cost, Pair, Site, best_pairs},
        boss_view::BossView,
        face::Face,
        pin_size::Size,
    },
};

/// Number of sectors about a joint, each with one place for a third pin. Pins at the corners of a
/// triangle may be off by more than 15°. More sectors cost time with the third power.
const SECTORS: usize = 24;

/// Sites of one pattern by index, with their joint cost.
pub(crate) struct SiteSet {
    pub(crate) sites: Vec<usize>,
    pub(crate) cost: Cost,
}

impl SiteSet {
    fn of(pair: &Pair) -> Self {
        Self {
            sites: pair.sites.to_vec(),
            cost: pair.cost,
        }
    }
}

/// Returns pins at some sites, the first with the first size.
pub(crate) fn pattern_at(sites: &[Site], set: &[usize], sizes: &[Size; 2]) -> Vec<(Point2, Size)> {
    let size = |index: usize| sizes[index.min(1)];
    let pins = set.iter().enumerate();
    pins.map(|(index, &site)| (sites[site].at, size(index)))
        .collect()
}

/// Returns the pairs of sites that hold a joint, the best first. If none does, returns sets of
/// three that hold it: around a round joint they leave less play than two across it.
pub(crate) fn held_sets(
    face: &Face,
    sites: &[Site],
    sizes: &[Size; 2],
    view: &BossView,
) -> Vec<SiteSet> {
    let gap_mm = face.gap_mm(&sizes[0]);
    let is_held = |set: &SiteSet| face.is_held_by(&pattern_at(sites, &set.sites, sizes));
    let pairs = best_pairs(sites, gap_mm, view);
    let held: Vec<SiteSet> = pairs.iter().map(SiteSet::of).filter(is_held).collect();
    if !held.is_empty() {
        return held;
    }
    let threes = threes(sites, gap_mm).into_iter().map(|three| SiteSet {
        cost: Cost::of(&three.map(|site| &sites[site]), view),
        sites: three.to_vec(),
    });
    let mut held: Vec<SiteSet> = threes.filter(is_held).collect();
    held.sort_by(|a, b| a.cost.compare(&b.cost));
    held
}

/// Returns all sets of three sites, no two nearer than a gap, of the cheapest site in each of
/// [`SECTORS`] about their middle.
fn threes(sites: &[Site], gap_mm: f64) -> Vec<[usize; 3]> {
    let around = cheapest_around(sites);
    let count = around.len();
    let pairs = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
    let all = pairs.flat_map(|[i, j]| (j + 1..count).map(move |k| [i, j, k]));
    let all = all.map(|three| three.map(|at| around[at]));
    let is_apart = |a: usize, b: usize| (sites[a].at - sites[b].at).norm() >= gap_mm;
    all.filter(|&[a, b, c]| is_apart(a, b) && is_apart(b, c) && is_apart(a, c))
        .collect()
}

/// Returns the cheapest site in each sector about the middle of all, and of equal ones the farthest
/// out, in the order of the sectors.
fn cheapest_around(sites: &[Site]) -> Vec<usize> {
    let places = || sites.iter().map(|site| site.at.coords);
    let middle = places().sum::<nalgebra::Vector2<f64>>() / sites.len().max(1) as f64;
    let rank = |index: usize| {
        let site: &Site = &sites[index];
        (site.price, -(site.at.coords - middle).norm())
    };
    let mut cheapest = [None; SECTORS];
    for (index, site) in sites.iter().enumerate() {
        let way = site.at.coords - middle;
        let turn = way.y.atan2(way.x) / std::f64::consts::TAU + 0.5;
        let known = &mut cheapest[((turn * SECTORS as f64) as usize).min(SECTORS - 1)];
        if known.is_none_or(|known| rank(index) < rank(known)) {
            *known = Some(index);
        }
    }
    cheapest.into_iter().flatten().collect()
}
