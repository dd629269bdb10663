//! The rooms in which the outside of a kit is not that of its model: the sockets of hardware, and
//! the gap for a string.

use super::{Evidence, Hardware};
use crate::geom::{Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Margin of a socket about its rod, mm: its bottom lies a little beyond the rod, and its corners
/// beside it.
const MARGIN_MM: f64 = 0.05;

/// The rooms in which the outside is not that of the model.
pub(super) struct Rooms {
    sockets: Vec<Socket>,
    /// The plane between the halves of a yo-yo, and the distance by which each was moved, mm.
    gap: Option<(Plane, f64)>,
}

/// A cylinder.
struct Socket {
    from: Point,
    along: Vector,
    length_mm: f64,
    radius_mm: f64,
}

impl Rooms {
    /// Returns the rooms of a kit's hardware.
    pub(super) fn of(evidence: &Evidence) -> Self {
        let promise = &evidence.promise;
        let socket = |rod: &Hardware| {
            let [from, to] = [rod.from_mm, rod.to_mm].map(Point::from);
            Socket {
                from,
                along: (to - from).normalize(),
                length_mm: (to - from).norm(),
                radius_mm: 0.5 * rod.socket_mm.max(rod.diameter_mm) + MARGIN_MM,
            }
        };
        let frame = promise.goal.frame();
        let plane = Plane::through(&frame.origin, &frame.axis());
        let gap = promise.string_gap_mm;
        Self {
            sockets: promise.hardware.iter().map(socket).collect(),
            gap: gap.map(|gap_mm| (plane, 0.5 * gap_mm)),
        }
    }

    /// Returns a surface with the halves of a yo-yo moved together again.
    pub(super) fn close_gap(&self, mesh: &TriMesh) -> TriMesh {
        let Some((plane, moved_mm)) = self.gap else {
            return mesh.clone();
        };
        mesh.map_vertices(|p| p - plane.normal * (moved_mm * plane.distance(p).signum()))
    }

    /// Returns the places outside of the rooms, on surfaces without a gap.
    pub(super) fn leave_out(&self, places: Vec<Point>) -> Vec<Point> {
        let is_outside = |p: &Point| !self.hold(p);
        places.into_iter().filter(is_outside).collect()
    }

    fn hold(&self, p: &Point) -> bool {
        let in_gap = |(plane, _): &(Plane, f64)| plane.distance(p).abs() <= MARGIN_MM;
        let in_socket = |socket: &Socket| {
            let way = p - socket.from;
            let height = way.dot(&socket.along);
            let aside = (way - socket.along * height).norm();
            let reach = -MARGIN_MM..=socket.length_mm + MARGIN_MM;
            aside <= socket.radius_mm && reach.contains(&height)
        };
        self.gap.iter().any(in_gap) || self.sockets.iter().any(in_socket)
    }
}
