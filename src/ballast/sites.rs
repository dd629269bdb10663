//! Where a stock part may lie, and where it acts most.

use rayon::prelude::*;

use super::load::{Load, Placed};
use super::{Fit, Part, Pocket};
use crate::geom::{Frame, Point, Quadric, Vector};
use crate::goal::Placement;
use crate::interior::Columns;
use crate::mass::{Lump, Moments, moments_of_mesh};
use crate::mesh::{MeshDistance, Solid};
use crate::shell::Keep;

/// Sites along the longer side of the model. Fewer miss narrow places; the best is refined to a
/// fraction of the step anyway.
const SITES_A_SIDE: f64 = 48.0;
/// Places are refined down to steps of this, mm: a tenth of what a printer places.
const FINEST_STEP_MM: f64 = 0.02;
/// Refining ends after so many moves. Each halves the step or gains; few places take more than
/// fifty.
const MOST_MOVES: usize = 200;
/// How much deeper than the wall asks a pocket is laid, mm: the measured wall is that of rounded
/// vertices.
const SPARE_MM: f64 = 1e-3;

/// The places of a model: points of what may be emptied, and how deep they lie.
pub(super) struct Sites<'a> {
    surface: MeshDistance,
    keeps: &'a [Keep],
    frame: Frame,
    wall_mm: f64,
    step_mm: f64,
    /// Goal frame, mm, with their depths below the surface.
    points: Vec<(Point, f64)>,
}

/// A part that seeks a place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wish<'w> {
    /// The part.
    pub part: &'w Part,
    /// What the moments added are weighed with; goal frame. Less is better.
    pub prices: Quadric,
    /// What is placed already, how parts fit, and the print's density.
    pub load: &'w Load,
}

/// What a part with its pocket adds about the origin for one direction of its axis, goal frame.
struct Stamp {
    /// Model frame.
    axis: Vector,
    added: Moments,
    jacket_mm3: f64,
    /// The least depth of a centre that its pocket can have, mm.
    least_depth_mm: f64,
}

impl<'a> Sites<'a> {
    /// The sites within these columns of what may be emptied.
    pub fn new(solid: &Solid, placement: &'a Placement, wall_mm: f64, columns: &Columns) -> Self {
        let surface = MeshDistance::new(solid.mesh());
        let (frame, step_mm) = (
            placement.goal.frame,
            solid.mesh().longest_side_mm() / SITES_A_SIDE,
        );
        let points: Vec<Point> = points_of(columns, step_mm);
        let depth = |p: Point| (p, surface.signed(&frame.to_model(&p)));
        let points = points.into_par_iter().map(depth).collect();
        Self {
            surface,
            keeps: &placement.keeps,
            frame,
            wall_mm,
            step_mm,
            points,
        }
    }

    /// The place where the part acts most; none where it does not fit.
    ///
    /// All sites are put in the order of what they add; the first with room is refined by moves
    /// along the axes.
    pub fn best(&self, wish: &Wish) -> Option<Placed> {
        let stamps = self.stamps(wish);
        let costs = |stamp: usize| {
            let cost = |site: usize| {
                (
                    stamp_cost(&stamps[stamp], wish, &self.points[site].0),
                    stamp,
                    site,
                )
            };
            (0..self.points.len())
                .into_par_iter()
                .map(cost)
                .collect::<Vec<_>>()
        };
        let mut order: Vec<(f64, usize, usize)> = (0..stamps.len()).flat_map(costs).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let is_deep = |&&(_, stamp, site): &&(f64, usize, usize)| {
            self.points[site].1 >= self.wall_mm + stamps[stamp].least_depth_mm
        };
        let first = order.iter().filter(is_deep).find(|&&(_, stamp, site)| {
            self.has_room(
                &self.lump(wish, &stamps[stamp], &self.points[site].0),
                wish.load,
            )
        });
        let &(_, stamp, site) = first?;
        let lump = self.refined(wish, &stamps[stamp], self.points[site].0);
        Some(Placed {
            part: wish.part.clone(),
            lump,
        })
    }

    /// The part in every direction it may have: a ball in one, the others along the axes of the
    /// goal's frame.
    fn stamps(&self, wish: &Wish) -> Vec<Stamp> {
        let axes = if wish.part.shape.is_ball() { 1 } else { 3 };
        let stamp = |i: usize| {
            // The third axis first: up, or the spin axis.
            let axis: Vector = self.frame.axes.column(2 - i).into_owned();
            let lump = self.lump_at(wish.part, &self.frame.origin, &axis);
            let Load {
                fit:
                    Fit {
                        clearance_mm,
                        web_mm,
                    },
                density_g_mm3,
                ..
            } = *wish.load;
            let pocket = Pocket::of(&lump, clearance_mm);
            let added = lump.moments(density_g_mm3) - pocket.moments();
            let half_mm = pocket
                .half_height_mm
                .map_or(pocket.radius_mm, |half| half.min(pocket.radius_mm));
            Stamp {
                axis,
                added: added.in_frame(&self.frame),
                jacket_mm3: moments_of_mesh(&pocket.grown(web_mm).mesh()).volume(),
                least_depth_mm: half_mm,
            }
        };
        (0..axes).map(stamp).collect()
    }

