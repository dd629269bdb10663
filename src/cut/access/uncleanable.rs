//! The parts of voids that are better kept solid, because a plan does not let them be cleaned.

use rayon::prelude::*;

use crate::{
    base::watch::Watch,
    cut::{
        access::{
            chamber::Chamber,
            sight::Visibility,
            void_access::{Mouths, Opened, VoidAccess, required_sight_ratio},
        },
        error::CutError,
        geometry::tree::CutTree,
        hollowed::{Hollowed, Void},
        ids::VoidId,
        pieces::{
            part::pieces_for_trial,
            split::{Joint, Piece, joints},
        },
        plan::{Cut, CutPlan, JointNote, SolidEnd, tree_of},
        remark::UncleanCause,
        request::PlanRequest,
    },
    geom::{Plane, Point, Vector},
    mesh::{Csg, TriMesh, bodies, union_find::UnionFind},
};

/// Hidden points belong to one patch if they are nearer than this many times their spacing.
const LINK_RATIO: f64 = 3.0;
/// The body kept solid starts at this quantile of a patch's hidden points. It grows in all
/// directions later, so it may start a little behind the first point.
const START_QUANTILE: f64 = 0.25;
/// Share of the allowed hidden area that is left hidden. The rest is a margin for changes when the
/// body is solved again.
const ALLOWED_HIDDEN_RATIO: f64 = 0.8;
/// Greatest number of hidden patches compared in a round, because each costs a cut of the void.
/// Smaller patches wait for the next round and hide next to nothing.
const COMPARED_ENDS: usize = 16;
/// If more than this share of a piece is to be kept solid, all of it is.
const WHOLE_RATIO: f64 = 0.5;
/// Distance within which two corners are the same, mm. Both pieces are cut from the same mesh and
/// keep its corners up to rounding.
const SAME_CORNER_MM: f64 = 1e-9;

/// A void that cannot be cleaned with this plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Unclean {
    /// The void.
    pub void: VoidId,
    /// The reason.
    pub cause: UncleanCause,
    /// The bodies inside it that should be kept solid.
    pub bodies: Vec<TriMesh>,
}

/// Returns the voids that cannot be cleaned with this plan, with the bodies to keep solid in each.
/// Seats for parts are left out. With `whole`, each such void is kept solid entirely.
pub fn find_unclean(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
    whole: bool,
) -> Result<Vec<Unclean>, CutError> {
    let tree = plan.tree()?;
    let is_empty = |void: VoidId| hollowed.voids[void.index()].holds.is_none();
    let unclean: Vec<_> = plan
        .voids
        .iter()
        .filter(|void| !void.is_clean && is_empty(void.void))
        .collect();
    let chambers = if unclean.is_empty() {
        Vec::new()
    } else {
        Chamber::all(hollowed, &request.watch)?
    };
    let of = |access: &&VoidAccess| {
        let opened = Opened::new(&chambers, access.void, &tree, request);
        let (void, needed_mm, required) =
            (opened.void, opened.needed_mm, required_sight_ratio(request));
        let solid = if whole {
            vec![opened.chamber.void.mesh().clone()]
        } else {
            bodies_to_keep_solid(&opened)?
        };
        let cause = if access.sight_ratio < required {
            UncleanCause::Hidden {
                sight_ratio: access.sight_ratio,
                asked_ratio: required,
            }
        } else {
            UncleanCause::Narrow {
                opening_mm: access.opening_mm,
                least_opening_mm: needed_mm,
            }
        };
        Ok(Unclean {
            void,
            cause,
            bodies: solid,
        })
    };
    unclean.par_iter().map(of).collect()
}

/// Returns the voids that no cut meets, each to be kept solid entirely. Seats for parts are left
/// out.
pub fn find_closed(hollowed: &Hollowed, cuts: &[Cut]) -> Result<Vec<Unclean>, CutError> {
    let tree = tree_of(cuts)?;
    let voids = hollowed.voids.iter().enumerate();
    let voids = voids.map(|(index, void)| (VoidId::of(index), void));
    let empty = voids.filter(|(_, void)| void.holds.is_none());
    let is_met = |body: &TriMesh, cut: usize| {
        let there: Vec<Point> = body
            .vertices()
            .iter()
            .filter(|p| tree.acts_at(cut, p))
            .copied()
            .collect();
        tree.planes[cut].passes_through(&there)
    };
    let unmet = empty.filter(|(_, void)| !(0..cuts.len()).any(|cut| is_met(void.mesh(), cut)));
    let all = |(id, void): (VoidId, &Void)| Unclean {
        void: id,
        cause: UncleanCause::Closed,
        bodies: vec![void.mesh().clone()],
    };
    Ok(unmet.map(all).collect())
}

