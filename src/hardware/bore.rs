//! A socket along the axis: its shape, and the check that the model holds it.

use std::f64::consts::PI;

use super::fitted::Kind;
use crate::base::setting::{Key, Setting};
use crate::geom::{Frame, Point};
use crate::mesh::{
    AxialLine, ClipError, Csg, NearAxis, TriMesh, primitives, walled_mm, winding_number,
};

/// The number of sides of a socket. With 48 the corners of a 20 mm bore stand 0.02 mm off the
/// circle; more only make more triangles.
const SIDES: u32 = 48;
/// The angle of the socket's first corner about the axis, rad. It keeps the corner off a model's
/// planes of symmetry.
const TURN_RAD: f64 = 0.3;
/// The number of depths at which the wall around a socket is checked.
const LOOKS: usize = 8;
/// The number of directions in which it is checked at each depth. Between them 2 % of the distance
/// from the axis may be missed.
const DIRECTIONS: usize = 16;
/// The share of its depth over which a socket must have a wall all around. With less, a blow on the
/// rod breaks the rim.
const HELD_RATIO: f64 = 0.5;

/// A reason why a socket cannot be bored.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SeatError {
    /// It breaks out of the model, or the wall at its bottom is too thin.
    #[error(
        "the {}'s socket, {depth_mm:.2} mm deep, has no wall of {wall_mm:.2} mm at its bottom; \
         remedy: {}",
        rod.word(),
        remedy_for_depth(*rod, *most_mm)
    )]
    BreaksOut {
        /// The rod it is for.
        rod: Kind,
        /// The depth asked for, mm.
        depth_mm: f64,
        /// The wall asked for, mm.
        wall_mm: f64,
        /// The greatest depth that fits there, mm; `None` if none does.
        most_mm: Option<f64>,
    },
    /// Too little of its depth has a wall around it.
    #[error(
        "the {rod}'s socket has a wall of {wall_mm:.2} mm around it over {held_mm:.2} of its \
         {depth_mm:.2} mm only; remedy: choose a deeper or thinner {rod}, or another place for it",
        rod = rod.word()
    )]
    HardlyHeld {
        /// The rod it is for.
        rod: Kind,
        /// The part of its depth that has a wall, mm.
        held_mm: f64,
        /// The depth asked for, mm.
        depth_mm: f64,
        /// The wall asked for, mm.
        wall_mm: f64,
    },
}

/// The number of shorter depths that are tried if a socket breaks out. With fewer, the advised
/// depth would be too coarse.
const DEPTHS: usize = 20;

/// Returns the remedy for a socket that breaks out.
fn remedy_for_depth(rod: Kind, most_mm: Option<f64>) -> String {
    let key = match rod {
        Kind::Axle | Kind::Ring => None,
        Kind::Tip => Some(Key::Tip),
        Kind::Stem => Some(Key::Stem),
    };
    let rod = rod.word();
    match (most_mm.map(|mm| (mm * 10.0).floor() / 10.0), key) {
        (Some(mm), Some(key)) if mm > 0.0 => {
            let setting = Setting::new(key, format!("DIAMETERxLENGTHx{mm:.1}"));
            format!("make it {mm:.1} mm deep (`{setting}`)")
        }
        (Some(mm), None) if mm > 0.0 => {
            format!("choose a shorter {rod}: {mm:.1} mm of it fit there")
        }
        _ => format!("no depth there leaves one: choose a thinner {rod}, or another place for it"),
    }
}

/// A socket about the z axis of a frame, from its mouth to its bottom.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Bore {
    pub rod: Kind,
    pub radius_mm: f64,
    /// The least wall around it and behind its bottom, mm.
    pub wall_mm: f64,
    /// The height of its mouth in the frame, mm.
    pub mouth_mm: f64,
    /// The height of its bottom in the frame, mm.
    pub bottom_mm: f64,
}

impl Bore {
    fn depth_mm(&self) -> f64 {
        (self.bottom_mm - self.mouth_mm).abs()
    }

    /// Checks that the model has a wall around the bore and behind its bottom. If the bore breaks
    /// out, the error gives the greatest depth that fits.
    pub fn check(&self, model: &TriMesh, frame: &Frame) -> Result<(), SeatError> {
        let walls = self.feel(model, frame);
        self.check_walls(&walls).map_err(|error| match error {
            SeatError::BreaksOut {
                rod,
                depth_mm,
                wall_mm,
                ..
            } => {
                let shorter = |i: &usize| Self {
                    bottom_mm: self.at_depth(self.share(*i)),
                    ..*self
                };
                let fits = (1..DEPTHS)
                    .rev()
                    .find(|i| shorter(i).check_walls(&walls).is_ok());
                SeatError::BreaksOut {
                    rod,
                    depth_mm,
                    wall_mm,
                    most_mm: fits.map(|i| self.share(i)),
                }
            }
            held => held,
        })
    }

    /// Returns `i` twentieths of its depth, mm.
    fn share(&self, i: usize) -> f64 {
        self.depth_mm() * i as f64 / DEPTHS as f64
    }

    /// Feels the model along the axis and around the bore.
    fn feel(&self, model: &TriMesh, frame: &Frame) -> Walls {
        let radius_mm = self.radius_mm + self.wall_mm;
        let near = NearAxis::new(model, frame, radius_mm);
        Walls {
            around: near.ring(DIRECTIONS, radius_mm, TURN_RAD),
            axis: near.line([0.0; 2]),
        }
    }

