//! The connections between polyhedra on both sides of a plane.

use super::disc::{Disc, largest_common_disc};
use super::ground::Ground;
use super::polyhedron::{Face, Polyhedron};
use super::unjoined::Unjoined;
use crate::geom::{Plane, Point, Vector, hull};

/// Cells along each side of a face in which a way for rods is looked for.
const PLACES: usize = 16;
/// Faces whose planes are farther from the splitting plane than this do not bear on it, mm.
const BEARING_MM: f64 = 1e-6;

/// The way in which two polyhedra are held together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Joint {
    /// Two panels bear on each other and are bolted through.
    Bolted,
    /// Rods span a gap between two panels, within a straight way inside the model.
    Rods,
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
    /// The radius about the axis that is free, mm. It is that of the disc in both faces; for rods
    /// it is that of the way inside the model.
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
    /// The room of rods that join polyhedra which do not bear on each other; `None` if none may.
    pub rods: Option<RodRoom>,
}

/// The room that rods between two faces need about their common axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RodRoom {
    /// The least radius of the disc in both faces, mm.
    pub face_mm: f64,
    /// The least radius of the way inside the model, mm.
    pub way_mm: f64,
    /// The least distance of the faces, mm.
    pub least_mm: f64,
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
        self.bolted(request).or_else(|| self.rods(request))
    }

    /// Returns what is between the two where they are not connected: the disc that their faces
    /// share, and the widest way for rods.
    pub fn unjoined(&self, request: &ConnectorRequest) -> Unjoined {
        let shared = self.common_disc(request);
        let faces_need_mm = request.rods.map_or(0.0, |room| room.face_mm);
        Unjoined {
            polyhedra: self.indices,
            plane: self.plane,
            disc_mm: shared.map_or(0.0, |(_, disc)| disc.radius_mm),
            way_mm: self.widest_way(faces_need_mm).map(|way| way.radius_mm),
        }
    }

    /// Returns the faces that lie on the plane, and the largest disc that both have.
    fn common_disc(&self, request: &ConnectorRequest) -> Option<([usize; 2], Disc)> {
        let most_mm = request.gap_mm + BEARING_MM;
        let faces = self.faces_within(most_mm)?;
        let outlines = [0, 1].map(|side| self.flat_outline(side, faces[side]));
        Some((faces, largest_common_disc(&[&outlines[0], &outlines[1]])?))
    }

    /// Returns the locked faces of both that are parallel to the plane and nearest to it, if both
    /// are as near as this.
    fn faces_within(&self, most_mm: f64) -> Option<[usize; 2]> {
        let normal = self.plane.normal;
        let face_towards = |side: usize, outward: Vector| {
            let faces = self.polyhedra[side].faces().iter().enumerate();
            let facing = faces.filter(|(_, face)| {
                face.is_locked
                    && face.area_mm2 > 0.0
                    && face.plane.normal.dot(&outward) > 1.0 - BEARING_MM
            });
            let off_mm = |face: &Face| self.plane.distance(&face.plane.foot()).abs();
            let near = facing.map(|(index, face)| (off_mm(face), index));
            let nearest = near.reduce(|a, b| if b.0 < a.0 { b } else { a });
            nearest.filter(|(off_mm, _)| *off_mm <= most_mm)
        };
        Some([face_towards(0, normal)?.1, face_towards(1, -normal)?.1])
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

    /// Returns the widest way between two faces that face each other over a gap, if it has room for
    /// rods.
    fn rods(&self, request: &ConnectorRequest) -> Option<Connection> {
        let room = request.rods?;
        let way = self.widest_way(room.face_mm)?;
        let has_room = way.radius_mm >= room.way_mm && way.length_mm() >= room.least_mm;
        has_room.then_some(way)
    }

    /// Returns the way square to the plane that keeps farthest from the surface of the model,
    /// between two locked faces. Both have a disc of the radius about it.
    fn widest_way(&self, face_mm: f64) -> Option<Connection> {
        let faces = self.faces_within(f64::INFINITY)?;
        let outlines = [0, 1].map(|side| self.flat_outline(side, faces[side]));
        let disc = largest_common_disc(&[&outlines[0], &outlines[1]])?;
        if disc.radius_mm < face_mm {
            return None;
        }
        let planes = [0, 1].map(|side| self.polyhedra[side].faces()[faces[side]].plane);
        let bvh = self.ground.distance().bvh();
        let ways = places(&outlines, &disc, face_mm).into_iter();
        let ways = ways.filter_map(|center| {
            let ends = [
                self.on_plane(center, &planes[0])?,
                self.on_plane(center, &planes[1])?,
            ];
            let radius_mm = bvh.segment_distance(&ends[0], &ends[1], f64::INFINITY);
            Some((radius_mm, ends))
        });
        let (radius_mm, ends) = ways.reduce(|a, b| if b.0 > a.0 { b } else { a })?;
        Some(Connection {
            polyhedra: self.indices,
            faces,
            ends,
            radius_mm,
            joint: Joint::Rods,
        })
    }

    /// Returns the outline of a face in the plane's coordinates, counterclockwise.
    fn flat_outline(&self, side: usize, face: usize) -> Vec<[f64; 2]> {
        let outline = self.polyhedra[side].outline(face);
        hull::convex_hull(outline.iter().map(|p| self.flat(p)).collect())
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

/// Returns places in both outlines at which a disc of the radius has room, the middle first.
fn places(outlines: &[Vec<[f64; 2]>; 2], disc: &Disc, radius_mm: f64) -> Vec<[f64; 2]> {
    let corners = || outlines[0].iter();
    let bound = |axis: usize, pick: fn(f64, f64) -> f64, start| {
        corners().map(|p| p[axis]).fold(start, pick)
    };
    let low = [0, 1].map(|axis| bound(axis, f64::min, f64::INFINITY));
    let high = [0, 1].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY));
    let at = |axis: usize, k: usize| {
        low[axis] + (high[axis] - low[axis]) * (k as f64 + 0.5) / PLACES as f64
    };
    let grid = (0..PLACES * PLACES).map(|cell| [at(0, cell % PLACES), at(1, cell / PLACES)]);
    let has_room = |p: &[f64; 2]| {
        outlines
            .iter()
            .all(|outline| has_room(outline, *p, radius_mm))
    };
    std::iter::once(disc.center)
        .chain(grid.filter(has_room))
        .collect()
}
