//! Every rung of the ladder on a body that reaches it, and the order of what comes out.

mod choosing;
mod climbing;
mod jigs_first;

use super::*;
use crate::base::watch::Watch;
use crate::job::CutMode;
use crate::open::scenes::{LEAN, chimneys, cuboid, forbid_bosses, solve, standing};
use crate::run::{Opened, Placed};

/// Returns a wide and a narrow tower on a bar. Pins of 3 mm have no room in the walls, and no boss
/// is looked for.
fn unequal_towers() -> Placed {
    let bodies = [
        cuboid([0.0, 0.0, 0.0], [14.0, 14.0, 24.0]),
        cuboid([13.0, 5.0, 0.0], [27.0, 9.0, 4.0]),
        cuboid([26.0, 3.0, 0.0], [34.0, 11.0, 24.0]),
    ];
    let mut placed = standing(&bodies, 1.0, LEAN);
    placed.shop.printer.pin_min_diameter_mm.value = 3.0;
    placed.policy.max_void_loss_ratio = 0.95;
    forbid_bosses(&mut placed);
    placed
}

/// Returns chimneys of which all but one can be pinned at a price, the more of them the dearer.
fn dear_chimneys(count: usize, partial_loss_ratio: f64) -> Placed {
    let mut placed = chimneys(count);
    placed.policy.cheap_loss_ratio = 0.02;
    placed.policy.partial_loss_ratio = partial_loss_ratio;
    placed
}

fn resolver_of(placed: &Placed) -> Resolver<'_> {
    Resolver::new(placed, solve(placed), &Watch::silent()).unwrap()
}

fn ladder_of(placed: &Placed) -> Ladder<'_> {
    Ladder::new(resolver_of(placed)).unwrap()
}

/// Returns the plan that every ladder begins with.
fn usual_of<'a>(ladder: &Ladder<'a>) -> Way<'a> {
    let walls = ladder.plan_in_walls(&ladder.ground, &ladder.request, Rung::Walls, &|_| false);
    let finished = ladder.finish(walls.unwrap()).unwrap();
    ladder.add_bosses(finished, Rung::Bosses).unwrap()
}

fn rungs(candidates: &[Candidate]) -> Vec<Rung> {
    let opened = candidates.iter().map(|candidate| &candidate.opened);
    opened.map(|opened| opened.rung).collect()
}

/// Counts the joints without any pin.
fn bare_joints(opened: &Opened) -> usize {
    let joints = opened.plan.joints.iter();
    joints.filter(|joint| joint.pins.is_empty()).count()
}

fn remarks<'c>(candidate: &'c Candidate) -> &'c [Remark] {
    &candidate.opened.remarks
}
