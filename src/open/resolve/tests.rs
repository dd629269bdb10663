//! Solving again on towers: what is kept solid stays so, and the rest is optimal again.

use super::*;
use crate::mass::Body;
use crate::open::scenes::{LEAN, LOW, cuboid, draw, lopsided, solve, towers, volume_mm3};
use crate::run::Achieved;

/// Accuracy of a drawn surface, half a pixel, mm.
const DRAWN_MM: f64 = 0.2;
/// Least difference of two volumes that their surfaces tell apart, as a share.
const VOLUME_RATIO: f64 = 0.01;

/// Returns a slab across both towers, from z = 14 to 16 mm.
fn slab() -> TriMesh {
    cuboid([-1.0, -1.0, 14.0], [41.0, 15.0, 16.0])
}

/// Returns bodies that are kept solid whatever is lost.
fn refuse(bodies: &[TriMesh], margin_openings: f64) -> Refused<'_> {
    Refused {
        bodies,
        margin_openings,
        is_lost: &|_| false,
    }
}

/// Returns whether all voids keep off the slab by a margin, mm, up to the drawing's accuracy.
fn keep_off_slab(voids: &Voids, margin_mm: f64) -> bool {
    let off_mm = |p: &Point| (p.z - 15.0).abs() - 1.0;
    let mut bodies = voids.hollowed.voids.iter();
    bodies.all(|void| {
        let corners = void.mesh().vertices();
        corners.iter().all(|p| off_mm(p) > margin_mm - DRAWN_MM)
    })
}

/// Returns the distance of a body's centre of mass from its goal's axis, mm.
fn aside_mm(placed: &Placed, voids: &Voids) -> f64 {
    let moments = moments_of_mesh(&voids.hollowed.to_mesh()).in_frame(&placed.goal().frame);
    Body::new(&moments, 1.0).center.xy().coords.norm()
}

#[test]
fn drawn_voids_meet_the_goal_and_uncorrected_ones_do_not() {
    let mut placed = lopsided();
    let corrected = draw(&placed).1;
    assert!(aside_mm(&placed, &corrected) <= 0.0005);
    assert!((1..=8).contains(&corrected.rounds));
    placed.policy.correction_rounds = 0;
    let rough = draw(&placed).1;
    assert!(aside_mm(&placed, &rough) > 0.0005);
    assert_eq!(rough.rounds, 0);
}

#[test]
fn what_is_kept_solid_costs_volume_and_figure() {
    let placed = towers(LOW);
    let (mut resolver, voids) = draw(&placed);
    let less = resolver.without(&voids, &refuse(&[slab()], 0.5)).unwrap();
    let [before, after] = [&voids, &less].map(Achieved::of);
    assert!(before.filled_ratio(&after) > 0.1);
    // No choice of voids beats the first optimum, up to its certified gap.
    assert!(before.loss_ratio(&after) > 0.0);
    assert!(less.refused_mm3 >= slab().signed_volume_mm3());
    let first = solve(&placed).solution.certificate;
    assert_eq!(resolver.first_value(), first.value);
}

#[test]
fn voids_that_are_lost_are_not_drawn() {
    let placed = lopsided();
    let (resolver, voids) = draw(&placed);
    let bit = cuboid([20.0, 6.0, 18.0], [22.0, 8.0, 20.0]);
    let without = |is_lost: &dyn Fn(&Voids) -> bool| {
        let refused = Refused {
            is_lost,
            ..refuse(std::slice::from_ref(&bit), 0.1)
        };
        let mut resolver = resolver.clone();
        let less = resolver.without(&voids, &refused).unwrap();
        (resolver, less)
    };
    let [(mut resolver, kept), (_, lost)] = [without(&|_| false), without(&|_| true)];
    let kept = resolver.correct(kept, Moments::default()).unwrap();
    assert_eq!(lost.rounds, voids.rounds + 1);
    assert_eq!(lost.hollowed, voids.hollowed);
    assert!(kept.hollowed != voids.hollowed && aside_mm(&placed, &kept) <= 0.0005);
    // The figure that it was refused by is that of the columns: corrections hardly move it.
    let loss_ratio = Achieved::of(&kept).loss_ratio(&Achieved::of(&lost));
    assert!(loss_ratio.abs() < 0.01, "{loss_ratio}");
}

#[test]
fn what_is_left_is_optimal_again() {
    // The goal to lean has no constraint that could ask for another round.
    for objective in [LOW, LEAN] {
        let placed = towers(objective);
        let (mut resolver, voids) = draw(&placed);
        let less = resolver.without(&voids, &refuse(&[slab()], 0.5)).unwrap();
        let less = resolver.correct(less, Moments::default()).unwrap();
        let [before, after] = [&voids, &less].map(|voids| voids.solution.certificate);
        assert!(less.solution.is_usable() && less.rounds > voids.rounds);
        assert!(after.value != before.value, "{after:?}");
        assert!(after.gap_ratio <= 1e-6, "{after:?}");
        assert!(objective == LEAN || aside_mm(&placed, &less) <= 0.0005);
    }
}

