//! Pins between two bodies that touch in a plane, for bodies that no plan of cuts has made.

use crate::{
    base::watch::Cancelled,
    cut::{
        geometry::{overlap::Flat, tree::CutTree},
        ids::{CutId, PinId},
        joints::{
            pin_shape::PinSite,
            pins::place_along,
            placement::{Facing, PinScene, Placement},
        },
        pieces::split::{Cap, Joint, cap_of, caps, is_on_plane},
        request::PlanRequest,
    },
    geom::{Plane, Point},
    mesh::TriMesh,
};

/// Two bodies that touch in a plane.
#[derive(Debug, Clone, Copy)]
pub struct Touching<'a> {
    /// The plane. Its normal points from the first body to the second.
    pub plane: Plane,
    /// The body below the plane, and the one above it. Beside their faces in the plane, both keep
    /// clear of it.
    pub bodies: [&'a TriMesh; 2],
    /// Planes that bound the region in which both may touch; their normals point out of it.
    pub within: &'a [Plane],
    /// Other surfaces from which sockets keep their wall, such as those of bores.
    pub others: &'a [TriMesh],
    /// The sides on which pins may stand, the better one first: true for those on the body below.
    pub upward: &'a [bool],
}

impl Touching<'_> {
    /// Returns the faces in which both bodies touch, as the one below has them.
    fn faces(&self) -> Vec<Cap> {
        let [below, above] = self.bodies.map(|body| caps(body, &self.plane, 0));
        let high: Vec<Cap> = above.into_iter().filter(|cap| cap.is_above).collect();
        let low = below.into_iter().filter(|cap| !cap.is_above);
        let shared = low.flat_map(|cap| {
            let clip = |flat: Flat, side: &Plane| {
                if flat.is_crossed_by(&self.plane, side) {
                    flat.clip_to_side(&self.plane, side, false)
                } else {
                    flat
                }
            };
            self.within
                .iter()
                .fold(Flat::of(&cap.triangles), clip)
                .pieces()
        });
        let touches = |cap: &Cap| {
            let middle = cap.inner_point();
            cap.area_mm2 > 0.0 && high.iter().any(|other| other.holds(&middle))
        };
        shared
            .map(|flat| cap_of(&flat, 0))
            .filter(touches)
            .collect()
    }

    /// Returns the surfaces from which sockets keep their wall: those of both bodies but for the
    /// plane, and all others. In the plane the faces' edges count, where those surfaces begin.
    fn surfaces(&self) -> TriMesh {
        let is_off = |corners: &[Point; 3]| !corners.iter().all(|p| is_on_plane(&self.plane, p));
        let of_bodies = self.bodies.iter().flat_map(|body| body.iter_corners());
        let of_bodies = of_bodies.filter(is_off);
        let others = self.others.iter().flat_map(TriMesh::iter_corners);
        let all: Vec<[Point; 3]> = of_bodies.chain(others).collect();
        let corners = all.iter().flatten().copied().collect();
        let triangles = (0..all.len() as u32).map(|at| [3 * at, 3 * at + 1, 3 * at + 2]);
        TriMesh::from_parts(corners, triangles.collect())
    }
}

/// Places pins joint after joint. They keep off those before, and no pattern is taken for another.
pub struct PinPlacer<'a> {
    request: &'a PlanRequest,
    placed: Vec<Placement>,
}

impl<'a> PinPlacer<'a> {
    /// Begins with no pins.
    pub fn new(request: &'a PlanRequest) -> Self {
        Self {
            request,
            placed: Vec::new(),
        }
    }

