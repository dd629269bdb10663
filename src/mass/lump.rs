//! A stock part as a lump of declared mass: its shape tells how the mass lies about its centre.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::Moments;
use crate::geom::{Matrix, Point, Vector};

/// The sizes of a stock part, mm. Its axis is told with its place; a ball needs none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind", deny_unknown_fields)]
pub enum LumpShape {
    /// A ball.
    Ball {
        /// Its diameter.
        diameter_mm: f64,
    },
    /// A round disc, such as a coin.
    Disc {
        /// Its diameter.
        diameter_mm: f64,
        /// Its height along the axis.
        thickness_mm: f64,
    },
    /// A hexagonal prism with a round bore, such as a nut.
    HexNut {
        /// Between two opposite flats.
        across_flats_mm: f64,
        /// The diameter of a plain bore that takes away as much as the thread does.
        bore_mm: f64,
        /// Its height along the axis.
        thickness_mm: f64,
    },
}

impl LumpShape {
    /// Every size, by name; all must be positive.
    pub fn sizes_mm(&self) -> Vec<(&'static str, f64)> {
        match *self {
            Self::Ball { diameter_mm } => vec![("diameter_mm", diameter_mm)],
            Self::Disc {
                diameter_mm,
                thickness_mm,
            } => {
                vec![("diameter_mm", diameter_mm), ("thickness_mm", thickness_mm)]
            }
            Self::HexNut {
                across_flats_mm,
                bore_mm,
                thickness_mm,
            } => vec![
                ("across_flats_mm", across_flats_mm),
                ("bore_mm", bore_mm),
                ("thickness_mm", thickness_mm),
                ("across_flats_mm less bore_mm", across_flats_mm - bore_mm),
            ],
        }
    }

    /// The radius of the round hole about its axis that it just passes, mm.
    pub fn radius_mm(&self) -> f64 {
        match *self {
            Self::Ball { diameter_mm } | Self::Disc { diameter_mm, .. } => diameter_mm / 2.0,
            Self::HexNut {
                across_flats_mm, ..
            } => across_flats_mm / 3f64.sqrt(),
        }
    }

    /// Half its extent along the axis, mm.
    pub fn half_height_mm(&self) -> f64 {
        match *self {
            Self::Ball { diameter_mm } => diameter_mm / 2.0,
            Self::Disc { thickness_mm, .. } | Self::HexNut { thickness_mm, .. } => {
                thickness_mm / 2.0
            }
        }
    }

    /// Whether it is the same from every side, so that it needs no axis.
    pub fn is_ball(&self) -> bool {
        matches!(self, Self::Ball { .. })
    }

    /// Its volume, mm³.
    pub fn volume_mm3(&self) -> f64 {
        match *self {
            Self::Ball { diameter_mm } => PI / 6.0 * diameter_mm.powi(3),
            Self::Disc {
                diameter_mm,
                thickness_mm,
            } => PI / 4.0 * diameter_mm * diameter_mm * thickness_mm,
            Self::HexNut {
                across_flats_mm,
                bore_mm,
                thickness_mm,
            } => hexagon(across_flats_mm, bore_mm)[0] * thickness_mm,
        }
    }

    /// The mean squares of the distance from the middle plane that holds the axis, and from the one
    /// across it, mm², of a homogeneous body.
    fn mean_squares_mm2(&self) -> [f64; 2] {
        match *self {
            Self::Ball { diameter_mm } => [diameter_mm * diameter_mm / 20.0; 2],
            Self::Disc {
                diameter_mm,
                thickness_mm,
            } => [
                diameter_mm * diameter_mm / 16.0,
                thickness_mm * thickness_mm / 12.0,
            ],
            Self::HexNut {
                across_flats_mm,
                bore_mm,
                thickness_mm,
            } => {
                let [area, second] = hexagon(across_flats_mm, bore_mm);
                [second / area, thickness_mm * thickness_mm / 12.0]
            }
        }
    }
}

/// The area of a bored hexagon, mm², and its second moment about a line through its middle, mm⁴.
fn hexagon(across_flats_mm: f64, bore_mm: f64) -> [f64; 2] {
    let (flats2, bore2) = (across_flats_mm * across_flats_mm, bore_mm * bore_mm);
    let (root3, eighth) = (3f64.sqrt(), PI / 4.0);
    [
        root3 / 2.0 * flats2 - eighth * bore2,
        5.0 * root3 / 144.0 * flats2 * flats2 - PI / 64.0 * bore2 * bore2,
    ]
}

/// A part of declared mass at a declared place.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lump {
    /// Its shape.
    pub shape: LumpShape,
    /// g.
    pub mass_g: f64,
    /// Its centre, model frame, mm.
    pub center_mm: [f64; 3],
    /// Its axis, model frame; any length but zero.
    pub axis: [f64; 3],
}

