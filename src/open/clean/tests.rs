//! Cleaning on towers and a box: what no cut lets be cleaned stays solid, and rounds end.

use super::*;
use crate::base::watch::Watch;
use crate::cut::{CutOrder, SeamStyle, Seams, UncleanCause};
use crate::geom::Vector;
use crate::open::plan::are_clean;
use crate::open::scenes::{
    LEAN, along, cuboid, draw, lopsided, need_jet, standing, towers, unwatched, volume_mm3,
};

/// Returns a wide and a narrow tower on a solid bar.
fn unequal_towers() -> Placed {
    let bodies = [
        cuboid([0.0, 0.0, 0.0], [14.0, 14.0, 24.0]),
        cuboid([13.0, 5.0, 0.0], [27.0, 9.0, 4.0]),
        cuboid([26.0, 3.0, 0.0], [34.0, 11.0, 24.0]),
    ];
    standing(&bodies, 1.0, LEAN)
}

/// Returns a box whose walls a jet of 6 mm reaches from no single cut.
fn deep_box() -> Placed {
    let mut placed = standing(&[cuboid([0.0; 3], [20.0, 20.0, 24.0])], 1.5, LEAN);
    need_jet(&mut placed, 6.0);
    // No further cut is made for cleaning alone.
    placed.policy.cut_worth_ratio = 1.0;
    placed
}

fn clean_up(placed: &Placed) -> Cleaned {
    let (mut resolver, voids) = draw(placed);
    clean(&mut resolver, Start::of(voids), &unwatched(placed), &|_| {
        false
    })
    .unwrap()
}

/// Returns the request for openings that the narrow tower is too narrow for.
fn wide_request(placed: &Placed) -> PlanRequest {
    PlanRequest {
        min_opening_mm: 10.0,
        ..unwatched(placed)
    }
}

/// Returns the parts of the interior between two heights.
fn storey(low_mm: f64, high_mm: f64, [left_mm, right_mm]: [f64; 2]) -> SolidEnd {
    SolidEnd {
        at_mm: [(left_mm + right_mm) / 2.0, 7.0, (low_mm + high_mm) / 2.0],
        low_mm: [left_mm, 0.0, low_mm],
        high_mm: [right_mm, 14.0, high_mm],
    }
}

#[test]
fn voids_that_can_be_cleaned_stay_as_they_are() {
    let placed = towers(LEAN);
    let before = draw(&placed).1;
    let cleaned = clean_up(&placed);
    assert!(cleaned.rounds.is_empty() && are_clean(&cleaned.plan, &unwatched(&placed)));
    assert_eq!(volume_mm3(&cleaned.voids), volume_mm3(&before));
}

#[test]
fn a_void_that_no_cut_opens_wide_enough_is_kept_solid() {
    let placed = unequal_towers();
    let (mut resolver, voids) = draw(&placed);
    assert_eq!(voids.hollowed.voids.len(), 2);
    let cleaned = clean(
        &mut resolver,
        Start::of(voids),
        &wide_request(&placed),
        &|_| false,
    )
    .unwrap();
    let [round] = &cleaned.rounds[..] else {
        panic!("{:?}", cleaned.rounds)
    };
    let causes: Vec<KeptCause> = round.kept.iter().map(|kept| kept.cause).collect();
    assert_eq!(causes, [KeptCause::Unopenable]);
    assert!(!round.by_plan && round.value_after < Some(round.value_before));
    let [void] = &cleaned.voids.hollowed.voids[..] else {
        panic!("the wide tower stays hollow")
    };
    assert!(void.mesh().aabb().max.x < 14.0);
}

