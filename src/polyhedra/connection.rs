//! The connections between polyhedra on both sides of a plane.

use super::disc::{Disc, largest_common_disc};
use super::ground::Ground;
use super::polyhedron::Polyhedron;
use super::unjoined::Unjoined;
use crate::geom::{Plane, Point, Vector, hull};

/// Cells along each side of the common shadow in which a place for a tube is looked for.
const PLACES: usize = 16;
/// Faces whose planes are farther from the splitting plane than this do not bear on it, mm.
const BEARING_MM: f64 = 1e-6;

/// The way in which two polyhedra are held together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joint {
    /// Two panels bear on each other and are bolted through.
    Bolted,
    /// A printed tube or a dowel spans a gap.
    Tube,
}

/// A connection of two polyhedra across a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Connection {
    /// The polyhedra, as indices: the one below the plane, and the one above.
    pub polyhedra: [usize; 2],
    /// The faces that it joins, in the same order.
    pub faces: [usize; 2],
    /// The ends of its axis, one on each face. The axis is perpendicular to the plane between.
    pub ends: [Point; 2],
    /// The radius of the disc that is free about the axis, mm.
    pub radius_mm: f64,
    /// The kind.
    pub joint: Joint,
}

impl Connection {
    /// Returns true if the connection comes within its radius of a polyhedron that it does not
    /// join. Errs on the safe side near edges.
    pub fn is_barred_by(&self, other: &Polyhedron) -> bool {
        let way = self.ends[1] - self.ends[0];
        // The stretch of the axis below all faces, moved out by the radius.
        let [mut from, mut to] = [0.0_f64, 1.0];
        for face in other.faces() {
            let room_mm = self.radius_mm - face.plane.distance(&self.ends[0]);
            let climb_mm = face.plane.normal.dot(&way);
            if climb_mm > 0.0 {
                to = to.min(room_mm / climb_mm);
            } else if climb_mm < 0.0 {
                from = from.max(room_mm / climb_mm);
            } else if room_mm < 0.0 {
                return false;
            }
        }
        from <= to
    }

    /// Returns the distance between the faces along the axis, mm.
    pub fn length_mm(&self) -> f64 {
        (self.ends[1] - self.ends[0]).norm()
    }
}

/// The sizes that a connection needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConnectorRequest {
    /// The least radius of the disc about the axis, mm.
    pub radius_mm: f64,
    /// The gap between panels that bear on each other, mm.
    pub gap_mm: f64,
    /// True if a tube may join polyhedra that do not bear on each other.
    pub takes_tubes: bool,
}

/// Two polyhedra on both sides of a plane: the one below it first.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<'a> {
    pub ground: &'a Ground,
    pub indices: [usize; 2],
    pub polyhedra: [&'a Polyhedron; 2],
    pub plane: Plane,
}

