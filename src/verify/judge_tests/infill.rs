//! A print of one piece whose cavity is a region of sparse infill.

use super::{block, failures, judge, sound_kit};
use crate::geom::{Matrix, Point, Vector};
use crate::verify::{Evidence, InfillOrder, LaidOrder, PartEvidence, Pose};

/// Volume of the region, mm³.
const REGION_MM3: f64 = 54.0 * 34.0 * 6.0;

/// Returns the sound kit uncut, with infill in place of its void.
fn one_piece() -> Evidence {
    let mut evidence = sound_kit();
    let shift = Vector::new(30.0, 20.0, -10.0);
    evidence.parts = vec![PartEvidence {
        id: "P01".into(),
        mesh: evidence.hollowed.map_vertices(|p| p + shift),
        inner: Vec::new(),
        pose: Pose::new(&Matrix::identity(), &shift),
    }];
    evidence.promise.printer.build_volume_mm = None;
    evidence.promise.infill = Some(InfillOrder {
        pattern: "gyroid".to_owned(),
        nominal_ratio: 0.15,
        laid_ratio: 0.142,
        regions: 1,
        volume_mm3: REGION_MM3,
        mass_g: 0.142 * REGION_MM3 * 1.2e-3,
        slicer_ratio: None,
        beyond: None,
        misses_mm: Vec::new(),
        field: None,
        smooth: None,
        file: Some("modifiers/region.stl".to_owned()),
        inner: Vec::new(),
    });
    evidence
}

#[test]
fn a_region_of_infill_is_no_closed_cavity_and_weighs_what_is_laid() {
    let evidence = one_piece();
    assert_eq!(failures(&evidence), Vec::<String>::new());
    let [whole, hollow] = [&evidence, &sound_kit()].map(judge);
    let laid_g = 0.142 * REGION_MM3 * 1.2e-3;
    assert!((whole.assembly.mass_g - hollow.assembly.mass_g - laid_g).abs() < 1e-9);
    assert!((whole.hollowed.mass_g - whole.assembly.mass_g).abs() < 1e-9);
}

#[test]
fn a_void_beside_the_regions_is_found_and_so_is_a_region_that_is_lost() {
    let mut evidence = one_piece();
    let regions = |evidence: &mut Evidence, count| {
        evidence.promise.infill.as_mut().unwrap().regions = count;
    };
    regions(&mut evidence, 0);
    assert_eq!(failures(&evidence), ["closed cavities"]);
    regions(&mut evidence, 2);
    assert_eq!(failures(&evidence), ["closed cavities"]);
}

#[test]
fn a_cavity_in_an_stl_is_no_infill_unless_the_region_has_a_file_of_its_own() {
    let mut evidence = one_piece();
    evidence.promise.infill.as_mut().unwrap().file = None;
    assert_eq!(failures(&evidence), ["closed cavities"]);
}

#[test]
fn more_than_slicers_lay_is_not_believed() {
    let mut evidence = one_piece();
    for (moments, moment) in [(0, 1e9), (2, 1e6), (4, f64::NAN)] {
        let mut beyond = [0.0; 10];
        beyond[moments] = moment;
        evidence.promise.infill.as_mut().unwrap().beyond = Some(beyond);
        let failed = failures(&evidence);
        assert!(failed.contains(&"laid beyond".to_owned()), "{failed:?}");
    }
}

#[test]
fn what_a_slicer_lays_beyond_counts_where_it_lies() {
    let mut evidence = one_piece();
    let before = judge(&evidence).assembly;
    let blob = block(Point::new(9.0, -1.0, 14.0), [2.0, 2.0, 4.0]);
    let beyond = crate::mass::moments_of_mesh(&blob);
    evidence.promise.infill.as_mut().unwrap().beyond = Some(beyond.0);
    let after = judge(&evidence).assembly;
    let added_g = 16.0 * 1.2e-3;
    assert!((after.mass_g - before.mass_g - added_g).abs() < 1e-9);
    let shift_mm = 10.0 * added_g / after.mass_g;
    assert!((after.center_mm[0] - before.center_mm[0] - shift_mm).abs() < 1e-9);
}

#[test]
fn a_hollow_kit_promises_what_a_slicer_lays_beyond_its_parts_and_no_more_than_that() {
    let mut evidence = sound_kit();
    let before = judge(&evidence).assembly;
    let blob = block(Point::new(9.0, -1.0, 14.0), [2.0, 2.0, 4.0]);
    let beyond = crate::mass::moments_of_mesh(&blob);
    let mut lay = |beyond: [f64; 10]| {
        evidence.promise.laid = Some(LaidOrder {
            beyond,
            misses_mm: vec![0.1],
        });
        (judge(&evidence).assembly, failures(&evidence))
    };
    let (after, _) = lay(beyond.0);
    let added_g = 16.0 * 1.2e-3;
    assert!((after.mass_g - before.mass_g - added_g).abs() < 1e-9);
    let moment = before.center_mm[0] * before.mass_g + 10.0 * added_g;
    assert!((after.center_mm[0] - moment / after.mass_g).abs() < 1e-9);
    let mut too_much = beyond.0;
    too_much[0] = 1e9;
    let (_, failed) = lay(too_much);
    assert!(failed.contains(&"laid beyond".to_owned()), "{failed:?}");
}
