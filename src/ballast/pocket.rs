//! The pocket of a stock part: a ball or a cylinder a little larger than the part, and the jacket
//! of material around it.

use std::f64::consts::PI;

use crate::geom::{Frame, Point, Vector};
use crate::mass::{Lump, Moments, moments_of_mesh, rims};
use crate::mesh::{TriMesh, primitives};

/// The clearance and the web of pockets.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Fit {
    /// The gap between a part and its pocket on all sides, mm.
    pub clearance_mm: f64,
    /// The least material between a pocket and another void, mm.
    pub web_mm: f64,
}

/// The number of segments of a pocket's circle. Its facets touch the circle from outside, so the
/// part has its clearance everywhere.
const SEGMENTS: u32 = 64;
/// The number of subdivisions of the icosahedron that stands for a ball.
const BALL_LEVEL: u32 = 3;
/// The radius of that mesh's vertices over that of the largest ball inside it, rounded up.
const BALL_STRETCH: f64 = 1.0046;
/// A skew axis that keeps vertices out of the planes through the centre along a coordinate axis. A
/// cut there would leave slivers.
const SKEW: Vector = Vector::new(0.27, 0.53, 0.81);
/// The skew of a cylinder about its axis, in segments.
const SKEW_SEGMENTS: f64 = 0.37;
/// The rings of a cap that are checked besides its rim, over the radius.
const RINGS: [f64; 2] = [0.0, 0.5];

/// The region of a pocket: a ball, or a cylinder about an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pocket {
    /// Its centre, model frame, mm.
    pub center: Point,
    /// The unit axis; without meaning for a ball.
    pub axis: Vector,
    /// The greatest distance of its points from the centre (ball) or the axis, mm.
    pub radius_mm: f64,
    /// Half its extent along the axis, mm; `None` for a ball.
    pub half_height_mm: Option<f64>,
}

impl Pocket {
    /// Returns the pocket that leaves this clearance around a part.
    pub fn of(lump: &Lump, clearance_mm: f64) -> Self {
        let shape = lump.shape;
        let tight = Self {
            center: Point::from(lump.center_mm),
            axis: Vector::from(lump.axis).normalize(),
            radius_mm: shape.radius_mm(),
            half_height_mm: (!shape.is_ball()).then(|| shape.half_height_mm()),
        };
        tight.grown(clearance_mm)
    }

    /// Returns the region of the same kind that holds everything within `margin_mm` of this one.
    pub fn grown(&self, margin_mm: f64) -> Self {
        Self {
            radius_mm: (self.radius_mm + margin_mm) * self.stretch(),
            half_height_mm: self.half_height_mm.map(|half| half + margin_mm),
            ..*self
        }
    }

    /// Returns the ratio by which its mesh is larger than the round region inside it.
    fn stretch(&self) -> f64 {
        if self.half_height_mm.is_some() {
            1.0 / (PI / f64::from(SEGMENTS)).cos()
        } else {
            BALL_STRETCH
        }
    }

    /// Returns its surface, closed and facing outward, model frame, mm.
    pub fn mesh(&self) -> TriMesh {
        let Some(half) = self.half_height_mm else {
            let skewed = Frame::with_axis(self.center, &SKEW);
            return primitives::ball(&Point::origin(), self.radius_mm, BALL_LEVEL)
                .map_vertices(|p| skewed.to_model(p));
        };
        let upright = Frame::with_axis(self.center, &self.axis);
        let (sin, cos) = (SKEW_SEGMENTS * 2.0 * PI / f64::from(SEGMENTS)).sin_cos();
        primitives::cylinder(self.radius_mm, 2.0 * half, SEGMENTS).map_vertices(|p| {
            upright.to_model(&Point::new(
                p.x * cos - p.y * sin,
                p.x * sin + p.y * cos,
                p.z - half,
            ))
        })
    }

    /// Returns the moments of its mesh, model frame, mm.
    pub fn moments(&self) -> Moments {
        moments_of_mesh(&self.mesh())
    }

    /// Returns the distance of a point from its surface, mm; negative inside.
    pub fn distance_mm(&self, point: &Point) -> f64 {
        let offset = point - self.center;
        let Some(half) = self.half_height_mm else {
            return offset.norm() - self.radius_mm;
        };
        let height = self.axis.dot(&offset);
        let (beyond, aside) = (
            height.abs() - half,
            (offset - self.axis * height).norm() - self.radius_mm,
        );
        beyond.max(0.0).hypot(aside.max(0.0)) + beyond.max(aside).min(0.0)
    }

