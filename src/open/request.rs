//! The request for cuts and pins of a placed goal.

use crate::ballast::{Load, Placed as PlacedPart, Pocket};
use crate::cut::{GoalAxis, PlanRequest, Seat};
use crate::run::Placed;

/// Returns what cuts, pins and parts must keep to for this job on its printer.
pub fn request(placed: &Placed, load: &Load) -> PlanRequest {
    let frame = &placed.goal().frame;
    let axis = GoalAxis {
        point: frame.origin,
        direction: frame.axis(),
    };
    let size_mm = placed.solid().mesh().longest_side_mm();
    let usual = PlanRequest::for_printer(&placed.shop.printer, size_mm, axis);
    PlanRequest {
        worth_ratio: placed.policy.cut_worth_ratio,
        seats: seats(load),
        rods: placed.shop.rods.clone(),
        labels: usual.labels.filter(|_| placed.job.ids.is_engraved()),
        ..usual
    }
}

/// Returns what the cuts must let into the pockets of ballast, in their order.
fn seats(load: &Load) -> Vec<Seat> {
    let seat = |(placed, pocket): (&PlacedPart, Pocket)| Seat {
        center: pocket.center,
        axis: pocket.half_height_mm.map(|half| (pocket.axis, half)),
        radius_mm: pocket.radius_mm,
        opening_mm: 2.0 * placed.lump.shape.radius_mm(),
    };
    load.parts.iter().zip(load.pockets()).map(seat).collect()
}
