//! The cleaning of voids, on a hollow box cut in two and with one fault at a time.

use super::judge_tests::{failures, judge, sound_kit};
use super::test_meshes::block;
use super::*;
use crate::geom::Point;

const IN_SIGHT: Cleaning = Cleaning {
    rule: CleaningRule::InSight,
    sight_ratio: 0.95,
    reach_mm: Some(100.0),
    pair_opening_mm: None,
    overhang_deg: None,
};

/// Returns the sound box, cut at z = 16, with its void to be cleaned by this rule.
fn kit(cleaning: Cleaning) -> Evidence {
    let mut kit = sound_kit();
    kit.promise.printer.cleaning = Some(cleaning);
    kit.promise.printer.minimum_opening_mm = Some(4.0);
    kit.promise.cuts = vec![PromisedCut {
        point_mm: [0.0, 0.0, 16.0],
        normal: [0.0, 0.0, 2.0],
    }];
    kit.promise.voids = vec![PromisedVoid {
        id: "V1".into(),
        sight_ratio: Some(1.0),
        least_opening_mm: Some(4.0),
    }];
    kit
}

/// Returns the box with a cover 0.4 mm thick inside the lower tray, which leaves a slit at one end.
/// It reaches into the side walls; the tests look at the sight alone.
fn kit_with_cover() -> Evidence {
    let mut kit = kit(IN_SIGHT);
    let cover = block(Point::new(2.0, 2.0, 4.5), [50.0, 36.0, 0.4]);
    kit.parts[0].mesh = kit.parts[0].mesh.clone().joined(&cover);
    kit
}

#[test]
fn both_trays_of_a_box_lie_open_and_in_sight() {
    let kit = kit(IN_SIGHT);
    assert_eq!(failures(&kit), Vec::<String>::new());
    let found = judge(&kit);
    assert_eq!((found.voids.len(), found.voids[0].sight_ratio), (1, 1.0));
    // Both trays are dimples: 3 mm deep under a mouth of 54 × 34.
    assert_eq!(found.voids[0].openings_mm, Vec::<Vec<f64>>::new());
    let of_void = |check: &&Check| check.kind.void() == Some("V1");
    assert_eq!(found.checks.iter().filter(of_void).count(), 2);
}

#[test]
fn a_wall_behind_a_cover_is_not_clean_and_not_as_stated() {
    let failed = failures(&kit_with_cover());
    assert!(failed.contains(&"void V1 clean".to_owned()), "{failed:?}");
    assert!(failed.contains(&"voids as stated".to_owned()), "{failed:?}");
}

#[test]
fn a_floor_that_faces_up_needs_no_sight_if_no_support_stands_on_it() {
    // The lower tray lies with its void up: its floor and sides need no support, in sight or not.
    let leaning = Cleaning {
        rule: CleaningRule::InSightOrSelfSupporting,
        overhang_deg: Some(45.0),
        ..IN_SIGHT
    };
    let mut kit = kit_with_cover();
    kit.promise.printer.cleaning = Some(leaning);
    assert!(!failures(&kit).contains(&"void V1 clean".to_owned()));
    assert!(judge(&kit).voids[0].sight_ratio < 0.95);
}

#[test]
fn a_wall_beyond_the_tools_reach_is_not_clean() {
    let mut kit = kit(Cleaning {
        reach_mm: Some(2.0),
        ..IN_SIGHT
    });
    // The floors lie 3 mm behind the mouths.
    assert!(failures(&kit).contains(&"void V1 clean".to_owned()));
    kit.promise.printer.cleaning = Some(Cleaning {
        reach_mm: Some(8.0),
        ..IN_SIGHT
    });
    assert!(!failures(&kit).contains(&"void V1 clean".to_owned()));
}

#[test]
fn a_void_whose_cut_is_not_where_the_sheet_says_is_not_open() {
    let mut kit = kit(Cleaning::MELT_OUT);
    kit.promise.cuts[0].point_mm[2] = 15.0;
    let failed = failures(&kit);
    assert!(failed.contains(&"void V1 open".to_owned()), "{failed:?}");
}

#[test]
fn a_sheet_that_leaves_a_void_out_is_found() {
    let mut kit = kit(IN_SIGHT);
    kit.promise.voids.clear();
    assert!(failures(&kit).contains(&"voids as stated".to_owned()));
}