    /// Returns points that stand for it, and its reach from each, mm. For a ball they are the
    /// centre and the radius, for a cylinder points of its rims and caps.
    pub fn outline(&self) -> (Vec<Point>, f64) {
        let Some(half) = self.half_height_mm else {
            return (vec![self.center], self.radius_mm);
        };
        let ring = |ratio: f64| rims(&self.center, &self.axis, [self.radius_mm * ratio, half]);
        let rim = ring(1.0).into_iter();
        (rim.chain(RINGS.into_iter().flat_map(ring)).collect(), 0.0)
    }

    /// Returns true if two pockets are at least this gap apart, mm.
    pub fn clears(&self, other: &Self, gap_mm: f64) -> bool {
        let is_clear = |a: &Self, b: &Self| {
            let (points, reach_mm) = a.outline();
            points.iter().all(|p| b.distance_mm(p) - reach_mm >= gap_mm)
        };
        is_clear(self, other) && is_clear(other, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mass::LumpShape;
    use crate::mesh::{MeshDistance, Solid};

    fn lump(shape: LumpShape) -> Lump {
        Lump {
            shape,
            mass_g: 1.0,
            center_mm: [1.0, 2.0, 3.0],
            axis: [1.0, 1.0, 0.0],
        }
    }

    const BALL: LumpShape = LumpShape::Ball { diameter_mm: 6.0 };
    const DISC: LumpShape = LumpShape::Disc {
        diameter_mm: 16.0,
        thickness_mm: 2.0,
    };
    const NUT: LumpShape = LumpShape::HexNut {
        across_flats_mm: 10.0,
        bore_mm: 5.35,
        thickness_mm: 5.0,
    };

    #[test]
    fn a_pocket_is_a_solid_that_leaves_the_clearance_all_around_the_part() {
        for shape in [BALL, DISC, NUT] {
            let (part, pocket) = (Pocket::of(&lump(shape), 0.0), Pocket::of(&lump(shape), 0.2));
            Solid::new(pocket.mesh()).unwrap();
            let distance = MeshDistance::new(&pocket.mesh());
            let (points, _) = lump(shape).outline();
            let least = points
                .iter()
                .map(|p| distance.signed(p))
                .fold(f64::INFINITY, f64::min);
            let room_mm = least
                - if shape.is_ball() {
                    shape.radius_mm()
                } else {
                    0.0
                };
            // Facets touch from outside; at rims the gap is measured across the corner's nearer
            // face.
            assert!(
                (0.2 - 1e-9..0.25).contains(&room_mm),
                "{shape:?}: {room_mm}"
            );
            assert!(pocket.radius_mm < part.radius_mm + 0.25);
        }
    }

    #[test]
    fn a_jacket_holds_everything_within_the_web() {
        for shape in [BALL, DISC] {
            let pocket = Pocket::of(&lump(shape), 0.1);
            let gap_mm =
                MeshDistance::new(&pocket.grown(1.0).mesh()).min_distance_to(&pocket.mesh());
            assert!(gap_mm >= 1.0 - 1e-9, "{shape:?}: {gap_mm}");
        }
    }

    #[test]
    fn the_distance_to_a_cylinder_is_that_to_its_mesh() {
        let pocket = Pocket::of(&lump(DISC), 0.0);
        let mesh = MeshDistance::new(&pocket.mesh());
        for (x, y, z) in [
            (1.0, 2.0, 3.0),
            (9.0, -7.0, 4.0),
            (2.0, 3.0, 3.0),
            (3.0, 5.0, 14.0),
        ] {
            let point = Point::new(x, y, z);
            // Facets lie 0.12 % of 8 mm inside the round.
            assert!(
                (pocket.distance_mm(&point) + mesh.signed(&point)).abs() < 0.011,
                "{point}"
            );
        }
    }

    #[test]
    fn two_discs_that_cross_are_not_clear_of_each_other() {
        let at = |center_mm, axis| {
            Pocket::of(
                &Lump {
                    center_mm,
                    axis,
                    ..lump(DISC)
                },
                0.0,
            )
        };
        let flat = at([0.0; 3], [0.0, 0.0, 1.0]);
        // The rim of one stands over the middle of the other, whose own rims are far away.
        assert!(!flat.clears(&at([0.0, 0.0, 9.5], [1.0, 0.0, 0.0]), 1.0));
        assert!(flat.clears(&at([0.0, 0.0, 10.1], [1.0, 0.0, 0.0]), 1.0));
    }
}