#[test]
fn what_is_kept_solid_stays_so_when_all_is_solved_again() {
    let placed = towers(LEAN);
    let (mut resolver, voids) = draw(&placed);
    assert!(!keep_off_slab(&voids, 0.0));
    let less = resolver.without(&voids, &refuse(&[slab()], 0.5)).unwrap();
    // Half of an opening of 3 mm.
    assert!(keep_off_slab(&less, 1.5));
    let post = cuboid([6.0, 6.0, 0.0], [8.0, 8.0, 10.0]);
    let again = resolver.with_bosses(&less, &[post]).unwrap();
    assert!(keep_off_slab(&again, 1.5));
    assert!(volume_mm3(&again) < volume_mm3(&less));
}

#[test]
fn what_is_kept_solid_gets_the_margin_in_openings() {
    let placed = towers(LEAN);
    let (resolver, voids) = draw(&placed);
    for margin_openings in [0.5, 1.0] {
        let less = resolver
            .clone()
            .without(&voids, &refuse(&[slab()], margin_openings));
        let less = less.unwrap();
        let corners = less
            .hollowed
            .voids
            .iter()
            .flat_map(|void| void.mesh().vertices());
        let above = corners.map(|p| p.z).filter(|z| *z > 15.0);
        let lowest_mm = above.fold(f64::INFINITY, f64::min);
        let expected_mm = 16.0 + 3.0 * margin_openings;
        assert!(
            (lowest_mm - expected_mm).abs() < DRAWN_MM,
            "{lowest_mm} {expected_mm}"
        );
    }
}

#[test]
fn bosses_count_by_what_could_have_been_emptied() {
    let placed = towers(LEAN);
    let (mut resolver, voids) = draw(&placed);
    assert_eq!(resolver.bosses_mm3(), 0.0);
    // Half of it stands in the wall of 1 mm.
    let boss = cuboid([5.0, 0.0, 10.0], [7.0, 2.0, 12.0]);
    resolver
        .with_bosses(&voids, std::slice::from_ref(&boss))
        .unwrap();
    let kept_mm3 = resolver.bosses_mm3();
    assert!((kept_mm3 - 4.0).abs() < 0.4, "{kept_mm3}");
    // It is solid already.
    resolver.with_bosses(&voids, &[boss]).unwrap();
    assert!((resolver.bosses_mm3() - kept_mm3).abs() < 1e-6);
}

#[test]
fn a_void_too_small_to_clean_is_refused_for_good_if_it_counts() {
    let mut placed = towers(LEAN);
    placed.shop.printer.min_opening_mm.value = 12.5;
    let columns_mm3 = |placed: &Placed| {
        let (resolver, voids) = draw(placed);
        assert!(voids.hollowed.voids.is_empty() && voids.refused_mm3 > 1000.0);
        resolver.solved().columns.moments().volume()
    };
    assert!(columns_mm3(&placed) < 1.0, "it may come back");
    placed.policy.significant_void_ratio = 1.0;
    assert!(columns_mm3(&placed) > 1000.0, "it is less than the model");
}

#[test]
fn a_part_of_the_interior_is_found_by_its_box_and_none_outside_it() {
    let placed = towers(LEAN);
    let (resolver, _) = draw(&placed);
    let end = |low_mm: [f64; 3], high_mm: [f64; 3]| SolidEnd {
        at_mm: low_mm,
        low_mm,
        high_mm,
    };
    let top = end([1.0, 1.0, 20.0], [13.0, 13.0, 30.0]);
    let [part] = &resolver.parts_about(&[top]).unwrap()[..] else {
        panic!("the left tower is hollow up to 23 mm")
    };
    let volume_mm3 = part.signed_volume_mm3();
    assert!(
        (volume_mm3 / (144.0 * 3.0) - 1.0).abs() < VOLUME_RATIO,
        "{volume_mm3}"
    );
    let beside = end([15.0, 1.0, 5.0], [25.0, 13.0, 20.0]);
    assert!(resolver.parts_about(&[beside]).unwrap().is_empty());
}

#[test]
fn a_cancelled_run_draws_nothing() {
    let placed = towers(LEAN);
    let (mut resolver, voids) = draw(&placed);
    resolver.watch().cancel();
    assert!(matches!(resolver.draw(), Err(Error::Cancelled)));
    let less = resolver.without(&voids, &refuse(&[slab()], 0.5));
    assert!(matches!(less, Err(Error::Cancelled)));
}
