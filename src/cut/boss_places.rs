//! Where pins with bosses might go: places of a cut, and pairs of them.

use super::{outline::Outline, section::Point2};

/// About how many places of a cut are looked at; more find room in narrower walls.
const PLACES_PER_CUT: f64 = 6000.0;
/// Places nearer together than this tell nothing new, mm.
const MIN_PITCH_MM: f64 = 0.15;
/// A pair of pins is at least this share of the widest possible distance apart: nearer ones align worse.
const SPREAD_RATIO: f64 = 0.5;
/// How many pairs are tried for a pattern that fits one way only and leaves the voids open.
const TRIED_PAIRS: usize = 400;

/// A place for a pin with what it costs to keep the material around it.
pub(crate) struct Site {
    pub(crate) at: Point2,
    pub(crate) price: f64,
}

/// A square grid over what an outline holds.
pub(crate) fn grid(outline: &Outline) -> Vec<Point2> {
    let Some((min, max)) = outline.bounds() else { return Vec::new() };
    let size = max - min;
    let pitch = (size.x * size.y / PLACES_PER_CUT).sqrt().max(MIN_PITCH_MM);
    let [columns, rows] = [size.x, size.y].map(|extent| (extent / pitch).floor() as usize);
    let at = |i: usize, j: usize| min + nalgebra::Vector2::new(i as f64 + 0.5, j as f64 + 0.5) * pitch;
    (0..columns).flat_map(|i| (0..rows).map(move |j| at(i, j))).collect()
}

/// Pairs of sites that are far enough apart, the cheapest first and of equally cheap ones the farthest,
/// [`TRIED_PAIRS`] at most.
pub(crate) fn cheapest_pairs(sites: &[Site], gap_mm: f64) -> Vec<(usize, usize)> {
    let indices = || (0..sites.len()).flat_map(|i| (i + 1..sites.len()).map(move |j| (i, j)));
    let apart = |(i, j): (usize, usize)| (sites[i].at - sites[j].at).norm();
    let widest = indices().map(apart).fold(0.0, f64::max);
    let least = gap_mm.max(SPREAD_RATIO * widest);
    let price = |(i, j): (usize, usize)| sites[i].price + sites[j].price;
    let mut pairs: Vec<(usize, usize)> = indices().filter(|&pair| apart(pair) >= least).collect();
    pairs.sort_by(|&a, &b| price(a).total_cmp(&price(b)).then(apart(b).total_cmp(&apart(a))).then(a.cmp(&b)));
    pairs.truncate(TRIED_PAIRS);
    pairs
}
