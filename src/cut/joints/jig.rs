//! Jigs: printed cradles that hold the parts of a joint while its glue sets.
//!
//! A jig has a rib under the outside of either part, on both sides of the seam, and a plate that
//! joins the ribs. The outline of a rib is all that is left of its slab when the body is lifted
//! out. So the jig pulls off in one movement, whatever the body, and prints without support. Both
//! parts are pressed down into it, and the same gap on both sides lets them meet.

use rayon::prelude::*;

use super::cradle::{Slab, View, body_under};
use super::sketch::Sketch;
use crate::{
    base::watch::Watch,
    cut::{
        error::CutError,
        geometry::chart::{Chart, Point2},
        hollowed::Hollowed,
        ids::PartId,
        pieces::{
            part::pieces,
            split::{Joint, joints},
        },
        plan::{CutPlan, JointNote},
        request::PlanRequest,
    },
    geom::{
        Plane, Point, Vector,
        play::{Play, Seat, Spot, Stop, Way, corners_of},
    },
    mesh::{ClipError, Csg, Solid, TriMesh},
};

/// Room on either side of a seam, for a finger with a cloth to wipe off glue, mm.
pub const WIPING_ROOM_MM: f64 = 4.0;

/// Distances of the ribs' faces from the joint, mm: the ribs do not bend.
const RIBS_MM: [f64; 2] = [WIPING_ROOM_MM, WIPING_ROOM_MM + 4.0];

/// More ribs, for joints that the usual ones do not hold: thicker ones, and ones farther away. Long
/// ones stop the turn of a round arm that leaves its joint at a slant.
const EXTRA_RIBS_MM: [[f64; 2]; 4] = [
    RIBS_MM,
    [WIPING_ROOM_MM, WIPING_ROOM_MM + 6.0],
    [2.0 * WIPING_ROOM_MM, 2.0 * WIPING_ROOM_MM + 6.0],
    [WIPING_ROOM_MM, WIPING_ROOM_MM + 12.0],
];

/// Width of a rib beside the body, mm.
const CHEEK_MM: f64 = 4.0;

/// Thickness of the plate that joins the ribs, mm.
const PLATE_MM: f64 = 3.0;

/// Depth to which a part is pressed into its cradle, but for this, mm: what dust and friction keep.
pub const PRESSED_MM: f64 = 0.03;

/// Directions in a joint's plane that are tried as the way out.
const WAYS_OUT: usize = 36;

/// Heights of the cradle's cheeks, as shares of the joint's height along the way out.
const CHEEKS: &[f64] = &[0.5, 0.75];

/// More heights, for joints that the usual ones do not hold.
const EXTRA_CHEEKS: &[f64] = &[0.3, 0.45, 0.6, 0.75, 0.9];

/// Number of the best ways out about which jigs for such joints are sought.
const BEST_WAYS: usize = 4;

/// Ways out between two others, about the best ones.
const WAYS_BETWEEN: [f64; 3] = [-0.5, 0.0, 0.5];

/// Step of the best usual jig, as a ratio to the accepted one, beyond which there is no hope.
const HOPE_RATIO: f64 = 2.5;

/// Slopes of a cradle below which its floor is lowered, so that the body stands on its cheeks.
const RELIEFS: [f64; 4] = [0.0, 0.35, 0.7, 1.2];

/// Distance within which a corner of the body counts as stopped by the cradle, mm.
const REACH_MM: f64 = 1.0;

/// Share of the accepted step that is kept in reserve: a judge measures the cradle by other points.
const RESERVE_RATIO: f64 = 0.1;

/// Share of the accepted step below which a smaller jig is better than a tighter one.
const TIGHT_RATIO: f64 = 0.6;

/// A jig for a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Jig {
    /// The index of the joint in the plan.
    pub joint: usize,
    /// The ids of the parts that it holds.
    pub parts: [PartId; 2],
    /// The jig in its place at the model, mm.
    pub solid: Solid,
    /// The unit direction in which the body comes out of it, model frame.
    pub out: [f64; 3],
    /// A point of the joint's plane, model frame, mm.
    pub point_mm: [f64; 3],
    /// The unit normal of that plane.
    pub normal: [f64; 3],
    /// The gap between the jig and the body, mm.
    pub gap_mm: f64,
    /// The distances of the ribs' faces from the plane on either side, mm.
    pub ribs_mm: [f64; 2],
    /// The rigid motion from the model frame to the print frame, as rows of a 4×4 matrix.
    pub print_from_model: [[f64; 4]; 4],
    /// The play of the parts in it.
    pub play: Play,
}