/// Returns the ends of voids beyond joints that lack two pins fitting one way only. Of the two
/// parts at such a joint, the one with less empty volume is taken. Each end is the box around a
/// void's piece in that part, grown by a margin (mm). If these ends are kept solid, the joint gains
/// material for pins or is no longer needed. Seats for parts are left out.
pub fn find_ends_beyond_unpinned_joints(
    hollowed: &Hollowed,
    plan: &CutPlan,
    margin_mm: f64,
    watch: &Watch,
) -> Result<Vec<SolidEnd>, CutError> {
    let tree = plan.tree()?;
    let parts = pieces_for_trial(hollowed, plan, &tree, watch)?;
    let inside = void_pieces(hollowed, &tree, &parts, watch)?;
    let empty_mm3 = |part: usize| -> f64 {
        inside
            .iter()
            .filter(|(of, _)| *of == part)
            .map(|(_, piece)| piece.volume_mm3)
            .sum()
    };
    let lacks_pins = |joint: &&Joint| {
        let ids = joint.parts();
        let is_it = |note: &&JointNote| note.parts == ids && note.cut == plan.cuts[joint.cut].id;
        plan.joints
            .iter()
            .find(is_it)
            .is_some_and(|note| !note.is_aligned())
    };
    let less_hollow = |joint: &Joint| {
        let sides = [joint.below, joint.above]
            .into_iter()
            .filter(|&part| empty_mm3(part) > 0.0);
        sides.min_by(|&a, &b| empty_mm3(a).total_cmp(&empty_mm3(b)))
    };
    let ends: Vec<usize> = joints(&parts, &tree)
        .iter()
        .filter(lacks_pins)
        .filter_map(less_hollow)
        .collect();
    let is_end = |part: usize| ends.contains(&part);
    Ok(solid_ends(&inside, &tree, margin_mm, is_end))
}

/// Returns the pieces of all voids without seats, each with the index of the part about it.
fn void_pieces(
    hollowed: &Hollowed,
    tree: &CutTree,
    parts: &[Piece],
    watch: &Watch,
) -> Result<Vec<(usize, Piece)>, CutError> {
    let chambers = Chamber::all(hollowed, watch)?;
    let mut inside: Vec<(usize, Piece)> = Vec::new();
    for chamber in chambers
        .iter()
        .filter(|chamber| chamber.void.holds.is_none())
    {
        for piece in chamber.split(tree)? {
            let part = parts
                .iter()
                .position(|part| borders(part, &piece.mesh, tree));
            inside.extend(part.map(|part| (part, piece)));
        }
    }
    Ok(inside)
}

/// Returns the boxes about the pieces of voids in some parts, grown by a margin, mm.
fn solid_ends(
    inside: &[(usize, Piece)],
    tree: &CutTree,
    margin_mm: f64,
    is_end: impl Fn(usize) -> bool,
) -> Vec<SolidEnd> {
    let solid_end = |(_, piece): &(usize, Piece)| {
        let at = farthest_corner(&piece.mesh, tree)?;
        Some(SolidEnd::new(&at, &piece.mesh.aabb().inflated(margin_mm)))
    };
    let ends = inside.iter().filter(|(part, _)| is_end(*part));
    ends.filter_map(solid_end).collect()
}

/// Returns the ends of voids in parts below the least of the request: the box around each, grown by
/// a margin, mm. If these stay solid, such a part needs no cut and stays with its neighbour. Seats
/// for parts are left out, and so is a plan of two parts, which needs its cut.
pub fn find_ends_in_small_parts(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
    margin_mm: f64,
) -> Result<Vec<SolidEnd>, CutError> {
    let tree = plan.tree()?;
    let parts = pieces_for_trial(hollowed, plan, &tree, &request.watch)?;
    let whole_mm3: f64 = parts.iter().map(|part| part.volume_mm3).sum();
    let is_small = |part: &Piece| request.is_small_part(part.volume_mm3, &part.mesh, whole_mm3);
    let small: Vec<bool> = parts.iter().map(is_small).collect();
    if parts.len() < 3 || !small.contains(&true) {
        return Ok(Vec::new());
    }
    let inside = void_pieces(hollowed, &tree, &parts, &request.watch)?;
    Ok(solid_ends(&inside, &tree, margin_mm, |part| small[part]))
}

