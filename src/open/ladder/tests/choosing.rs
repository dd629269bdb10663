//! The choice of rungs, and of plans among what they give.

use super::*;
use crate::cut::CutOrder;
use crate::hollow::Figure;
use crate::job::Job;
use crate::open::scenes::{across, order, thick_box, towers};
use crate::run::BossRound;

/// Gives a plan four joints, so many of which lack pins.
fn lacking<'a>(way: &Way<'a>, rung: Rung, count: usize) -> Way<'a> {
    let mut way = Way {
        rung,
        ..way.clone()
    };
    let mut joint = way.bossed.plan.joints[0].clone();
    (joint.pins, joint.one_way) = (vec!["N1".into(), "N2".into()], true);
    joint.held = true;
    way.bossed.plan.joints = vec![joint; 4];
    for joint in &mut way.bossed.plan.joints[..count] {
        joint.pins.clear();
    }
    way
}

/// Returns the number of a way's figure.
fn value(way: &Way) -> f64 {
    way.bossed.voids.solution.certificate.value
}

/// Sets the number of a way's figure, such as the height of its centre.
fn with_value<'a>(way: &Way<'a>, value: f64) -> Way<'a> {
    let mut way = way.clone();
    way.bossed.voids.solution.certificate.value = value;
    way
}

#[test]
fn a_draft_that_misses_a_promised_angle_gives_way_to_one_that_keeps_it() {
    let mut placed = thick_box();
    placed.request.least_angle_deg = 10.0;
    let mut ladder = ladder_of(&placed);
    let reach = |voids: &mut Voids, angle_deg: f64| {
        let proof = &mut voids.solution.certificate;
        (proof.figure, proof.value) = (Figure::TopplingAngleRad, angle_deg.to_radians());
    };
    (ladder.hides_seams, ladder.joins_parts) = (true, true);
    reach(&mut ladder.ground.voids, 12.0);
    let mut drafted = usual_of(&ladder);
    let mut chosen_deg = |ladder: &Ladder, angle_deg: f64| {
        reach(&mut drafted.bossed.voids, angle_deg);
        let (chosen, missed) = ladder.keep_angle(drafted.clone()).unwrap();
        assert_eq!(missed.is_some(), value(&chosen) != value(&drafted));
        value(&chosen).to_degrees().round()
    };
    assert_eq!(chosen_deg(&ladder, 8.0), 12.0);
    assert_eq!(chosen_deg(&ladder, 11.0), 11.0);
    // What a person ordered stays, and what a tendency asks for.
    let ordered = ladder.by_order(order(vec![across(12.0)]));
    assert_eq!(chosen_deg(&ordered, 8.0), 8.0);
    for tendency in [Tendency::Level, Tendency::Short, Tendency::FewerParts] {
        assert_eq!(chosen_deg(&ladder.leaning(tendency), 8.0), 8.0);
    }
    // So does a draft where no hollowing keeps the promise.
    reach(&mut ladder.ground.voids, 9.0);
    assert_eq!(chosen_deg(&ladder, 8.0), 8.0);
}

#[test]
fn a_full_plan_needs_no_further_rung() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    assert!(usual.is_full());
    for rung in Rung::BEYOND_USUAL {
        assert!(!ladder.needs(rung, &usual, &[]), "{rung:?}");
    }
}

#[test]
fn fewer_cuts_are_tried_only_if_there_are_several() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let mut usual = lacking(&usual_of(&ladder), Rung::Bosses, 1);
    assert!(!ladder.needs(Rung::FewerCuts, &usual, &[]));
    usual.bossed.plan.cuts.push(across(5.0));
    assert!(ladder.needs(Rung::FewerCuts, &usual, &[]));
}

#[test]
fn other_cuts_are_tried_until_a_way_solves_and_not_in_place_of_ordered_ones() {
    let placed = thick_box();
    let free = ladder_of(&placed);
    let mut usual = lacking(&usual_of(&free), Rung::Bosses, 2);
    usual.bossed.plan.cuts.push(across(5.0));
    let solving = lacking(&usual, Rung::FewerCuts, 0);
    let better = lacking(&usual, Rung::FewerCuts, 1);
    for rung in [Rung::WideJoints, Rung::SolidEnds] {
        assert!(free.needs(rung, &usual, &[]));
        assert!(free.needs(rung, &usual, std::slice::from_ref(&better)));
        assert!(!free.needs(rung, &usual, std::slice::from_ref(&solving)));
    }
    let modes = [
        (CutMode::Auto, Some(order(vec![across(12.0)]))),
        (CutMode::Never, None),
    ];
    for (cut, plan) in modes {
        let job = Job {
            cut,
            plan,
            ..placed.job.clone()
        };
        let bound = Placed {
            job,
            ..placed.clone()
        };
        let bound = ladder_of(&bound);
        for rung in [Rung::FewerCuts, Rung::WideJoints, Rung::SolidEnds] {
            assert!(!bound.needs(rung, &usual, &[]), "{rung:?}");
        }
    }
}

