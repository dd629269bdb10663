//! How much of a void's wall is in sight of its opening.

use rayon::prelude::*;

use super::{section::Chart, split::Piece};
use crate::{
    geom::{Bvh, Plane, Point},
    mesh::Solid,
};

/// Triangles of a piece that are looked at, at most: more resolve shares below a percent, which no brush feels.
const SAMPLES: usize = 1500;
/// The part of a line of sight that is looked along: the rest would meet the wall it ends on.
const LOOKED_RATIO: f64 = 0.999;
/// A triangle whose corners lie this near to a cut is part of the mouth, mm; rounding leaves 1e-12.
const MOUTH_MM: f64 = 1e-9;

/// The area of a piece's wall and how much of it is seen, mm², of a sample of its triangles.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Seen {
    wall_mm2: f64,
    seen_mm2: f64,
}

/// The walls of one void.
pub(crate) struct Walls(Bvh);

impl Walls {
    pub(crate) fn of(void: &Solid) -> Self {
        Self(Bvh::new(void.mesh().iter_corners()))
    }

    /// What an eye in the middle of the widest mouth of the piece sees of it; nothing if the piece has no mouth.
    pub(crate) fn seen(&self, piece: &Piece, planes: &[Plane]) -> Seen {
        let stride = piece.mesh.triangles().len().div_ceil(SAMPLES).max(1);
        let eye = eye(piece, planes);
        let looks: Vec<Seen> = (0..piece.mesh.triangles().len())
            .into_par_iter()
            .step_by(stride)
            .map(|index| self.look(&piece.mesh.corners(index), eye, planes))
            .collect();
        looks.into_iter().fold(Seen::default(), Seen::and)
    }

    fn look(&self, corners: &[Point; 3], eye: Option<Point>, planes: &[Plane]) -> Seen {
        let [a, b, c] = corners;
        let area_mm2 = (b - a).cross(&(c - a)).norm() / 2.0;
        let is_mouth = planes.iter().any(|plane| corners.iter().all(|p| plane.distance(p).abs() < MOUTH_MM));
        let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
        let is_seen = |eye: Point| {
            let end = eye + (middle - eye) * LOOKED_RATIO;
            !self.0.is_crossed_by(&eye, &end)
        };
        match eye {
            _ if is_mouth => Seen::default(),
            Some(eye) if is_seen(eye) => Seen { wall_mm2: area_mm2, seen_mm2: area_mm2 },
            _ => Seen { wall_mm2: area_mm2, seen_mm2: 0.0 },
        }
    }
}

impl Seen {
    pub(crate) fn and(self, other: Self) -> Self {
        Self { wall_mm2: self.wall_mm2 + other.wall_mm2, seen_mm2: self.seen_mm2 + other.seen_mm2 }
    }

    /// The share that is seen; 0 of nothing.
    pub(crate) fn ratio(&self) -> f64 {
        if self.wall_mm2 > 0.0 { self.seen_mm2 / self.wall_mm2 } else { 0.0 }
    }
}

/// The middle of the widest mouth of a piece.
fn eye(piece: &Piece, planes: &[Plane]) -> Option<Point> {
    let discs = piece.caps.iter().filter_map(|cap| Some((cap.cut, cap.outline.largest_disc(0.0)?)));
    let (cut, disc) = discs.max_by(|a, b| a.1.radius_mm.total_cmp(&b.1.radius_mm))?;
    Some(Chart::of_plane(&planes[cut]).lift(&planes[cut], &disc.center))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::split::split;
    use crate::geom::Vector;
    use crate::mesh::{Csg, primitives};

    fn seen_ratio(void: &Solid, planes: &[Plane]) -> f64 {
        let walls = Walls::of(void);
        let pieces = split(void.mesh(), planes).unwrap();
        pieces.iter().map(|piece| walls.seen(piece, planes)).fold(Seen::default(), Seen::and).ratio()
    }

    fn level(z: f64) -> Plane {
        Plane { normal: Vector::z(), offset_mm: z }
    }

    #[test]
    fn a_ball_cut_in_half_is_all_in_sight() {
        let ball = Solid::new(primitives::ball(&Point::origin(), 10.0, 3)).unwrap();
        assert_eq!(seen_ratio(&ball, &[level(0.01)]), 1.0);
    }

    #[test]
    fn the_far_arm_of_a_bend_is_out_of_sight() {
        // A shaft of 4 × 4 mm down to z = −20 with an arm of 20 mm at its foot: the arm's 16 mm beyond the
        // shaft are seen only where the line from the middle of the mouth slips in under the corner.
        let shaft = primitives::cuboid(&Point::new(-2.0, -2.0, -20.0), &Point::new(2.0, 2.0, 2.0));
        let arm = primitives::cuboid(&Point::new(-2.0, -2.0, -20.0), &Point::new(18.0, 2.0, -16.0));
        let bend = Csg::of_mesh(&shaft).unwrap().union(&Csg::of_mesh(&arm).unwrap()).unwrap();
        let bend = bend.to_solid().unwrap();
        let ratio = seen_ratio(&bend, &[level(0.0)]);
        assert!(ratio > 0.3 && ratio < 0.8, "{ratio}");
        assert_eq!(seen_ratio(&bend, &[]), 0.0);
    }
}
