//! Cuts limited to the sides of other cuts on which they are needed. A cut for one void then does
//! not divide the whole body.

use crate::{
    cut::{
        access::void_access::VoidAccess,
        error::CutError,
        geometry::tree::{CutTree, Limit},
        pieces::{
            pose::fits,
            split::{Piece, check_no_cavity},
        },
        planner::{attempt::update_accesses, score::Scene},
    },
    geom::Plane,
};

/// Cuts, each made only where it is needed.
pub(crate) struct LimitedCuts {
    pub(crate) tree: CutTree,
    /// Access that the cuts give to the voids.
    pub(crate) voids: Vec<VoidAccess>,
    /// Pieces that the cuts leave.
    pub(crate) pieces: Vec<Piece>,
}

/// Limits each cut to a side of another if that leaves fewer parts; the last cut is tried first.
/// The voids must stay as clean as in `voids`, which describes the cuts made everywhere. The number
/// of parts too large for the printer must not grow.
pub(crate) fn limit_cuts(
    scene: &Scene,
    planes: &[Plane],
    voids: Vec<VoidAccess>,
) -> Result<LimitedCuts, CutError> {
    let tree = CutTree::everywhere(planes);
    let mut limited = LimitedCuts {
        pieces: scene.split(&tree)?,
        tree,
        voids,
    };
    for cut in (0..planes.len()).rev() {
        for other in (0..planes.len()).filter(|&other| other != cut) {
            for is_above in [true, false] {
                if let Some(better) = limited.with(
                    scene,
                    cut,
                    Limit {
                        cut: other,
                        is_above,
                    },
                )? {
                    limited = better;
                }
            }
        }
    }
    Ok(limited)
}

impl LimitedCuts {
    /// Returns the cuts with one more limit, or `None` if that is no better.
    fn with(&self, scene: &Scene, cut: usize, limit: Limit) -> Result<Option<Self>, CutError> {
        let Some(tree) = self.tree.with_limit(cut, limit) else {
            return Ok(None);
        };
        scene.request.watch.check()?;
        // Cuts that are limited to a side of this one are also made in fewer places.
        let is_changed =
            |other: usize| other == cut || tree.limits(other).iter().any(|limit| limit.cut == cut);
        let changed: Vec<Plane> = (0..tree.planes.len())
            .filter(|&other| is_changed(other))
            .map(|other| tree.planes[other])
            .collect();
        let voids = update_accesses(scene, &self.voids, &tree, &changed)?;
        if self
            .voids
            .iter()
            .zip(&voids)
            .any(|(before, after)| is_worse(scene, before, after))
        {
            return Ok(None);
        }
        let pieces = scene.split(&tree)?;
        let next = Self {
            tree,
            voids,
            pieces,
        };
        let is_better = next.pieces.len() < self.pieces.len()
            && check_no_cavity(&next.pieces).is_ok()
            && next.count_oversize(scene) <= self.count_oversize(scene)
            && next.has_all_cuts();
        Ok(is_better.then_some(next))
    }

    /// Counts the pieces that do not fit the build volume.
    fn count_oversize(&self, scene: &Scene) -> usize {
        self.pieces
            .iter()
            .filter(|piece| !fits(piece, &self.tree.planes, scene.request))
            .count()
    }

    /// Returns true if every cut is made somewhere.
    fn has_all_cuts(&self) -> bool {
        let is_made = |cut: usize| {
            self.pieces
                .iter()
                .flat_map(|piece| &piece.caps)
                .any(|cap| cap.cut == cut)
        };
        (0..self.tree.planes.len()).all(is_made)
    }
}