/// Makes a jig for every joint of a plan that nothing else aligns, as far as the shape of the
/// outside allows it.
pub fn jigs(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Vec<Jig>, CutError> {
    if plan.joints.iter().all(JointNote::is_aligned) {
        return Ok(Vec::new());
    }
    let tree = plan.tree()?;
    let pieces = pieces(hollowed, plan, &tree, &request.watch)?;
    let mut made = Vec::new();
    for joint in joints(&pieces, &tree) {
        let (cut, parts) = (&plan.cuts[joint.cut].id, joint.parts());
        let is_own = |note: &JointNote| note.cut == *cut && note.parts == parts;
        let index = plan.joints.iter().position(is_own);
        let index = index.filter(|&index| !plan.joints[index].is_aligned());
        if let Some(index) = index {
            let bench = Bench::new(
                hollowed.outer.mesh(),
                &tree.planes[joint.cut],
                &joint,
                request,
            );
            let sketch = bench.best(&request.watch)?;
            let jig = sketch.map(|sketch| bench.build(&sketch, index, parts));
            made.extend(jig.transpose()?);
        }
    }
    Ok(made)
}

/// A joint for which jigs are tried.
struct Bench<'a> {
    /// The triangles of the outside that the ribs may touch.
    outside: Vec<[Point; 3]>,
    plane: &'a Plane,
    /// The corners of the joint's rim.
    rim: Vec<Point>,
    request: &'a PlanRequest,
}

impl<'a> Bench<'a> {
    fn new(outside: &TriMesh, plane: &'a Plane, joint: &Joint, request: &'a PlanRequest) -> Self {
        let chart = Chart::of_plane(plane);
        let rim: Vec<Point2> =
            corners_of(joint.faces.iter().flat_map(|face| face.outline.corners()));
        let [.., [_, farthest_mm]] = EXTRA_RIBS_MM;
        let reach_mm = farthest_mm + request.pins.snug_gap_mm;
        let is_near = |corners: &[Point; 3]| {
            let heights = corners.each_ref().map(|p| plane.distance(p));
            let [low, high] = range(heights.into_iter());
            low <= reach_mm && high >= -reach_mm
        };
        Self {
            outside: outside.iter_corners().filter(is_near).collect(),
            plane,
            rim: rim.iter().map(|corner| chart.lift(plane, corner)).collect(),
            request,
        }
    }

    /// Returns the smallest jig that holds the parts tightly, else the tightest that holds them as
    /// well as is asked for; `None` if none does.
    fn best(&self, watch: &Watch) -> Result<Option<Sketch>, CutError> {
        let ways: Vec<f64> = (0..WAYS_OUT).map(|way| way as f64).collect();
        let usual = self.sketches_along(&ways, &[RIBS_MM], CHEEKS, watch)?;
        let mut tightest: Vec<(f64, f64)> = (ways.iter().zip(&usual))
            .filter_map(|(way, found)| Some((least_step_mm(found)?, *way)))
            .filter(|(step_mm, _)| *step_mm <= HOPE_RATIO * self.max_step_mm())
            .collect();
        let usual = self.choose(usual);
        if usual.is_some() {
            return Ok(usual);
        }
        tightest.sort_by(|a, b| a.0.total_cmp(&b.0));
        let best = tightest.iter().take(BEST_WAYS);
        let ways: Vec<f64> = best
            .flat_map(|(_, way)| WAYS_BETWEEN.map(|between| way + between))
            .collect();
        let extra = self.sketches_along(&ways, &EXTRA_RIBS_MM, EXTRA_CHEEKS, watch)?;
        Ok(self.choose(extra))
    }

    /// Returns the step that a jig may leave, mm.
    fn max_step_mm(&self) -> f64 {
        self.request.pins.max_step_mm.unwrap_or(f64::INFINITY) * (1.0 - RESERVE_RATIO)
    }

    /// Returns jigs with each of some ways out, in their order: the choice is then the same on any
    /// number of threads.
    fn sketches_along(
        &self,
        ways: &[f64],
        ribs: &[[f64; 2]],
        cheeks: &[f64],
        watch: &Watch,
    ) -> Result<Vec<Vec<Sketch>>, CutError> {
        let (u, v) = self.plane.basis();
        let along = |way: &f64| {
            let (sin, cos) = (std::f64::consts::TAU * way / WAYS_OUT as f64).sin_cos();
            let view = View::new(self.plane, u * cos + v * sin);
            let mut found = Vec::new();
            for faces_mm in ribs {
                watch.check()?;
                found.extend(self.sketches(view, *faces_mm, cheeks));
            }
            Ok(found)
        };
        ways.par_iter().map(along).collect()
    }

    /// Returns the best of some jigs that hold the parts.
    fn choose(&self, sketches: Vec<Vec<Sketch>>) -> Option<Sketch> {
        let max_step_mm = self.max_step_mm();
        let mut best: Option<Sketch> = None;
        for sketch in sketches.into_iter().flatten() {
            let is_held = sketch.play.step_mm <= max_step_mm;
            let is_better = |best: &Sketch| sketch.is_better(best, TIGHT_RATIO * max_step_mm);
            if is_held && best.as_ref().is_none_or(is_better) {
                best = Some(sketch);
            }
        }
        best
    }

