//! The places where a stock part may lie, and the one where it acts most.

use rayon::prelude::*;

use super::load::{Load, PlacedPart};
use super::pocket::{Fit, Pocket};
use super::stock::Part;
use crate::base::watch::Watch;
use crate::geom::{Frame, Point, Quadric, Vector};
use crate::goal::Placement;
use crate::interior::Columns;
use crate::mass::{Lump, Moments, moments_of_mesh};
use crate::mesh::{MeshDistance, Solid};
use crate::shell::Keep;

/// The number of sites along the longest side of the model. Fewer miss narrow places; the best is
/// refine to a fraction of the step anyway.
const SITES_A_SIDE: f64 = 48.0;
/// The finest step of a refinement, mm: a tenth of a printer's resolution.
const FINEST_STEP_MM: f64 = 0.02;
/// The greatest number of moves of a refinement. Each halves the step or gains; few places take
/// more than fifty.
const MOST_MOVES: usize = 200;
/// The extra depth of a pocket below the wall, mm: the wall is measured on rounded vertices.
const SPARE_MM: f64 = 1e-3;

/// The sites of a model: points of the region that may be emptied, and their depths.
pub(super) struct Sites<'a> {
    surface: MeshDistance,
    keeps: &'a [Keep],
    frame: Frame,
    wall_mm: f64,
    step_mm: f64,
    /// Goal frame, mm, with their depths below the surface.
    points: Vec<(Point, f64)>,
}

/// The question for the best place of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaceQuery<'w> {
    /// The part.
    pub part: &'w Part,
    /// The price of each added moment, goal frame; a lower total is better.
    pub prices: Quadric,
    /// The parts already placed, their fit, and the print's density.
    pub load: &'w Load,
    /// The watch over the run.
    pub watch: &'w Watch,
}

/// A part with its pocket at the origin, with one direction of its axis, goal frame.
struct OrientedPart {
    /// Model frame.
    axis: Vector,
    added: Moments,
    jacket_mm3: f64,
    /// The least depth of its centre below the wall at which its pocket can fit, mm.
    least_depth_mm: f64,
}

impl<'a> Sites<'a> {
    /// Finds the sites within the columns that may be emptied.
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

    /// Returns the place where the part acts most; `None` if it does not fit, or if the run was
    /// stopped.
    ///
    /// All sites are sorted by their cost. The first with room is refined by moves along the axes.
    pub fn best(&self, query: &PlaceQuery) -> Option<PlacedPart> {
        let oriented_parts = self.oriented_parts(query);
        let costs = |oriented: usize| {
            let cost = |site: usize| {
                (
                    cost_at(&oriented_parts[oriented], query, &self.points[site].0),
                    oriented,
                    site,
                )
            };
            (0..self.points.len())
                .into_par_iter()
                .map(cost)
                .collect::<Vec<_>>()
        };
        let mut order: Vec<(f64, usize, usize)> =
            (0..oriented_parts.len()).flat_map(costs).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        let is_deep = |&&(_, oriented, site): &&(f64, usize, usize)| {
            self.points[site].1 >= self.wall_mm + oriented_parts[oriented].least_depth_mm
        };
        let mut deep = order.iter().filter(is_deep);
        let &(_, oriented, site) = deep.find(|&&(_, oriented, site)| {
            let at = &self.points[site].0;
            let lump = self.lump(query, &oriented_parts[oriented], at);
            query.watch.check().is_ok() && self.has_room(&lump, query.load)
        })?;
        let lump = self.refine(query, &oriented_parts[oriented], self.points[site].0);
        Some(PlacedPart {
            part: query.part.clone(),
            lump,
        })
    }

