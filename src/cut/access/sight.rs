//! How much of a void's wall is in sight of its openings.

use rayon::prelude::*;

use crate::{
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

/// Points of a void's wall that are looked at: a share of 5 % is then known to half a per cent.
const SAMPLES: f64 = 2000.0;
/// Of a small piece at least so many points are looked at.
const LEAST_SAMPLES: usize = 24;
/// Places across a mouth, along each of two directions, that are looked from.
const EYES_ACROSS: usize = 5;
/// So many where little is hidden from those: what is seen only from between them is slivers, a few
/// thousandths of a wall.
const CLOSER_EYES_ACROSS: usize = 16;
/// Where more than this share of a piece is hidden, no closer look will find it clean.
const HIDDEN_RATIO: f64 = 0.15;
/// The part of a line of sight that is looked along: the rest would meet the wall it ends on.
const LOOKED_RATIO: f64 = 0.999;

/// A place that is looked from, in a mouth of a cut.
struct Eye {
    cut: usize,
    at: Point,
}

/// How a void is looked into.
pub(crate) struct Look<'a> {
    tree: &'a CutTree,
    /// The radius of the least opening: nearer to a rim no tool enters.
    tool_radius_mm: f64,
    reach_mm: f64,
    /// Pieces of which more than this share is hidden from few places are not looked at from more.
    given_up_ratio: f64,
}

impl<'a> Look<'a> {
    pub(crate) fn new(tree: &'a CutTree, request: &PlanRequest) -> Self {
        let reach_mm = request.cleaning.reach_mm.unwrap_or(f64::INFINITY);
        let tool_radius_mm = request.min_opening_mm / 2.0;
        Self {
            tree,
            tool_radius_mm,
            reach_mm,
            given_up_ratio: HIDDEN_RATIO,
        }
    }

    /// The same, but from many places however much is hidden: slower, and right for what is told of
    /// a plan.
    pub(crate) fn thorough(self) -> Self {
        Self {
            given_up_ratio: 1.0,
            ..self
        }
    }

    /// The places that are looked from through mouths, each of a cut: of every mouth that lets the
    /// tool in those where it finds room; the middle of the widest mouth where none lets it in.
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
            let places = across(outline, count)
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

    /// Whether the eye's cut is made where it looks from, and no other is between it and a point.
    fn is_before(&self, eye: &Eye, at: &Point) -> bool {
        let parts = |cut: usize| {
            let [from, to] = [&eye.at, at].map(|p| self.tree.planes[cut].distance(p));
            let crossing = eye.at + (at - eye.at) * (from / (from - to));
            (from > 0.0) != (to > 0.0) && self.tree.acts_at(cut, &crossing)
        };
        let others = (0..self.tree.planes.len()).filter(|&cut| cut != eye.cut);
        self.tree.acts_at(eye.cut, &eye.at) && !others.into_iter().any(parts)
    }
}

/// Places spread over the box of a mouth, so many along each of two directions.
fn across(mouth: &Outline, count: usize) -> Vec<Point2> {
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

/// The wall of a piece of a void, and what is not seen of it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Seen {
    /// The area of the wall, mm².
    pub(crate) wall_mm2: f64,
    /// The area in sight and within reach, mm²; of a sample.
    pub(crate) seen_mm2: f64,
    /// The points of the sample that are not.
    pub(crate) hidden: Vec<Point>,
    /// The points of the sample that are.
    pub(crate) visible: Vec<Point>,
    /// The area that each of its points stands for, mm².
    pub(crate) share_mm2: f64,
}