    /// Returns jigs with one way out, and ribs between two distances from the joint, that hold both
    /// parts and fit the printer.
    fn sketches(&self, view: View, [near, far]: [f64; 2], cheeks: &[f64]) -> Vec<Sketch> {
        let gap_mm = self.request.pins.snug_gap_mm;
        let rim: Vec<Spot> = self.rim.iter().map(|p| flat(&view.local(p))).collect();
        let across = range(rim.iter().map(|spot| spot.x));
        let [low, high] = range(rim.iter().map(|spot| spot.y));
        let beside_mm = gap_mm + CHEEK_MM;
        let window = [across[0] - beside_mm, across[1] + beside_mm];
        let local = |corners: &[Point; 3]| corners.each_ref().map(|p| view.local(p));
        let surface: Vec<[Point; 3]> = self.outside.iter().map(local).collect();
        // What is beyond a rib's face is no nearer to it than the gap.
        let slabs = [
            [-far - gap_mm, gap_mm - near],
            [near - gap_mm, far + gap_mm],
        ]
        .map(|heights| Slab::of(&surface, heights));
        let held = [[-far, -near], [near, far]].map(|heights| Slab::of(&surface, heights));
        let under_seam_mm = Slab::of(&surface, [-near, near]).lowest_mm(window);
        let cradles = slabs.each_ref().map(|slab| slab.cradle(window, gap_mm));
        let sketch = |(share, slope): (f64, f64)| {
            let top_mm = low + share * (high - low);
            let ribs = cradles
                .each_ref()
                .map(|cradle| cradle.outline(top_mm, slope));
            let press = Stop {
                at: Spot::new(0.5 * (across[0] + across[1]), high),
                normal: Way::new(0.0, -1.0),
                room_mm: PRESSED_MM,
            };
            let middle = Spot::new(press.at.x, 0.5 * (low + high));
            let seat = |side: usize| {
                let stops = held[side].stops(&ribs[side], REACH_MM);
                Seat::pressed(&stops, &press, middle)
            };
            let play = seat(0)?.play_between(&seat(1)?, middle, &rim);
            let deepest = ribs.iter().flatten().map(|corner| corner.y);
            let top = deepest.fold(under_seam_mm - WIPING_ROOM_MM, f64::min);
            let sketch = Sketch {
                view,
                ribs_mm: [near, far],
                plate: [top - PLATE_MM, top],
                ribs,
                play,
            };
            self.fits(&sketch).then_some(sketch)
        };
        let kinds = cheeks
            .iter()
            .flat_map(|share| RELIEFS.map(|slope| (*share, slope)));
        kinds.filter_map(sketch).collect()
    }

    /// Returns true if a jig fits the printer, lying or turned by a right angle.
    fn fits(&self, sketch: &Sketch) -> bool {
        let corners = || sketch.ribs.iter().flatten();
        let [low, high] = range(corners().map(|corner| corner.x));
        let [_, top] = range(corners().map(|corner| corner.y));
        let size = [high - low, 2.0 * sketch.ribs_mm[1], top - sketch.plate[0]];
        let Some(room) = self.request.build_volume_mm else {
            return true;
        };
        let holds = |x: f64, y: f64| size[0] <= x && size[1] <= y;
        size[2] <= room[2] && (holds(room[0], room[1]) || holds(room[1], room[0]))
    }

    /// Builds a jig.
    fn build(&self, sketch: &Sketch, joint: usize, parts: [PartId; 2]) -> Result<Jig, CutError> {
        let [near, far] = sketch.ribs_mm;
        let [low, top] = sketch.plate;
        let body = |outline: &[Spot], heights: [f64; 2]| {
            let mesh = body_under(outline, low, heights).map_err(ClipError::from)?;
            Csg::of_mesh(&mesh)
        };
        let [below, above] = &sketch.ribs;
        let ends = [below[0], below[below.len() - 1]].map(|corner| Spot::new(corner.x, top));
        let inside = 0.5 * (near + far);
        let plate = body(&ends, [-inside, inside])?;
        let whole = plate
            .union(&body(below, [-far, -near])?)?
            .union(&body(above, [near, far])?)?
            .to_mesh()?;
        let view = &sketch.view;
        let solid = Solid::new(whole.map_vertices(|p| view.model(p))).map_err(ClipError::from)?;
        Ok(Jig {
            joint,
            parts,
            print_from_model: self.pose(view, &solid),
            solid,
            out: view.out.into(),
            point_mm: self.plane.foot().into(),
            normal: self.plane.normal.into(),
            gap_mm: self.request.pins.snug_gap_mm,
            ribs_mm: [near, far],
            play: sketch.play,
        })
    }