#[test]
fn a_void_that_the_goal_needs_is_not_kept_solid_and_its_obstacle_is_told() {
    let placed = lopsided();
    let (mut resolver, voids) = draw(&placed);
    let columns = resolver.solved().columns.moments().volume();
    let request = PlanRequest {
        min_opening_mm: 20.0,
        ..unwatched(&placed)
    };
    let Err(Error::Cut(CutError::Obstacle(obstacle))) =
        clean(&mut resolver, Start::of(voids), &request, &|_| false)
    else {
        panic!("no cut opens a tower of 14 mm by 20 mm")
    };
    assert!(matches!(obstacle, Obstacle::Unopenable { .. }));
    let after = resolver.solved().columns.moments().volume();
    assert_eq!(after, columns, "the round is undone");
}

#[test]
fn hidden_ends_are_kept_solid_until_the_rest_is_clean() {
    let placed = deep_box();
    let cleaned = clean_up(&placed);
    assert!(are_clean(&cleaned.plan, &unwatched(&placed)));
    let causes = cleaned.rounds.iter().flat_map(|round| &round.kept);
    let is_hidden = |kept: &KeptSolid| {
        matches!(
            kept.cause,
            KeptCause::Uncleanable(UncleanCause::Hidden { .. })
        )
    };
    assert!(causes.clone().count() > 0 && causes.clone().all(is_hidden));
    assert!(
        !cleaned.voids.hollowed.voids.is_empty(),
        "an end is not the whole"
    );
}

#[test]
fn without_a_round_left_a_void_stays_unclean() {
    let mut placed = deep_box();
    placed.policy.cleaning_rounds = 0;
    let cleaned = clean_up(&placed);
    assert!(cleaned.rounds.is_empty());
    assert!(!are_clean(&cleaned.plan, &unwatched(&placed)));
}

#[test]
fn after_the_rounds_of_shrinking_whole_voids_are_kept_solid() {
    let mut placed = deep_box();
    placed.policy.shrinking_rounds = 0;
    let whole_mm3 = volume_mm3(&draw(&placed).1);
    let cleaned = clean_up(&placed);
    let [round] = &cleaned.rounds[..] else {
        panic!("{:?}", cleaned.rounds)
    };
    assert_eq!(round.volume_mm3, whole_mm3);
    assert!(cleaned.voids.hollowed.voids.is_empty());
}

#[test]
fn rather_any_further_cut_than_a_goal_that_cannot_be_met() {
    let mut placed = lopsided();
    need_jet(&mut placed, 5.0);
    placed.policy.cut_worth_ratio = 1.0;
    placed.policy.shrinking_rounds = 0;
    let cleaned = clean_up(&placed);
    assert!(cleaned.rounds.is_empty(), "{:?}", cleaned.rounds);
    assert!(cleaned.plan.cuts.len() > 1, "{:?}", cleaned.plan.cuts);
    assert!(are_clean(&cleaned.plan, &unwatched(&placed)));
}

#[test]
fn a_goal_that_no_cut_saves_leaves_its_void_unclean_and_the_round_says_so() {
    let mut placed = lopsided();
    need_jet(&mut placed, 1.0);
    placed.policy.shrinking_rounds = 0;
    let cleaned = clean_up(&placed);
    let [round] = &cleaned.rounds[..] else {
        panic!("{:?}", cleaned.rounds)
    };
    assert_eq!(round.value_after, None);
    assert!(!cleaned.voids.hollowed.voids.is_empty());
    assert!(!are_clean(&cleaned.plan, &unwatched(&placed)));
}

#[test]
fn without_cuts_a_void_stays_closed_and_nothing_is_kept_solid() {
    let mut placed = towers(LEAN);
    placed.job.cut = CutMode::Never;
    let (mut resolver, voids) = draw(&placed);
    let Err(Error::Cut(CutError::Obstacle(obstacle))) = clean(
        &mut resolver,
        Start::of(voids),
        &unwatched(&placed),
        &|_| false,
    ) else {
        panic!("a closed void has no plan")
    };
    assert!(
        matches!(obstacle, Obstacle::ClosedCavity { cavities: 2, .. }),
        "{obstacle}"
    );
}

