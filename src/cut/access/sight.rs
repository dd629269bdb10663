//! The share of a void's wall that is in sight of its openings.

use rayon::prelude::*;

use crate::{
    base::watch::{Cancelled, Watch},
    cut::{
        geometry::{
            chart::{Chart, Point2},
            outline::Outline,
            tree::CutTree,
        },
        pieces::split::Piece,
        request::PlanRequest,
    },
    geom::{Bvh, Point},
    mesh::{Solid, area_mm2, spread_points},
};

/// Sample points on the wall of a void. A hidden share of 5 % is then known to within 0.5 %.
const SAMPLES: f64 = 2000.0;
/// An estimate looks at every so many of them. It then errs by about 1 %.
const ESTIMATE_STRIDE: usize = 3;
/// Least number of sample points on a piece, however small.
const MIN_SAMPLES: usize = 24;
/// Number of viewpoints across a mouth, along each of two directions.
const EYES_ACROSS: usize = 5;
/// Number of viewpoints across a mouth in the second, finer test. Only slivers, a few thousandths
/// of a wall, are visible from the additional viewpoints alone.
const FINE_EYES_ACROSS: usize = 16;
/// Hidden share of a piece above which the finer test is skipped, because it cannot pass.
const HIDDEN_RATIO: f64 = 0.15;
/// Share of a line of sight that is tested. The rest would hit the wall at its end.
const TESTED_LINE_RATIO: f64 = 0.999;

/// A viewpoint in the mouth of a cut.
struct Eye {
    cut: usize,
    at: Point,
}

/// The parameters of the line-of-sight test.
pub(crate) struct SightTest<'a> {
    tree: &'a CutTree,
    /// Radius of the least opening, mm. The tool gets no nearer to a rim than this.
    tool_radius_mm: f64,
    reach_mm: f64,
    /// Hidden share of a piece above which the finer test is skipped.
    max_hidden_ratio: f64,
    watch: &'a Watch,
}

impl<'a> SightTest<'a> {
    pub(crate) fn new(tree: &'a CutTree, request: &'a PlanRequest) -> Self {
        let reach_mm = request.cleaning.reach_mm.unwrap_or(f64::INFINITY);
        let tool_radius_mm = request.min_opening_mm / 2.0;
        Self {
            tree,
            tool_radius_mm,
            reach_mm,
            max_hidden_ratio: HIDDEN_RATIO,
            watch: &request.watch,
        }
    }

    /// Returns the same test, but with the finer viewpoints for every piece. It is slower, and
    /// meant for the numbers reported with a plan.
    pub(crate) fn thorough(self) -> Self {
        Self {
            max_hidden_ratio: 1.0,
            ..self
        }
    }

    /// Returns the viewpoints in these mouths, each given with the index of its cut. In every mouth
    /// that admits the tool, they are the places with room for it. If no mouth admits the tool, the
    /// only viewpoint is the middle of the widest mouth.
    fn eyes(&self, mouths: &[(usize, &Outline)], count: usize) -> Vec<Eye> {
        let discs = mouths
            .iter()
            .filter_map(|mouth| Some((mouth, mouth.1.largest_disc(0.0)?)));
        let mut discs: Vec<_> = discs.collect();
        discs.sort_by(|a, b| b.1.radius_mm.total_cmp(&a.1.radius_mm));
        let middles = discs
            .iter()
            .map(|(mouth, disc)| self.eye(mouth.0, &disc.center));
        let is_wide = |radius_mm: f64| radius_mm >= self.tool_radius_mm;
        let wide = discs
            .iter()
            .filter(|(_, disc)| is_wide(disc.radius_mm))
            .count();
        let mut eyes: Vec<Eye> = middles.take(wide.max(1)).collect();
        for ((cut, outline), _) in &discs[..wide] {
            let places = grid_over(outline, count)
                .into_iter()
                .filter(|at| is_wide(outline.signed_distance(at)));
            eyes.extend(places.map(|at| self.eye(*cut, &at)));
        }
        eyes
    }

    fn eye(&self, cut: usize, at: &Point2) -> Eye {
        let plane = &self.tree.planes[cut];
        Eye {
            cut,
            at: Chart::of_plane(plane).lift(plane, at),
        }
    }

    /// Returns true if the eye's cut exists where the eye is, and no other cut lies between eye and
    /// point.
    fn is_before(&self, eye: &Eye, at: &Point) -> bool {
        let separates = |cut: usize| {
            let [from, to] = [&eye.at, at].map(|p| self.tree.planes[cut].distance(p));
            let crossing = eye.at + (at - eye.at) * (from / (from - to));
            (from > 0.0) != (to > 0.0) && self.tree.acts_at(cut, &crossing)
        };
        let others = (0..self.tree.planes.len()).filter(|&cut| cut != eye.cut);
        self.tree.acts_at(eye.cut, &eye.at) && !others.into_iter().any(separates)
    }
}

/// Returns a grid of places over the bounding box of a mouth, `count` along each direction.
fn grid_over(mouth: &Outline, count: usize) -> Vec<Point2> {
    let Some((min, max)) = mouth.bounds() else {
        return Vec::new();
    };
    let step = (max - min) / count as f64;
    let at = |i: usize| {
        let (column, row) = ((i % count) as f64, (i / count) as f64);
        min + nalgebra::Vector2::new(step.x * (column + 0.5), step.y * (row + 0.5))
    };
    (0..count * count).map(at).collect()
}

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
    bvh: Bvh,
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
            bvh: Bvh::new(wall),
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
        let eyes_seeing = |at: &Point, eyes: &[Eye]| -> Vec<Point> {
            eyes.iter()
                .filter(|eye| self.sees(eye, at, sight))
                .map(|eye| eye.at)
                .collect()
        };
        let lines = |at: &Point| {
            sight.watch.check()?;
            let eyes = eyes_seeing(at, &few);
            let eyes = if eyes.is_empty() {
                eyes_seeing(at, &many)
            } else {
                eyes
            };
            Ok(Sightlines { at: *at, eyes })
        };
        self.points.par_iter().map(lines).collect()
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
        let test = |at: Point| {
            sight.watch.check()?;
            let is_hidden = !eyes.iter().any(|eye| self.sees(eye, &at, sight));
            Ok((at, is_hidden))
        };
        let tested = points.into_par_iter().map(test);
        let tested = tested.collect::<Result<Vec<(Point, bool)>, Cancelled>>()?;
        let (hidden, visible): (Vec<_>, Vec<_>) =
            tested.into_iter().partition(|(_, is_hidden)| *is_hidden);
        let points = |tested: Vec<(Point, bool)>| tested.into_iter().map(|(at, _)| at).collect();
        Ok((points(hidden), points(visible)))
    }

    /// Returns true if a point is in sight of an eye and within reach.
    fn sees(&self, eye: &Eye, at: &Point, sight: &SightTest) -> bool {
        let line = at - eye.at;
        line.norm() <= sight.reach_mm
            && sight.is_before(eye, at)
            && !self
                .bvh
                .crosses_segment(&eye.at, &(eye.at + line * TESTED_LINE_RATIO))
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
        cut::{pieces::split::split, scenes::request},
        geom::{Plane, Vector},
        mesh::{Csg, primitives},
    };

    fn seen_within(void: &Solid, planes: &[Plane], reach_mm: f64) -> f64 {
        let walls = Walls::of(void);
        let tree = CutTree::everywhere(planes);
        let request = request();
        let sight = SightTest {
            reach_mm,
            ..SightTest::new(&tree, &request)
        };
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
