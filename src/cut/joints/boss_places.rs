//! Candidate places of pins with bosses in a cut, and pairs of them.

use std::cmp::Ordering;

use crate::{
    cut::{
        error::CutError,
        geometry::{chart::Point2, outline::Outline},
        joints::boss_view::BossView,
    },
    mesh::TriMesh,
};

/// Approximate number of places examined per cut; more find room in narrower walls.
const PLACES_PER_CUT: f64 = 6000.0;
/// Smallest distance of two places, mm; closer ones add no information.
const MIN_PITCH_MM: f64 = 0.15;
/// Least distance of a pair of pins, as a share of the widest possible one: closer pins align
/// worse.
const SPREAD_RATIO: f64 = 0.5;
/// Largest number of checks that bosses leave the voids open; each costs a boolean.
const MAX_OPENING_CHECKS: usize = 24;

/// A place for a pin, with the price of keeping the material around it.
pub(crate) struct Site {
    pub(crate) at: Point2,
    pub(crate) price: f64,
    /// Share of each void's wall that its boss hides.
    pub(crate) hidden_ratios: Vec<f64>,
    pub(crate) body: TriMesh,
}

/// Cost of a set of bosses.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    /// Visible wall area that is missing from what the cleaning rule requires, mm².
    pub(crate) shortfall_mm2: f64,
    pub(crate) price: f64,
}

impl Cost {
    /// Returns the cost of bosses at some sites together.
    pub(crate) fn of(sites: &[&Site], view: &BossView) -> Self {
        let hidden_ratios: Vec<&[f64]> = sites.iter().map(|site| &site.hidden_ratios[..]).collect();
        Self {
            shortfall_mm2: view.shortfall_mm2(&hidden_ratios),
            price: sites.iter().map(|site| site.price).sum(),
        }
    }

    /// Orders by the missing visible area, then by price.
    pub(crate) fn compare(&self, other: &Self) -> Ordering {
        self.shortfall_mm2
            .total_cmp(&other.shortfall_mm2)
            .then(self.price.total_cmp(&other.price))
    }
}

/// Two sites by index, with their joint cost.
pub(crate) struct Pair {
    pub(crate) sites: [usize; 2],
    pub(crate) cost: Cost,
}

/// Returns a square grid over the bounding box of an outline; empty if the outline is.
pub(crate) fn grid(outline: &Outline) -> Vec<Point2> {
    let Some((min, max)) = outline.bounds() else {
        return Vec::new();
    };
    let size = max - min;
    let pitch = (size.x * size.y / PLACES_PER_CUT).sqrt().max(MIN_PITCH_MM);
    let [columns, rows] = [size.x, size.y].map(|extent| (extent / pitch).floor() as usize);
    let at =
        |i: usize, j: usize| min + nalgebra::Vector2::new(i as f64 + 0.5, j as f64 + 0.5) * pitch;
    (0..columns)
        .flat_map(|i| (0..rows).map(move |j| at(i, j)))
        .collect()
}

/// Returns the pairs of sites that are far enough apart, best first. They are ordered by missing
/// visible area, then by price, then by distance, widest first.
pub(crate) fn best_pairs(sites: &[Site], gap_mm: f64, view: &BossView) -> Vec<Pair> {
    let indices = || (0..sites.len()).flat_map(|i| (i + 1..sites.len()).map(move |j| [i, j]));
    let distance = |[i, j]: [usize; 2]| (sites[i].at - sites[j].at).norm();
    let widest = indices().map(distance).fold(0.0, f64::max);
    let min_distance = gap_mm.max(SPREAD_RATIO * widest);
    let pair = |[i, j]: [usize; 2]| Pair {
        sites: [i, j],
        cost: Cost::of(&[&sites[i], &sites[j]], view),
    };
    let mut pairs: Vec<Pair> = indices()
        .filter(|&pair| distance(pair) >= min_distance)
        .map(pair)
        .collect();
    pairs.sort_by(|a, b| {
        a.cost
            .compare(&b.cost)
            .then(distance(b.sites).total_cmp(&distance(a.sites)))
            .then(a.sites.cmp(&b.sites))
    });
    pairs
}

/// Finds sets of sites that leave every void open, with few checks. A site that closes a void
/// alone does so in every pair; its neighbours most likely do too.
pub(crate) struct OpenPairs<'a> {
    view: &'a BossView<'a>,
    sites: &'a [Site],
    /// Sites closer than this to one that closes a void are skipped, mm.
    near_mm: f64,
    open_alone: Vec<Option<bool>>,
    checks_left: usize,
}

