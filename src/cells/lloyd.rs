//! Lloyd's relaxation: every site goes to the place in its cell that is best, again and again.

use super::chain::Chain;
use super::diagram::each_cell;
use super::energy::{Bulk, Chebyshev, Weight};
use super::room::Room;
use crate::base::words::choice;
use crate::geom::{Matrix, Point};

choice! {
    /// The distance that a relaxation makes small.
    #[derive(Default)]
    Norm, "norm" {
        /// The greatest coordinate: cells become cubes.
        #[default]
        Linf = "linf",
        /// The straight distance: sites go to the centres of their cells.
        L2 = "l2",
    }
}

/// The order of a relaxation.
pub struct Order<'a> {
    /// The distance.
    pub norm: Norm,
    /// Most steps.
    pub steps: usize,
    /// The movement of a site below which no further step is taken, mm.
    pub still_mm: f64,
    /// The axes of the cells at a place, as columns; those of the model if it is `None`.
    pub frame: Option<&'a (dyn Fn(&Point) -> Matrix + Sync)>,
    /// The weight of the energy at a place; 1 if it is `None`.
    pub weight: Option<&'a Weight<'a>>,
}

/// A step of a relaxation: what holds before its sites move, and how far they do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The sum of ∫ ‖x − p‖∞ over all cells, mm⁴.
    pub chebyshev: f64,
    /// The sum of ∫ |x − p|² over all cells, mm⁵.
    pub spread: f64,
    /// The mean movement of the sites, mm.
    pub mean_mm: f64,
    /// The greatest movement of a site, mm.
    pub most_mm: f64,
}

/// Most Newton steps for a cell: three to five reach the best place.
const NEWTON_STEPS: usize = 12;
/// Least step, as a part of the first one: below it the place is the best to rounding.
const NEWTON_RATIO: f64 = 1e-10;
/// Rounding of an energy, as a part of it.
const ROUNDING: f64 = 1e-14;
/// Most halvings of a Newton step.
const HALVINGS: usize = 30;
/// The same with a weight. It is interpolated, so slope and energy agree only to its curvature, and
/// what follows would not become better.
const WEIGHTED_RATIO: f64 = 1e-3;
const WEIGHTED_HALVINGS: usize = 6;

/// Relaxes sites, and returns its steps; `sites` are the relaxed ones after it.
///
/// It ends early once no site moves by more than `still_mm`, or when `stopped` says so.
pub fn relax(
    sites: &mut Vec<Point>,
    room: &Room,
    order: &Order<'_>,
    stopped: impl Fn() -> bool,
) -> Vec<Step> {
    let mut steps = Vec::with_capacity(order.steps);
    for _ in 0..order.steps {
        if stopped() {
            break;
        }
        let moved = each_cell(sites, room, |index, cell| {
            let site = sites[index];
            let energy = chebyshev(&cell.part, &site, order);
            let bulk = Bulk::of(&cell.part, &site, order.weight);
            let best = match order.norm {
                Norm::L2 => bulk.center,
                Norm::Linf => best_place(&cell.part, site, energy, order),
            };
            (best, energy.energy, bulk.spread)
        });
        let distances = moved.iter().zip(sites.iter());
        let distances: Vec<f64> = distances
            .map(|((to, ..), from)| (to - from).norm())
            .collect();
        let step = Step {
            chebyshev: moved.iter().map(|(_, energy, _)| energy).sum(),
            spread: moved.iter().map(|(.., spread)| spread).sum(),
            mean_mm: distances.iter().sum::<f64>() / distances.len().max(1) as f64,
            most_mm: distances.iter().copied().fold(0.0, f64::max),
        };
        *sites = moved.into_iter().map(|(to, ..)| to).collect();
        steps.push(step);
        if step.most_mm <= order.still_mm {
            break;
        }
    }
    steps
}

fn chebyshev(part: &Chain, site: &Point, order: &Order<'_>) -> Chebyshev {
    let frame = order.frame.map_or(Matrix::identity(), |frame| frame(site));
    Chebyshev::of(part, site, &frame, order.weight)
}

/// Returns the place of a cell with the least energy, by Newton's method from a place of known
/// energy. The energy is convex, and never rises.
fn best_place(part: &Chain, from: Point, known: Chebyshev, order: &Order<'_>) -> Point {
    // The axes stay those of the start: the energy of turning axes is not convex.
    let frame = order.frame.map_or(Matrix::identity(), |frame| frame(&from));
    let at = |place: &Point| Chebyshev::of(part, place, &frame, order.weight);
    let (least_ratio, halvings) = match order.weight {
        Some(_) => (WEIGHTED_RATIO, WEIGHTED_HALVINGS),
        None => (NEWTON_RATIO, HALVINGS),
    };
    let (mut place, mut here) = (from, known);
    let mut first_mm = None;
    for _ in 0..NEWTON_STEPS {
        let Some(way) = here.hessian.lu().solve(&-here.gradient) else {
            break;
        };
        let first = *first_mm.get_or_insert(way.norm());
        if way.norm() <= least_ratio * first {
            break;
        }
        let mut share = 1.0;
        let mut better = None;
        for _ in 0..halvings {
            let next = place + way * share;
            let there = at(&next);
            // Near the best place energies differ by rounding only, and the slope still tells.
            let is_flatter = there.gradient.norm() < here.gradient.norm();
            let is_no_more = there.energy <= here.energy * (1.0 + ROUNDING);
            if there.energy < here.energy || (is_no_more && is_flatter) {
                better = Some((next, there));
                break;
            }
            share *= 0.5;
        }
        let Some((next, there)) = better else {
            break;
        };
        (place, here) = (next, there);
    }
    place
}
