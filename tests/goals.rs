//! Rotors and floating things as a user makes them: kits that keep their promises, and proofs where
//! there can be none.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

use common::{equipoise, number, prepared};
use serde_json::Value;

/// The wall of these kits.
const WALL: &str = "1.5mm";

#[test]
fn a_leaning_ellipsoid_becomes_a_rotor_of_its_grade_and_its_kit_is_judged_so_again() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("rotor");
    let (code, sheet) = prepared(
        &kit,
        WALL,
        &["--goal", "balance", "--speed", "6000", "--bore", "4mm"],
    );
    assert_eq!(code, Some(0), "{:#}", sheet["checks"]);
    assert!(
        number(&sheet, "/solid/unbalance/grade_mm_s") > 100.0,
        "solid it shakes"
    );
    assert!(number(&sheet, "/assembly/unbalance/grade_mm_s") <= 2.5);
    // Nothing was removed but what had to be: the certificate is of the mass that stays.
    assert_eq!(sheet["certificate"]["figure"], "mass_g");
    let (mass, bound) = (
        number(&sheet, "/assembly/mass_g"),
        number(&sheet, "/certificate/bound"),
    );
    assert!(
        mass > 0.99 * bound && mass < number(&sheet, "/solid/mass_g"),
        "{mass} {bound}"
    );
    assert_eq!(
        equipoise(&["verify", kit.to_str().unwrap()]).status.code(),
        Some(0)
    );
}

#[test]
fn it_floats_upright_where_solid_it_would_sink_and_the_sheet_says_to_seal_it() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("boat");
    let (code, sheet) = prepared(&kit, WALL, &["--goal", "float", "--liquid", "seawater"]);
    assert_eq!(code, Some(0), "{:#}", sheet["checks"]);
    assert!(sheet["solid"].get("afloat").is_none(), "solid it sinks");
    assert!(number(&sheet, "/assembly/afloat/metacentric_height_mm") > 0.0);
    assert!(number(&sheet, "/assembly/afloat/rights_from_deg") >= 5.0);
    let floats = number(&sheet, "/assembly/afloat/waterline_mm")
        - number(&sheet, "/goal/water/waterline_mm");
    assert!(floats.abs() < 0.02, "{floats}");
    assert!(sheet["warnings"].to_string().contains("seal every joint"));
    assert_eq!(
        equipoise(&["verify", kit.to_str().unwrap()]).status.code(),
        Some(0)
    );
}

#[test]
fn what_cannot_be_is_proved_and_ends_with_exit_code_1() {
    let cases: [(&[&str], &str); 3] = [
        (
            &["--goal", "balance", "--spin-point", "20,0,0"],
            "balance grade stays at G",
        ),
        (
            &["--goal", "float", "--waterline", "1mm"],
            "times the water it displaces",
        ),
        (
            &["--goal", "float", "--liquid", "9", "--waterline", "30mm"],
            "even solid it weighs only",
        ),
    ];
    for (goal, says) in cases {
        let folder = tempfile::tempdir().unwrap();
        let kit = folder.path().join("none");
        let (code, why) = prepared(&kit, WALL, goal);
        assert_eq!(
            (code, &why["verdict"]),
            (Some(1), &Value::from("impossible")),
            "{goal:?}"
        );
        assert!(
            why["reason"].as_str().unwrap().contains(says),
            "{goal:?}: {}",
            why["reason"]
        );
        assert!(
            !why["remedies"].as_array().unwrap().is_empty() && !kit.exists(),
            "{goal:?}"
        );
    }
}
