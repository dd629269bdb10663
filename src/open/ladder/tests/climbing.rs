//! The ladder as a whole: the plans that it gives.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use super::*;
use crate::base::watch::Progress;
use crate::cut::SolidEnd;
use crate::geom::Point;
use crate::job::Effort;
use crate::mesh::primitives;
use crate::open::ladder::joined::Fewer;
use crate::open::scenes::{LOW, along, cut_towers, lopsided, need_jet, order, thick_box};

/// Returns a box so deep for its jet that it takes two cuts to clean it. Pins of 5 mm have no room
/// where these cross.
fn deep_box() -> Placed {
    let mut placed = standing(&[cuboid([0.0; 3], [26.0, 26.0, 40.0])], 1.5, LEAN);
    need_jet(&mut placed, 11.0);
    placed.shop.printer.pin_min_diameter_mm.value = 5.0;
    forbid_bosses(&mut placed);
    placed
}

/// Returns two balls with a neck between them. Pins of 6 mm have room where the balls are wide.
fn dumbbell() -> Placed {
    let ball = |z_mm: f64| primitives::ball(&Point::new(0.0, 0.0, z_mm), 12.0, 2);
    let bodies = [
        cuboid([-4.0, -4.0, -16.0], [4.0, 4.0, -10.0]),
        ball(0.0),
        cuboid([-4.0, -4.0, 10.0], [4.0, 4.0, 24.0]),
        ball(34.0),
    ];
    let mut placed = standing(&bodies, 1.0, LEAN);
    placed.shop.printer.min_opening_mm.value = 2.0;
    placed.shop.printer.pin_min_diameter_mm.value = 6.0;
    placed
}

fn climb_silently(placed: &Placed) -> Vec<Candidate<'_>> {
    ladder_of(placed).climb().unwrap()
}

#[test]
fn pins_stand_in_walls_that_have_room_for_them() {
    let placed = thick_box();
    let candidates = climb_silently(&placed);
    let [only] = &candidates[..] else {
        panic!("{:?}", rungs(&candidates))
    };
    let opened = &only.opened;
    assert_eq!(opened.rung, Rung::Bosses);
    assert!(opened.bosses.is_empty() && opened.remarks.is_empty());
    assert!(opened.plan.joints.iter().all(|joint| joint.is_aligned()));
}

#[test]
fn bosses_stand_where_walls_have_no_room_and_the_plan_without_them_comes_second() {
    let placed = cut_towers(LEAN);
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::Bosses, Rung::Walls]);
    let [bossed, walls] = [&candidates[0].opened, &candidates[1].opened];
    assert_eq!((bossed.bosses.len(), bare_joints(bossed)), (1, 0));
    assert!(bossed.remarks.is_empty());
    assert_eq!((walls.bosses.len(), bare_joints(walls)), (0, 2));
    assert_eq!(walls.remarks, [Remark::SteppedDown(Rung::Walls)]);
}

#[test]
fn a_cut_for_cleaning_alone_is_left_out_and_the_hidden_end_stays_solid() {
    let placed = deep_box();
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::FewerCuts, Rung::Bosses]);
    let [fewer, usual] = [&candidates[0].opened, &candidates[1].opened];
    assert!(fewer.plan.cuts.len() < usual.plan.cuts.len());
    assert!(fewer.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(!fewer.cleaning.is_empty() && usual.cleaning.is_empty());
    let Remark::Pins {
        rung,
        lacking,
        joints,
        loss_ratio,
    } = fewer.remarks[0]
    else {
        panic!("{:?}", fewer.remarks)
    };
    let unaligned = usual.plan.joints.iter().filter(|joint| !joint.is_aligned());
    assert_eq!(rung, Rung::FewerCuts);
    assert_eq!(
        (lacking, joints),
        (unaligned.count(), usual.plan.joints.len())
    );
    assert!(lacking > 0);
    assert!(loss_ratio > 0.0, "{loss_ratio}");
    let [Remark::FewerParts { parts, .. }, stepped] = &usual.remarks[..] else {
        panic!("{:?}", usual.remarks)
    };
    assert_eq!(*parts, [2, usual.plan.count_parts()]);
    assert_eq!(*stepped, Remark::SteppedDown(Rung::Bosses));
}

#[test]
fn a_quick_search_takes_the_first_plan_and_says_what_it_did_not_try() {
    let mut placed = deep_box();
    let longer = placed.clone();
    let normal = climb_silently(&longer);
    placed.job.effort = Effort::Quick;
    let resolver = resolver_of(&placed);
    let budget = resolver.budget().clone();
    let quick = Ladder::new(resolver).unwrap().climb().unwrap();
    assert_eq!(rungs(&quick), [Rung::Bosses]);
    // It is the plan that the longer search found first.
    let cuts = |candidate: &Candidate| candidate.opened.plan.cuts.clone();
    assert_eq!(cuts(&quick[0]), cuts(&normal[1]));
    let expected = Remark::Untried {
        untried: vec![Untried::FewerParts, Untried::MorePins],
        next: Effort::Normal,
    };
    assert_eq!(budget.remark(), Some(expected));
}