/// Returns true if a void is harder to clean than before.
fn is_worse(scene: &Scene, before: &VoidAccess, after: &VoidAccess) -> bool {
    let needed_mm = after.least_opening_mm(scene.request);
    let is_narrower = after.opening_mm < before.opening_mm && after.opening_mm < needed_mm;
    let is_hidden = !after.is_clean && after.sight_ratio < before.sight_ratio;
    is_narrower || is_hidden || (before.is_clean && !after.is_clean)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        cut::{
            CutId, CutOrder, Hollowed, PlanRequest,
            access::void_access::accesses,
            joints::pins::Pins,
            pieces::split::joints,
            planner::{layout::Layout, to_plan::to_plan},
            scenes::{cuboid, parts, plan_by, request, with_balls},
        },
        geom::Vector,
        printer::{Cleaning, CleaningRule},
    };

    /// Returns a bar with two balls, a cut across the second ball, and one along both.
    fn bar() -> (Hollowed, [Plane; 2], PlanRequest) {
        let body = with_balls(
            cuboid([0.0; 3], [60.0, 20.0, 20.0]),
            &[[15.0, 10.0, 10.0, 6.0], [45.0, 10.0, 10.0, 6.0]],
        );
        let across = Plane {
            normal: Vector::x(),
            offset_mm: 45.013,
        };
        let along = Plane {
            normal: Vector::z(),
            offset_mm: 10.007,
        };
        let cleaning = Cleaning {
            rule: CleaningRule::InSight,
            sight_ratio: 0.95,
            ..Cleaning::MELT_OUT
        };
        (
            body,
            [across, along],
            PlanRequest {
                cleaning,
                layer_mm: 0.0,
                ..request()
            },
        )
    }

    fn limit_clean_cuts(scene: &Scene, planes: &[Plane]) -> LimitedCuts {
        let voids = accesses(&scene.chambers, &CutTree::everywhere(planes), scene.request).unwrap();
        assert!(voids.iter().all(|void| void.is_clean), "{voids:?}");
        limit_cuts(scene, planes, voids).unwrap()
    }

    #[test]
    fn a_cut_for_one_void_leaves_the_half_of_another_whole() {
        let (body, planes, request) = bar();
        let scene = Scene::new(&body, &request).unwrap();
        let limited = limit_clean_cuts(&scene, &planes);
        assert_eq!(
            limited.tree.limits(1),
            [Limit {
                cut: 0,
                is_above: false
            }]
        );
        assert_eq!(
            (
                limited.pieces.len(),
                joints(&limited.pieces, &limited.tree).len()
            ),
            (3, 3)
        );
        assert_eq!(
            limited.voids[1].opened_by,
            [CutId::of(0), CutId::of(1)],
            "its other half is cut along"
        );
        assert!(
            limited.voids.iter().all(|void| void.is_clean),
            "{:?}",
            limited.voids
        );
    }

    #[test]
    fn the_last_cut_made_is_the_first_to_be_glued() {
        let (body, planes, request) = bar();
        let scene = Scene::new(&body, &request).unwrap();
        let limited = limit_clean_cuts(&scene, &planes);
        let cuts: Vec<usize> = joints(&limited.pieces, &limited.tree)
            .iter()
            .map(|joint| joint.cut)
            .collect();
        assert_eq!(cuts, [1, 0, 0]);
    }

    #[test]
    fn cuts_limited_to_opposite_sides_divide_the_face_between_them_into_quarters() {
        let (body, [across, along], request) = bar();
        let upright = Plane {
            normal: Vector::y(),
            offset_mm: 10.011,
        };
        let tree = CutTree::everywhere(&[across, along, upright]);
        let tree = tree
            .with_limit(
                1,
                Limit {
                    cut: 0,
                    is_above: false,
                },
            )
            .unwrap();
        let tree = tree
            .with_limit(
                2,
                Limit {
                    cut: 0,
                    is_above: true,
                },
            )
            .unwrap();
        let pieces = Scene::new(&body, &request).unwrap().split(&tree).unwrap();
        let joints = joints(&pieces, &tree);
        let face_mm2 = |is_above: bool| -> f64 {
            let caps = pieces.iter().flat_map(|piece| &piece.caps);
            caps.filter(|cap| cap.cut == 0 && cap.is_above == is_above)
                .map(|cap| cap.area_mm2)
                .sum()
        };
        let quarters: Vec<f64> = joints
            .iter()
            .filter(|joint| joint.cut == 0)
            .map(|joint| joint.area_mm2())
            .collect();
        assert_eq!((pieces.len(), joints.len(), quarters.len()), (4, 6, 4));
        for is_above in [true, false] {
            assert!(
                (quarters.iter().sum::<f64>() - face_mm2(is_above)).abs() < 1e-9,
                "{quarters:?}"
            );
        }
        // The section of the ball is nearly central.
        assert!(
            quarters
                .iter()
                .all(|mm2| (mm2 / face_mm2(true) - 0.25).abs() < 0.01),
            "{quarters:?}"
        );
    }

    #[test]
    fn a_cut_that_both_sides_need_is_made_on_both() {
        let (body, [_, along], request) = bar();
        let scene = Scene::new(&body, &request).unwrap();
        let between = Plane {
            normal: Vector::x(),
            offset_mm: 30.013,
        };
        let limited = limit_clean_cuts(&scene, &[between, along]);
        // The cut between the balls opens nothing, so it may end at the other cut, on either side.
        assert!(limited.tree.limits(1).is_empty());
        assert_eq!((limited.tree.limits(0).len(), limited.pieces.len()), (1, 3));
    }

    #[test]
    fn a_plan_with_a_limited_cut_survives_writing_and_reading_to_the_bit() {
        let (body, planes, request) = bar();
        let scene = Scene::new(&body, &request).unwrap();
        let LimitedCuts {
            tree,
            voids,
            pieces,
        } = limit_clean_cuts(&scene, &planes);
        let layout = Layout {
            tree,
            voids,
            pieces,
            bridges: Vec::new(),
        };
        let plan = to_plan(&scene, &layout, Pins::Placed, Vec::new()).unwrap();
        assert!(
            plan.joints.iter().all(|joint| joint.is_aligned()),
            "{:?}",
            plan.joints
        );
        let text = CutOrder::of(&plan).to_toml().unwrap();
        assert!(text.contains("side = \"below\""), "{text}");
        let again = plan_by(
            &body,
            &request,
            &CutOrder::from_toml("cuts.toml", &text).unwrap(),
        )
        .unwrap();
        assert_eq!(
            (&again.cuts, &again.joints, &again.pins),
            (&plan.cuts, &plan.joints, &plan.pins)
        );
        let named = text.replace("\"C1\"", "\"waist\"");
        let named = plan_by(
            &body,
            &request,
            &CutOrder::from_toml("cuts.toml", &named).unwrap(),
        )
        .unwrap();
        assert_eq!(
            (&named.cuts[1].within[0].cut, named.joints.len()),
            (&CutId::from("waist"), 3)
        );
        let volume: f64 = parts(&body, &plan, &request)
            .unwrap()
            .iter()
            .map(|part| part.solid.mesh().signed_volume_mm3())
            .sum();
        let whole = body.to_mesh().signed_volume_mm3() + plan.pegs().signed_volume_mm3();
        assert!((volume - whole).abs() < 1e-6 * whole, "{volume} {whole}");
    }

    #[test]
    fn limits_in_a_circle_to_both_sides_or_to_unknown_cuts_are_refused() {
        let cut = |id: &str, other: &str| {
            format!(
                "[[cuts]]\nid = \"{id}\"\npoint_mm = [0, 0, 0]\nnormal = [1, 0, 0]\nwithin = [{{ cut = \"{other}\", side = \"above\" }}]\n"
            )
        };
        let refused = |text: String| {
            CutOrder::from_toml("cuts.toml", &text)
                .unwrap_err()
                .to_string()
        };
        let message = refused(cut("C1", "C2") + &cut("C2", "C1"));
        assert!(message.contains("kept to sides of each other"), "{message}");
        let both = cut("C2", "C1").replace(" }]", " }, { cut = \"C1\", side = \"below\" }]");
        let first = "[[cuts]]\nid = \"C1\"\npoint_mm = [0, 0, 0]\nnormal = [0, 1, 0]\n";
        let message = refused(first.to_owned() + &both);
        assert!(message.contains("to both sides of another"), "{message}");
        let message = refused(cut("C1", "C9"));
        assert!(
            message.contains("cut C1 names cut C9, which is not there"),
            "{message}"
        );
    }
}
