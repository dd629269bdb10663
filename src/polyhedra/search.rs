//! The search: several starts, growth, dropped faces, and the limits at last.

use rayon::prelude::*;

use super::dropping::{drop_cheapest, drop_idle};
use super::growth::{Growth, Terms, Tilts};
use super::mending::mend;
use super::random::Random;
use super::starts::{Deep, Normals, common_mm, directions, first_sides};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Plane, Vector};

/// Least number of faces at the start: dropping some is better than starting with few.
const FIRST_FACES: usize = 24;
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

/// What a search is asked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wish<'a> {
    pub terms: Terms<'a>,
    /// Planes that stay.
    pub locked: &'a [Plane],
    /// The greatest number of faces, at least 4; `None` keeps all that grow.
    pub faces: Option<usize>,
    /// The number of starts.
    pub starts: usize,
}

impl Wish<'_> {
    fn normals<'b>(&'b self, free: &'b [Vector]) -> Normals<'b> {
        let locked = self.locked;
        Normals { free, locked }
    }

    fn first_faces(&self) -> usize {
        self.faces
            .map_or(FIRST_FACES, |faces| faces.max(FIRST_FACES))
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
    let started: Result<Vec<Option<Growth>>, Cancelled> = (0..wish.starts)
        .into_par_iter()
        .map(|start| {
            watch.check()?;
            Ok(start_at(wish, &deep[seat_of(start, seats)], start))
        })
        .collect();
    let mut grown: Vec<Growth> = started?.into_iter().flatten().collect();
    grown.sort_by(|a, b| b.volume_mm3.total_cmp(&a.volume_mm3));
    if let Some(faces) = wish.faces {
        grown.truncate(grown.len().div_ceil(STARTS_PER_FINALIST));
        let finished: Result<Vec<Growth>, Cancelled> = grown
            .into_par_iter()
            .map(|growth| finished(growth, faces, watch))
            .collect();
        grown = finished?;
    }
    let better = |a: Growth<'a>, b: Growth<'a>| if b.merit_mm3 > a.merit_mm3 { b } else { a };
    Ok(grown.into_iter().reduce(better))
}

/// Returns by how much the first planes of any start part the nearest obstacle from its deep
/// point, mm: the most of all starts. Zero or less if the point itself cannot be parted.
pub(super) fn widest_start_mm(wish: &Wish, deep: &[Deep]) -> f64 {
    let seats = seats(deep);
    let start = |start: usize| {
        let at = &deep[seat_of(start, seats)].at;
        let first = directions(wish.first_faces(), start);
        common_mm(&wish.terms, at, &wish.normals(&first))
    };
    let starts = if seats == 0 { 0 } else { wish.starts };
    (0..starts).map(start).fold(0.0, f64::max)
}

/// Counts the deep points at which a start is worth its time.
fn seats(deep: &[Deep]) -> usize {
    let deepest_mm = deep.first().map_or(0.0, |deep| deep.depth_mm);
    deep.iter()
        .take_while(|deep| deep.depth_mm >= SHALLOW_RATIO * deepest_mm)
        .count()
}

/// Returns the deep point of a start: every other one is the deepest.
fn seat_of(start: usize, seats: usize) -> usize {
    if start.is_multiple_of(2) {
        0
    } else {
        start / 2 % seats
    }
}

fn start_at<'a>(wish: &Wish<'a>, deep: &Deep, seed: usize) -> Option<Growth<'a>> {
    let terms = Terms {
        price: 0.0,
        ..wish.terms
    };
    let first = directions(wish.first_faces(), seed);
    let sides = first_sides(&terms, &deep.at, &wish.normals(&first))?;
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
