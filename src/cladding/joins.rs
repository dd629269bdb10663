//! The order in which several polyhedra come together.

use super::units::Join;
use crate::geom::Vector;
use crate::polyhedra::{BasePlan, Child};

/// Returns the ways in which polyhedra come together, the innermost planes first. The upper ones
/// come to the lower ones.
pub(super) fn joins(plan: &BasePlan, up: &Vector) -> Vec<Join> {
    let mut order = Vec::new();
    let mut waiting: Vec<usize> = (0..plan.splits.len().min(1)).collect();
    while let Some(split) = waiting.pop() {
        order.push(split);
        let of = plan.splits[split];
        let within = [of.below, of.above]
            .into_iter()
            .filter_map(|child| match child {
                Child::Split(inner) => Some(inner),
                Child::Polyhedron(_) => None,
            });
        waiting.extend(within);
    }
    let outermost_last = order.into_iter().rev();
    let join = |split: usize| {
        let [below, above] = plan.polyhedra_beside(split);
        let way = plan.splits[split].plane.normal;
        let is_upright = up.dot(&way) >= 0.0;
        Join {
            moving: if is_upright {
                above.clone()
            } else {
                below.clone()
            },
            standing: if is_upright { below } else { above },
            way: if is_upright { way } else { -way },
        }
    };
    outermost_last.map(join).collect()
}