#[test]
fn dear_bosses_are_tried_unless_another_way_solves_cheaply() {
    let placed = dear_chimneys(2, 0.35);
    let mut ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    assert!(usual.bossed.has_dear());
    assert!(ladder.needs(Rung::DearBosses, &usual, &[]));
    let solving = lacking(&usual, Rung::WideJoints, 0);
    let solving = with_value(&solving, 0.95 * value(&usual));
    assert!(solving.solves(&usual, &ladder.policy));
    // It leans 5 % less far, more than the limit of 2 %.
    assert!(ladder.needs(Rung::DearBosses, &usual, std::slice::from_ref(&solving)));
    ladder.policy.cheap_loss_ratio = 0.06;
    assert!(!ladder.needs(Rung::DearBosses, &usual, &[solving]));
    // Without bosses refused for their price alone there is nothing to pay.
    let plain = Way {
        bossed: Bossed::without(usual.bossed.voids.clone(), usual.bossed.plan.clone()),
        ..usual.clone()
    };
    assert!(!ladder.needs(Rung::DearBosses, &plain, &[]));
}

#[test]
fn some_bosses_are_tried_only_if_all_dear_ones_are_not_worth_it() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let usual = with_value(&lacking(&usual_of(&ladder), Rung::Bosses, 3), 10.0);
    let dear = lacking(&usual, Rung::DearBosses, 1);
    let [worth, dearer] = [12.0, 15.0].map(|height_mm| with_value(&dear, height_mm));
    assert!(!ladder.needs(Rung::SomeBosses, &usual, &[]));
    assert!(!ladder.needs(Rung::SomeBosses, &usual, &[worth]));
    assert!(ladder.needs(Rung::SomeBosses, &usual, std::slice::from_ref(&dearer)));
    let other = Way {
        rung: Rung::WideJoints,
        ..dearer
    };
    assert!(!ladder.needs(Rung::SomeBosses, &usual, &[other]));
}

#[test]
fn plans_that_are_solved_again_for_pins_get_wider_openings() {
    let placed = towers(LEAN);
    let mut ladder = ladder_of(&placed);
    ladder.policy.spare_opening_ratio = 1.5;
    let usual = usual_of(&ladder);
    let asked_mm = ladder.request.min_opening_mm;
    for (rung, worth_ratio) in [
        (Rung::FewerCuts, 1.0),
        (Rung::WideJoints, ladder.request.worth_ratio),
    ] {
        let found = ladder.try_rung(rung, &usual, &[]).unwrap();
        let request = &found[0].request;
        assert_eq!(request.min_opening_mm, 1.5 * asked_mm);
        assert_eq!(request.worth_ratio, worth_ratio);
        assert_eq!(request.wants_wide_joints, rung == Rung::WideJoints);
        assert_eq!(found[0].rung, rung);
    }
}

#[test]
fn a_rung_without_a_plan_is_no_fault() {
    let placed = towers(LEAN);
    let mut ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    // No void of 12 mm opens by 30 mm, and without any the centre stays where it is.
    ladder.policy.spare_opening_ratio = 10.0;
    let found = ladder.try_rung(Rung::WideJoints, &usual, &[]).unwrap();
    assert!(
        found
            .iter()
            .all(|way| way.bossed.voids.hollowed.voids.is_empty())
    );
}

#[test]
fn voids_are_ended_as_often_as_the_policy_says() {
    let placed = unequal_towers();
    let mut ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    for (max_ends, expected) in [(0, 0), (1, 1), (3, 2)] {
        ladder.policy.max_ends = max_ends;
        let ended = ladder.end_voids_of(&usual).unwrap();
        assert_eq!(ended.len(), expected);
        let is_last_full = ended.last().is_none_or(Way::is_full);
        assert_eq!(is_last_full, max_ends != 1, "one end is not enough");
    }
}