/// Returns the corner of a void's piece that is farthest from all cuts.
pub(super) fn farthest_corner(piece: &TriMesh, tree: &CutTree) -> Option<Point> {
    let off_cuts_mm = |p: &Point| {
        tree.planes
            .iter()
            .map(|plane| plane.distance(p).abs())
            .fold(f64::INFINITY, f64::min)
    };
    piece
        .vertices()
        .iter()
        .max_by(|a, b| off_cuts_mm(a).total_cmp(&off_cuts_mm(b)))
        .copied()
}

/// Returns true if a part has the wall of a void's piece: they share its corner farthest from all
/// cuts.
fn borders(part: &Piece, piece: &TriMesh, tree: &CutTree) -> bool {
    let corner = farthest_corner(piece, tree);
    corner.is_some_and(|corner| {
        part.mesh
            .vertices()
            .iter()
            .any(|p| (p - corner).norm() <= SAME_CORNER_MM)
    })
}

/// Returns the bodies to keep solid: every piece that lets nothing out, and hidden ends of the
/// others. Ends are added until enough of the wall is visible. Those with the least volume per
/// hidden area come first.
fn bodies_to_keep_solid(opened: &Opened) -> Result<Vec<TriMesh>, CutError> {
    let pieces = opened.chamber.split(opened.tree)?;
    let seen = opened.inspect_each(&pieces)?;
    let wall_mm2: f64 = seen.iter().map(|seen| seen.wall_mm2).sum();
    let (mut solid, mut hidden) = (Vec::new(), Vec::new());
    let watch = &opened.request.watch;
    for (piece, seen) in pieces.iter().zip(&seen) {
        watch.check()?;
        if opened.lets_out(&Mouths::of(piece, &opened.tree.planes)) {
            hidden.extend(
                hidden_patches(seen)
                    .into_iter()
                    .map(|patch| (patch, piece, seen)),
            );
        } else {
            solid.push(piece.mesh.clone());
        }
    }
    hidden.sort_by(|a, b| b.0.area_mm2.total_cmp(&a.0.area_mm2));
    let mut hidden_mm2: f64 = hidden.iter().map(|(patch, ..)| patch.area_mm2).sum();
    let allowed_mm2 =
        ALLOWED_HIDDEN_RATIO * (1.0 - required_sight_ratio(opened.request)) * wall_mm2;
    for end in cheapest_ends(&hidden, watch)? {
        if hidden_mm2 <= allowed_mm2 {
            break;
        }
        hidden_mm2 -= end.area_mm2;
        solid.extend(end.bodies);
    }
    Ok(solid)
}

/// The bodies to keep solid for one hidden patch.
struct End {
    bodies: Vec<TriMesh>,
    area_mm2: f64,
    volume_mm3: f64,
}

/// Returns the ends for the largest hidden patches, ordered by volume per hidden area, cheapest
/// first.
fn cheapest_ends(
    hidden: &[(HiddenPatch, &Piece, &Visibility)],
    watch: &Watch,
) -> Result<Vec<End>, CutError> {
    let of = |(patch, piece, seen): &(HiddenPatch, &Piece, &Visibility)| {
        watch.check()?;
        let bodies = end_behind(piece, seen, patch)?;
        let volume_mm3 = bodies.iter().map(TriMesh::signed_volume_mm3).sum();
        Ok(End {
            bodies,
            area_mm2: patch.area_mm2,
            volume_mm3,
        })
    };
    let ends = hidden[..hidden.len().min(COMPARED_ENDS)].par_iter().map(of);
    let mut ends = ends.collect::<Result<Vec<End>, CutError>>()?;
    let cost_mm = |end: &End| end.volume_mm3 / end.area_mm2;
    ends.sort_by(|a, b| cost_mm(a).total_cmp(&cost_mm(b)));
    Ok(ends)
}

/// A connected hidden part of a piece's wall.
struct HiddenPatch {
    points: Vec<Point>,
    area_mm2: f64,
}