impl<'a> OpenPairs<'a> {
    pub(crate) fn new(view: &'a BossView, sites: &'a [Site], near_mm: f64) -> Self {
        Self {
            view,
            sites,
            near_mm,
            open_alone: vec![None; sites.len()],
            checks_left: MAX_OPENING_CHECKS,
        }
    }

    /// True if no checks are left.
    pub(crate) fn is_exhausted(&self) -> bool {
        self.checks_left == 0
    }

    /// Returns true if bosses at all these sites leave every void open. Sites close to one that
    /// closes a void count as closing.
    pub(crate) fn leaves_open(&mut self, sites: &[usize]) -> Result<bool, CutError> {
        if sites.iter().any(|&site| self.is_near_closing(site)) {
            return Ok(false);
        }
        for &site in sites {
            if self.open_alone[site].is_none() {
                self.open_alone[site] = Some(self.check_open(&[site])?);
            }
        }
        Ok(sites
            .iter()
            .all(|&site| self.open_alone[site] == Some(true))
            && self.check_open(sites)?)
    }

    fn is_near_closing(&self, site: usize) -> bool {
        let at = &self.sites[site].at;
        let closing = self
            .sites
            .iter()
            .zip(&self.open_alone)
            .filter(|(_, is_open)| **is_open == Some(false));
        closing
            .into_iter()
            .any(|(other, _)| (other.at - at).norm() < self.near_mm)
    }

    fn check_open(&mut self, sites: &[usize]) -> Result<bool, CutError> {
        self.checks_left = self.checks_left.saturating_sub(1);
        let bodies: Vec<TriMesh> = sites
            .iter()
            .map(|&site| self.sites[site].body.clone())
            .collect();
        self.view.stays_open(&bodies)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            Hollowed,
            geometry::tree::CutTree,
            scenes::{cuboid, request},
        },
        geom::{Plane, Vector},
    };

    /// Returns sites along x. Each row is the position, the price, the hidden share of the one
    /// void, and whether the boss is a lid (else a post).
    fn sites(rows: &[(f64, f64, f64, bool)]) -> Vec<Site> {
        let site = |&(x, price, hidden_ratio, is_lid): &(f64, f64, f64, bool)| {
            let side = if is_lid { 20.0 } else { 1.0 };
            let body = cuboid([x - side, -side, -4.0], [x + side, side, -2.0]).into_mesh();
            Site {
                at: Point2::new(x, 0.0),
                price,
                hidden_ratios: vec![hidden_ratio],
                body,
            }
        };
        rows.iter().map(site).collect()
    }

    fn in_a_box(test: impl Fn(&BossView)) {
        let void = cuboid([-10.0, -10.0, -20.0], [10.0, 10.0, 20.0]);
        let body = Hollowed::new(
            cuboid([-15.0, -15.0, -25.0], [15.0, 15.0, 25.0]),
            vec![void],
        );
        let tree = CutTree::everywhere(&[Plane {
            normal: Vector::z(),
            offset_mm: 0.01,
        }]);
        test(&BossView::new(&body, &tree, &request()).unwrap());
    }

    #[test]
    fn the_best_pair_is_the_cheapest_that_is_far_enough_apart() {
        in_a_box(|view| {
            let sites = sites(&[
                (-9.0, 1.0, 0.0, false),
                (-8.0, 1.0, 0.0, false),
                (0.0, 5.0, 0.0, false),
                (9.0, 2.0, 0.0, false),
            ]);
            let best = best_pairs(&sites, 3.0, view);
            // Pairs 0-3 and 1-3 are equally cheap, and 0-3 is wider. Sites 0 and 1 are too close.
            assert_eq!(best[0].sites, [0, 3]);
            assert!(best.iter().all(|pair| pair.sites != [0, 1]));
        });
    }

    #[test]
    fn a_pair_with_a_closing_site_is_refused_and_its_neighbours_are_not_checked() {
        in_a_box(|view| {
            let sites = sites(&[
                (-9.0, 1.0, 0.0, true),
                (-8.5, 1.0, 0.0, false),
                (5.0, 1.0, 0.0, false),
                (9.0, 1.0, 0.0, false),
            ]);
            let mut open = OpenPairs::new(view, &sites, 2.0);
            assert!(!open.leaves_open(&[0, 2]).unwrap());
            let checks_left = open.checks_left;
            assert!(!open.leaves_open(&[1, 3]).unwrap(), "beside what closes");
            assert_eq!(open.checks_left, checks_left);
            assert!(open.leaves_open(&[2, 3]).unwrap());
        });
    }
}