#[test]
fn ends_of_voids_get_the_margin_of_the_policy() {
    let placed = unequal_towers();
    let mut ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    ladder.policy.max_ends = 1;
    let mut low_mm = |margin_openings: f64| {
        ladder.policy.ends_margin_openings = margin_openings;
        let ended = ladder.end_voids_of(&usual).unwrap();
        ended[0].bossed.plan.solid[0].low_mm[2]
    };
    let [tight_mm, wide_mm] = [0.0, 1.0].map(&mut low_mm);
    let opening_mm = usual.request.min_opening_mm;
    assert!((tight_mm - wide_mm - opening_mm).abs() < 1e-9);
}

#[test]
fn the_best_way_leaves_the_fewest_joints_without_pins_and_then_costs_least() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let usual = with_value(&lacking(&usual_of(&ladder), Rung::Bosses, 3), 10.0);
    let way = |rung: Rung, count: usize, height_mm: f64| {
        with_value(&lacking(&usual, rung, count), height_mm)
    };
    let cheapest = || way(Rung::FewerCuts, 2, 9.0);
    let cheaper = || way(Rung::WideJoints, 1, 11.0);
    let dearer = || way(Rung::DearBosses, 1, 12.0);
    // Pins in all joints at twice the height are beyond every limit.
    let too_dear = || way(Rung::SolidEnds, 0, 20.0);
    let best = |ways| ladder.best(&usual, ways).map(|way| way.rung);
    let all = || vec![too_dear(), cheapest(), dearer(), cheaper()];
    assert_eq!(best(all()), Some(Rung::WideJoints));
    assert_eq!(best(vec![dearer(), cheapest()]), Some(Rung::DearBosses));
    assert_eq!(best(vec![too_dear()]), None, "nothing is worth it");
    let no_better = way(Rung::WideJoints, 3, 8.0);
    assert_eq!(best(vec![no_better]), None, "it has no more pins");
}

#[test]
fn the_best_plan_comes_first_then_the_usual_one_then_the_one_without_bosses() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let walls = usual_of(&ladder);
    let usual = with_round(&lacking(&walls, Rung::Bosses, 2));
    let best = lacking(&walls, Rung::WideJoints, 1);
    let price = best.price(&usual);
    let walls = Way {
        rung: Rung::Walls,
        ..walls
    };
    let all = ladder.candidates(Some(best), usual, walls, vec![fault()]);
    assert_eq!(rungs(&all), [Rung::WideJoints, Rung::Bosses, Rung::Walls]);
    let stepped = Remark::SteppedDown;
    assert_eq!(remarks(&all[0]), [price, fault()]);
    assert_eq!(remarks(&all[1]), [stepped(Rung::Bosses), fault()]);
    assert_eq!(remarks(&all[2]), [stepped(Rung::Walls), fault()]);
}

#[test]
fn a_usual_plan_without_bosses_comes_alone_and_steps_down_from_nothing() {
    let placed = thick_box();
    let ladder = ladder_of(&placed);
    let usual = usual_of(&ladder);
    let all = ladder.candidates(None, usual.clone(), usual, Vec::new());
    assert_eq!(rungs(&all), [Rung::Bosses]);
    assert!(remarks(&all[0]).is_empty());
}

#[test]
fn ordered_pins_leave_one_candidate_whatever_it_breaks() {
    let mut placed = thick_box();
    placed.job.plan = Some(CutOrder {
        pins: Some(Vec::new()),
        ..order(vec![across(12.0)])
    });
    let ladder = ladder_of(&placed);
    let usual = with_round(&usual_of(&ladder));
    let best = lacking(&usual, Rung::DearBosses, 0);
    let all = ladder.candidates(Some(best), usual.clone(), usual, Vec::new());
    assert_eq!(rungs(&all), [Rung::DearBosses]);
}

/// Returns a fault of a rung.
fn fault() -> Remark {
    Remark::RungFailed {
        rung: Rung::SolidEnds,
        why: "a test says so".into(),
    }
}

/// Adds a round of bosses without any.
fn with_round<'a>(way: &Way<'a>) -> Way<'a> {
    let mut way = way.clone();
    let certificate = way.bossed.voids.solution.certificate;
    way.bossed.rounds.push(BossRound {
        bosses: Vec::new(),
        kept_mm3: 0.0,
        before: certificate,
        after: certificate,
    });
    way
}