#[test]
fn a_void_that_no_ordered_cut_meets_stays_solid_if_little_is_lost_by_it() {
    let mut placed = unequal_towers();
    // The cut runs through the wide tower only.
    let wide = CutOrder {
        cuts: vec![along(7.0)],
        ..CutOrder::default()
    };
    placed.job.plan = Some(wide);
    placed.policy.max_void_loss_ratio = 0.5;
    let before = draw(&placed).1.hollowed.voids.len();
    let cleaned = clean_up(&placed);
    assert_eq!((before, cleaned.voids.hollowed.voids.len()), (2, 1));
    let causes = cleaned.rounds[0].kept.iter().map(|kept| kept.cause);
    let closed = KeptCause::Uncleanable(UncleanCause::Closed);
    assert_eq!(causes.collect::<Vec<_>>(), [closed]);
    // Where it is too much to lose, the order is refused.
    placed.policy.max_void_loss_ratio = 0.1;
    let (mut resolver, voids) = draw(&placed);
    let start = Start::of(voids);
    let refused = clean(&mut resolver, start, &unwatched(&placed), &|_| false);
    let Err(Error::Cut(CutError::Obstacle(obstacle))) = refused else {
        panic!("too much is lost")
    };
    assert!(matches!(obstacle, Obstacle::ClosedCavity { .. }));
}

#[test]
fn an_ordered_region_names_the_void_that_it_is_taken_from() {
    let placed = towers(LEAN);
    let (mut resolver, voids) = draw(&placed);
    let region = storey(15.0, 30.0, [26.0, 40.0]);
    let kept = without_ends(&mut resolver, &voids, &[region], &KeptCause::Ordered).unwrap();
    let (round, less) = kept.unwrap();
    let right = voids
        .hollowed
        .voids
        .iter()
        .position(|void| void.mesh().aabb().min.x > 20.0);
    let expected = KeptSolid {
        void: VoidId::of(right.unwrap()),
        cause: KeptCause::Ordered,
    };
    assert_eq!(round.kept, [expected]);
    assert!(round.by_plan && round.volume_mm3 > 0.0);
    assert!(volume_mm3(&less) < volume_mm3(&voids) - round.volume_mm3);
}

#[test]
fn a_region_that_holds_nothing_changes_nothing() {
    let placed = towers(LEAN);
    let (mut resolver, voids) = draw(&placed);
    let between = storey(5.0, 20.0, [15.0, 25.0]);
    let kept = without_ends(&mut resolver, &voids, &[between], &KeptCause::Ordered).unwrap();
    assert!(kept.is_none());
}

#[test]
fn a_region_that_the_goal_needs_is_not_kept_solid() {
    let placed = lopsided();
    let (mut resolver, voids) = draw(&placed);
    let columns = resolver.solved().columns.moments().volume();
    let tower = storey(0.0, 24.0, [14.0, 28.0]);
    let kept = without_ends(&mut resolver, &voids, &[tower], &KeptCause::BeyondJoint).unwrap();
    assert!(kept.is_none());
    assert_eq!(resolver.solved().columns.moments().volume(), columns);
}

#[test]
fn rather_than_a_goal_that_is_missed_cuts_are_allowed_first_in_number_then_where_they_are_seen() {
    let placed = towers(LEAN);
    let mut request = PlanRequest {
        worth_ratio: 0.1,
        ..unwatched(&placed)
    };
    let solid = placed.solid();
    let outer = solid.mesh();
    request.seams = Seams::look(SeamStyle::Hidden, outer, &Vector::z(), &Watch::silent()).unwrap();
    assert!(allow_more_cuts(&mut request));
    assert!(request.worth_ratio == 0.0 && request.seams.are_seen());
    assert!(allow_more_cuts(&mut request));
    assert!(!request.seams.are_seen());
    assert!(
        !allow_more_cuts(&mut request),
        "nothing is forbidden any more"
    );
}
