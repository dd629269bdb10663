//! Drafts: plans with cuts alone, for a search that weighs many of them. The one that is taken gets
//! its pins in the end.

use super::{
    Fewest, check_request, fewest_cuts, find_plans, limited_cut_remarks, small_part_remarks,
};
use crate::{
    base::verdict::Verdict,
    cut::{
        error::{CutError, Obstacle, verdict},
        hollowed::Hollowed,
        joints::pins::Pins,
        order::CutOrder,
        pieces::rejoin::rejoin,
        plan::{Cut, CutPlan, bridges_on},
        planner::{
            attempt::Attempt,
            layers::snap_to_layers,
            layout::Layout,
            score::Scene,
            search::Found,
            to_plan::{to_draft, to_plan},
        },
        remark::Remark,
        request::PlanRequest,
    },
    geom::Plane,
};

/// Finds the cuts of [`plan`](super::plan) and leaves out pins, labels and the move to whole
/// layers.
pub fn draft(
    hollowed: &Hollowed,
    request: &PlanRequest,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(draft_fewest(hollowed, request))
}

fn draft_fewest(hollowed: &Hollowed, request: &PlanRequest) -> Result<CutPlan, CutError> {
    check_request(request)?;
    let scene = Scene::new(hollowed, request)?;
    let Fewest { layout, notes, .. } = fewest_cuts(&scene, find_plans(&scene)?.as_ref())?;
    to_draft(&scene, &layout, notes)
}

/// A body that is drafted several times, while seams weigh more or less against what stays
/// unclean. What its plans open and cost is found once.
pub struct Drafts<'a> {
    scene: Scene<'a>,
    found: Option<Found>,
}

/// The weight of seams in one of several drafts.
#[derive(Debug, Clone)]
pub struct SeamWeight {
    /// Weight of walls that lack sight, against seams.
    pub lack_weight: f64,
    /// The plans that were tried already, as [`Draft::sought`] has them.
    pub tried: Vec<Vec<Plane>>,
    /// Price of seams that a plan must stay below, in circles about the model of average weight.
    pub dearest_ratio: f64,
}

impl SeamWeight {
    /// Returns the request with this weight.
    pub fn weigh(&self, request: &PlanRequest) -> PlanRequest {
        let mut request = request.clone();
        request.seams.lack_weight = Some(self.lack_weight);
        request.seams.tried.clone_from(&self.tried);
        request.seams.dearest_ratio = Some(self.dearest_ratio);
        request
    }
}

/// A plan with cuts alone, and what the search found for it.
#[derive(Debug, Clone)]
pub struct Draft {
    /// The plan.
    pub plan: CutPlan,
    /// The planes of the search, before they moved into creases and others were added.
    pub sought: Vec<Plane>,
}

impl<'a> Drafts<'a> {
    /// Finds the plans for a body, to be drafted by requests of this weighing of seams. The answer
    /// is no if some void cannot be opened.
    ///
    /// # Errors
    /// As for [`draft`]. The request must weigh seams.
    pub fn new(
        hollowed: &'a Hollowed,
        request: &'a PlanRequest,
    ) -> Result<Verdict<Self, Obstacle>, CutError> {
        let prepare = || {
            check_request(request)?;
            let scene = Scene::new(hollowed, request)?;
            let found = find_plans(&scene)?;
            Ok(Self { scene, found })
        };
        verdict(prepare())
    }

    /// Drafts as [`draft`] does, with another weight of seams.
    pub fn draft(&self, weight: &SeamWeight) -> Result<Verdict<Draft, Obstacle>, CutError> {
        let request = weight.weigh(self.scene.request);
        let scene = self.scene.weighed(&request);
        let draft = |fewest: Fewest| {
            Ok(Draft {
                plan: to_draft(&scene, &fewest.layout, fewest.notes)?,
                sought: fewest.sought,
            })
        };
        verdict(fewest_cuts(&scene, self.found.as_ref()).and_then(draft))
    }
}

