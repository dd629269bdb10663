//! Ends of voids that would enclose resin while their part is printed in a vat.

use std::collections::HashMap;

use crate::{
    cut::{
        error::CutError,
        hollowed::Hollowed,
        ids::VoidId,
        pieces::{
            part::{bits, pieces_for_trial, voids_by_vertex},
            pose::Posed,
            split::Piece,
        },
        plan::CutPlan,
        request::{PlanRequest, PosePreference},
    },
    geom::{Plane, Vector},
    mesh::TriMesh,
    poses::{Columns, Cup, LEAST_CUP_MM3, Shape, find_cups},
};

/// Distance between the lines along which cups are looked for, as a share of the thinnest wall.
const PITCH_RATIO: f64 = 0.5;
/// Share of the volume that is no cup yet that may stay. The rest is a margin for changes when the
/// body is solved again.
const STAYING_RATIO: f64 = 0.5;

/// A place in a void that encloses resin in the best pose of its part.
#[derive(Debug, Clone, PartialEq)]
pub struct HollowCup {
    /// The void.
    pub void: VoidId,
    /// The place, as closed boxes side by side, model frame, mm.
    pub body: TriMesh,
    /// Its volume, mm³.
    pub volume_mm3: f64,
}

/// Returns the places in voids that enclose resin in the best pose of each part, the largest first
/// in each part. Parts with less resin than a suction cup needs have none, nor has any part that
/// no vat prints. A void that holds a part is left out.
pub fn find_hollow_cups(
    hollowed: &Hollowed,
    plan: &CutPlan,
    request: &PlanRequest,
) -> Result<Vec<HollowCup>, CutError> {
    let tree = plan.tree()?;
    let is_closed = tree.planes.is_empty() && plan.drains.is_empty();
    if request.pose != PosePreference::Tilted || is_closed {
        return Ok(Vec::new());
    }
    let pieces = pieces_for_trial(hollowed, plan, &tree, &request.watch)?;
    let search = Search {
        hollowed,
        void_of: voids_by_vertex(hollowed),
        planes: &tree.planes,
        request,
    };
    let mut found = Vec::new();
    for piece in &pieces {
        found.extend(search.cups_of(piece)?);
    }
    Ok(found)
}

/// The search for cups in the pieces of a plan.
struct Search<'a> {
    hollowed: &'a Hollowed,
    /// The void of each vertex of the hollowed body, by its bits.
    void_of: HashMap<[u64; 3], VoidId>,
    planes: &'a [Plane],
    request: &'a PlanRequest,
}

impl Search<'_> {
    fn cups_of(&self, piece: &Piece) -> Result<Vec<HollowCup>, CutError> {
        let posed = Posed {
            mesh: &piece.mesh,
            piece,
            planes: self.planes,
            pins: &[],
            pin_cuts: &[],
        };
        let pose = posed.pose(self.request, |p| self.void_of.contains_key(&bits(p)))?;
        let [x, y, z, _] = pose.print_from_model[2];
        let columns = Columns::of(
            &Shape::plain(&piece.mesh),
            &Vector::new(x, y, z),
            PITCH_RATIO * self.request.wall_mm,
        );
        let cups = find_cups(&columns);
        let void_below = |cup: &Cup| -> Option<VoidId> {
            let corners = piece.mesh.corners(cup.floor? as usize);
            let void = corners.iter().find_map(|p| self.void_of.get(&bits(p)))?;
            let holds = self.hollowed.voids[void.index()].holds.is_some();
            (!holds).then_some(*void)
        };
        Ok(too_large(&cups, void_below))
    }
}

