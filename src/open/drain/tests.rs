//! Draining of a post with hooked arms, which catch resin in every pose.

use super::*;
use crate::cut::PosePreference;
use crate::open::scenes::{LEAN, across, cuboid, draw, order, standing, unwatched, volume_mm3};
use crate::run::Placed;

/// Returns a post on a heavy foot with four arms whose ends hang down, cut across below the arms.
fn hooked() -> Placed {
    let bodies = [
        cuboid([-30.0, -30.0, -20.0], [30.0, 30.0, -10.0]),
        cuboid([-7.0, -7.0, -11.0], [7.0, 7.0, 24.0]),
        cuboid([-26.0, -6.0, 14.0], [26.0, 6.0, 24.0]),
        cuboid([-6.0, -26.0, 14.0], [6.0, 26.0, 24.0]),
        cuboid([-26.0, -6.0, 2.0], [-15.0, 6.0, 24.0]),
        cuboid([15.0, -6.0, 2.0], [26.0, 6.0, 24.0]),
        cuboid([-6.0, -26.0, 2.0], [6.0, -15.0, 24.0]),
        cuboid([-6.0, 15.0, 2.0], [6.0, 26.0, 24.0]),
    ];
    let mut placed = standing(&bodies, 1.0, LEAN);
    placed.job.plan = Some(order(vec![across(-2.0)]));
    placed
}

#[test]
fn ends_that_catch_resin_in_a_vat_are_kept_solid_until_none_does() {
    let placed = hooked();
    let request = PlanRequest {
        pose: PosePreference::Tilted,
        ..unwatched(&placed)
    };
    let (mut resolver, voids) = draw(&placed);
    let before = clean(
        &mut resolver.clone(),
        Start::of(voids.clone()),
        &request,
        &|_| false,
    )
    .unwrap();
    let cleaned = clean_and_drain(&mut resolver, Start::of(voids), &request, &|_| false).unwrap();
    let mut causes = cleaned.rounds.iter().flat_map(|round| &round.kept);
    let is_cup = |kept: &KeptSolid| matches!(kept.cause, KeptCause::Cup { .. });
    assert!(causes.any(is_cup), "{:?}", cleaned.rounds);
    assert!(volume_mm3(&cleaned.voids) < volume_mm3(&before.voids));
    let left = find_hollow_cups(&cleaned.voids.hollowed, &cleaned.plan, &request).unwrap();
    assert_eq!(left, vec![], "after {} rounds", cleaned.rounds.len());
}

#[test]
fn nothing_is_filled_for_a_printer_without_a_vat() {
    let placed = hooked();
    let (mut resolver, voids) = draw(&placed);
    let request = unwatched(&placed);
    let cleaned = clean_and_drain(&mut resolver, Start::of(voids), &request, &|_| false).unwrap();
    assert_eq!(cleaned.rounds, vec![]);
}
