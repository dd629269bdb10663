//! Viewpoints in the mouths of voids, and what they see of the walls.

use crate::{
    base::watch::Watch,
    cut::{
        geometry::{
            chart::{Chart, Point2},
            outline::Outline,
            tree::CutTree,
        },
        request::PlanRequest,
    },
    geom::{Bvh, NO_HINT, Point},
};

/// Hidden share of a piece above which the finer test is skipped, because it cannot pass.
const HIDDEN_RATIO: f64 = 0.15;
/// Number of viewpoints along the rim of a mouth for each one across it. In a long, narrow mouth
/// few places of a grid have room for the tool.
const ALONG_RATIO: usize = 4;
/// Excess of their distance from the rim, so that rounding drops none of them.
const ROOM_SLACK_RATIO: f64 = 1e-9;
/// Share of a line of sight that is tested. The rest would hit the wall at its end.
const TESTED_LINE_RATIO: f64 = 0.999;

/// A viewpoint in the mouth of a cut.
pub(super) struct Eye {
    cut: usize,
    at: Point,
}

/// The parameters of the line-of-sight test.
pub(crate) struct SightTest<'a> {
    tree: &'a CutTree,
    /// Radius of the least opening, mm. The tool gets no nearer to a rim than this.
    tool_radius_mm: f64,
    pub(super) reach_mm: f64,
    /// Hidden share of a piece above which the finer test is skipped.
    pub(super) max_hidden_ratio: f64,
    /// True if viewpoints follow the rims of the mouths, too.
    follows_rims: bool,
    pub(super) watch: &'a Watch,
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
            follows_rims: false,
            watch: &request.watch,
        }
    }

    /// Returns the same test, but with the finer viewpoints for every piece, and with some along
    /// the rims. It is slower, and meant for the numbers reported with a plan.
    pub(crate) fn thorough(self) -> Self {
        Self {
            max_hidden_ratio: 1.0,
            follows_rims: true,
            ..self
        }
    }

    /// Returns the viewpoints in these mouths, each given with the index of its cut. In every mouth
    /// that admits the tool, they are the places with room for it. If no mouth admits the tool, the
    /// only viewpoint is the middle of the widest mouth.
    pub(super) fn eyes(&self, mouths: &[(usize, &Outline)], count: usize) -> Vec<Eye> {
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
            let mut places = grid_over(outline, count);
            if self.follows_rims {
                places.extend(self.beside_rim(outline, ALONG_RATIO * count));
            }
            let places = places
                .into_iter()
                .filter(|at| is_wide(outline.signed_distance(at)));
            eyes.extend(places.map(|at| self.eye(*cut, &at)));
        }
        eyes
    }

    /// Returns places as far from the rim of a mouth as the tool needs, evenly along it, on either
    /// side.
    fn beside_rim(&self, mouth: &Outline, count: usize) -> Vec<Point2> {
        let room_mm = self.tool_radius_mm * (1.0 + ROOM_SLACK_RATIO);
        let beside = |[foot, along]: [Point2; 2]| {
            let way = along - foot;
            let normal = nalgebra::Vector2::new(-way.y, way.x) * room_mm;
            [foot + normal, foot - normal]
        };
        mouth.walk(count).into_iter().flat_map(beside).collect()
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

/// Viewpoints that look at one point after another. What hid a point, or which eye saw it, mostly
/// holds for the next point too.
pub(super) struct Lookout<'a> {
    bvh: &'a Bvh,
    eyes: &'a [Eye],
    sight: &'a SightTest<'a>,
    /// For each eye, the triangle that hid the last point from it.
    blockers: Vec<u32>,
    /// The eye that saw the last point.
    last: usize,
}

impl<'a> Lookout<'a> {
    pub(super) fn new(bvh: &'a Bvh, eyes: &'a [Eye], sight: &'a SightTest<'a>) -> Self {
        Self {
            bvh,
            eyes,
            sight,
            blockers: vec![NO_HINT; eyes.len()],
            last: 0,
        }
    }

    /// Returns true if any eye sees a point.
    pub(super) fn sees(&mut self, at: &Point) -> bool {
        let last = self.last;
        let others = (0..self.eyes.len()).filter(|&eye| eye != last);
        let first = (last < self.eyes.len()).then_some(last);
        let seeing = first
            .into_iter()
            .chain(others)
            .find(|&eye| self.is_in_sight(eye, at));
        self.last = seeing.unwrap_or(last);
        seeing.is_some()
    }

    /// Returns the places of all eyes that see a point.
    pub(super) fn eyes_seeing(&mut self, at: &Point) -> Vec<Point> {
        let eyes = self.eyes;
        let seeing = (0..eyes.len()).filter(|&eye| self.is_in_sight(eye, at));
        seeing.map(|eye| eyes[eye].at).collect()
    }

    /// Returns true if a point is in sight of an eye and within reach.
    fn is_in_sight(&mut self, eye: usize, at: &Point) -> bool {
        let (blocker, eye) = (&mut self.blockers[eye], &self.eyes[eye]);
        let line = at - eye.at;
        if line.norm() > self.sight.reach_mm || !self.sight.is_before(eye, at) {
            return false;
        }
        let end = eye.at + line * TESTED_LINE_RATIO;
        let crossed = self.bvh.find_crossed(&eye.at, &end, *blocker);
        *blocker = crossed.unwrap_or(*blocker);
        crossed.is_none()
    }
}