    /// Returns the part in its possible directions: a ball in one, the others along the axes of the
    /// goal's frame.
    fn oriented_parts(&self, query: &PlaceQuery) -> Vec<OrientedPart> {
        let axes = if query.part.shape.is_ball() { 1 } else { 3 };
        let oriented = |i: usize| {
            // The third axis first: up, or the spin axis.
            let axis: Vector = self.frame.axes.column(2 - i).into_owned();
            let lump = self.lump_at(query.part, &self.frame.origin, &axis);
            let Load {
                fit:
                    Fit {
                        clearance_mm,
                        web_mm,
                    },
                density_g_mm3,
                ..
            } = *query.load;
            let pocket = Pocket::of(&lump, clearance_mm);
            let added = lump.moments(density_g_mm3) - pocket.moments();
            let half_mm = pocket
                .half_height_mm
                .map_or(pocket.radius_mm, |half| half.min(pocket.radius_mm));
            OrientedPart {
                axis,
                added: added.in_frame(&self.frame),
                jacket_mm3: moments_of_mesh(&pocket.grown(web_mm).mesh()).volume(),
                least_depth_mm: half_mm,
            }
        };
        (0..axes).map(oriented).collect()
    }

    fn lump(&self, query: &PlaceQuery, oriented: &OrientedPart, local: &Point) -> Lump {
        self.lump_at(query.part, &self.frame.to_model(local), &oriented.axis)
    }

    fn lump_at(&self, part: &Part, center: &Point, axis: &Vector) -> Lump {
        Lump {
            shape: part.shape,
            mass_g: part.mass_g,
            center_mm: (*center).into(),
            axis: (*axis).into(),
        }
    }

    /// Moves a part by a share of the way to another place. Returns `None` if there is no room.
    pub fn move_toward(
        &self,
        from: &PlacedPart,
        to: &PlacedPart,
        share: f64,
        load: &Load,
    ) -> Option<PlacedPart> {
        let (a, b) = (
            Point::from(from.lump.center_mm),
            Point::from(to.lump.center_mm),
        );
        let lump = Lump {
            center_mm: (a + (b - a) * share).into(),
            ..to.lump
        };
        self.has_room(&lump, load).then(|| PlacedPart {
            part: to.part.clone(),
            lump,
        })
    }

    /// Returns true if its pocket spares the wall, the solid regions and the webs of the other
    /// pockets.
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

    /// Moves a place along the axes as long as that gains. A step that gains nothing is halved.
    fn refine(&self, query: &PlaceQuery, oriented: &OrientedPart, start: Point) -> Lump {
        let (mut best, mut step_mm) = (
            (cost_at(oriented, query, &start), start),
            self.step_mm / 2.0,
        );
        for _ in 0..MOST_MOVES {
            let moves = (0..6).map(|i| {
                let way = Vector::ith(i / 2, if i % 2 == 0 { step_mm } else { -step_mm });
                (cost_at(oriented, query, &(best.1 + way)), best.1 + way)
            });
            let gains = moves.filter(|(cost, p)| {
                *cost < best.0 && self.has_room(&self.lump(query, oriented, p), query.load)
            });
            match gains.min_by(|a, b| a.0.total_cmp(&b.0)) {
                Some(better) => best = better,
                None if step_mm < FINEST_STEP_MM => break,
                None => step_mm /= 2.0,
            }
        }
        self.lump(query, oriented, &best.1)
    }
}

/// Returns the cost of the part at a point of the goal frame. It sums the part less its pocket, and
/// the solid material around it where the void would have been.
fn cost_at(oriented: &OrientedPart, query: &PlaceQuery, p: &Point) -> f64 {
    let moved = oriented.added.translated(&p.coords);
    let added: f64 = query
        .prices
        .0
        .iter()
        .zip(moved.0)
        .map(|(price, moment)| price * moment)
        .sum();
    added + oriented.jacket_mm3 * query.prices.value(p).max(0.0)
}

/// Returns points of the columns, at least one step apart along every axis.
fn points_of(columns: &Columns, step_mm: f64) -> Vec<Point> {
    let is_row = |x: f64, pitch: f64| (x / step_mm).floor() != ((x - pitch) / step_mm).floor();
    let [px, py] = columns.pitch_mm;
    let is_kept = |column: &usize| {
        let [x, y] = columns.centers[*column];
        is_row(x, px) && is_row(y, py)
    };
    (0..columns.len())
        .filter(is_kept)
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
