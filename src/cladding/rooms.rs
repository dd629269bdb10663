//! Cuts parts that are too large for the printer's room, by planes along the way of their cell.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::divide::{Scene, name_holdings, new_part, pieces_of};
use super::error::CladdingError;
use super::lie::Lie;
use super::overlap::face_mm2;
use super::part::Part;
use super::region::{Bound, BoundKind};
use crate::base::watch::Watch;
use crate::geom::{Bvh, Plane, Point, Vector, hull, orthonormal_basis};
use crate::mesh::{ClipError, Csg, TriMesh, bodies, move_off_vertices};

/// Least width of a piece, in walls.
const WIDTH_WALLS: f64 = 3.0;
/// Least side of the room, in walls.
const ROOM_WALLS: f64 = 4.0;
/// Number of directions of cuts over half a turn.
const DIRECTIONS: usize = 12;
/// Number of turns over a right angle at which boxes about a piece are tried.
const TURNS: usize = 12;
/// Tolerance of the coarse body on which cuts are tried, mm.
const TRIAL_MM: f64 = 0.2;
/// The most cuts of one part.
const MOST_CUTS: usize = 64;
/// Share of the room that a planned piece fills at most, so that the coarse body does not mislead.
const FILL_RATIO: f64 = 0.995;

/// The printer's room for parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// Width, depth and height, mm.
    pub size_mm: [f64; 3],
    /// The wall of the parts, mm.
    pub wall_mm: f64,
}

impl Scene<'_> {
    /// Cuts all parts that fit the room in no pose. The planes run along the way of the part's
    /// cell, so that all pieces still leave that way.
    ///
    /// Each cut is the one after which the pieces fill the fewest rooms. Of these, it is the one
    /// that parts the fewest pieces from their panel, and then the one with the shortest seam. A
    /// cut that leaves a piece narrower than three walls is taken only if all do. A part higher
    /// than the room is also cut across. The same bytes on any number of threads.
    ///
    /// # Errors
    /// The room is too small, no cut helps, the boolean engine fails, or the watch is stopped.
    pub fn fit(
        &self,
        parts: Vec<Part>,
        room: &Room,
        watch: &Watch,
    ) -> Result<Vec<Part>, CladdingError> {
        let least_mm = ROOM_WALLS * room.wall_mm;
        let shortest_mm = room.size_mm.iter().copied().fold(f64::INFINITY, f64::min);
        if shortest_mm.is_nan() || shortest_mm < least_mm {
            return Err(CladdingError::Room {
                room_mm: shortest_mm,
                least_mm,
            });
        }
        let fitted = parts.into_par_iter().map(|part| {
            let cutter = Cutter {
                room,
                up: self.normal(part.face),
            };
            cutter.fit(part, watch)
        });
        let fitted: Vec<Vec<Part>> = fitted.collect::<Result<_, CladdingError>>()?;
        let mut fitted = fitted.concat();
        name_holdings(&mut fitted);
        Ok(fitted)
    }

    /// Returns how a part lies in the printer's room: panel side down, if it fits so.
    pub fn lie(&self, part: &Part, room: &Room) -> Option<Lie> {
        Lie::of_part(part, &[], &self.normal(part.face), room)
    }
}

impl Lie {
    /// Returns how a part lies in the printer's room, with the points of what stands out of it. The
    /// side that bears on its panel, whose normal is given, is down if the part fits so.
    pub fn of_part(part: &Part, more: &[Point], normal: &Vector, room: &Room) -> Option<Self> {
        let mut points = hull_points(&part.body).ok()?;
        points.extend(more);
        Self::find(&points, normal, room.size_mm)
    }
}

/// Returns the corners of a body's convex hull.
fn hull_points(body: &TriMesh) -> Result<Vec<Point>, ClipError> {
    Ok(Csg::convex_hull(body.vertices())?
        .to_mesh()?
        .into_vertices())
}

/// Cuts parts of one cell.
struct Cutter<'a> {
    room: &'a Room,
    /// The way of the cell.
    up: Vector,
}

/// The price of a cut: less is better.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Price {
    slivers: usize,
    rooms: usize,
    loose: usize,
    seam_mm: f64,
}

impl Price {
    fn compare(&self, other: &Self) -> Ordering {
        let counts = |price: &Self| [price.slivers, price.rooms, price.loose];
        let by_count = counts(self).cmp(&counts(other));
        by_count.then(self.seam_mm.total_cmp(&other.seam_mm))
    }
}