impl Pair<'_> {
    /// Returns the best connection across the plane; `None` if there is none of the radius.
    pub fn connect(&self, request: &ConnectorRequest) -> Option<Connection> {
        let bolted = self.bolted(request);
        bolted.or_else(|| request.takes_tubes.then(|| self.tube(request))?)
    }

    /// Returns what is between the two where they are not connected: the disc that their faces
    /// share, and a tube that would have room.
    pub fn unjoined(&self, request: &ConnectorRequest) -> Unjoined {
        let shared = self.common_disc(request);
        Unjoined {
            polyhedra: self.indices,
            plane: self.plane,
            disc_mm: shared.map_or(0.0, |(_, disc)| disc.radius_mm),
            tube_mm: self.tube(request).map(|tube| tube.length_mm()),
        }
    }

    /// Returns the faces that lie on the plane, and the largest disc that both have.
    fn common_disc(&self, request: &ConnectorRequest) -> Option<([usize; 2], Disc)> {
        let normal = self.plane.normal;
        let face_towards = |side: usize, outward: Vector| {
            self.polyhedra[side].faces().iter().position(|face| {
                let off_mm = (self.plane.distance(&face.plane.foot())).abs();
                let is_near = off_mm <= request.gap_mm + BEARING_MM;
                face.is_locked
                    && face.area_mm2 > 0.0
                    && face.plane.normal.dot(&outward) > 1.0 - BEARING_MM
                    && is_near
            })
        };
        let faces = [face_towards(0, normal)?, face_towards(1, -normal)?];
        let outlines = [0, 1].map(|side| self.flat_outline(side, faces[side]));
        Some((faces, largest_common_disc(&[&outlines[0], &outlines[1]])?))
    }

    /// Connects two locked faces by the largest disc that both have.
    fn bolted(&self, request: &ConnectorRequest) -> Option<Connection> {
        let (faces, disc) = self.common_disc(request)?;
        if disc.radius_mm < request.radius_mm {
            return None;
        }
        let ends = [0, 1].map(|side| {
            let plane = self.polyhedra[side].faces()[faces[side]].plane;
            self.on_plane(disc.center, &plane)
        });
        Some(Connection {
            polyhedra: self.indices,
            faces,
            ends: [ends[0]?, ends[1]?],
            radius_mm: disc.radius_mm,
            joint: Joint::Bolted,
        })
    }

    /// Looks for a straight tube that leaves both polyhedra square to the plane and stays inside
    /// the model. Of several, takes the one that keeps farthest from the surface.
    fn tube(&self, request: &ConnectorRequest) -> Option<Connection> {
        let shadows = [0, 1].map(|side| self.shadow(side));
        let disc = largest_common_disc(&[&shadows[0], &shadows[1]])?;
        if disc.radius_mm < request.radius_mm {
            return None;
        }
        let least_mm = self.polyhedra[0].separation().distance_mm + request.radius_mm;
        let places = places(&shadows, &disc, request.radius_mm);
        let tubes = places.into_iter().filter_map(|center| {
            let (faces, ends) = self.exits(center)?;
            // The whole disc leaves through one face on each side.
            let is_in_face = |side: usize| {
                let outline = self.flat_outline(side, faces[side]);
                has_room(&outline, center, request.radius_mm)
            };
            if !is_in_face(0) || !is_in_face(1) {
                return None;
            }
            let bvh = self.ground.distance().bvh();
            let free_mm = bvh.segment_distance(&ends[0], &ends[1], f64::INFINITY);
            (free_mm >= least_mm).then_some((free_mm, faces, ends))
        });
        let (_, faces, ends) = tubes.reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        Some(Connection {
            polyhedra: self.indices,
            faces,
            ends,
            radius_mm: request.radius_mm,
            joint: Joint::Tube,
        })
    }

    /// Returns the faces through which an axis square to the plane leaves both polyhedra, and the
    /// points there; `None` if it misses one.
    fn exits(&self, center: [f64; 2]) -> Option<([usize; 2], [Point; 2])> {
        let normal = self.plane.normal;
        let exit = |side: usize, outward: Vector| {
            let faces = self.polyhedra[side].faces().iter().enumerate();
            let met = faces.filter(|(_, face)| face.plane.normal.dot(&outward) > 0.0);
            let met = met.filter_map(|(index, face)| {
                let at = self.on_plane(center, &face.plane)?;
                Some((outward.dot(&at.coords), index, at))
            });
            met.reduce(|a, b| if b.0 < a.0 { b } else { a })
        };
        let (below, above) = (exit(0, normal)?, exit(1, -normal)?);
        Some(([below.1, above.1], [below.2, above.2]))
    }

    /// Returns the outline of a face in the plane's coordinates, counterclockwise.
    fn flat_outline(&self, side: usize, face: usize) -> Vec<[f64; 2]> {
        let outline = self.polyhedra[side].outline(face);
        hull::convex_hull(outline.iter().map(|p| self.flat(p)).collect())
    }

    /// Returns the outline of a polyhedron's shadow on the plane, counterclockwise.
    fn shadow(&self, side: usize) -> Vec<[f64; 2]> {
        let corners = self.polyhedra[side].corners().iter();
        hull::convex_hull(corners.map(|p| self.flat(p)).collect())
    }

    fn flat(&self, p: &Point) -> [f64; 2] {
        let (u, w) = self.plane.basis();
        [u.dot(&p.coords), w.dot(&p.coords)]
    }

    /// Returns the point of `plane` above a place on the splitting plane.
    fn on_plane(&self, [x, y]: [f64; 2], plane: &Plane) -> Option<Point> {
        let (u, w) = self.plane.basis();
        let at = self.plane.foot() + u * x + w * y;
        let slope = plane.normal.dot(&self.plane.normal);
        let along = -plane.distance(&at) / slope;
        along.is_finite().then(|| at + self.plane.normal * along)
    }
}

/// Returns true if a disc lies inside a convex outline that runs counterclockwise.
fn has_room(outline: &[[f64; 2]], center: [f64; 2], radius_mm: f64) -> bool {
    (0..outline.len()).all(|k| {
        let [from, to] = [outline[k], outline[(k + 1) % outline.len()]];
        let length = (to[0] - from[0]).hypot(to[1] - from[1]);
        hull::turn(from, to, center) >= radius_mm * length
    })
}

/// Returns places in both shadows at which a disc of the radius has room, the middle first.
fn places(shadows: &[Vec<[f64; 2]>; 2], disc: &Disc, radius_mm: f64) -> Vec<[f64; 2]> {
    let corners = || shadows[0].iter();
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, start| {
        corners().map(|p| p[axis]).fold(start, pick)
    };
    let low = [0, 1].map(|axis| bound(axis, f64::min, f64::INFINITY));
    let high = [0, 1].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY));
    let at = |axis: usize, k: usize| {
        low[axis] + (high[axis] - low[axis]) * (k as f64 + 0.5) / PLACES as f64
    };
    let grid = (0..PLACES * PLACES).map(|cell| [at(0, cell % PLACES), at(1, cell / PLACES)]);
    let has_room = |p: &[f64; 2]| shadows.iter().all(|shadow| has_room(shadow, *p, radius_mm));
    std::iter::once(disc.center)
        .chain(grid.filter(has_room))
        .collect()
}