    /// Returns the pose on its plate: the way out is up. Long ones lie along the longer side of the
    /// printer.
    fn pose(&self, view: &View, solid: &Solid) -> [[f64; 4]; 4] {
        let is_turned = self.request.build_volume_mm.is_some_and(|[x, y, _]| x < y);
        let axes = if is_turned {
            [-view.normal, view.across, view.out]
        } else {
            [view.across, view.normal, view.out]
        };
        let row = |axis: &Vector| {
            let heights = solid.mesh().vertices().iter().map(|p| axis.dot(&p.coords));
            let [low, _] = range(heights);
            [axis.x, axis.y, axis.z, -low]
        };
        let [x, y, z] = axes.each_ref().map(row);
        [x, y, z, [0.0, 0.0, 0.0, 1.0]]
    }
}

/// Returns the least step of some jigs, mm.
fn least_step_mm(sketches: &[Sketch]) -> Option<f64> {
    let steps = sketches.iter().map(|sketch| sketch.play.step_mm);
    steps.min_by(f64::total_cmp)
}

fn flat(p: &Point) -> Spot {
    Spot::new(p.x, p.z)
}

/// Returns the least and the greatest of some values.
fn range(values: impl Iterator<Item = f64>) -> [f64; 2] {
    values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            Cut,
            scenes::{cuboid, plan_by, request},
            tests::cuts,
        },
        geom::Bvh,
        mesh::primitives::cylinder,
    };

    /// Plans one level cut through the middle of a thin shell without room for pins.
    fn cut_across(body: &Hollowed, height_mm: f64) -> CutPlan {
        let across = Cut {
            id: "C1".into(),
            point_mm: [0.0, 0.0, height_mm],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        let plan = plan_by(body, &request(), &cuts(vec![across])).unwrap();
        assert!(plan.pins.is_empty() && !plan.joints[0].is_aligned());
        plan
    }

    /// A thin box tube that stands on a wider foot and carries a wider head: both would catch a jig
    /// that reached around them.
    fn tube() -> Hollowed {
        let outer = Csg::of_solid(&cuboid([0.0; 3], [30.0, 20.0, 60.0])).unwrap();
        let foot = cuboid([-5.0, -5.0, -4.0], [35.0, 25.0, 16.0]);
        let outer = outer.union(&Csg::of_solid(&foot).unwrap()).unwrap();
        let void = cuboid([1.5, 1.5, 2.0], [28.5, 18.5, 58.0]);
        Hollowed::new(outer.to_solid().unwrap(), vec![void])
    }

    #[test]
    fn a_jig_holds_both_parts_keeps_its_gap_and_comes_off() {
        let body = tube();
        // The lower rib reaches from 22 down to 18 mm: the foot begins 2 mm below it.
        let plan = cut_across(&body, 26.0);
        let found = jigs(&body, &plan, &request()).unwrap();
        let [jig] = &found[..] else {
            panic!("{} jigs", found.len())
        };
        let accepted_mm = request().pins.max_step_mm.unwrap();
        assert!(jig.play.step_mm <= accepted_mm, "{:?}", jig.play);
        let outside = Bvh::new(body.outer.mesh().iter_corners());
        let way = Vector::from(jig.out) * 200.0;
        for p in jig.solid.mesh().vertices() {
            assert!(!outside.crosses_segment(p, &(p - way)), "{p} is caught");
        }
        let corners = jig.solid.mesh().iter_corners();
        let gaps = corners.map(|corners| outside.triangle_distance(&corners, 5.0));
        let gap_mm = gaps.fold(5.0, f64::min);
        // The outline's steps and its thinning add to the gap, and never take from it.
        let most = jig.gap_mm + 0.06;
        assert!((jig.gap_mm..most).contains(&gap_mm), "{gap_mm}");
        // A part's own side is up on its plate, and nothing is below it.
        let [.., z, _] = jig.print_from_model;
        let height = |p: &Point| z[0] * p.x + z[1] * p.y + z[2] * p.z + z[3];
        let heights = jig.solid.mesh().vertices().iter().map(height);
        assert!(heights.fold(f64::INFINITY, f64::min).abs() < 1e-9);
    }

    #[test]
    fn a_tube_without_corners_has_no_jig_since_it_turns_in_any() {
        let shell = |radius_mm: f64, height_mm: f64| cylinder(radius_mm, height_mm, 256);
        let outer = Solid::new(shell(20.0, 60.0)).unwrap();
        let void = shell(18.5, 56.0).map_vertices(|p| p + Vector::z() * 2.0);
        let body = Hollowed::new(outer, vec![Solid::new(void).unwrap()]);
        let plan = cut_across(&body, 30.01);
        assert_eq!(jigs(&body, &plan, &request()).unwrap(), vec![]);
    }
}
