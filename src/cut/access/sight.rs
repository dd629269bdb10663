//! The share of a void's wall that is in sight of its openings.

use rayon::prelude::*;

use crate::{
    base::watch::Cancelled,
    cut::{
        access::eyes::{Eye, Lookout, SightTest},
        geometry::outline::Outline,
        pieces::split::Piece,
    },
    geom::Point,
    mesh::{Solid, area_mm2, spread_points},
};

/// Sample points on the wall of a void. A hidden share of 5 % is then known to within 0.5 %.
const SAMPLES: f64 = 2000.0;
/// An estimate looks at every so many of them. A test holds its error to two hundredths.
const ESTIMATE_STRIDE: usize = 3;
/// Least number of sample points on a piece, however small.
const MIN_SAMPLES: usize = 24;
/// Number of viewpoints across a mouth, along each of two directions.
const EYES_ACROSS: usize = 5;
/// Number of viewpoints across a mouth in the second, finer test. Only slivers, a few thousandths
/// of a wall, are visible from the additional viewpoints alone.
const FINE_EYES_ACROSS: usize = 16;
/// Number of points that are tested one after another, each with what was learned from those
/// before. The chunks are the same for any number of threads.
const POINTS_AT_ONCE: usize = 64;

/// The wall of a piece of a void, and its visible and hidden parts.
#[derive(Debug, Clone, Default)]
pub(crate) struct Visibility {
    /// Area of the wall, mm².
    pub(crate) wall_mm2: f64,
    /// Area in sight and within reach, mm², estimated from the sample.
    pub(crate) seen_mm2: f64,
    /// Sample points out of sight or out of reach.
    pub(crate) hidden: Vec<Point>,
    /// Sample points in sight and within reach.
    pub(crate) visible: Vec<Point>,
    /// Area that each sample point stands for, mm².
    pub(crate) share_mm2: f64,
}

/// A point of a wall, and the viewpoints that see it.
pub(crate) struct Sightlines {
    pub(crate) at: Point,
    pub(crate) eyes: Vec<Point>,
}

impl Sightlines {
    pub(crate) fn is_seen(&self) -> bool {
        !self.eyes.is_empty()
    }
}

/// The walls of one void.
pub(crate) struct Walls {
    void: Solid,
    /// Sample points on the wall of the whole void.
    points: Vec<Point>,
    /// Area that each sample point stands for, mm².
    share_mm2: f64,
}

impl Walls {
    pub(crate) fn of(void: &Solid) -> Self {
        let wall: Vec<[Point; 3]> = void.mesh().iter_corners().collect();
        let area: f64 = wall.iter().map(area_mm2).sum();
        let points = spread_points(&wall, SAMPLES as usize)
            .into_iter()
            .map(|point| point.at)
            .collect();
        Self {
            void: void.clone(),
            points,
            share_mm2: area / SAMPLES,
        }
    }

    /// Estimates the share of the wall that is in sight through these mouths before the void is
    /// cut. Each mouth comes with the index of its cut. A point behind another plane counts as
    /// hidden.
    pub(crate) fn estimate_sight_ratio(
        &self,
        mouths: &[(usize, Outline)],
        sight: &SightTest,
    ) -> Result<f64, Cancelled> {
        let mouths: Vec<(usize, &Outline)> = mouths
            .iter()
            .map(|(cut, outline)| (*cut, outline))
            .collect();
        let points: Vec<Point> = self
            .points
            .iter()
            .step_by(ESTIMATE_STRIDE)
            .copied()
            .collect();
        let total = points.len().max(1);
        let (_, visible) = self.classify(points, &mouths, sight)?;
        Ok(visible.len() as f64 / total as f64)
    }

