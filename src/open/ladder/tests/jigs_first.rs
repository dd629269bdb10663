//! The search as the standard policy orders it: jigs, and seams that are seen, before dear rungs.

use super::*;
use crate::cut::SeamStyle;
use crate::open::scenes::{across, order, thick_box};
use crate::printer::Printer;

/// Lets jigs hold joints before anything dearer, as in the standard policy.
fn with_jigs(mut placed: Placed) -> Placed {
    placed.policy.jigs_first = true;
    placed
}

/// Hides the seams of a body, if hidden ones cost no more than other rungs.
fn with_hidden_seams(placed: Placed) -> Placed {
    let mut placed = with_jigs(placed);
    placed.job.seam = SeamStyle::Hidden;
    placed.policy.aligned_loss_ratio = Policy::STANDARD.aligned_loss_ratio;
    placed
}

/// Gives the printer another room for parts, mm.
fn set_plate(placed: &mut Placed, size_mm: [f64; 3]) {
    let mut room = Printer::find("prusa-mk4").unwrap().build_volume_mm;
    room.as_mut().unwrap().value = size_mm;
    placed.shop.printer.build_volume_mm = room;
}

fn climb_silently(placed: &Placed) -> Vec<Candidate<'_>> {
    ladder_of(placed).climb().unwrap()
}

#[test]
fn a_jig_ends_the_search_before_dear_bosses() {
    let placed = with_jigs(dear_chimneys(2, 0.35));
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::Bosses]);
    assert_eq!(bare_joints(&candidates[0].opened), 2);
    assert_eq!(count_unaligned_in_best(&candidates).unwrap(), 0);
}

#[test]
fn without_room_for_jigs_the_dear_rungs_are_climbed() {
    let mut placed = with_jigs(dear_chimneys(2, 0.35));
    // The parts of the chimneys have room there, and no jig has.
    set_plate(&mut placed, [30.0, 15.0, 60.0]);
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::DearBosses, Rung::Bosses]);
    assert!(count_unaligned_in_best(&candidates).unwrap() > 0);
}

/// Returns a way of which neither pins nor jigs align a joint.
fn unaligned<'a>(way: &Way<'a>) -> Way<'a> {
    let mut way = way.clone();
    for joint in &mut way.bossed.plan.joints {
        joint.pins.clear();
    }
    way.request.build_volume_mm = Some([1.0; 3]);
    way
}

/// Returns whether a body has a plan whose seams are seen and whose joints are aligned.
fn has_seen_seams(placed: &Placed) -> bool {
    let ladder = ladder_of(placed);
    let usual = unaligned(&usual_of(&ladder));
    let seen = ladder.plan_seen_seams(&usual).unwrap();
    if let Some(seen) = &seen {
        assert_eq!(seen.rung, Rung::SeenSeams);
        assert_eq!(seen.count_unaligned().unwrap(), 0);
        assert!(seen.request.seams.up().is_none(), "nobody looks at them");
    }
    seen.is_some()
}

#[test]
fn seams_are_seen_if_that_aligns_all_joints_for_little() {
    assert!(has_seen_seams(&with_hidden_seams(thick_box())));
    let mut too_dear = with_hidden_seams(thick_box());
    too_dear.policy.aligned_loss_ratio = -1.0;
    assert!(!has_seen_seams(&too_dear));
}

#[test]
fn seams_stay_where_a_person_ordered_them() {
    let mut ordered = with_hidden_seams(thick_box());
    ordered.job.plan = Some(order(vec![across(12.0)]));
    assert!(!has_seen_seams(&ordered));
    assert!(!has_seen_seams(&with_jigs(thick_box())), "all are seen");
}

/// Returns a box whose walls have room for pins only where a slanted cut makes them wide. Its parts
/// just fit on the plate, so that no jig does.
fn thin_box() -> Placed {
    let mut placed = standing(&[cuboid([0.0; 3], [26.0, 26.0, 30.0])], 3.0, LEAN);
    set_plate(&mut placed, [30.0, 30.0, 60.0]);
    forbid_bosses(&mut placed);
    with_hidden_seams(placed)
}

#[test]
fn a_seam_that_nothing_aligns_gives_way_to_one_that_is_seen() {
    let placed = thin_box();
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::SeenSeams, Rung::Bosses]);
    let [seen, usual] = [&candidates[0].opened, &candidates[1].opened];
    let is_level = |opened: &Opened| opened.plan.cuts[0].normal == [0.0, 0.0, 1.0];
    assert!(is_level(usual) && !is_level(seen));
    assert!(seen.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(!usual.plan.joints.iter().all(|joint| joint.is_aligned()));
    let Remark::Pins {
        rung: Rung::SeenSeams,
        lacking: 1,
        joints: 1,
        loss_ratio,
    } = seen.remarks[0]
    else {
        panic!("{:?}", seen.remarks)
    };
    assert!(loss_ratio <= placed.policy.aligned_loss_ratio);
    assert!(!seen.remarks.iter().any(Remark::hides_seams));
}

#[test]
fn seams_are_not_seen_where_jigs_hold_the_joints() {
    let mut placed = thin_box();
    set_plate(&mut placed, [60.0; 3]);
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::Bosses]);
    assert_eq!(count_unaligned_in_best(&candidates).unwrap(), 0);
}