#[test]
fn of_two_plans_with_their_pins_the_one_with_fewer_parts_is_taken_if_it_costs_no_more() {
    let mut placed = deep_box();
    placed.policy.part_loss_ratio = 0.0;
    let ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    let walls = usual.clone();
    let draft = ladder.draft_fewer_parts(&usual).unwrap().unwrap();
    let parts = |way: &Way| way.bossed.plan.count_parts();
    let weigh = |limit: f64, offered: f64| {
        let mut ladder = ladder.clone();
        ladder.policy.part_loss_ratio = limit;
        ladder.policy.offered_loss_ratio = offered;
        let fewer = Fewer {
            draft: draft.clone(),
            is_as_good: true,
        };
        let both = (usual.clone(), walls.clone());
        let (taken, _) = ladder.weigh_fewer_parts(both, fewer).unwrap();
        (parts(&taken), ladder.notes)
    };
    let (_, none) = weigh(0.0, 0.0);
    assert!(none.is_empty(), "{none:?}");
    let (dear, offers) = weigh(0.0, 1.0);
    assert_eq!(dear, parts(&usual));
    let dear_offers = offers.clone();
    let [
        Remark::FewerParts {
            parts: [few, many], ..
        },
    ] = offers[..]
    else {
        panic!("{offers:?}")
    };
    assert_eq!((few, many), (2, dear));
    let (cheap, offers) = weigh(1.0, 1.0);
    assert!(cheap == 2 && offers.is_empty());
    // What was offered before is offered no more when a plan with fewer parts is taken.
    let mut ladder = ladder.clone();
    ladder.policy.part_loss_ratio = 1.0;
    ladder.notes = dear_offers;
    let fewer = Fewer {
        draft,
        is_as_good: true,
    };
    ladder.weigh_fewer_parts((usual, walls), fewer).unwrap();
    assert!(ladder.notes.is_empty(), "{:?}", ladder.notes);
}

#[test]
fn a_plan_with_the_fewest_parts_is_sought_beside_many_and_only_there() {
    let placed = deep_box();
    let ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    let few = ladder.draft_fewest_parts(&usual).unwrap().unwrap();
    let parts = [&usual, &few].map(|way| way.bossed.plan.count_parts());
    assert!(parts[0] > 2 && parts[1] == 2, "{parts:?}");
    assert!(ladder.draft_fewest_parts(&few).unwrap().is_none());
}

#[test]
fn fewer_parts_with_pins_come_before_more_without_up_to_a_limit() {
    let mut placed = deep_box();
    placed.policy.aligned_loss_ratio = 1.0;
    let candidates = climb_silently(&placed);
    let best = &candidates[0].opened;
    assert!(best.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert_eq!((best.plan.count_parts(), best.bosses.len()), (2, 0));
    let [Remark::Pins { rung, lacking, .. }] = best.remarks[..] else {
        panic!("{:?}", best.remarks)
    };
    assert!(rung == Rung::FewerCuts && lacking > 0);
}

#[test]
fn cuts_pass_where_the_filled_body_has_room_for_pins() {
    let placed = dumbbell();
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::WideJoints, Rung::Bosses]);
    let [wide, usual] = [&candidates[0].opened, &candidates[1].opened];
    assert!(wide.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(!usual.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(wide.request.wants_wide_joints && !usual.request.wants_wide_joints);
    assert!(wide.plan.cuts[0].normal != usual.plan.cuts[0].normal);
}

#[test]
fn voids_end_before_joints_without_room() {
    let placed = unequal_towers();
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::SolidEnds, Rung::Bosses]);
    let [ended, usual] = [&candidates[0].opened, &candidates[1].opened];
    assert!(ended.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(!usual.plan.joints.iter().all(|joint| joint.is_aligned()));
    assert!(!ended.plan.solid.is_empty() && usual.plan.solid.is_empty());
    let round = &ended.cleaning[0];
    assert!(round.by_plan, "{round:?}");
    let mut causes = round.kept.iter().map(|kept| kept.cause);
    assert!(causes.all(|cause| cause == KeptCause::BeyondJoint));
}

#[test]
fn dear_bosses_are_paid_for_the_joints_that_have_no_cheap_ones() {
    let placed = dear_chimneys(2, 0.35);
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::DearBosses, Rung::Bosses]);
    assert_eq!(candidates.iter().map(bare).collect::<Vec<_>>(), [1, 2]);
}

