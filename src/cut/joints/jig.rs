//! Jigs: printed cradles that hold the parts of a joint while its glue sets.
//!
//! A jig has a rib under the outside of either part, on both sides of the seam, and a plate that
//! joins the ribs. The outline of a rib is all that is left of its slab when the body is lifted
//! out. So the jig pulls off in one movement, whatever the body, and prints without support. Both
//! parts are pressed down into it, and the same gap on both sides lets them meet.

use super::bench::Bench;
use super::cradle::{View, body_under};
use super::sketch::{Held, range};
use crate::{
    cut::{
        error::CutError,
        hollowed::Hollowed,
        ids::PartId,
        pieces::{part::pieces, split::joints},
        plan::{CutPlan, JointNote},
        request::PlanRequest,
    },
    geom::{
        Vector,
        play::{Play, Spot},
    },
    mesh::{ClipError, Csg, Solid, shells},
};

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
    let bodies = shells(hollowed.outer.mesh());
    let mut made = Vec::new();
    for joint in joints(&pieces, &tree) {
        let (cut, parts) = (&plan.cuts[joint.cut].id, joint.parts());
        let is_own = |note: &JointNote| note.cut == *cut && note.parts == parts;
        let index = plan.joints.iter().position(is_own);
        let index = index.filter(|&index| !plan.joints[index].is_aligned());
        if let Some(index) = index {
            let bench = Bench::new(&bodies, &tree.planes[joint.cut], &joint, request);
            let held = bench.best()?;
            let jig = held.map(|held| bench.build(&held, index, parts));
            made.extend(jig.transpose()?);
        }
    }
    Ok(made)
}

impl Bench<'_> {
    /// Builds a jig.
    fn build(&self, held: &Held, joint: usize, parts: [PartId; 2]) -> Result<Jig, CutError> {
        let Held { sketch, play } = held;
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
            play: *play,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            Cut,
            scenes::{cuboid, plan_by, request},
            tests::cuts,
        },
        geom::{Bvh, Point},
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
    fn a_separate_body_beside_the_joint_changes_no_jig() {
        let alone = tube();
        // As near as the other half of a yo-yo: 3 mm beside the upper rib, where a cheek stands.
        let beside = Csg::of_solid(&cuboid([33.0, 0.0, 27.0], [45.0, 20.0, 60.0])).unwrap();
        let outer = Csg::of_solid(&alone.outer).unwrap().union(&beside).unwrap();
        let voids = alone.voids.iter().map(|void| void.body.clone());
        let both = Hollowed::new(outer.to_solid().unwrap(), voids.collect());
        let [jigs_alone, jigs_beside] = [&alone, &both].map(|body| {
            let plan = cut_across(body, 26.0);
            jigs(body, &plan, &request()).unwrap()
        });
        let ([alone], [beside]) = (&jigs_alone[..], &jigs_beside[..]) else {
            panic!("{} and {} jigs", jigs_alone.len(), jigs_beside.len())
        };
        assert_eq!(alone.play, beside.play);
        assert!(alone.solid == beside.solid, "another shape");
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
