//! Rotors and floating things as a user makes them: kits that keep their promises, and proofs that
//! there can be none.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use common::{assert_exit, json, list, make_kit, number, prepare_quickly, verify};

#[test]
fn a_tilted_ellipsoid_becomes_a_rotor_within_its_grade() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("rotor");
    let sheet = make_kit(
        &kit,
        "--wall 1.5mm --goal balance --up z --speed 6000 --bore 4mm",
    );
    let solid = number(&sheet, "/solid/unbalance/grade_mm_s");
    assert!(solid > 100.0, "a solid one shakes: {solid}");
    assert!(number(&sheet, "/assembly/unbalance/grade_mm_s") <= 2.5);
    // As little as possible was emptied: the certificate is about the mass that stays.
    assert_eq!(sheet["certificate"]["figure"], "mass_g");
    let mass_g = number(&sheet, "/assembly/mass_g");
    let bound_g = number(&sheet, "/certificate/bound");
    assert!(mass_g > 0.99 * bound_g, "{mass_g} {bound_g}");
    assert!(mass_g < number(&sheet, "/solid/mass_g"));
    assert_eq!(verify(&kit).0, Some(0));
}

#[test]
fn a_hollow_ellipsoid_floats_upright_and_the_sheet_says_to_seal_it() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("boat");
    let sheet = make_kit(&kit, "--wall 1.5mm --goal float --up z --liquid seawater");
    assert!(sheet["solid"].get("afloat").is_none(), "a solid one sinks");
    assert!(number(&sheet, "/assembly/afloat/metacentric_height_mm") > 0.0);
    assert!(number(&sheet, "/assembly/afloat/rights_from_deg") >= 5.0);
    let asked_mm = number(&sheet, "/goal/water/waterline_mm");
    let off_mm = number(&sheet, "/assembly/afloat/waterline_mm") - asked_mm;
    assert!(off_mm.abs() < 0.02, "{off_mm}");
    assert!(sheet["warnings"].to_string().contains("seal every joint"));
    assert_eq!(verify(&kit).0, Some(0));
}

#[test]
fn an_impossible_goal_is_proved_with_its_reason_and_remedies() {
    for (goal, reason) in [
        (
            "balance --bore 2mm --spin-point 20,0,0",
            "balance grade stays at G",
        ),
        ("float --waterline 1mm", "times the water it displaces"),
        (
            "float --liquid 9 --waterline 30mm",
            "even solid it weighs only",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        let kit = folder.path().join("none");
        let output = prepare_quickly(&kit, &format!("--wall 1.5mm --up z --goal {goal}"));
        assert_exit(&output, 1);
        assert!(!kit.exists(), "{goal}");
        let answer = json(&output);
        assert_eq!(answer["verdict"], "impossible", "{goal}");
        let said = answer["reason"].as_str().unwrap();
        assert!(said.contains(reason), "{goal}: {said}");
        assert!(!list(&answer, "remedies").is_empty(), "{goal}");
    }
}