impl Cutter<'_> {
    fn fit(&self, part: Part, watch: &Watch) -> Result<Vec<Part>, CladdingError> {
        let face = part.face;
        let mut waiting = vec![part];
        let mut done = Vec::new();
        let mut cuts = 0;
        while let Some(part) = waiting.pop() {
            watch.check()?;
            let points = hull_points(&part.body)?;
            if Lie::find(&points, &self.up, self.room.size_mm).is_some() {
                done.push(part);
                continue;
            }
            let plane = self.best_cut(&part)?.filter(|_| cuts < MOST_CUTS);
            let plane = plane.ok_or(CladdingError::NoCut { face })?;
            cuts += 1;
            let pieces = cut(&part, &plane)?;
            if pieces.len() < 2 {
                return Err(CladdingError::NoCut { face });
            }
            waiting.extend(pieces.into_iter().rev());
        }
        Ok(done)
    }

    /// Returns the best plane for a part; `None` if no plane passes through it.
    fn best_cut(&self, part: &Part) -> Result<Option<Plane>, ClipError> {
        let coarse = Csg::of_mesh(&part.body)?.coarsen(TRIAL_MM).to_mesh()?;
        let planes = self.planes(&coarse);
        let priced = planes.par_iter().map(|plane| {
            let plane = move_off_vertices(&coarse, plane);
            Ok(self
                .price(&coarse, part, &plane)?
                .map(|price| (price, plane)))
        });
        let priced: Vec<Option<(Price, Plane)>> = priced.collect::<Result<_, ClipError>>()?;
        let best = priced.into_iter().flatten();
        let best = best.reduce(|a, b| if b.0.compare(&a.0).is_lt() { b } else { a });
        Ok(best.map(|(_, plane)| plane))
    }

    /// Returns the planes that are tried: they part a body evenly, or fill a room.
    fn planes(&self, body: &TriMesh) -> Vec<Plane> {
        let (u, w) = orthonormal_basis(&self.up);
        let across = (0..DIRECTIONS).map(|k| {
            let (sine, cosine) = (std::f64::consts::PI * k as f64 / DIRECTIONS as f64).sin_cos();
            u * cosine + w * sine
        });
        let highest_mm = self.room.size_mm.iter().copied().fold(0.0, f64::max);
        let [low, high] = extent(body, &self.up);
        let is_too_high = high - low > highest_mm;
        let normals = across.chain(is_too_high.then_some(self.up));
        normals
            .flat_map(|normal| self.planes_along(body, normal))
            .collect()
    }

    fn planes_along(&self, body: &TriMesh, normal: Vector) -> Vec<Plane> {
        let [low, high] = extent(body, &normal);
        let mut offsets = Vec::new();
        for side in self.room.size_mm {
            let side_mm = side * FILL_RATIO;
            let count = ((high - low) / side_mm).ceil().clamp(1.0, MOST_CUTS as f64) as usize;
            if count > 1 {
                let even = (1..count).map(|k| low + (high - low) * k as f64 / count as f64);
                offsets.extend(even.chain([low + side_mm, high - side_mm]));
            }
        }
        if offsets.is_empty() {
            offsets.push(0.5 * (low + high));
        }
        offsets.sort_by(f64::total_cmp);
        offsets.dedup();
        let plane = |offset_mm| Plane { normal, offset_mm };
        offsets.into_iter().map(plane).collect()
    }

    /// Returns the price of a cut; `None` if it misses the body.
    fn price(
        &self,
        body: &TriMesh,
        part: &Part,
        plane: &Plane,
    ) -> Result<Option<Price>, ClipError> {
        let (above, below) = body.split_by_plane(plane)?;
        if above.is_empty() || below.is_empty() {
            return Ok(None);
        }
        let mut price = Price {
            slivers: 0,
            rooms: 0,
            loose: 0,
            seam_mm: seam_mm(body, plane),
        };
        for piece in bodies(&above).iter().chain(&bodies(&below)) {
            let shape = self.shape(piece);
            price.rooms += self.rooms_of(&shape);
            price.slivers += usize::from(shape.width_mm < WIDTH_WALLS * self.room.wall_mm);
            let floor = part.region.bounds().first();
            let is_loose = floor.is_some_and(|floor| face_mm2(piece, &floor.plane) <= 0.0);
            price.loose += usize::from(part.is_on_panel() && is_loose);
        }
        Ok(Some(price))
    }

    /// Measures a piece across the way and along it.
    fn shape(&self, piece: &TriMesh) -> Shape {
        let (u, w) = orthonormal_basis(&self.up);
        let flat = |p: &Point| [u.dot(&p.coords), w.dot(&p.coords)];
        let ring = hull::convex_hull(piece.vertices().iter().map(flat).collect());
        let [low, high] = extent(piece, &self.up);
        Shape {
            width_mm: width_mm(&ring),
            ring,
            height_mm: high - low,
        }
    }

    /// Returns how many rooms a piece fills at least, by boxes about it at several turns.
    fn rooms_of(&self, shape: &Shape) -> usize {
        const ORDERS: [[usize; 3]; 6] = [
            [0, 1, 2],
            [1, 0, 2],
            [0, 2, 1],
            [2, 0, 1],
            [1, 2, 0],
            [2, 1, 0],
        ];
        let turns = (0..TURNS).flat_map(|turn| {
            let angle = std::f64::consts::FRAC_PI_2 * turn as f64 / TURNS as f64;
            let (sine, cosine) = angle.sin_cos();
            let size = [[cosine, sine], [-sine, cosine]].map(|[x, y]| {
                let places = shape.ring.iter().map(|at| at[0] * x + at[1] * y);
                let ends = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
                    [low.min(at), high.max(at)]
                });
                ends[1] - ends[0]
            });
            let sizes = [size[0], size[1], shape.height_mm];
            ORDERS.map(|order| {
                let count = |k: usize| {
                    let room_mm = self.room.size_mm[order[k]] * FILL_RATIO;
                    (sizes[k] / room_mm).ceil().clamp(1.0, 1e3) as usize
                };
                count(0) * count(1) * count(2)
            })
        });
        turns.min().unwrap_or(1)
    }
}

