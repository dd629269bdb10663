//! Voronoi cells of sites, cut off at the surface of a room.

use rayon::prelude::*;

use super::axes::Axes;
use super::chain::Chain;
use super::fan;
use super::near::Near;
use super::polytope::{Beyond, Polytope};
use super::room::Room;
use crate::base::random::Random;
use crate::geom::{Plane, Point};

/// A reason why sites have no cells.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SitesError {
    /// There is no site.
    #[error("there are no sites; remedy: give one at least")]
    None,
    /// There are too many.
    #[error("{0} sites are too many; remedy: give {MOST_SITES} at most, or larger cells")]
    TooMany(usize),
    /// A coordinate is no number.
    #[error("site {0} is no point; remedy: give three finite numbers in mm")]
    NotFinite(usize),
    /// A site lies outside of the room.
    #[error("site {0} lies outside of the model; remedy: move it inside, or leave it out")]
    Outside(usize),
    /// Two sites are the same point.
    #[error("sites {0} and {1} are the same point; remedy: leave one out")]
    Doubled(usize, usize),
}

/// Most sites of a diagram.
pub const MOST_SITES: usize = 1_000_000;

/// Most throws for a random site.
const MOST_THROWS: usize = 10_000;

/// Returns an error unless all sites are different points in the room. Sites are counted from 1.
pub fn check_sites(sites: &[Point], room: &Room) -> Result<(), SitesError> {
    if sites.is_empty() {
        return Err(SitesError::None);
    }
    if sites.len() > MOST_SITES {
        return Err(SitesError::TooMany(sites.len()));
    }
    let is_finite = |site: &Point| site.coords.iter().all(|x| x.is_finite());
    if let Some(index) = sites.iter().position(|site| !is_finite(site)) {
        return Err(SitesError::NotFinite(index + 1));
    }
    let mut order: Vec<usize> = (0..sites.len()).collect();
    order.sort_by(|&a, &b| fan::order(&sites[a], &sites[b]).then(a.cmp(&b)));
    let same = order
        .windows(2)
        .find(|pair| sites[pair[0]] == sites[pair[1]]);
    if let Some(&[a, b]) = same.and_then(|pair| pair.first_chunk()) {
        return Err(SitesError::Doubled(a.min(b) + 1, a.max(b) + 1));
    }
    let outside = sites.par_iter().position_first(|site| !room.holds(site));
    outside.map_or(Ok(()), |index| Err(SitesError::Outside(index + 1)))
}

/// Returns so many random points of a room; fewer if it is so thin that hardly any is met.
///
/// The same seed gives the same points on any machine.
pub fn random_sites(room: &Room, count: usize, seed: u64) -> Vec<Point> {
    let bounds = room.bounds();
    let mut random = Random::new(seed);
    let mut sites = Vec::new();
    let throws = count.saturating_mul(MOST_THROWS);
    for _ in 0..throws {
        if sites.len() == count {
            break;
        }
        let at = [0, 1, 2].map(|axis| random.between(bounds.min[axis], bounds.max[axis]));
        let site = Point::from(at);
        if room.holds(&site) {
            sites.push(site);
        }
    }
    sites
}

/// A cell of a site.
#[derive(Debug, Clone)]
pub struct Cell {
    /// The convex cell in the box around the room.
    pub polytope: Polytope,
    /// The boundary of its part in the room.
    pub part: Chain,
}

impl Cell {
    /// Returns the cell in the model from one in a frame.
    #[must_use]
    pub fn in_model(&self, axes: &Axes) -> Self {
        Self {
            polytope: self.polytope.in_model(axes),
            part: self.part.mapped(|at| axes.to_model(at)),
        }
    }
}

/// Returns the cells of all sites.
///
/// A cell is cut by the bisectors to near sites, until every other site is farther than twice the
/// cell's farthest corner. The cells have the same bits on any number of threads.
pub fn cells(sites: &[Point], room: &Room) -> Vec<Cell> {
    each_cell(sites, room, |_, cell| cell)
}

/// Returns what `work` makes of every cell; a cell is not kept longer than that.
pub(super) fn each_cell<T: Send>(
    sites: &[Point],
    room: &Room,
    work: impl Fn(usize, Cell) -> T + Sync,
) -> Vec<T> {
    let near = Near::new(sites);
    let indices = 0..sites.len();
    let one = |index: usize| {
        let polytope = polytope_of(index, sites, room, &near);
        let part = room.within(&polytope);
        work(index, Cell { polytope, part })
    };
    indices.into_par_iter().map(one).collect()
}

/// Cuts the cell of a site from the box around the room.
fn polytope_of(index: usize, sites: &[Point], room: &Room, near: &Near<'_>) -> Polytope {
    let site = sites[index];
    let mut cell = Polytope::of_box(room.bounds());
    let mut reach_mm = cell.reach_mm(&site);
    for ring in 0..=near.rings() {
        for other in near.ring(index, ring) {
            let way = sites[other] - site;
            if way.norm() > 2.0 * reach_mm {
                // Those after it in the ring are farther still.
                break;
            }
            let bisector = Plane::through(&(site + way * 0.5), &way);
            cell.cut(&bisector, Beyond::Cell(other));
            reach_mm = cell.reach_mm(&site);
        }
        if near.reach_mm(ring) > 2.0 * reach_mm {
            break;
        }
    }
    cell
}
