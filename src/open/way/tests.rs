//! The rank of a way among others, at the limits of the policy.

use super::*;
use crate::cut::PinId;
use crate::hollow::{Figure, Status};
use crate::open::scenes::{plan_walls, thick_box};

/// Least step between two numbers near 1 that a limit must tell apart.
const STEP: f64 = 1e-9;

/// Sets the number of a way's figure; its centre of mass is the better the lower it is.
fn with_height<'a>(way: &Way<'a>, height_mm: f64) -> Way<'a> {
    let mut way = way.clone();
    way.bossed.voids.solution.certificate.value = height_mm;
    way
}

/// Takes pins out of the way's one joint, so that so many are left.
fn with_pins<'a>(way: &Way<'a>, count: usize, one_way: bool) -> Way<'a> {
    let mut way = way.clone();
    let joint = &mut way.bossed.plan.joints[0];
    joint.pins = (0..count).map(|_| PinId::from("N1")).collect();
    joint.one_way = one_way;
    joint.held = true;
    way
}

#[test]
fn a_joint_lacks_pins_unless_two_of_them_fit_one_way_only() {
    let placed = thick_box();
    let way = plan_walls(&placed);
    for (count, one_way, lacking) in [
        (0, false, [1, 1]),
        (1, true, [1, 0]),
        (2, false, [1, 0]),
        (2, true, [0, 0]),
    ] {
        let way = with_pins(&way, count, one_way);
        assert_eq!(way.lacking(), lacking, "{count} pins, {one_way}");
        assert_eq!(way.is_full(), lacking == [0, 0]);
    }
}

#[test]
fn a_way_loses_if_its_figure_is_worse_than_the_usual_one_whichever_sign_is_worse() {
    let placed = thick_box();
    let usual = with_height(&plan_walls(&placed), 10.0);
    assert_eq!(with_height(&usual, 12.0).loss_ratio(&usual), 0.2);
    assert_eq!(with_height(&usual, 8.0).loss_ratio(&usual), -0.2);
    let mut angle = usual.clone();
    angle.bossed.voids.solution.certificate.figure = Figure::TopplingAngleRad;
    assert_eq!(with_height(&angle, 8.0).loss_ratio(&angle), 0.2);
}

#[test]
fn pins_in_every_joint_may_cost_the_dear_limit_and_no_more() {
    let placed = thick_box();
    let usual = with_height(&plan_walls(&placed), 8.0);
    let way = with_height(&usual, 12.0);
    let with_limit = |dear_loss_ratio| Policy {
        dear_loss_ratio,
        partial_loss_ratio: 0.0,
        ..Policy::STANDARD
    };
    assert!(way.is_worth(&usual, &with_limit(0.5)));
    assert!(way.solves(&usual, &with_limit(0.5)));
    assert!(!way.is_worth(&usual, &with_limit(0.5 - STEP)));
}

#[test]
fn pins_in_some_joints_may_cost_the_partial_limit_and_no_more() {
    let placed = thick_box();
    let usual = with_pins(&with_height(&plan_walls(&placed), 8.0), 0, false);
    let way = with_height(&usual, 10.0);
    let with_limit = |partial_loss_ratio| Policy {
        partial_loss_ratio,
        dear_loss_ratio: 9.0,
        ..Policy::STANDARD
    };
    assert!(way.is_worth(&usual, &with_limit(0.25)));
    assert!(!way.is_worth(&usual, &with_limit(0.25 - STEP)));
    assert!(
        !way.solves(&usual, &with_limit(0.25)),
        "its joint lacks pins"
    );
}

#[test]
fn pins_may_fill_the_stated_share_of_the_voids_and_no_more() {
    let placed = thick_box();
    let usual = plan_walls(&placed);
    let mut way = usual.clone();
    way.bossed.voids.hollowed.voids.clear();
    let with_limit = |max_void_loss_ratio| Policy {
        max_void_loss_ratio,
        ..Policy::STANDARD
    };
    assert!(way.is_worth(&usual, &with_limit(1.0)));
    assert!(!way.is_worth(&usual, &with_limit(1.0 - STEP)));
}

#[test]
fn what_the_usual_way_cleans_every_worthy_way_cleans() {
    let placed = thick_box();
    let usual = plan_walls(&placed);
    let mut dirty = usual.clone();
    dirty.bossed.plan.voids[0].is_clean = false;
    assert!(!dirty.is_worth(&usual, &Policy::STANDARD));
    assert!(usual.is_worth(&dirty, &Policy::STANDARD));
    assert!(dirty.is_worth(&dirty.clone(), &Policy::STANDARD));
}

#[test]
fn a_way_without_a_usable_solution_is_worth_nothing() {
    let placed = thick_box();
    let usual = plan_walls(&placed);
    let mut way = usual.clone();
    way.bossed.voids.solution.status = Status::CannotStand {
        greatest_angle_rad: -0.1,
    };
    assert!(usual.is_worth(&usual, &Policy::STANDARD));
    assert!(!way.is_worth(&usual, &Policy::STANDARD));
}

#[test]
fn the_price_tells_what_the_usual_way_lacked() {
    let placed = thick_box();
    let full = with_height(&plan_walls(&placed), 12.0);
    let mut usual = with_pins(&with_height(&full, 10.0), 1, false);
    usual
        .bossed
        .plan
        .joints
        .push(full.bossed.plan.joints[0].clone());
    let price = Way {
        rung: Rung::WideJoints,
        ..full
    }
    .price(&usual);
    let expected = Remark::Pins {
        rung: Rung::WideJoints,
        lacking: 1,
        joints: 2,
        loss_ratio: 0.2,
    };
    assert_eq!(price, expected);
}

#[test]
fn no_way_is_worth_an_angle_that_is_promised_and_that_the_usual_way_keeps() {
    let mut placed = thick_box();
    placed.request.least_angle_deg = 10.0;
    let policy = Policy::STANDARD;
    let mut angle = plan_walls(&placed);
    angle.bossed.voids.solution.certificate.figure = Figure::TopplingAngleRad;
    let reaching = |angle_deg: f64| with_height(&angle, angle_deg.to_radians());
    let [usual, kept, near, lost] = [10.5, 10.3, 10.1, 9.7].map(reaching);
    // A usual way that just keeps it is kept, too.
    assert!(near.is_worth(&near.clone(), &policy) && !lost.is_worth(&near, &policy));
    assert!(kept.is_worth(&usual, &policy) && kept.hides_worth(&usual, &policy));
    // The written parts have a little less than the copy.
    for way in [near, lost.clone()] {
        assert!(!way.is_worth(&usual, &policy) && !way.hides_worth(&usual, &policy));
    }
    // Where the usual way misses it too, the other is worth its seams.
    let missed = reaching(9.9);
    assert!(lost.hides_worth(&missed, &policy));
}