/// A point of a wall, and the places in mouths that it is seen from.
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
    /// The sample for a glance at all of it.
    points: Vec<Point>,
    /// The area that a point of the sample stands for, mm².
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

    /// About the share of the wall that is in sight through these mouths, each of a cut, before the
    /// void is cut: what lies behind another plane is not.
    pub(crate) fn glimpsed(&self, mouths: &[(usize, Outline)], look: &Look) -> f64 {
        let mouths: Vec<(usize, &Outline)> = mouths
            .iter()
            .map(|(cut, outline)| (*cut, outline))
            .collect();
        let (_, visible) = self.looked_at(self.points.clone(), &mouths, look);
        visible.len() as f64 / self.points.len().max(1) as f64
    }

    /// Every point of the sample with the places in these mouths, each of a cut, that see it before
    /// the void is cut: from many places only where few do not.
    pub(crate) fn sightlines(&self, mouths: &[(usize, Outline)], look: &Look) -> Vec<Sightlines> {
        let mouths: Vec<(usize, &Outline)> = mouths
            .iter()
            .map(|(cut, outline)| (*cut, outline))
            .collect();
        let [few, many] = [EYES_ACROSS, CLOSER_EYES_ACROSS].map(|count| look.eyes(&mouths, count));
        let seeing = |at: &Point, eyes: &[Eye]| -> Vec<Point> {
            eyes.iter()
                .filter(|eye| self.sees(eye, at, look))
                .map(|eye| eye.at)
                .collect()
        };
        let lines = |at: &Point| {
            let eyes = seeing(at, &few);
            let eyes = if eyes.is_empty() {
                seeing(at, &many)
            } else {
                eyes
            };
            Sightlines { at: *at, eyes }
        };
        self.points.par_iter().map(lines).collect()
    }

    /// The area of the wall, mm².
    pub(crate) fn area_mm2(&self) -> f64 {
        SAMPLES * self.share_mm2
    }

    /// What is in sight of the piece's own mouths and within reach; nothing if the piece has none.
    pub(crate) fn seen(&self, piece: &Piece, look: &Look) -> Seen {
        let wall = wall(piece);
        let wall_mm2: f64 = wall.iter().map(area_mm2).sum();
        let count = (wall_mm2 / self.share_mm2).ceil() as usize;
        let points = spread_points(&wall, count.max(LEAST_SAMPLES));
        let points: Vec<Point> = points.into_iter().map(|point| point.at).collect();
        let share_mm2 = wall_mm2 / points.len().max(1) as f64;
        let mouths: Vec<(usize, &Outline)> = piece
            .caps
            .iter()
            .map(|cap| (cap.cut, &cap.outline))
            .collect();
        let (hidden, visible) = self.looked_at(points, &mouths, look);
        Seen {
            wall_mm2,
            seen_mm2: share_mm2 * visible.len() as f64,
            hidden,
            visible,
            share_mm2,
        }
    }

    /// The points that are hidden and those that are not: from few places first, and from many
    /// where little is hidden.
    fn looked_at(
        &self,
        points: Vec<Point>,
        mouths: &[(usize, &Outline)],
        look: &Look,
    ) -> (Vec<Point>, Vec<Point>) {
        let total = points.len() as f64;
        let (hidden, mut visible) = self.parted(points, &look.eyes(mouths, EYES_ACROSS), look);
        if hidden.len() as f64 > look.given_up_ratio * total {
            return (hidden, visible);
        }
        let (hidden, more) = self.parted(hidden, &look.eyes(mouths, CLOSER_EYES_ACROSS), look);
        visible.extend(more);
        (hidden, visible)
    }

    /// The points that are hidden from all eyes or out of reach of those that see them, and the
    /// others.
    fn parted(&self, points: Vec<Point>, eyes: &[Eye], look: &Look) -> (Vec<Point>, Vec<Point>) {
        points
            .into_par_iter()
            .partition(|at| !eyes.iter().any(|eye| self.sees(eye, at, look)))
    }

    /// Whether a point is in sight of an eye and within reach.
    fn sees(&self, eye: &Eye, at: &Point, look: &Look) -> bool {
        let line = at - eye.at;
        line.norm() <= look.reach_mm
            && look.is_before(eye, at)
            && !self
                .bvh
                .is_crossed_by(&eye.at, &(eye.at + line * LOOKED_RATIO))
    }
}

/// The triangles of a piece but for its mouths.
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

impl Seen {
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

    /// The share that is seen; 0 of nothing.
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
        let look = Look {
            reach_mm,
            ..Look::new(&tree, &request())
        };
        let pieces = split(void.mesh(), &tree).unwrap();
        pieces
            .iter()
            .map(|piece| walls.seen(piece, &look))
            .fold(Seen::default(), Seen::and)
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

    /// A shaft of 4 × 4 mm from z = 2 down to −20 with an arm of 20 mm at its foot.
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
        // A line from the mouth slips in under the corner at most 16/4 times as steep as deep: it
        // meets the arm's floor 1 mm beyond the shaft. Of 32·20 + 2·16 (shaft and its foot) + 16·16
        // (arm) mm² all of the arm but that is hidden.
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
        // A straight shaft of 40 mm cut off near its top: of 4·6·38 + 36 mm² of wall below the cut
        // a tool of 20 mm reaches half; the 2 mm above the cut are all seen.
        let shaft = primitives::cuboid(&Point::new(-3.0, -3.0, -38.0), &Point::new(3.0, 3.0, 2.0));
        let shaft = Solid::new(shaft).unwrap();
        assert_eq!(seen_ratio(&shaft, &[level(0.0)]), 1.0);
        let ratio = seen_within(&shaft, &[level(0.0)], 20.0);
        let expected = (24.0 * 20.0 + 24.0 * 2.0 + 36.0) / (24.0 * 40.0 + 72.0);
        assert!((ratio - expected).abs() < 0.02, "{ratio} {expected}");
    }
}
