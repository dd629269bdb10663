//! Sites in a grid, for those near a place.

use crate::geom::{Aabb, Point};

/// Sites a box of the grid holds in the mean.
const SITES_PER_BOX: f64 = 2.0;
/// Most boxes along an axis.
const MOST_BOXES: usize = 200;

/// Sites in the boxes of a grid.
#[derive(Debug)]
pub struct Near<'a> {
    sites: &'a [Point],
    bounds: Aabb,
    /// The side of a box, mm.
    side_mm: f64,
    counts: [usize; 3],
    boxes: Vec<Vec<usize>>,
}

impl<'a> Near<'a> {
    /// Sorts sites into boxes.
    pub fn new(sites: &'a [Point]) -> Self {
        let bounds = Aabb::of_points(sites);
        let size = bounds.size();
        let longest = size.max().max(f64::MIN_POSITIVE);
        let count = sites.len().max(1) as f64;
        // Flat or thin sets of sites have no volume: their boxes follow the longest side.
        let volume = size
            .iter()
            .map(|side| side.max(0.01 * longest))
            .product::<f64>();
        let least = longest / MOST_BOXES as f64;
        let side_mm = (volume * SITES_PER_BOX / count).cbrt().max(least);
        let counts = [0, 1, 2].map(|axis| (size[axis] / side_mm) as usize + 1);
        let mut near = Self {
            sites,
            bounds,
            side_mm,
            counts,
            boxes: vec![Vec::new(); counts.iter().product()],
        };
        for (index, site) in sites.iter().enumerate() {
            let at = near.index(near.place(site));
            near.boxes[at].push(index);
        }
        near
    }

    /// Returns the box in which a point lies, or the one nearest to it.
    fn place(&self, at: &Point) -> [usize; 3] {
        [0, 1, 2].map(|axis| {
            let from = (at[axis] - self.bounds.min[axis]) / self.side_mm;
            (from.max(0.0) as usize).min(self.counts[axis] - 1)
        })
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.counts[1] + y) * self.counts[0] + x
    }

    /// Returns the number of rings of boxes around any box that hold all sites.
    pub fn rings(&self) -> usize {
        self.counts.into_iter().max().unwrap_or(1)
    }

    /// Returns the sites in the boxes of a ring around a site, the nearest first. Ring 0 is its own
    /// box; sites of later rings are at least `ring` boxes' sides away.
    pub fn ring(&self, site: usize, ring: usize) -> Vec<usize> {
        let center = self.place(&self.sites[site]);
        let range = |axis: usize| {
            let low = center[axis].saturating_sub(ring);
            low..=(center[axis] + ring).min(self.counts[axis] - 1)
        };
        let mut found = Vec::new();
        for z in range(2) {
            for y in range(1) {
                for x in range(0) {
                    let place = [x, y, z];
                    let off = [0, 1, 2].map(|axis| place[axis].abs_diff(center[axis]));
                    if off.into_iter().max() == Some(ring) {
                        found.extend(&self.boxes[self.index(place)]);
                    }
                }
            }
        }
        found.retain(|&other| other != site);
        let far = |other: usize| (self.sites[other] - self.sites[site]).norm_squared();
        found.sort_by(|&a, &b| far(a).total_cmp(&far(b)).then(a.cmp(&b)));
        found
    }

    /// Returns a distance within which all sites lie in rings up to this one, mm.
    pub fn reach_mm(&self, ring: usize) -> f64 {
        ring as f64 * self.side_mm
    }
}
