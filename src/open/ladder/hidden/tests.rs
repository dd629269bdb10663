//! The choice among drafts with hidden seams.

use super::*;
use crate::base::watch::Watch;
use crate::open::resolve::Resolver;
use crate::open::scenes::{solve, thick_box};
use crate::printer::Cleaning;
use crate::run::Placed;

/// Returns a choice from a clean plan with a dear seam. On its printer walls from this angle on
/// hold no support, or all do.
fn choice_from<'a>(usual: &Way<'a>, policy: Policy, overhang_deg: Option<f64>) -> HiddenChoice<'a> {
    let mut usual = usual.clone();
    usual.request.cleaning = Cleaning {
        sight_ratio: 0.95,
        overhang_deg,
        ..Cleaning::MELT_OUT
    };
    HiddenChoice {
        policy,
        usual,
        usual_price: 1.0,
        best: None,
        least_loss_ratio: None,
        unseen: None,
    }
}

/// Returns the same plan with a hidden seam at a price, and a wall that lacks sight.
fn without_sight<'a>(choice: &HiddenChoice<'a>, price: f64) -> Hidden<'a> {
    let mut way = choice.usual.clone();
    for void in &mut way.bossed.plan.voids {
        (void.sight_ratio, void.is_clean) = (0.6, false);
    }
    Hidden {
        way,
        loss_ratio: 0.0,
        price,
    }
}

/// Drafts the usual plan of a placed body and looks at a test's claims about it.
fn with_usual(claim: impl Fn(&Ladder, Way)) {
    let placed: Placed = thick_box();
    let resolver = Resolver::new(&placed, solve(&placed), &Watch::silent()).unwrap();
    let ladder = Ladder::new(resolver).unwrap();
    let (ground, request) = (&ladder.ground, &ladder.request);
    let usual = ladder.plan_in_walls(ground, request, Rung::Walls, &|_| false);
    claim(&ladder, usual.unwrap());
}

#[test]
fn a_plan_without_sight_is_kept_apart_where_steep_walls_hold_no_support() {
    with_usual(|ladder, usual| {
        let mut choice = choice_from(&usual, ladder.policy, Some(45.0));
        for price in [0.4, 0.2, 0.3] {
            assert!(!choice.take(without_sight(&choice, price)));
        }
        assert!(choice.best.is_none());
        assert_eq!(choice.take_unseen().unwrap().price, 0.2, "the best of them");
    });
}

#[test]
fn elsewhere_it_is_not_worth_making() {
    with_usual(|ladder, usual| {
        let mut choice = choice_from(&usual, ladder.policy, None);
        assert!(!choice.take(without_sight(&choice, 0.2)));
        assert!(choice.take_unseen().is_none());
        assert_eq!(choice.least_loss_ratio, Some(0.0));
    });
}

#[test]
fn a_plan_without_sight_must_be_seen_much_less_than_what_was_chosen() {
    with_usual(|ladder, usual| {
        let mut choice = choice_from(&usual, ladder.policy, Some(45.0));
        choice.take(without_sight(
            &choice,
            1.0 - 0.9 * ladder.policy.unseen_gain,
        ));
        assert!(choice.take_unseen().is_none());
    });
}