    /// Returns every sample point with the viewpoints that see it before the void is cut. Each
    /// mouth comes with the index of its cut. The finer viewpoints are used only for points that
    /// the coarse ones do not see.
    pub(crate) fn sightlines(
        &self,
        mouths: &[(usize, Outline)],
        sight: &SightTest,
    ) -> Result<Vec<Sightlines>, Cancelled> {
        let mouths: Vec<(usize, &Outline)> = mouths
            .iter()
            .map(|(cut, outline)| (*cut, outline))
            .collect();
        let [few, many] = [EYES_ACROSS, FINE_EYES_ACROSS].map(|count| sight.eyes(&mouths, count));
        let lines = |points: &[Point]| {
            let [mut few, mut many] =
                [&few, &many].map(|eyes| Lookout::new(self.void.bvh(), eyes, sight));
            let line = |at: &Point| {
                sight.watch.check()?;
                let eyes = few.eyes_seeing(at);
                let eyes = if eyes.is_empty() {
                    many.eyes_seeing(at)
                } else {
                    eyes
                };
                Ok(Sightlines { at: *at, eyes })
            };
            points.iter().map(line).collect()
        };
        let lines = self.points.par_chunks(POINTS_AT_ONCE).map(lines);
        let lines: Vec<Vec<Sightlines>> = lines.collect::<Result<_, Cancelled>>()?;
        Ok(lines.into_iter().flatten().collect())
    }

    /// Returns the area of the wall, mm².
    pub(crate) fn area_mm2(&self) -> f64 {
        SAMPLES * self.share_mm2
    }

    /// Returns the wall in sight of the piece's own mouths and within reach. Without mouths, all of
    /// it is hidden.
    pub(crate) fn inspect(
        &self,
        piece: &Piece,
        sight: &SightTest,
    ) -> Result<Visibility, Cancelled> {
        let wall = wall(piece);
        let wall_mm2: f64 = wall.iter().map(area_mm2).sum();
        let count = (wall_mm2 / self.share_mm2).ceil() as usize;
        let points = spread_points(&wall, count.max(MIN_SAMPLES));
        let points: Vec<Point> = points.into_iter().map(|point| point.at).collect();
        let share_mm2 = wall_mm2 / points.len().max(1) as f64;
        let mouths: Vec<(usize, &Outline)> = piece
            .caps
            .iter()
            .map(|cap| (cap.cut, &cap.outline))
            .collect();
        let (hidden, visible) = self.classify(points, &mouths, sight)?;
        Ok(Visibility {
            wall_mm2,
            seen_mm2: share_mm2 * visible.len() as f64,
            hidden,
            visible,
            share_mm2,
        })
    }

    /// Splits points into hidden and visible ones. If few are hidden from the coarse viewpoints,
    /// these are tested again from the finer ones.
    fn classify(
        &self,
        points: Vec<Point>,
        mouths: &[(usize, &Outline)],
        sight: &SightTest,
    ) -> Result<(Vec<Point>, Vec<Point>), Cancelled> {
        let total = points.len() as f64;
        let (hidden, mut visible) =
            self.partition_by_sight(points, &sight.eyes(mouths, EYES_ACROSS), sight)?;
        if hidden.len() as f64 > sight.max_hidden_ratio * total {
            return Ok((hidden, visible));
        }
        let (hidden, more) =
            self.partition_by_sight(hidden, &sight.eyes(mouths, FINE_EYES_ACROSS), sight)?;
        visible.extend(more);
        Ok((hidden, visible))
    }

    /// Splits points into those that no eye sees within reach, and the others.
    fn partition_by_sight(
        &self,
        points: Vec<Point>,
        eyes: &[Eye],
        sight: &SightTest,
    ) -> Result<(Vec<Point>, Vec<Point>), Cancelled> {
        let test = |points: &[Point]| {
            let mut lookout = Lookout::new(self.void.bvh(), eyes, sight);
            let is_seen = |at| {
                sight.watch.check()?;
                Ok(lookout.sees(at))
            };
            points.iter().map(is_seen).collect()
        };
        let tested = points.par_chunks(POINTS_AT_ONCE).map(test);
        let tested: Vec<Vec<bool>> = tested.collect::<Result<_, Cancelled>>()?;
        let (mut hidden, mut visible) = (Vec::new(), Vec::new());
        for (at, is_seen) in points.into_iter().zip(tested.into_iter().flatten()) {
            if is_seen {
                visible.push(at);
            } else {
                hidden.push(at);
            }
        }
        Ok((hidden, visible))
    }
}

/// Returns the triangles of a piece without its mouths.
fn wall(piece: &Piece) -> Vec<[Point; 3]> {
    let mut is_wall = vec![true; piece.mesh.triangles().len()];
    for &face in piece.caps.iter().flat_map(|cap| &cap.faces) {
        is_wall[face] = false;
    }
    piece
        .mesh
        .iter_corners()
        .zip(is_wall)
        .filter_map(|(corners, is_wall)| is_wall.then_some(corners))
        .collect()
}

