//! Bosses on towers and chimneys: who gets them, at which price, and what is said of the rest.

use super::*;
use crate::cut::{Obstacle, PartId};
use crate::open::scenes::{
    LEAN, chimneys, cuboid, cut_towers, lopsided, plan_walls, thick_box, volume_mm3,
};
use crate::open::way::Way;
use crate::run::Placed;

/// Least step between two ratios that a limit must tell apart.
const STEP: f64 = 1e-12;

/// Returns the plan of a scene with its bosses.
fn with_bosses(placed: &Placed) -> Way<'_> {
    let mut way = plan_walls(placed);
    way.bossed = add_bosses(&mut way.resolver, way.bossed, &way.request).unwrap();
    way
}

/// Pays for what is too dear in a way.
fn pay(mut way: Way, max_loss_ratio: f64) -> Bossed {
    let paid = pay_for_bosses(&mut way.resolver, way.bossed, &way.request, max_loss_ratio);
    paid.unwrap()
}

/// Returns the number of bosses of each round.
fn round_sizes(bossed: &Bossed) -> Vec<usize> {
    let rounds = bossed.rounds.iter();
    rounds.map(|round| round.bosses.len()).collect()
}

/// Returns why joints got no bosses.
fn reasons(bossed: &Bossed) -> Vec<Refusal> {
    let remarks = bossed.remarks().into_iter();
    let reason = |remark| match remark {
        Remark::NoBosses { why, .. } => Some(why),
        _ => None,
    };
    remarks.filter_map(reason).collect()
}

/// Returns the chimneys with a limit on what their bosses may cost.
fn chimneys_with(cheap_loss_ratio: f64) -> Placed {
    let mut placed = chimneys(2);
    placed.policy.cheap_loss_ratio = cheap_loss_ratio;
    placed
}

/// Returns the towers with a limit on the share of voids that bosses may fill.
fn towers_with(max_void_loss_ratio: f64) -> Placed {
    let mut placed = cut_towers(LEAN);
    placed.policy.max_void_loss_ratio = max_void_loss_ratio;
    placed
}

#[test]
fn all_joints_get_their_bosses_at_once_if_nothing_else_must_be_solid() {
    let placed = cut_towers(LEAN);
    let walls = plan_walls(&placed);
    assert_eq!(walls.lacking(), [2, 2]);
    let way = with_bosses(&placed);
    assert_eq!(way.lacking(), [0, 0]);
    assert_eq!(round_sizes(&way.bossed), [4]);
    assert!(way.bossed.remarks().is_empty() && !way.bossed.has_dear());
    let round = &way.bossed.rounds[0];
    assert!(round.kept_mm3 > 0.0 && round.kept_mm3 == way.resolver.bosses_mm3());
    assert!(volume_mm3(&way.bossed.voids) < volume_mm3(&walls.bossed.voids));
}

#[test]
fn joints_get_their_bosses_one_by_one_if_all_at_once_fill_too_much() {
    let before = Achieved::of(&plan_walls(&cut_towers(LEAN)).bossed.voids);
    let all = Achieved::of(&with_bosses(&cut_towers(LEAN)).bossed.voids);
    // Each half fills more than half of that of what the other has left.
    let placed = towers_with(0.7 * before.filled_ratio(&all));
    let way = with_bosses(&placed);
    assert_eq!(round_sizes(&way.bossed), [2, 2]);
    assert_eq!(way.lacking(), [0, 0]);
}

#[test]
fn bosses_that_fill_too_much_are_refused_and_the_reason_is_told() {
    let placed = towers_with(0.0);
    let way = with_bosses(&placed);
    assert_eq!(way.lacking(), [2, 2]);
    let reasons = reasons(&way.bossed);
    assert_eq!(reasons.len(), 2);
    let is_told = |why: &Refusal| matches!(why, Refusal::FillVoids { ratio } if *ratio > 0.0);
    assert!(reasons.iter().all(is_told), "{reasons:?}");
    assert!(!way.bossed.has_dear(), "no price buys them");
}

#[test]
fn refused_patterns_are_remembered_until_the_joint_is_given_up() {
    for patterns in [1, 3] {
        let mut placed = towers_with(0.0);
        placed.policy.boss_rounds = 1;
        placed.policy.boss_patterns = patterns;
        let failed = with_bosses(&placed).bossed.failed;
        // Two joints with two pins each.
        assert_eq!(failed.places.len(), 4 * patterns);
        assert_eq!(failed.given_up.len(), 2);
        let mut places = failed.places;
        places.sort_by(|a, b| a.partial_cmp(b).unwrap());
        let is_new = |pair: &[[f64; 3]]| pair[0] != pair[1];
        assert!(
            places.windows(2).all(is_new),
            "a refused place is tried again"
        );
    }
}

#[test]
fn no_bosses_are_looked_for_beyond_the_rounds() {
    let mut placed = cut_towers(LEAN);
    placed.policy.boss_patterns = 1;
    for (rounds, found) in [(0, 0), (1, 4)] {
        placed.policy.boss_rounds = rounds;
        assert_eq!(with_bosses(&placed).bossed.held.len(), found);
    }
}

