//! The search: several starts, growth, dropped faces, and the limits at last.

use rayon::prelude::*;

use super::dropping::{drop_cheapest, drop_idle};
use super::growth::{Growth, Terms, Tilts};
use super::mending::mend;
use super::starts::{Deep, Normals, common_mm, directions, directions_with, first_sides, regular};
use crate::base::random::Random;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Plane, Vector};

/// Least number of faces at the start: dropping some is better than starting with few.
const FIRST_FACES: usize = 24;
/// One start of so many begins with the final number of faces.
const DIRECT_STRIDE: usize = 3;
/// The tilts of the first growth.
const FIRST: Tilts = Tilts {
    first: 0.35,
    least: 0.05,
};
/// The tilts of the growth after a face was dropped.
const BETWEEN: Tilts = Tilts {
    first: 0.12,
    least: 0.05,
};
/// The tilts of the last growth.
const LAST: Tilts = Tilts {
    first: 0.15,
    least: 0.01,
};
/// Deep points with less than this share of the greatest depth are no starts.
const SHALLOW_RATIO: f64 = 0.4;
/// One of so many starts is dropped to few faces: the largest ones.
const STARTS_PER_FINALIST: usize = 2;
/// The volume's share that a broken limit costs, from cheap to dear.
const PRICES: [f64; 4] = [0.02, 0.06, 0.2, 0.6];
/// Rounds of random moves at every price.
const SETTLING: usize = 60;

/// The order of a search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wish<'a> {
    pub terms: Terms<'a>,
    /// Planes that stay.
    pub locked: &'a [Plane],
    /// The greatest number of faces, at least 4; `None` keeps all that grow.
    pub faces: Option<usize>,
    /// The number of starts.
    pub starts: usize,
    /// The normals of the model's flats: with any, there is one start more.
    pub flats: &'a [Vector],
}

impl Wish<'_> {
    fn normals<'b>(&'b self, free: &'b [Vector]) -> Normals<'b> {
        let locked = self.locked;
        Normals { free, locked }
    }

    fn start_count(&self) -> usize {
        self.starts + usize::from(!self.flats.is_empty())
    }

    /// Returns the deep point of a start: every other one, and that of the flats, is the deepest.
    fn seat(&self, start: usize, seats: usize) -> usize {
        if start.is_multiple_of(2) || start >= self.starts {
            0
        } else {
            start / 2 % seats
        }
    }

    /// Returns the directions of the first faces.
    ///
    /// Dropping faces is better than starting with few in most models, but not in round ones. One
    /// start of three begins with as many faces as are asked for.
    fn directions(&self, start: usize) -> Vec<Vector> {
        let faces = self.faces.unwrap_or(FIRST_FACES);
        if start >= self.starts {
            directions_with(self.flats, FIRST_FACES)
        } else if start % DIRECT_STRIDE == DIRECT_STRIDE - 1 {
            regular(faces, start).unwrap_or_else(|| directions(faces, start))
        } else {
            directions(faces.max(FIRST_FACES), start)
        }
    }
}

/// Returns the best polyhedron of several starts from the deep points; `None` if no start has
/// room.
///
/// A local optimum. The same on any number of threads.
pub(super) fn search<'a>(
    wish: &Wish<'a>,
    deep: &[Deep],
    watch: &Watch,
) -> Result<Option<Growth<'a>>, Cancelled> {
    let seats = seats(deep);
    if seats == 0 {
        return Ok(None);
    }
    let started: Result<Vec<Option<Growth>>, Cancelled> = (0..wish.start_count())
        .into_par_iter()
        .map(|start| {
            watch.check()?;
            Ok(start_at(wish, &deep[wish.seat(start, seats)], start))
        })
        .collect();
    let mut grown: Vec<Growth> = started?.into_iter().flatten().collect();
    grown.sort_by(|a, b| b.volume_mm3.total_cmp(&a.volume_mm3));
    if let Some(faces) = wish.faces {
        grown = finalists(grown, faces);
        let finished: Result<Vec<Growth>, Cancelled> = grown
            .into_par_iter()
            .map(|growth| finished(growth, faces, watch))
            .collect();
        grown = finished?;
        grown.retain(|growth| growth.planes.len() <= faces);
    }
    let better = |a: Growth<'a>, b: Growth<'a>| if b.merit_mm3 > a.merit_mm3 { b } else { a };
    Ok(grown.into_iter().reduce(better))
}

/// Returns by how much the first planes of any start part the nearest obstacle from its deep
/// point, mm: the most of all starts. Zero or less if the point itself cannot be parted.
pub(super) fn widest_start_mm(wish: &Wish, deep: &[Deep]) -> f64 {
    let seats = seats(deep);
    let start = |start: usize| {
        let at = &deep[wish.seat(start, seats)].at;
        let first = wish.directions(start);
        common_mm(&wish.terms, at, &wish.normals(&first))
    };
    let starts = if seats == 0 { 0 } else { wish.start_count() };
    (0..starts).map(start).fold(0.0, f64::max)
}

/// Returns the largest of the growths that have faces to drop, and of those that have none.
fn finalists(grown: Vec<Growth>, faces: usize) -> Vec<Growth> {
    let has_few = |growth: &Growth| growth.planes.len() <= faces;
    let (few, many): (Vec<Growth>, Vec<Growth>) = grown.into_iter().partition(has_few);
    let best = [few, many].into_iter().flat_map(|group| {
        let count = group.len().div_ceil(STARTS_PER_FINALIST);
        group.into_iter().take(count)
    });
    best.collect()
}

/// Counts the deep points at which a start is worth its time.
fn seats(deep: &[Deep]) -> usize {
    let deepest_mm = deep.first().map_or(0.0, |deep| deep.depth_mm);
    deep.iter()
        .take_while(|deep| deep.depth_mm >= SHALLOW_RATIO * deepest_mm)
        .count()
}

fn start_at<'a>(wish: &Wish<'a>, deep: &Deep, seed: usize) -> Option<Growth<'a>> {
    let terms = Terms {
        price: 0.0,
        ..wish.terms
    };
    let flats_alone = wish.normals(wish.flats);
    let from_flats = first_sides(&terms, &deep.at, &flats_alone).filter(|_| seed >= wish.starts);
    let first = wish.directions(seed);
    let mixed = || first_sides(&terms, &deep.at, &wish.normals(&first));
    let sides = from_flats.or_else(mixed)?;
    let mut growth = Growth::new(terms, &sides)?;
    growth.grow(FIRST);
    Some(growth)
}

/// Drops faces until they are few, then brings the rest within the limits.
fn finished<'a>(
    mut growth: Growth<'a>,
    faces: usize,
    watch: &Watch,
) -> Result<Growth<'a>, Cancelled> {
    while growth.planes.len() > faces {
        watch.check()?;
        let Some(dropped) = drop_cheapest(&mut growth) else {
            break;
        };
        growth = dropped;
        growth.grow(BETWEEN);
    }
    if !growth.terms.limits.is_none() {
        let mut random = Random::new(growth.planes.len() as u64);
        for price in PRICES {
            watch.check()?;
            growth.set_price(price);
            growth.settle(SETTLING, &mut random);
            growth.grow(LAST);
        }
        growth = mend(growth, faces, &mut random);
    }
    growth.grow(LAST);
    Ok(drop_idle(growth))
}