/// Returns the cups in voids, the largest first, until the rest of all cups is no cup.
fn too_large(cups: &[Cup], void_below: impl Fn(&Cup) -> Option<VoidId>) -> Vec<HollowCup> {
    let mut left_mm3: f64 = cups.iter().map(|cup| cup.volume_mm3).sum();
    if left_mm3 < LEAST_CUP_MM3 {
        return Vec::new();
    }
    let mut found = Vec::new();
    for cup in cups {
        if left_mm3 < STAYING_RATIO * LEAST_CUP_MM3 {
            break;
        }
        if let Some(void) = void_below(cup) {
            left_mm3 -= cup.volume_mm3;
            found.push(HollowCup {
                void,
                body: cup.body.clone(),
                volume_mm3: cup.volume_mm3,
            });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            CutOrder,
            plan::Cut,
            scenes::{plan_by, request},
        },
        mesh::{Csg, Solid, primitives},
    };

    fn cuboid(low: [f64; 3], high: [f64; 3]) -> Csg {
        Csg::of_mesh(&primitives::cuboid(&low.into(), &high.into())).unwrap()
    }

    /// Returns a block with these hollows in one void, cut at z = 0.
    fn cut_block(hollows: &[[[f64; 3]; 2]], pose: PosePreference) -> Vec<HollowCup> {
        let void = hollows.iter().map(|[low, high]| cuboid(*low, *high));
        let void = void.reduce(|all, part| all.union(&part).unwrap()).unwrap();
        let outer = primitives::cuboid(&[-30.0, -30.0, -12.0].into(), &[30.0, 30.0, 30.0].into());
        let hollowed = Hollowed::new(Solid::new(outer).unwrap(), vec![void.to_solid().unwrap()]);
        let cut = Cut {
            id: "C1".into(),
            point_mm: [0.0; 3],
            normal: [0.0, 0.0, 1.0],
            within: Vec::new(),
        };
        let order = CutOrder {
            cuts: vec![cut],
            ..CutOrder::default()
        };
        let request = PlanRequest { pose, ..request() };
        let plan = plan_by(&hollowed, &request, &order).unwrap();
        find_hollow_cups(&hollowed, &plan, &request).unwrap()
    }

    const SHAFT: [[f64; 3]; 2] = [[-6.0, -6.0, -8.0], [6.0, 6.0, 24.0]];
    /// An arm on each of four sides of the shaft's end, with a hook that points back at the cut.
    const HOOKS: [[[f64; 3]; 2]; 6] = [
        [[-24.0, -5.0, 16.0], [24.0, 5.0, 24.0]],
        [[-5.0, -24.0, 16.0], [5.0, 24.0, 24.0]],
        [[-24.0, -5.0, 4.0], [-14.0, 5.0, 24.0]],
        [[14.0, -5.0, 4.0], [24.0, 5.0, 24.0]],
        [[-5.0, -24.0, 4.0], [5.0, -14.0, 24.0]],
        [[-5.0, 14.0, 4.0], [5.0, 24.0, 24.0]],
    ];

    #[test]
    fn hooked_ends_catch_resin_in_every_pose_and_a_straight_shaft_in_none() {
        assert_eq!(cut_block(&[SHAFT], PosePreference::Tilted), vec![]);
        let hooked: Vec<_> = HOOKS.into_iter().chain([SHAFT]).collect();
        let found = cut_block(&hooked, PosePreference::Tilted);
        let volume_mm3: f64 = found.iter().map(|cup| cup.volume_mm3).sum();
        assert!(volume_mm3 > LEAST_CUP_MM3, "{found:?}");
        for cup in &found {
            // They lie in an arm or a hook, beyond the shaft and above the cut.
            let place = cup.body.aabb();
            assert!(place.max.z < 24.5 && place.min.z > 0.0, "{place:?}");
            assert_eq!(cup.void, VoidId::of(0));
        }
    }

    #[test]
    fn what_is_not_printed_in_a_vat_has_no_cups() {
        let hooked: Vec<_> = HOOKS.into_iter().chain([SHAFT]).collect();
        for pose in [PosePreference::CutFaceDown, PosePreference::LittleSupport] {
            assert_eq!(cut_block(&hooked, pose), vec![]);
        }
    }
}