#[test]
fn a_refused_attempt_leaves_everything_as_it_was() {
    let placed = towers_with(0.0);
    let mut way = plan_walls(&placed);
    let columns = way.resolver.solved().columns.moments();
    let before = way.bossed.clone();
    let mut search = Search::new(&mut way.resolver, way.bossed, &way.request);
    let found = search.find().unwrap();
    assert_eq!(found.len(), 4);
    let price = Price::cheap(&search.policy);
    let Verdict::No(refusal) = search.attempt(&found, price).unwrap() else {
        panic!("nothing may be filled")
    };
    assert!(matches!(refusal, Refusal::FillVoids { .. }));
    assert_eq!(search.state.voids.hollowed, before.voids.hollowed);
    assert_eq!(search.state.voids.solution, before.voids.solution);
    assert_eq!(search.state.plan, before.plan);
    assert!(search.state.rounds.is_empty() && search.state.held.is_empty());
    assert_eq!(search.resolver.bosses_mm3(), 0.0);
    assert_eq!(search.resolver.solved().columns.moments(), columns);
}

#[test]
fn a_boss_that_would_unbalance_the_body_is_told_as_such() {
    let pin = plan_walls(&thick_box()).bossed.plan.pins[0].clone();
    let boss = Boss {
        pin,
        parts: [PartId::of(0), PartId::of(1)],
        // All of the tower whose void balances the body.
        body: cuboid([13.0, -1.0, 3.0], [29.0, 15.0, 25.0]),
        is_new: true,
    };
    let placed = lopsided();
    let mut way = plan_walls(&placed);
    let mut search = Search::new(&mut way.resolver, way.bossed, &way.request);
    search.try_found(&[boss]).unwrap();
    assert_eq!(reasons(&search.state), [Refusal::MakeGoalImpossible]);
}

/// Looks for bosses at no more than this cost beside them.
fn search_up_to(mut way: Way, cheap_loss_ratio: f64) -> Bossed {
    let mut search = Search::new(&mut way.resolver, way.bossed, &way.request);
    search.policy.cheap_loss_ratio = cheap_loss_ratio;
    search.run().unwrap();
    search.state
}

#[test]
fn bosses_beside_which_more_is_solid_are_taken_up_to_the_cheap_limit_and_no_further() {
    let placed = chimneys(2);
    let walls = plan_walls(&placed);
    let dear = search_up_to(walls.clone(), 0.0);
    assert!(dear.has_dear() && dear.rounds.is_empty());
    let loss_ratio = cheapest(&dear);
    assert!((0.01..0.2).contains(&loss_ratio), "{loss_ratio}");
    let taken = search_up_to(walls, loss_ratio);
    assert_eq!(round_sizes(&taken), [1], "the other chimney stays open");
    assert!(!taken.has_dear());
}

/// Returns the least cost for which bosses were refused.
fn cheapest(bossed: &Bossed) -> f64 {
    let losses = reasons(bossed).into_iter().filter_map(Refusal::loss_ratio);
    losses.fold(f64::INFINITY, f64::min)
}

#[test]
fn what_is_dear_is_paid_up_to_the_given_price_and_no_further() {
    let placed = chimneys_with(0.0);
    let way = with_bosses(&placed);
    let loss_ratio = cheapest(&way.bossed);
    let refused = pay(way.clone(), loss_ratio - STEP);
    assert!(refused.rounds.is_empty() && refused.has_dear());
    let paid = pay(way.clone(), loss_ratio);
    assert_eq!(round_sizes(&paid), [1]);
    let lost = way.bossed.baseline.loss_ratio(&Achieved::of(&paid.voids));
    assert!(lost <= loss_ratio, "{lost}");
    // The other chimney is the last opening now.
    let reasons = reasons(&paid);
    assert!(
        matches!(reasons[..], [Refusal::FillVoids { .. }]),
        "{reasons:?}"
    );
}

#[test]
fn ordered_pins_get_their_bosses_at_the_price_of_ordered_ones() {
    let free = chimneys_with(0.0);
    let paid = pay(with_bosses(&free), 0.65);
    let mut placed = chimneys_with(0.0);
    placed.job.plan = Some(CutOrder::of(&paid.plan));
    let way = with_bosses(&placed);
    assert_eq!(way.bossed.plan.pins.len(), 1);
    assert_eq!(round_sizes(&way.bossed), [1]);

    placed.policy.ordered_loss_ratio = 0.0;
    let mut walls = plan_walls(&placed);
    let refused = add_bosses(&mut walls.resolver, walls.bossed, &walls.request);
    let Err(Error::Cut(CutError::Obstacle(obstacle))) = refused else {
        panic!("the error names the pin that has no place")
    };
    assert!(
        matches!(obstacle, Obstacle::PinOffFace { .. }),
        "{obstacle}"
    );
}

#[test]
fn bosses_bear_the_names_of_their_pins_in_the_plan() {
    let placed = cut_towers(LEAN);
    let mut bossed = with_bosses(&placed).bossed;
    bossed.name_pins();
    let named = bossed.rounds.iter().flat_map(|round| &round.bosses);
    let mut count = 0;
    for boss in named {
        let own = bossed.plan.pins.iter().find(|pin| pin.id == boss.pin.id);
        assert_eq!(own.unwrap().center_mm, boss.pin.center_mm);
        count += 1;
    }
    assert_eq!(count, 4);
}