impl Visibility {
    pub(crate) fn and(mut self, other: Self) -> Self {
        self.hidden.extend(other.hidden);
        self.visible.extend(other.visible);
        let (wall_mm2, seen_mm2) = (
            self.wall_mm2 + other.wall_mm2,
            self.seen_mm2 + other.seen_mm2,
        );
        Self {
            wall_mm2,
            seen_mm2,
            share_mm2: self.share_mm2.max(other.share_mm2),
            ..self
        }
    }

    /// Returns the visible share of the wall, or 0 if there is no wall.
    pub(crate) fn ratio(&self) -> f64 {
        if self.wall_mm2 > 0.0 {
            self.seen_mm2 / self.wall_mm2
        } else {
            0.0
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{geometry::tree::CutTree, pieces::split::split, scenes::request},
        geom::{Plane, Vector},
        mesh::{Csg, primitives},
    };

    fn seen_within(void: &Solid, planes: &[Plane], reach_mm: f64) -> f64 {
        let walls = Walls::of(void);
        let tree = CutTree::everywhere(planes);
        let request = request();
        let mut sight = SightTest::new(&tree, &request);
        sight.reach_mm = reach_mm;
        let pieces = split(void.mesh(), &tree, &request.watch).unwrap();
        pieces
            .iter()
            .map(|piece| walls.inspect(piece, &sight).unwrap())
            .fold(Visibility::default(), Visibility::and)
            .ratio()
    }

    fn seen_ratio(void: &Solid, planes: &[Plane]) -> f64 {
        seen_within(void, planes, f64::INFINITY)
    }

    fn level(z: f64) -> Plane {
        Plane {
            normal: Vector::z(),
            offset_mm: z,
        }
    }

    /// Returns a shaft of 4 × 4 mm from z = 2 down to −20, with an arm of 20 mm at its foot.
    fn bend() -> Solid {
        let shaft = primitives::cuboid(&Point::new(-2.0, -2.0, -20.0), &Point::new(2.0, 2.0, 2.0));
        let arm = primitives::cuboid(
            &Point::new(-2.0, -2.0, -20.0),
            &Point::new(18.0, 2.0, -16.0),
        );
        Csg::of_mesh(&shaft)
            .unwrap()
            .union(&Csg::of_mesh(&arm).unwrap())
            .unwrap()
            .to_solid()
            .unwrap()
    }

    #[test]
    fn a_ball_cut_in_half_is_all_in_sight() {
        let ball = Solid::new(primitives::ball(&Point::origin(), 10.0, 3)).unwrap();
        assert_eq!(seen_ratio(&ball, &[level(0.01)]), 1.0);
    }

    #[test]
    fn the_far_arm_of_a_bend_is_out_of_sight() {
        // A line from the mouth past the corner drops at least 16 mm over 4 mm. So it meets the
        // floor of the arm within 1 mm of the shaft. The shaft and its foot have 32·20 + 2·16 mm²,
        // the arm 16·16 mm². All of the arm beyond that 1 mm is hidden.
        let ratio = seen_ratio(&bend(), &[level(0.0)]);
        assert!(ratio > 0.5 && ratio < 0.75, "{ratio}");
        assert_eq!(seen_ratio(&bend(), &[]), 0.0);
        let lengthwise = Plane {
            normal: Vector::y(),
            offset_mm: 0.01,
        };
        assert_eq!(seen_ratio(&bend(), &[lengthwise]), 1.0);
    }

    #[test]
    fn what_the_tool_does_not_reach_is_not_in_sight() {
        // A straight shaft of 40 mm, cut off near its top. Below the cut it has 4·6·38 + 36 mm² of
        // wall, and a tool of 20 mm reaches half of it. The 2 mm above the cut are all visible.
        let shaft = primitives::cuboid(&Point::new(-3.0, -3.0, -38.0), &Point::new(3.0, 3.0, 2.0));
        let shaft = Solid::new(shaft).unwrap();
        assert_eq!(seen_ratio(&shaft, &[level(0.0)]), 1.0);
        let ratio = seen_within(&shaft, &[level(0.0)], 20.0);
        let expected = (24.0 * 20.0 + 24.0 * 2.0 + 36.0) / (24.0 * 40.0 + 72.0);
        assert!((ratio - expected).abs() < 0.02, "{ratio} {expected}");
    }
}