    fn check_walls(&self, walls: &Walls) -> Result<(), SeatError> {
        let heights =
            (0..LOOKS).map(|i| self.at_depth(self.depth_mm() * (1.0 - i as f64 / LOOKS as f64)));
        let around: Vec<bool> = heights.map(|z| walls.count(z) == DIRECTIONS).collect();
        let behind_mm = self.at_depth(self.depth_mm() + self.wall_mm);
        let Self { rod, wall_mm, .. } = *self;
        let depth_mm = self.depth_mm();
        if !(around[0] && walls.axis.is_inside(behind_mm)) {
            return Err(SeatError::BreaksOut {
                rod,
                depth_mm,
                wall_mm,
                most_mm: None,
            });
        }
        let held = around.iter().filter(|&&is_walled| is_walled).count();
        let held_mm = depth_mm * held as f64 / LOOKS as f64;
        let is_held = held_mm >= HELD_RATIO * depth_mm;
        if is_held {
            Ok(())
        } else {
            Err(SeatError::HardlyHeld {
                rod,
                held_mm,
                depth_mm,
                wall_mm,
            })
        }
    }

    /// Returns true if it goes right through the model: its bottom lies outside, and there is a
    /// wall behind its mouth.
    pub fn passes_through(&self, model: &TriMesh, frame: &Frame) -> bool {
        let walls = self.feel(model, frame);
        walls.count(self.bottom_mm) == 0 && walls.count(self.at_depth(self.wall_mm)) == DIRECTIONS
    }

    /// Returns the length over which the bore has its wall all around, mm.
    pub fn held_mm(&self, model: &TriMesh, frame: &Frame) -> f64 {
        let ends_mm = [
            self.mouth_mm.min(self.bottom_mm),
            self.mouth_mm.max(self.bottom_mm),
        ];
        walled_mm(&self.feel(model, frame).around, ends_mm)
    }

    /// Returns the height in the frame at a depth below the mouth, mm.
    fn at_depth(&self, depth_mm: f64) -> f64 {
        self.mouth_mm + depth_mm.copysign(self.bottom_mm - self.mouth_mm)
    }
}

/// The body along a bore's axis and around it.
struct Walls {
    around: Vec<AxialLine>,
    axis: AxialLine,
}

impl Walls {
    /// Counts the directions in which the wall around the bore lies in the body at a height of the
    /// frame.
    fn count(&self, z: f64) -> usize {
        self.around.iter().filter(|line| line.is_inside(z)).count()
    }
}

/// Returns the prism that is subtracted for a round rod between two heights of a frame. The rod's
/// circle touches its sides.
pub(super) fn prism(
    frame: &Frame,
    radius_mm: f64,
    [low_mm, high_mm]: [f64; 2],
) -> Result<Csg, ClipError> {
    let corner_mm = radius_mm / (PI / f64::from(SIDES)).cos();
    let (sin, cos) = TURN_RAD.sin_cos();
    let upright = primitives::cylinder(corner_mm, high_mm - low_mm, SIDES);
    let place = |p: &Point| {
        frame.to_model(&Point::new(
            cos * p.x - sin * p.y,
            sin * p.x + cos * p.y,
            p.z + low_mm,
        ))
    };
    Csg::of_mesh(&upright.map_vertices(place))
}

/// Returns true if a point lies in the body that a mesh bounds.
pub(super) fn is_inside(mesh: &TriMesh, point: &Point) -> bool {
    winding_number(mesh, point) > 0.5
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::primitives::cuboid;

    fn bore(bottom_mm: f64) -> Bore {
        Bore {
            rod: Kind::Tip,
            radius_mm: 2.0,
            wall_mm: 1.0,
            mouth_mm: 0.0,
            bottom_mm,
        }
    }

    #[test]
    fn a_rod_fits_its_prism_and_the_prism_is_no_larger_than_it_must_be() {
        let prism = prism(&Frame::identity(), 2.0, [1.0, 4.0])
            .unwrap()
            .to_mesh()
            .unwrap();
        let volume = prism.signed_volume_mm3();
        // A prism about a circle is larger by (π/n)²/3 of its area, 0.14 % for 48 sides.
        assert!(
            volume > 12.0 * PI && volume < 12.0 * PI * 1.0015,
            "{volume}"
        );
        let off_axis = prism
            .vertices()
            .iter()
            .map(|p| p.x.hypot(p.y))
            .filter(|r| *r > 0.0);
        assert!(off_axis.fold(f64::INFINITY, f64::min) > 2.0);
    }

    #[test]
    fn a_socket_needs_its_wall_behind_the_bottom_and_around() {
        let block = cuboid(&Point::new(-4.0, -4.0, 0.0), &Point::new(4.0, 4.0, 10.0));
        let check = |bottom_mm| bore(bottom_mm).check(&block, &Frame::identity());
        let is_through = |bottom_mm| bore(bottom_mm).passes_through(&block, &Frame::identity());
        assert!(check(8.9) == Ok(()) && !is_through(8.9));
        assert!(matches!(check(9.1), Err(SeatError::BreaksOut { .. })) && !is_through(9.1));
        assert!(matches!(check(11.0), Err(SeatError::BreaksOut { .. })) && is_through(11.0));
        let thin = cuboid(&Point::new(-2.9, -4.0, 0.0), &Point::new(4.0, 4.0, 10.0));
        assert!(bore(5.0).check(&thin, &Frame::identity()).is_err());
    }

    #[test]
    fn a_socket_that_is_open_over_most_of_its_depth_is_refused() {
        let block = cuboid(&Point::new(-4.0, -4.0, 7.0), &Point::new(4.0, 4.0, 20.0));
        let result = bore(10.0).check(&block, &Frame::identity());
        assert!(matches!(result, Err(SeatError::HardlyHeld { held_mm, .. }) if held_mm == 3.75));
    }
}
