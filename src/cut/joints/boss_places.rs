//! Where pins with bosses might go: places of a cut, and pairs of them.

use std::cmp::Ordering;

use crate::{
    cut::{
        error::CutError,
        geometry::{chart::Point2, outline::Outline},
        joints::boss_view::BossView,
    },
    mesh::TriMesh,
};

/// About how many places of a cut are looked at; more find room in narrower walls.
const PLACES_PER_CUT: f64 = 6000.0;
/// Places nearer together than this tell nothing new, mm.
const MIN_PITCH_MM: f64 = 0.15;
/// A pair of pins is at least this share of the widest possible distance apart: nearer ones align
/// worse.
const SPREAD_RATIO: f64 = 0.5;
/// How often it is looked whether bosses leave the voids open, each of which costs a boolean.
const TRIED_OPENINGS: usize = 24;

/// A place for a pin with what it costs to keep the material around it.
pub(crate) struct Site {
    pub(crate) at: Point2,
    pub(crate) price: f64,
    /// How much of each void's wall its boss hides, as a share of it.
    pub(crate) hides: Vec<f64>,
    pub(crate) body: TriMesh,
}

/// What bosses cost.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    /// How much less than asked is in sight of the voids' walls, mm².
    pub(crate) lack_mm2: f64,
    pub(crate) price: f64,
}

impl Cost {
    /// The cost of bosses at some sites together.
    pub(crate) fn of(sites: &[&Site], view: &BossView) -> Self {
        let hides: Vec<&[f64]> = sites.iter().map(|site| &site.hides[..]).collect();
        Self {
            lack_mm2: view.lack_mm2(&hides),
            price: sites.iter().map(|site| site.price).sum(),
        }
    }

    /// Less where less is hidden of what must be seen, then where the price is less.
    pub(crate) fn order(&self, other: &Self) -> Ordering {
        self.lack_mm2
            .total_cmp(&other.lack_mm2)
            .then(self.price.total_cmp(&other.price))
    }
}

/// Two sites by their indices, with what they cost together.
pub(crate) struct Pair {
    pub(crate) sites: [usize; 2],
    pub(crate) cost: Cost,
}

/// A square grid over what an outline holds.
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

/// Pairs of sites that are far enough apart: those first that leave in sight what must be, or lack
/// least; of these the cheapest, and of equally cheap ones the farthest.
pub(crate) fn best_pairs(sites: &[Site], gap_mm: f64, view: &BossView) -> Vec<Pair> {
    let indices = || (0..sites.len()).flat_map(|i| (i + 1..sites.len()).map(move |j| [i, j]));
    let apart = |[i, j]: [usize; 2]| (sites[i].at - sites[j].at).norm();
    let widest = indices().map(apart).fold(0.0, f64::max);
    let least = gap_mm.max(SPREAD_RATIO * widest);
    let pair = |[i, j]: [usize; 2]| Pair {
        sites: [i, j],
        cost: Cost::of(&[&sites[i], &sites[j]], view),
    };
    let mut pairs: Vec<Pair> = indices()
        .filter(|&pair| apart(pair) >= least)
        .map(pair)
        .collect();
    pairs.sort_by(|a, b| {
        a.cost
            .order(&b.cost)
            .then(apart(b.sites).total_cmp(&apart(a.sites)))
            .then(a.sites.cmp(&b.sites))
    });
    pairs
}

/// Which pairs of sites leave every void open, found with few looks: what closes one alone does so
/// in every pair, and so do, most likely, the sites beside it.
pub(crate) struct OpenPairs<'a> {
    view: &'a BossView<'a>,
    sites: &'a [Site],
    /// Sites nearer than this to one that closes a void are not looked at, mm.
    near_mm: f64,
    opens: Vec<Option<bool>>,
    looks_left: usize,
}

impl<'a> OpenPairs<'a> {
    pub(crate) fn new(view: &'a BossView, sites: &'a [Site], near_mm: f64) -> Self {
        Self {
            view,
            sites,
            near_mm,
            opens: vec![None; sites.len()],
            looks_left: TRIED_OPENINGS,
        }
    }

    /// Whether no more looks are left.
    pub(crate) fn is_over(&self) -> bool {
        self.looks_left == 0
    }

    /// Whether bosses at both sites leave every void open.
    pub(crate) fn holds(&mut self, pair: [usize; 2]) -> Result<bool, CutError> {
        if pair.iter().any(|&site| self.is_beside_closing(site)) {
            return Ok(false);
        }
        for site in pair {
            if self.opens[site].is_none() {
                self.opens[site] = Some(self.look(&[site])?);
            }
        }
        Ok(pair.iter().all(|&site| self.opens[site] == Some(true)) && self.look(&pair)?)
    }

    fn is_beside_closing(&self, site: usize) -> bool {
        let at = &self.sites[site].at;
        let closing = self
            .sites
            .iter()
            .zip(&self.opens)
            .filter(|(_, opens)| **opens == Some(false));
        closing
            .into_iter()
            .any(|(other, _)| (other.at - at).norm() < self.near_mm)
    }

    fn look(&mut self, sites: &[usize]) -> Result<bool, CutError> {
        self.looks_left = self.looks_left.saturating_sub(1);
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

    /// Sites along x, each with its price, what it hides of the one void, and a boss that is a post
    /// or a lid.
    fn sites(rows: &[(f64, f64, f64, bool)]) -> Vec<Site> {
        let site = |&(x, price, hides, is_lid): &(f64, f64, f64, bool)| {
            let side = if is_lid { 20.0 } else { 1.0 };
            let body = cuboid([x - side, -side, -4.0], [x + side, side, -2.0]).into_mesh();
            Site {
                at: Point2::new(x, 0.0),
                price,
                hides: vec![hides],
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
            // Equally cheap are 0 and 1 with 3: the farther apart. 0 and 1 are too near each other.
            assert_eq!(best[0].sites, [0, 3]);
            assert!(best.iter().all(|pair| pair.sites != [0, 1]));
        });
    }

    #[test]
    fn a_pair_with_a_site_that_closes_the_void_does_not_hold_and_its_neighbours_are_not_looked_at()
    {
        in_a_box(|view| {
            let sites = sites(&[
                (-9.0, 1.0, 0.0, true),
                (-8.5, 1.0, 0.0, false),
                (5.0, 1.0, 0.0, false),
                (9.0, 1.0, 0.0, false),
            ]);
            let mut open = OpenPairs::new(view, &sites, 2.0);
            assert!(!open.holds([0, 2]).unwrap());
            let looks_left = open.looks_left;
            assert!(!open.holds([1, 3]).unwrap(), "beside what closes");
            assert_eq!(open.looks_left, looks_left);
            assert!(open.holds([2, 3]).unwrap());
        });
    }
}
