//! A stock part as a lump of declared mass. Its shape gives the distribution of the mass about its
//! centre.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::moments::Moments;
use crate::geom::{Matrix, Point, Vector};

/// The shape and sizes of a stock part, mm. Its axis is given with its place; a ball needs none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", tag = "kind", deny_unknown_fields)]
pub enum LumpShape {
    /// A ball.
    Ball {
        /// Diameter, mm.
        diameter_mm: f64,
    },
    /// A round disc, such as a coin.
    Disc {
        /// Diameter, mm.
        diameter_mm: f64,
        /// Height along the axis, mm.
        thickness_mm: f64,
    },
    /// A hexagonal prism with a round bore, such as a nut.
    HexNut {
        /// Distance between two opposite flats, mm.
        across_flats_mm: f64,
        /// Diameter of a plain bore that removes as much material as the thread does, mm.
        bore_mm: f64,
        /// Height along the axis, mm.
        thickness_mm: f64,
    },
}

impl LumpShape {
    /// Returns every size with its name; all must be positive.
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

    /// Returns the radius of the smallest round hole about its axis that it passes through, mm.
    pub fn radius_mm(&self) -> f64 {
        match *self {
            Self::Ball { diameter_mm } | Self::Disc { diameter_mm, .. } => diameter_mm / 2.0,
            Self::HexNut {
                across_flats_mm, ..
            } => across_flats_mm / 3f64.sqrt(),
        }
    }

    /// Returns half its extent along the axis, mm.
    pub fn half_height_mm(&self) -> f64 {
        match *self {
            Self::Ball { diameter_mm } => diameter_mm / 2.0,
            Self::Disc { thickness_mm, .. } | Self::HexNut { thickness_mm, .. } => {
                thickness_mm / 2.0
            }
        }
    }

    /// Returns whether it is the same from every side, so that it needs no axis.
    pub fn is_ball(&self) -> bool {
        matches!(self, Self::Ball { .. })
    }

    /// Returns its volume, mm³.
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

    /// Returns, for a homogeneous body, the mean squared distance from a plane that holds the axis
    /// and from the middle plane across the axis, mm².
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

/// Returns the area of a bored hexagon, mm², and its second moment about a line through its middle,
/// mm⁴.
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
    /// Shape.
    pub shape: LumpShape,
    /// Mass, g.
    pub mass_g: f64,
    /// Centre, model frame, mm.
    pub center_mm: [f64; 3],
    /// Axis, model frame; any length except zero.
    pub axis: [f64; 3],
}

impl Lump {
    /// Returns the moments, model frame, of a body of `density_g_mm3` with the same mass, centre
    /// and inertia tensor. They are what the lump adds to a print of that density. Exact for
    /// homogeneous parts of these shapes.
    pub fn moments(&self, density_g_mm3: f64) -> Moments {
        let volume_mm3 = self.mass_g / density_g_mm3;
        let [across, along] = self.shape.mean_squares_mm2();
        let axis = Vector::from(self.axis).normalize();
        let second = Matrix::identity() * across + axis * axis.transpose() * (along - across);
        Moments::from_parts(volume_mm3, &Vector::zeros(), &(second * volume_mm3))
            .translated(&Vector::from(self.center_mm))
    }

    /// Returns points of its outline and a radius about them, mm, that decide whether it has room.
    /// For a ball these are its centre and its radius, for other shapes the points of both rims and
    /// zero.
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

/// Number of points of a rim. A chord between them lies 0.5 % of the radius inside.
const RIM_POINTS: u32 = 32;

/// Returns points on both rims of a cylinder of this radius and half height about a unit axis, mm.
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

    /// Returns the moments of a lump of 3 g at a place, printed at 1 g/cm³.
    fn moments(shape: LumpShape, axis: Vector) -> Moments {
        Lump {
            shape,
            mass_g: 3.0,
            center_mm: [4.0, -2.0, 7.0],
            axis: axis.into(),
        }
        .moments(1e-3)
    }

    /// Returns the same for a mesh about the origin with its axis along z.
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
        // An icosphere of level 5 lacks 3e-4 of its squared radius.
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