/// Groups the hidden sample points of a wall into patches of near neighbours.
fn hidden_patches(seen: &Visibility) -> Vec<HiddenPatch> {
    let hidden = &seen.hidden;
    let link_mm = LINK_RATIO * seen.share_mm2.sqrt();
    let mut sets = UnionFind::new(hidden.len());
    for i in 0..hidden.len() {
        for j in 0..i {
            if (hidden[i] - hidden[j]).norm() <= link_mm {
                sets.merge(i as u32, j as u32);
            }
        }
    }
    let (labels, count) = sets.labels();
    let mut patches: Vec<HiddenPatch> = (0..count)
        .map(|_| HiddenPatch {
            points: Vec::new(),
            area_mm2: 0.0,
        })
        .collect();
    for (point, label) in hidden.iter().zip(labels) {
        patches[label as usize].points.push(*point);
        patches[label as usize].area_mm2 += seen.share_mm2;
    }
    patches
}

/// Returns the bodies of the piece at and behind a hidden patch, as seen from the middle of the
/// visible points. Returns the whole piece if they are most of it.
fn end_behind(
    piece: &Piece,
    seen: &Visibility,
    patch: &HiddenPatch,
) -> Result<Vec<TriMesh>, CutError> {
    let middle = |points: &[Point]| {
        points.iter().fold(Vector::zeros(), |sum, p| sum + p.coords) / points.len().max(1) as f64
    };
    let whole = || vec![piece.mesh.clone()];
    let away = middle(&patch.points) - middle(&seen.visible);
    let Some(normal) = away.try_normalize(f64::EPSILON) else {
        return Ok(whole());
    };
    let mut heights: Vec<f64> = patch.points.iter().map(|p| normal.dot(&p.coords)).collect();
    heights.sort_by(f64::total_cmp);
    let offset_mm = heights[(START_QUANTILE * heights.len() as f64) as usize];
    let (beyond, _) = Csg::of_mesh(&piece.mesh)?.split_by_plane(&Plane { normal, offset_mm })?;
    let holds = |body: &TriMesh| {
        let room = body.aabb().inflated(seen.share_mm2.sqrt());
        patch.points.iter().any(|p| room.distance_squared(p) == 0.0)
    };
    let ends = bodies(&beyond.to_mesh()?).into_iter();
    let ends: Vec<TriMesh> = ends.filter(holds).collect();
    let volume_mm3: f64 = ends.iter().map(TriMesh::signed_volume_mm3).sum();
    Ok(if volume_mm3 > WHOLE_RATIO * piece.volume_mm3 {
        whole()
    } else {
        ends
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            CutOrder,
            scenes::{plan_by, request},
        },
        mesh::{Solid, primitives},
        printer::{Cleaning, CleaningRule},
    };

    /// Returns a block with a shaft and an arm at its foot, the request, and a cut across the
    /// shaft.
    fn bent() -> (Hollowed, PlanRequest, CutOrder) {
        let cuboid = |low: [f64; 3], high: [f64; 3]| primitives::cuboid(&low.into(), &high.into());
        let shaft = Csg::of_mesh(&cuboid([-6.0, -6.0, -30.0], [6.0, 6.0, 10.0])).unwrap();
        let arm = Csg::of_mesh(&cuboid([-6.0, -6.0, -30.0], [40.0, 6.0, -22.0])).unwrap();
        let outer = Solid::new(cuboid([-15.0, -15.0, -40.0], [50.0, 15.0, 20.0])).unwrap();
        let hollowed = Hollowed::new(outer, vec![shaft.union(&arm).unwrap().to_solid().unwrap()]);
        let cleaning = Cleaning {
            rule: CleaningRule::InSight,
            sight_ratio: 0.95,
            ..Cleaning::MELT_OUT
        };
        let cut = Cut {
            id: "C1".into(),
            point_mm: [0.0, 0.0, 5.0],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        let order = CutOrder {
            cuts: vec![cut],
            ..CutOrder::default()
        };
        (
            hollowed,
            PlanRequest {
                cleaning,
                ..request()
            },
            order,
        )
    }

    #[test]
    fn the_far_end_of_an_arm_must_be_solid() {
        let (hollowed, request, order) = bent();
        let plan = plan_by(&hollowed, &request, &order).unwrap();
        let found = find_unclean(&hollowed, &plan, &request, false).unwrap();
        assert_eq!(
            (found.len(), found[0].bodies.len()),
            (1, 1),
            "{:?}",
            plan.voids
        );
        let body = found[0].bodies[0].aabb();
        assert!(body.min.x > 6.0 && body.max.x > 39.0, "{body:?}");
        assert!(matches!(found[0].cause, UncleanCause::Hidden { .. }));
        let all = find_unclean(&hollowed, &plan, &request, true).unwrap();
        assert_eq!(all[0].bodies, vec![hollowed.voids[0].mesh().clone()]);
    }

    /// Returns a block with a post, hollow up to a thin wall below the post's top, and cuts across
    /// both.
    fn posted() -> (Hollowed, PlanRequest, CutPlan) {
        let cuboid = |low: [f64; 3], high: [f64; 3]| {
            Csg::of_mesh(&primitives::cuboid(&low.into(), &high.into()))
        };
        let union = |a: [[f64; 3]; 2], b: [[f64; 3]; 2]| {
            cuboid(a[0], a[1])
                .unwrap()
                .union(&cuboid(b[0], b[1]).unwrap())
                .unwrap()
                .to_solid()
                .unwrap()
        };
        let outer = union(
            [[-30.0, -30.0, 0.0], [30.0, 30.0, 30.0]],
            [[-3.5, -3.0, 20.0], [3.5, 3.0, 60.0]],
        );
        let void = union(
            [[-20.0, -20.0, 5.0], [20.0, 20.0, 25.0]],
            [[-2.5, -2.0, 15.0], [2.5, 2.0, 59.0]],
        );
        let hollowed = Hollowed::new(outer, vec![void]);
        let level = |id: &str, z: f64| Cut {
            id: id.into(),
            point_mm: [0.0, 0.0, z],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        let order = CutOrder {
            cuts: vec![level("C1", 15.0), level("C2", 40.0)],
            ..CutOrder::default()
        };
        let plan = plan_by(&hollowed, &request(), &order).unwrap();
        (hollowed, request(), plan)
    }

    #[test]
    fn at_a_joint_without_pins_the_less_hollow_part_becomes_solid() {
        let (hollowed, request, plan) = posted();
        let pins: Vec<usize> = plan.joints.iter().map(|joint| joint.pins.len()).collect();
        assert!(
            pins.contains(&0) && pins.iter().any(|&count| count >= 2),
            "{pins:?}"
        );
        let find_ends = |plan: &CutPlan, margin_mm: f64| {
            let watch = &request.watch;
            find_ends_beyond_unpinned_joints(&hollowed, plan, margin_mm, watch).unwrap()
        };
        let found = find_ends(&plan, 0.0);
        let [end] = found[..] else {
            panic!("{found:?}")
        };
        let known =
            [end.low_mm, end.high_mm].map(|corner| corner.map(|mm| (mm * 1e6).round() / 1e6));
        assert_eq!(known, [[-2.5, -2.0, 40.0], [2.5, 2.0, 59.0]]);
        assert!(end.is_sound() && end.at_mm[2] > 58.9, "{end:?}");
        let wider = find_ends(&plan, 2.0 * request.min_opening_mm)[0];
        assert!((end.low_mm[0] - wider.low_mm[0] - 2.0 * request.min_opening_mm).abs() < 1e-9);
        // With all joints pinned, nothing needs to be kept solid.
        let mut pinned = plan.clone();
        pinned.joints.retain(|joint| joint.is_aligned());
        assert_eq!(find_ends(&pinned, 0.0), vec![]);
    }

    #[test]
    fn if_any_opening_suffices_nothing_must_be_solid() {
        let (hollowed, request, order) = bent();
        let request = PlanRequest {
            cleaning: Cleaning::MELT_OUT,
            ..request
        };
        let plan = plan_by(&hollowed, &request, &order).unwrap();
        assert!(plan.voids[0].is_clean);
        assert_eq!(
            find_unclean(&hollowed, &plan, &request, false).unwrap(),
            vec![]
        );
    }

    #[test]
    fn the_planner_cuts_along_the_bend_so_that_all_is_in_sight() {
        let (hollowed, request, _) = bent();
        let plan = crate::cut::scenes::plan(&hollowed, &request).unwrap();
        assert!(plan.voids[0].is_clean, "{:?}", plan.voids);
        assert_eq!(plan.cuts.len(), 1, "{:?}", plan.cuts);
    }
}
