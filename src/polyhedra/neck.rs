//! A neck of the model at a plane: how far polyhedra on both sides stay off it for rods.

use super::connection::{ConnectorRequest, RodRoom};
use super::ground::Ground;
use crate::geom::{Aabb, Plane, Point, Vector};

/// Places along each side of the model at which the middle of a neck is looked for.
const PLACES: usize = 32;
/// Steps in which its ends are looked for, as a share of the model's extent along it.
const STEP_RATIO: f64 = 1.0 / 200.0;

/// Returns the planes that bound both sides of a neck at a plane, the one below it first; their
/// normals point out of the sides. `None` if the neck has no room for rods.
///
/// It goes through the middle of the neck to both sides, as far as faces need for their discs.
pub(super) fn ends_of_neck(
    ground: &Ground,
    plane: &Plane,
    distance_mm: f64,
    connector: &ConnectorRequest,
) -> Option<[Plane; 2]> {
    let room = connector.rods?;
    let neck = Neck {
        ground,
        distance_mm,
        room,
    };
    let middle = neck.middle(plane)?;
    let [below, above] = [-plane.normal, plane.normal].map(|way| neck.reach_mm(&middle, &way));
    Some([
        Plane {
            offset_mm: plane.offset_mm - below?,
            ..*plane
        },
        Plane {
            normal: -plane.normal,
            offset_mm: -plane.offset_mm - above?,
        },
    ])
}

struct Neck<'a> {
    ground: &'a Ground,
    /// The distance of polyhedra from the surface, mm.
    distance_mm: f64,
    room: RodRoom,
}

impl Neck<'_> {
    /// Returns the deepest point of the model on a plane, if rods have room about it.
    fn middle(&self, plane: &Plane) -> Option<Point> {
        let around = self.ground.solid().mesh().aabb();
        let (u, w) = plane.basis();
        let [across, along] = [u, w].map(|axis| span(&around, &axis));
        let at =
            |k: usize, [from, to]: [f64; 2]| from + (to - from) * (k as f64 + 0.5) / PLACES as f64;
        let places = (0..PLACES * PLACES).map(|cell| {
            let (x, y) = (at(cell % PLACES, across), at(cell / PLACES, along));
            plane.foot() + u * x + w * y
        });
        let depths = places.map(|p| (self.depth_mm(&p), p));
        let deepest = depths.reduce(|a, b| if b.0 > a.0 { b } else { a });
        let steps = [across, along].map(|[from, to]| (to - from) / PLACES as f64);
        let p = self.deeper(deepest?.1, &[u * steps[0], w * steps[1]]);
        (self.depth_mm(&p) >= self.room.way_mm).then_some(p)
    }

    /// Returns a place about as deep as can be near one, in ever smaller steps.
    fn deeper(&self, from: Point, steps: &[Vector; 2]) -> Point {
        let mut best = from;
        for half in 1..8 {
            let share = 0.5_f64.powi(half);
            for [x, y] in [[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]] {
                let at = best + steps[0] * (x * share) + steps[1] * (y * share);
                if self.depth_mm(&at) > self.depth_mm(&best) {
                    best = at;
                }
            }
        }
        best
    }

    fn depth_mm(&self, at: &Point) -> f64 {
        self.ground.distance().signed(at)
    }

    /// Returns how far from a point along a direction the model has room for the disc of a face,
    /// mm; `None` if rods do not get there.
    fn reach_mm(&self, from: &Point, way: &Vector) -> Option<f64> {
        let [low, high] = span(&self.ground.solid().mesh().aabb(), way);
        let step_mm = STEP_RATIO * (high - low);
        let steps = (1..(1.0 / STEP_RATIO) as usize).map(|step| step as f64 * step_mm);
        for reach_mm in steps {
            let depth_mm = self.depth_mm(&(from + way * reach_mm));
            if depth_mm < self.room.way_mm {
                return None;
            }
            let is_apart = reach_mm >= 0.5 * self.room.least_mm;
            if is_apart && depth_mm >= self.distance_mm + self.room.face_mm {
                return Some(reach_mm);
            }
        }
        None
    }
}

/// Returns the least and the greatest place of a box along a direction.
fn span(around: &Aabb, way: &Vector) -> [f64; 2] {
    let middle = nalgebra::center(&around.min, &around.max);
    let half = 0.5 * around.size().dot(&way.abs());
    let at = way.dot(&middle.coords);
    [at - half, at + half]
}
