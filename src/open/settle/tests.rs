//! Settling on two towers: what is kept solid beside bosses, and each limit from both sides.

use super::*;
use crate::cut::{PinSite, UncutFace};
use crate::open::scenes::{
    LEAN, across, along, draw, lopsided, order, plan_walls, thick_box, towers, unwatched,
};
use crate::run::Placed;

/// Least step between two ratios that a limit must tell apart.
const STEP: f64 = 1e-12;

/// The terms that a test changes.
struct Trial {
    order: CutOrder,
    is_ordered: bool,
    rounds: usize,
    must_be_clean: bool,
    max_loss_ratio: f64,
}

impl Trial {
    /// Returns terms that allow any loss.
    fn of(order: CutOrder, rounds: usize) -> Self {
        Self {
            order,
            is_ordered: false,
            rounds,
            must_be_clean: true,
            max_loss_ratio: f64::INFINITY,
        }
    }

    /// Settles a scene's voids as they are drawn first.
    fn settle(&self, placed: &Placed) -> Result<Verdict<Settled, Refusal>, Error> {
        let (mut resolver, voids) = draw(placed);
        let terms = Terms {
            order: &self.order,
            is_ordered: self.is_ordered,
            request: &unwatched(placed),
            rounds: self.rounds,
            must_be_clean: self.must_be_clean,
            before: Achieved::of(&voids),
            start: Achieved::of(&voids),
            max_price_ratio: f64::INFINITY,
            max_loss_ratio: self.max_loss_ratio,
        };
        settle(&mut resolver, voids, &terms)
    }

    fn refusal(&self, placed: &Placed) -> Option<Refusal> {
        match self.settle(placed).unwrap() {
            Verdict::Found(_) => None,
            Verdict::No(refusal) => Some(refusal),
        }
    }
}

/// Cuts the left tower alone, so that the right one's void stays closed.
fn left_cut() -> CutOrder {
    order(vec![along(7.0)])
}

/// Returns the towers with a limit on the share of the voids that may become solid.
fn towers_with(max_void_loss_ratio: f64) -> Placed {
    let mut placed = towers(LEAN);
    placed.policy.max_void_loss_ratio = max_void_loss_ratio;
    placed
}

#[test]
fn a_void_that_no_ordered_cut_meets_is_kept_solid() {
    let placed = towers_with(1.0);
    let settled = Trial::of(left_cut(), 1).settle(&placed).unwrap();
    let settled = settled.found().unwrap();
    let [void] = &settled.voids.hollowed.voids[..] else {
        panic!("{} voids", settled.voids.hollowed.voids.len())
    };
    assert!(void.mesh().aabb().max.x < 14.0);
    assert_eq!(settled.plan.voids.len(), 1);
}

#[test]
fn without_a_round_left_nothing_more_is_kept_solid() {
    let refusal = Trial::of(left_cut(), 0).refusal(&towers_with(1.0));
    assert_eq!(refusal, Some(Refusal::LeaveUncleanVoid));
}

#[test]
fn what_is_kept_solid_beside_bosses_may_fill_its_share_of_the_voids_and_no_more() {
    let trial = Trial::of(left_cut(), 1);
    let Some(Refusal::FillVoids { ratio }) = trial.refusal(&towers_with(0.1)) else {
        panic!("one of two voids is more than a tenth")
    };
    assert!((0.4..0.7).contains(&ratio), "{ratio}");
    assert_eq!(trial.refusal(&towers_with(ratio)), None);
    let refused = trial.refusal(&towers_with(ratio - STEP));
    assert_eq!(refused, Some(Refusal::FillVoids { ratio }));
}

#[test]
fn what_is_kept_solid_beside_bosses_may_cost_the_limit_and_no_more() {
    let placed = towers_with(1.0);
    let with_limit = |max_loss_ratio| Trial {
        max_loss_ratio,
        ..Trial::of(left_cut(), 1)
    };
    let Some(Refusal::CostTooMuch { loss_ratio }) = with_limit(0.0).refusal(&placed) else {
        panic!("a tower without void leans less far")
    };
    assert!(loss_ratio > 0.01, "{loss_ratio}");
    assert_eq!(with_limit(loss_ratio).refusal(&placed), None);
    let refused = with_limit(loss_ratio - STEP).refusal(&placed);
    assert_eq!(refused, Some(Refusal::CostTooMuch { loss_ratio }));
}

#[test]
fn bosses_beside_which_nothing_is_kept_solid_are_not_asked_for_their_cost() {
    let trial = Trial {
        max_loss_ratio: -1.0,
        ..Trial::of(order(vec![along(7.0), along(33.0)]), 1)
    };
    assert_eq!(trial.refusal(&towers_with(1.0)), None);
}