    fn lump(&self, wish: &Wish, stamp: &Stamp, local: &Point) -> Lump {
        self.lump_at(wish.part, &self.frame.to_model(local), &stamp.axis)
    }

    fn lump_at(&self, part: &Part, center: &Point, axis: &Vector) -> Lump {
        Lump {
            shape: part.shape,
            mass_g: part.mass_g,
            center_mm: (*center).into(),
            axis: (*axis).into(),
        }
    }

    /// The part moved by a share of the way to another place; none where that has no room.
    pub fn between(&self, from: &Placed, to: &Placed, share: f64, load: &Load) -> Option<Placed> {
        let (a, b) = (
            Point::from(from.lump.center_mm),
            Point::from(to.lump.center_mm),
        );
        let lump = Lump {
            center_mm: (a + (b - a) * share).into(),
            ..to.lump
        };
        self.has_room(&lump, load).then(|| Placed {
            part: to.part.clone(),
            lump,
        })
    }

    /// Whether its pocket leaves the wall, what must stay solid, and the other pockets' webs.
    fn has_room(&self, lump: &Lump, load: &Load) -> bool {
        let pocket = Pocket::of(lump, load.fit.clearance_mm);
        let wall_mm = self.wall_mm + SPARE_MM;
        let (points, reach_mm) = pocket.outline();
        let is_free = |p: &Point| {
            self.keeps
                .iter()
                .all(|keep| keep.distance_mm(p) >= reach_mm)
                && self.surface.signed(p) - reach_mm >= wall_mm
        };
        points.iter().all(is_free)
            && load
                .pockets()
                .all(|other| other.clears(&pocket, load.fit.web_mm))
            && (pocket.half_height_mm.is_none()
                || self.surface.min_distance_to(&pocket.mesh()) >= wall_mm)
    }

    /// The place moved along the axes as long as that gains, in steps that halve where nothing
    /// does.
    fn refined(&self, wish: &Wish, stamp: &Stamp, start: Point) -> Lump {
        let (mut best, mut step_mm) =
            ((stamp_cost(stamp, wish, &start), start), self.step_mm / 2.0);
        for _ in 0..MOST_MOVES {
            let moves = (0..6).map(|i| {
                let way = Vector::ith(i / 2, if i % 2 == 0 { step_mm } else { -step_mm });
                (stamp_cost(stamp, wish, &(best.1 + way)), best.1 + way)
            });
            let gains = moves.filter(|(cost, p)| {
                *cost < best.0 && self.has_room(&self.lump(wish, stamp, p), wish.load)
            });
            match gains.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some(better) => best = better,
                None if step_mm < FINEST_STEP_MM => break,
                None => step_mm /= 2.0,
            }
        }
        self.lump(wish, stamp, &best.1)
    }
}

/// What the part adds at a point of the goal frame: the part less its pocket; and what must stay
/// solid around it where the void would have been.
fn stamp_cost(stamp: &Stamp, wish: &Wish, p: &Point) -> f64 {
    let moved = stamp.added.translated(&p.coords);
    let added: f64 = wish
        .prices
        .0
        .iter()
        .zip(moved.0)
        .map(|(price, moment)| price * moment)
        .sum();
    added + stamp.jacket_mm3 * wish.prices.value(p).max(0.0)
}

/// Points of the columns, no nearer to each other along any axis than the step.
fn points_of(columns: &Columns, step_mm: f64) -> Vec<Point> {
    let is_row = |x: f64, pitch: f64| (x / step_mm).floor() != ((x - pitch) / step_mm).floor();
    let [px, py] = columns.pitch_mm;
    let is_taken = |column: &usize| {
        let [x, y] = columns.centers[*column];
        is_row(x, px) && is_row(y, py)
    };
    (0..columns.len())
        .filter(is_taken)
        .flat_map(|column| {
            let [x, y] = columns.centers[column];
            columns
                .intervals_of(column)
                .iter()
                .flat_map(move |&[bottom, top]| {
                    let steps = ((top - bottom) / step_mm).floor() as u32;
                    let middle = 0.5 * (bottom + top - f64::from(steps) * step_mm);
                    (0..=steps).map(move |i| Point::new(x, y, middle + f64::from(i) * step_mm))
                })
                .collect::<Vec<_>>()
        })
        .collect()
}