    /// Places the pins of a joint, and returns them: those that let the bodies together one way
    /// only, if there is room for such. Without room for any, there are none. All stand on one of
    /// the bodies, and `accepts` may refuse them there.
    ///
    /// # Errors
    /// The watch of the request is stopped.
    pub fn place(
        &mut self,
        joint: &Touching,
        accepts: impl Fn(&[PinSite]) -> bool,
    ) -> Result<Vec<PinSite>, Cancelled> {
        let (tree, surfaces) = (CutTree::everywhere(&[joint.plane]), joint.surfaces());
        let faces = Joint {
            cut: 0,
            below: 0,
            above: 1,
            faces: joint.faces(),
        };
        let scene = PinScene {
            request: self.request,
            tree: &tree,
            material: &surfaces,
        };
        let placed: Vec<&Placement> = self.placed.iter().collect();
        let mut best = Placement::default();
        for &is_upward in joint.upward {
            let facing = Facing {
                others: &placed,
                is_upward,
            };
            let found = place_along(&scene, &faces, facing)?;
            if found.rank() > best.rank() && accepts(&found.sites) {
                best = found;
            }
            if best.is_sound() {
                break;
            }
        }
        let count: usize = self.placed.iter().map(|joint| joint.sites.len()).sum();
        for (index, site) in best.sites.iter_mut().enumerate() {
            (site.id, site.cut) = (PinId::of(count + index), CutId::of(self.placed.len()));
        }
        let sites = best.sites.clone();
        self.placed.push(best);
        Ok(sites)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::scenes::request;
    use crate::geom::Vector;
    use crate::mesh::primitives::cuboid;

    fn level() -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: 10.0,
        }
    }

    /// Returns two blocks, one on the other, the upper one shifted by half its length.
    fn blocks() -> [TriMesh; 2] {
        [
            cuboid(&Point::origin(), &Point::new(40.0, 30.0, 10.0)),
            cuboid(&Point::new(20.0, 0.0, 10.0), &Point::new(60.0, 30.0, 20.0)),
        ]
    }

    fn joint<'a>([below, above]: &'a [TriMesh; 2], within: &'a [Plane]) -> Touching<'a> {
        Touching {
            plane: level(),
            bodies: [below, above],
            within,
            others: &[],
            upward: &[true, false],
        }
    }

    /// Returns the plane in which the upper block ends over the lower one.
    fn ends() -> [Plane; 1] {
        [Plane {
            normal: -Vector::x(),
            offset_mm: -20.0,
        }]
    }

    #[test]
    fn pins_stand_where_both_bodies_are_and_keep_the_wall_to_every_side() {
        let (blocks, within, request) = (blocks(), ends(), request());
        let joint = joint(&blocks, &within);
        let pins = PinPlacer::new(&request).place(&joint, |_| true).unwrap();
        assert!(pins.len() >= 2, "{pins:?}");
        for pin in &pins {
            let [x, y, z] = pin.center_mm;
            let room_mm = PinSite::socket_corner_mm(pin.socket_diameter_mm) + request.wall_mm;
            let sides = [x - 20.0, 40.0 - x, y, 30.0 - y];
            assert!(sides.iter().all(|side| *side >= room_mm - 1e-9), "{pin:?}");
            assert!((z - 10.0).abs() < 1e-9 && pin.direction == [0.0, 0.0, 1.0]);
            assert!(pin.socket_depth_mm + request.wall_mm <= 10.0 + 1e-9);
        }
    }

    #[test]
    fn pins_keep_off_a_bore_and_stand_on_the_other_side_if_one_is_refused() {
        let (blocks, within, request) = (blocks(), ends(), request());
        let bore = cuboid(&Point::new(27.0, 0.0, 11.0), &Point::new(33.0, 30.0, 20.0));
        let bores = [bore.clone()];
        let joint = Touching {
            others: &bores,
            ..joint(&blocks, &within)
        };
        let bored = crate::geom::Bvh::new(bore.iter_corners());
        let pins = PinPlacer::new(&request).place(&joint, |_| true).unwrap();
        for pin in &pins {
            let mouth = Point::from(pin.center_mm);
            let end = mouth + Vector::from(pin.direction) * pin.socket_depth_mm;
            let room_mm = PinSite::socket_corner_mm(pin.socket_diameter_mm) + request.wall_mm;
            assert!(bored.segment_distance(&mouth, &end, f64::INFINITY) >= room_mm - 1e-9);
        }
        let below = |pins: &[PinSite]| pins.iter().all(|pin| pin.direction[2] < 0.0);
        let pins = PinPlacer::new(&request).place(&joint, below).unwrap();
        assert!(!pins.is_empty() && below(&pins), "{pins:?}");
        let none = PinPlacer::new(&request).place(&joint, |_| false).unwrap();
        assert!(none.is_empty());
    }

    #[test]
    fn a_second_joint_of_the_same_shape_gets_another_pattern() {
        let (blocks, within, request) = (blocks(), ends(), request());
        let mut placer = PinPlacer::new(&request);
        let first = placer.place(&joint(&blocks, &within), |_| true).unwrap();
        let far = Vector::new(0.0, 200.0, 0.0);
        let moved = blocks.each_ref().map(|body| body.map_vertices(|p| p + far));
        let second = placer.place(&joint(&moved, &within), |_| true).unwrap();
        assert!(!second.is_empty());
        let shape = |pins: &[PinSite], shift: Vector| -> Vec<[f64; 4]> {
            let places = pins.iter().map(|pin| {
                let [x, y, z] = (Point::from(pin.center_mm) - shift).into();
                [x, y, z, pin.diameter_mm]
            });
            places.collect()
        };
        assert_ne!(shape(&first, Vector::zeros()), shape(&second, far));
        assert_ne!(first[0].id, second[0].id);
    }
}