#[test]
fn a_void_that_balances_the_body_cannot_be_kept_solid() {
    let mut placed = lopsided();
    placed.policy.max_void_loss_ratio = 1.0;
    // The cut passes beside the tower with the void.
    let refusal = Trial::of(order(vec![along(34.0)]), 1).refusal(&placed);
    assert_eq!(refusal, Some(Refusal::MakeGoalImpossible));
}

#[test]
fn narrow_voids_are_kept_solid_only_if_all_must_be_clean() {
    let mut placed = towers_with(0.9);
    // No cut opens a void of 12 mm so wide, but it is drawn.
    placed.shop.printer.min_opening_mm.value = 11.0;
    let (mut resolver, voids) = draw(&placed);
    let request = PlanRequest {
        min_opening_mm: 13.0,
        ..unwatched(&placed)
    };
    let order = order(vec![across(18.0)]);
    for (must_be_clean, expected) in [
        (true, Some(Refusal::FillVoids { ratio: 1.0 })),
        (false, None),
    ] {
        let terms = Terms {
            order: &order,
            is_ordered: false,
            request: &request,
            rounds: 1,
            must_be_clean,
            before: Achieved::of(&voids),
            start: Achieved::of(&voids),
            max_price_ratio: f64::INFINITY,
            max_loss_ratio: f64::INFINITY,
        };
        let settled = settle(&mut resolver, voids.clone(), &terms).unwrap();
        let refusal = match settled {
            Verdict::Found(_) => None,
            Verdict::No(refusal) => Some(refusal),
        };
        assert_eq!(refusal, expected, "{must_be_clean}");
    }
}

/// Returns a cut of the thick box that leaves its face whole.
fn uncut_order() -> CutOrder {
    let cut = across(10.0);
    let face = UncutFace {
        cut: cut.id.clone(),
        point_mm: [2.5, 2.5, 10.0],
    };
    CutOrder {
        uncut: vec![face],
        ..order(vec![cut])
    }
}

#[test]
fn a_void_behind_a_face_that_stays_whole_is_closed() {
    let refusal = Trial::of(uncut_order(), 1).refusal(&thick_box());
    assert_eq!(refusal, Some(Refusal::CloseVoid));
}

/// Returns the order of a scene's plan with its first pin moved off the body.
fn order_with_pin_off_face(placed: &Placed) -> CutOrder {
    let plan = plan_walls(placed).bossed.plan;
    let pin = PinSite {
        center_mm: [-50.0; 3],
        ..plan.pins[0].clone()
    };
    CutOrder {
        pins: Some(vec![pin]),
        ..CutOrder::of(&plan)
    }
}

#[test]
fn a_pin_without_its_face_is_refused_unless_a_person_ordered_it() {
    let placed = thick_box();
    let mut trial = Trial::of(order_with_pin_off_face(&placed), 1);
    assert_eq!(trial.refusal(&placed), Some(Refusal::MoveJoint));
    trial.is_ordered = true;
    let Err(Error::Cut(CutError::Obstacle(obstacle))) = trial.settle(&placed) else {
        panic!("the error names the pin")
    };
    assert!(matches!(obstacle, Obstacle::PinOffFace { .. }));
}

#[test]
fn a_cancelled_run_settles_nothing() {
    let placed = thick_box();
    let (mut resolver, voids) = draw(&placed);
    let terms = Terms {
        order: &CutOrder::default(),
        is_ordered: false,
        request: &unwatched(&placed),
        rounds: 1,
        must_be_clean: true,
        before: Achieved::of(&voids),
        start: Achieved::of(&voids),
        max_price_ratio: f64::INFINITY,
        max_loss_ratio: 1.0,
    };
    resolver.watch().cancel();
    let settled = settle(&mut resolver, voids, &terms);
    assert!(matches!(settled, Err(Error::Cancelled)));
}

#[test]
fn bosses_that_cost_more_than_joints_may_are_refused_before_anything_is_planned() {
    let placed = thick_box();
    let (mut resolver, voids) = draw(&placed);
    let terms = Terms {
        order: &order(vec![across(18.0)]),
        is_ordered: false,
        request: &unwatched(&placed),
        rounds: 0,
        must_be_clean: false,
        before: Achieved::of(&voids),
        start: Achieved::of(&voids),
        max_price_ratio: -STEP,
        max_loss_ratio: f64::INFINITY,
    };
    let settled = settle(&mut resolver, voids, &terms).unwrap();
    let Verdict::No(refusal) = settled else {
        panic!("a price above the limit is paid")
    };
    assert_eq!(refusal, Refusal::CostTooMuch { loss_ratio: 0.0 });
}