/// A piece, seen along the way of its cell.
struct Shape {
    ring: Vec<[f64; 2]>,
    width_mm: f64,
    height_mm: f64,
}

/// Returns the least width of a convex ring over all directions, mm.
fn width_mm(ring: &[[f64; 2]]) -> f64 {
    let widths = (0..ring.len()).map(|k| {
        let [from, to] = [ring[k], ring[(k + 1) % ring.len()]];
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        let across = ring.iter().map(|at| hull::turn(from, to, *at) / length);
        across.fold(0.0, f64::max)
    });
    widths.fold(f64::INFINITY, f64::min)
}

/// Returns the least and the greatest place of a body along a direction, mm.
pub(super) fn extent(body: &TriMesh, along: &Vector) -> [f64; 2] {
    let places = body.vertices().iter().map(|p| along.dot(&p.coords));
    places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], at| {
        [low.min(at), high.max(at)]
    })
}

/// Returns the length of the line in which a plane meets a surface, mm.
fn seam_mm(body: &TriMesh, plane: &Plane) -> f64 {
    let lengths = body.iter_corners().map(|corners| {
        let heights = corners.map(|p| plane.distance(&p));
        let ends = (0..3).filter_map(|k| {
            let next = (k + 1) % 3;
            let [a, b] = [heights[k], heights[next]];
            let at = || corners[k] + (corners[next] - corners[k]) * (a / (a - b));
            ((a > 0.0) != (b > 0.0)).then(at)
        });
        let ends: Vec<Point> = ends.collect();
        ends.windows(2)
            .map(|pair| (pair[1] - pair[0]).norm())
            .sum::<f64>()
    });
    lengths.sum()
}

/// Cuts a part by a plane; the pieces below it come first.
fn cut(part: &Part, plane: &Plane) -> Result<Vec<Part>, CladdingError> {
    let plane = move_off_vertices(&part.body, plane);
    let (above, below) = Csg::of_mesh(&part.body)?.split_by_plane(&plane)?;
    let flipped = Plane {
        normal: -plane.normal,
        offset_mm: -plane.offset_mm,
    };
    let mut pieces = Vec::new();
    for (half, plane) in [(below, plane), (above, flipped)] {
        let region = part.region.with(Bound {
            plane,
            kind: BoundKind::Cut,
        });
        for body in pieces_of(&half)? {
            let mut piece = new_part(part.face, &region, body);
            let bvh = Bvh::new(piece.body.iter_corners());
            let crumbs = part
                .crumbs
                .iter()
                .filter(|crumb| bvh.winding(&crumb.at) > 0);
            piece.crumbs.extend(crumbs);
            pieces.push(piece);
        }
    }
    Ok(pieces)
}