#[test]
fn if_all_dear_bosses_cost_too_much_some_of_them_are_paid() {
    let placed = dear_chimneys(3, 0.09);
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::SomeBosses, Rung::Bosses]);
    assert_eq!(candidates.iter().map(bare).collect::<Vec<_>>(), [2, 3]);
}

/// Counts the joints of a candidate without any pin.
fn bare(candidate: &Candidate) -> usize {
    bare_joints(&candidate.opened)
}

#[test]
fn ordered_cuts_stay_on_every_rung() {
    let placed = dear_chimneys(2, 0.35);
    let ordered = &placed.job.plan.as_ref().unwrap().cuts;
    let candidates = climb_silently(&placed);
    let mut plans = candidates.iter().map(|candidate| &candidate.opened.plan);
    assert!(plans.all(|plan| plan.cuts == *ordered));
}

#[test]
fn a_fault_on_one_rung_is_told_and_the_others_are_tried() {
    let mut placed = unequal_towers();
    // No plan can be asked for openings of 0 mm.
    placed.policy.spare_opening_ratio = 0.0;
    let candidates = climb_silently(&placed);
    assert_eq!(rungs(&candidates), [Rung::SolidEnds, Rung::Bosses]);
    for candidate in &candidates {
        let Some(Remark::RungFailed { rung, why }) = remarks(candidate).last() else {
            panic!("{:?}", remarks(candidate))
        };
        assert!(
            *rung == Rung::WideJoints && why.contains("min_opening_mm is 0"),
            "{why}"
        );
    }
}

/// Returns a watch that stops the run when it begins its plan of this number, from 0.
fn watch_that_stops_at_plan(number: usize) -> Watch {
    let (stop, plans) = (Arc::new(AtomicBool::new(false)), AtomicUsize::new(0));
    let button = Arc::clone(&stop);
    let press = move |progress: Progress| {
        let begins = progress.phase == Phase::Plan && progress.phase_ratio == 0.0;
        if begins && plans.fetch_add(1, Ordering::Relaxed) == number {
            button.store(true, Ordering::Relaxed);
        }
    };
    Watch::observed_until(press, stop)
}

#[test]
fn a_run_cancelled_on_a_rung_ends_and_is_no_fault() {
    let placed = unequal_towers();
    // The usual plan, that of wide joints, and the first of the last rung.
    for number in 0..3 {
        let watch = watch_that_stops_at_plan(number);
        let resolver = Resolver::new(&placed, solve(&placed), &watch).unwrap();
        let climbed = Ladder::new(resolver).and_then(Ladder::climb);
        assert!(watch.is_cancelled(), "plan {number} was begun");
        assert!(matches!(climbed, Err(Error::Cancelled)), "plan {number}");
    }
}

/// Orders the interior between two heights and two x to stay solid, mm.
fn keep_solid(placed: &mut Placed, [low_mm, high_mm]: [f64; 2], [left_mm, right_mm]: [f64; 2]) {
    let region = SolidEnd {
        at_mm: [(left_mm + right_mm) / 2.0, 7.0, (low_mm + high_mm) / 2.0],
        low_mm: [left_mm, 0.0, low_mm],
        high_mm: [right_mm, 14.0, high_mm],
    };
    placed.job.plan.as_mut().unwrap().solid.push(region);
}

#[test]
fn regions_that_a_person_ordered_stay_solid() {
    let mut placed = cut_towers(LOW);
    forbid_bosses(&mut placed);
    for tower in [[0.0, 14.0], [26.0, 40.0]] {
        keep_solid(&mut placed, [20.0, 24.0], tower);
    }
    let [only] = &climb_silently(&placed)[..] else {
        panic!("there are no bosses to do without")
    };
    let Opened {
        voids,
        plan,
        cleaning,
        remarks,
        ..
    } = &only.opened;
    assert_eq!(plan.solid, placed.job.plan.as_ref().unwrap().solid);
    let mut causes = cleaning[0].kept.iter().map(|kept| kept.cause);
    assert!(causes.all(|cause| cause == KeptCause::Ordered));
    let mut bodies = voids.hollowed.voids.iter();
    assert!(bodies.all(|void| void.mesh().aabb().max.z < 20.0));
    assert!(remarks.is_empty(), "{remarks:?}");
}

#[test]
fn an_order_too_solid_for_the_goal_is_not_followed_and_the_remark_says_so() {
    let mut placed = lopsided();
    placed.job.plan = Some(order(vec![along(23.0)]));
    keep_solid(&mut placed, [0.0, 24.0], [14.0, 28.0]);
    forbid_bosses(&mut placed);
    let candidates = climb_silently(&placed);
    let opened = &candidates[0].opened;
    assert_eq!(opened.remarks, [Remark::OrderTooSolid]);
    assert!(!opened.voids.hollowed.voids.is_empty());
    assert!(opened.plan.solid.is_empty() && opened.cleaning.is_empty());
}