/// Returns the draft with the planes of another one's cuts, for a body of which more is solid. Each
/// cut is made where it is needed now.
///
/// # Errors
/// A cut of the draft is degenerate, or the body cannot be cut.
pub fn draft_again(
    hollowed: &Hollowed,
    request: &PlanRequest,
    draft: &CutPlan,
) -> Result<Verdict<CutPlan, Obstacle>, CutError> {
    verdict(draft_planes(hollowed, request, draft))
}

fn draft_planes(
    hollowed: &Hollowed,
    request: &PlanRequest,
    draft: &CutPlan,
) -> Result<CutPlan, CutError> {
    let scene = Scene::new(hollowed, request)?;
    let planes = draft.cuts.iter().map(Cut::plane);
    let planes = planes.collect::<Result<Vec<Plane>, CutError>>()?;
    let Attempt { planes, voids, .. } = Attempt::new(&scene, &planes)?;
    let layout = Layout::new(&scene, planes, voids)?;
    let is_kept = |note: &&Remark| note.is_proof() && !matches!(note, Remark::LimitedCut { .. });
    let mut notes: Vec<Remark> = draft.notes.iter().filter(is_kept).cloned().collect();
    notes.extend(limited_cut_remarks(&layout.tree));
    notes.extend(small_part_remarks(&scene, &layout));
    to_draft(&scene, &layout, notes)
}

/// Returns the plan of a [`draft`] of the same body: cuts moved to whole layers, with pins and
/// labels.
pub fn finish_draft(
    hollowed: &Hollowed,
    request: &PlanRequest,
    draft: CutPlan,
) -> Result<CutPlan, CutError> {
    let scene = Scene::new(hollowed, request)?;
    let order = CutOrder::of(&draft);
    let tree = draft.tree()?;
    let bridges = bridges_on(&tree.planes, &order.cuts, &order.uncut);
    let layout = Layout {
        pieces: rejoin(scene.split(&tree)?, &tree, &bridges, &request.watch)?,
        voids: draft.voids,
        tree,
        bridges,
    };
    let plan = to_plan(&scene, &layout, Pins::Placed, draft.notes.clone())?;
    let plan = snap_to_layers(&scene, &layout, plan, draft.notes)?;
    Ok(CutPlan {
        solid: draft.solid,
        ..plan
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::scenes::{cuboid, plan, request, with_balls};
    use crate::geom::Point;

    #[test]
    fn a_finished_draft_is_the_plan_that_is_made_at_once() {
        let outer = cuboid([0.0; 3], [50.0, 47.0, 41.3]);
        let hollowed = with_balls(outer, &[[14.0, 20.0, 20.0, 8.0], [36.0, 26.0, 21.0, 8.0]]);
        let request = PlanRequest {
            layer_mm: 0.2,
            ..request()
        };
        let at_once = plan(&hollowed, &request).unwrap();
        let draft = draft(&hollowed, &request).unwrap().or_error::<CutError>();
        let draft = draft.unwrap();
        assert!(draft.pins.is_empty() && draft.labels.is_empty() && draft.moves.is_empty());
        assert_eq!(draft.count_parts(), at_once.count_parts());
        assert_eq!(draft.voids.len(), at_once.voids.len());
        let finished = finish_draft(&hollowed, &request, draft).unwrap();
        assert_eq!(finished.notes, at_once.notes);
        assert_eq!(finished.pins.len(), at_once.pins.len());
        for (pin, same) in finished.pins.iter().zip(&at_once.pins) {
            let apart = Point::from(pin.center_mm) - Point::from(same.center_mm);
            assert!(apart.norm() < 1e-9, "{pin:?} {same:?}");
            assert_eq!((&pin.id, &pin.cut), (&same.id, &same.cut));
            assert_eq!(pin.diameter_mm, same.diameter_mm);
        }
    }
}
