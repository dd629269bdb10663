//! A neck of the model at a plane: how far polyhedra on both sides stay off it for rods.

use super::connection::{ConnectorRequest, RodRoom};
use super::ground::Ground;
use crate::geom::{Aabb, Plane, Point, Vector};

/// Places along each side of the part at which the middle of a neck is looked for.
const PLACES: usize = 32;
/// Steps in which its ends are looked for, as a share of the part's extent along it.
const STEP_RATIO: f64 = 1.0 / 200.0;

/// The part of the model in which a neck is looked for.
#[derive(Debug, Clone, Copy)]
pub(super) struct NeckPart<'a> {
    pub ground: &'a Ground,
    /// The planes that bound it.
    pub locked: &'a [Plane],
    /// The box around its corners.
    pub around: Aabb,
}

/// Returns the planes that bound both sides of a neck at a plane, the one below it first; their
/// normals point out of the sides. `None` if the neck has no room for rods.
///
/// It goes through the middle of the neck to both sides, as far as faces need for their discs.
pub(super) fn ends_of_neck(
    part: &NeckPart,
    plane: &Plane,
    distance_mm: f64,
    connector: &ConnectorRequest,
) -> Option<[Plane; 2]> {
    let room = connector.rods?;
    let neck = Neck {
        part,
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
    part: &'a NeckPart<'a>,
    /// The distance of polyhedra from the surface, mm.
    distance_mm: f64,
    room: RodRoom,
}

impl Neck<'_> {
    /// Returns the deepest point of the part on a plane, if rods have room about it.
    fn middle(&self, plane: &Plane) -> Option<Point> {
        let (u, w) = plane.basis();
        let [across, along] = [u, w].map(|axis| span(&self.part.around, &axis));
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

    /// Returns how far a point lies below the surface and the planes of the part, mm.
    fn depth_mm(&self, at: &Point) -> f64 {
        self.below_surface_mm(at).min(self.below_planes_mm(at))
    }

    fn below_surface_mm(&self, at: &Point) -> f64 {
        self.part.ground.distance().signed(at)
    }

    fn below_planes_mm(&self, at: &Point) -> f64 {
        let planes = self.part.locked.iter();
        let depths = planes.map(|plane| -plane.distance(at));
        depths.fold(f64::INFINITY, f64::min)
    }

    /// Returns how far from a point along a direction the part has room for the disc of a face, mm;
    /// `None` if rods do not get there.
    fn reach_mm(&self, from: &Point, way: &Vector) -> Option<f64> {
        let [low, high] = span(&self.part.around, way);
        let step_mm = STEP_RATIO * (high - low);
        let steps = (1..(1.0 / STEP_RATIO) as usize).map(|step| step as f64 * step_mm);
        for reach_mm in steps {
            let at = from + way * reach_mm;
            if self.depth_mm(&at) < self.room.way_mm {
                return None;
            }
            let is_apart = reach_mm >= 0.5 * self.room.least_mm;
            // A polyhedron keeps the distance from the surface, and none from planes.
            let has_face = self.below_surface_mm(&at) >= self.distance_mm + self.room.face_mm
                && self.below_planes_mm(&at) >= self.room.face_mm;
            if is_apart && has_face {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Solid;
    use crate::mesh::primitives::cuboid;

    /// Returns the planes at both sides of a plane across a bar of 200 × 100 × 100 mm, in its part
    /// below y = 30 mm. Rods need a way of this radius.
    fn ends_in_a_part(way_mm: f64) -> Option<[Plane; 2]> {
        let bar = cuboid(&Point::origin(), &Point::new(200.0, 100.0, 100.0));
        let ground = Ground::new(&Solid::new(bar).unwrap()).unwrap();
        let part = NeckPart {
            ground: &ground,
            locked: &[Plane {
                normal: Vector::y(),
                offset_mm: 30.0,
            }],
            around: Aabb {
                min: Point::origin(),
                max: Point::new(200.0, 30.0, 100.0),
            },
        };
        let plane = Plane {
            normal: Vector::x(),
            offset_mm: 100.0,
        };
        let connector = ConnectorRequest {
            radius_mm: 20.0,
            gap_mm: 0.1,
            rods: Some(RodRoom {
                face_mm: 9.0,
                way_mm,
                least_mm: 10.0,
            }),
        };
        ends_of_neck(&part, &plane, 5.0, &connector)
    }

    #[test]
    fn a_neck_is_no_wider_than_its_part_of_the_model() {
        // The part has 15 mm about its middle, the whole bar 50.
        let ends = ends_in_a_part(14.5).unwrap();
        assert!((ends[0].offset_mm - 95.0).abs() < 1e-9, "{ends:?}");
        assert!((ends[1].offset_mm + 105.0).abs() < 1e-9, "{ends:?}");
        assert_eq!(ends_in_a_part(15.5), None);
    }
}