impl Lump {
    /// The moments, model frame, of a body of `density_g_mm3` that has the same mass, centre and
    /// tensor: what it adds to a print of that density. Exact for homogeneous parts of these
    /// shapes.
    pub fn moments(&self, density_g_mm3: f64) -> Moments {
        let volume_mm3 = self.mass_g / density_g_mm3;
        let [across, along] = self.shape.mean_squares_mm2();
        let axis = Vector::from(self.axis).normalize();
        let second = Matrix::identity() * across + axis * axis.transpose() * (along - across);
        Moments::from_parts(volume_mm3, &Vector::zeros(), &(second * volume_mm3))
            .translated(&Vector::from(self.center_mm))
    }

    /// Points of its outline that decide whether it has room: the centre of a ball, and a distance
    /// from there; the rims of the others, and none.
    pub fn outline(&self) -> (Vec<Point>, f64) {
        let center = Point::from(self.center_mm);
        if self.shape.is_ball() {
            return (vec![center], self.shape.radius_mm());
        }
        (
            rims(
                &center,
                &Vector::from(self.axis).normalize(),
                [self.shape.radius_mm(), self.shape.half_height_mm()],
            ),
            0.0,
        )
    }
}

/// Points of a rim. A chord between them lies 0.5 % of the radius inside.
const RIM_POINTS: u32 = 32;

/// Points on both rims of a cylinder of this radius and half height about a unit axis, mm.
pub fn rims(center: &Point, axis: &Vector, [radius_mm, half_height_mm]: [f64; 2]) -> Vec<Point> {
    let (u, v) = crate::geom::orthonormal_basis(axis);
    let on_rim = |i: u32| {
        let (sin, cos) = (2.0 * PI * f64::from(i) / f64::from(RIM_POINTS)).sin_cos();
        (u * cos + v * sin) * radius_mm
    };
    let ends = [-half_height_mm, half_height_mm];
    ends.iter()
        .flat_map(|&end| (0..RIM_POINTS).map(move |i| center + axis * end + on_rim(i)))
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Frame;
    use crate::mass::moments_of_mesh;
    use crate::mesh::primitives;

    /// The moments of a lump of 3 g at a place, printed at 1 g/cm³.
    fn moments(shape: LumpShape, axis: Vector) -> Moments {
        Lump {
            shape,
            mass_g: 3.0,
            center_mm: [4.0, -2.0, 7.0],
            axis: axis.into(),
        }
        .moments(1e-3)
    }

    /// The same of a mesh about the origin with its axis along z.
    fn of_mesh(mesh: &crate::mesh::TriMesh, axis: Vector) -> Moments {
        let plain = moments_of_mesh(mesh);
        let frame = Frame::with_axis(Point::new(4.0, -2.0, 7.0), &axis);
        (plain * (3000.0 / plain.volume())).from_frame(&frame)
    }

    fn close(got: &Moments, want: &Moments, ratio: f64) -> bool {
        got.0
            .iter()
            .zip(want.0)
            .all(|(got, want)| (got - want).abs() <= ratio * want.abs().max(3000.0))
    }

    #[test]
    fn a_ball_and_a_disc_weigh_as_their_meshes_do() {
        let axis = Vector::new(1.0, 2.0, -0.5);
        let ball = moments(LumpShape::Ball { diameter_mm: 5.0 }, axis);
        // An icosphere of level 5 falls short by 3e-4 in the squares of its radius.
        assert!(close(
            &ball,
            &of_mesh(&primitives::ball(&Point::origin(), 2.5, 5), axis),
            1e-3
        ));
        let disc = moments(
            LumpShape::Disc {
                diameter_mm: 6.0,
                thickness_mm: 2.0,
            },
            axis,
        );
        let mesh = primitives::cylinder(3.0, 2.0, 512).map_vertices(|p| p - Vector::z());
        assert!(close(&disc, &of_mesh(&mesh, axis), 1e-4));
    }

    #[test]
    fn a_nut_is_a_hexagon_less_its_bore() {
        let [flats, bore, height] = [10.0, 5.35, 5.0];
        let nut = LumpShape::HexNut {
            across_flats_mm: flats,
            bore_mm: bore,
            thickness_mm: height,
        };
        let middle = |p: &Point| p - Vector::z() * (height / 2.0);
        let hexagon = primitives::cylinder(flats / 3f64.sqrt(), height, 6).map_vertices(middle);
        let hole = primitives::cylinder(bore / 2.0, height, 512).map_vertices(middle);
        let mesh = hexagon.joined(&hole.reversed());
        assert!((nut.volume_mm3() / mesh.signed_volume_mm3() - 1.0).abs() < 1e-4);
        assert!(close(
            &moments(nut, Vector::y()),
            &of_mesh(&mesh, Vector::y()),
            1e-4
        ));
    }
}
