//! Tops and standing objects that keep their promise on a table, as a user makes them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use common::{
    ELLIPSOID, QUICK, assert_exit, checklist, equipoise, list, make_kit, number, path,
    prepare_quickly, printed, verify, words,
};
use serde_json::Value;

/// The measured value of a check, and the verdict; `None` if there is no such check.
fn check(sheet: &Value, kind: &str) -> Option<(f64, bool)> {
    let row = list(sheet, "checks")
        .iter()
        .find(|row| row["kind"] == kind)?;
    Some((number(row, "/value"), row["pass"] == true))
}

#[test]
fn an_ellipsoid_spins_on_its_own_round_end() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = make_kit(&folder.path().join("kit"), "--goal top --up z --wall 1.5mm");
    assert!(list(&sheet, "hardware").is_empty());
    let (lean_deg, kept) = check(&sheet, "lean").unwrap();
    assert!(kept && lean_deg > 20.0, "{lean_deg}");
    // The kit made at 100 mm states 47 mm, and this one at 60 mm states 28 mm.
    let radius_mm = number(&sheet, "/goal/spins_on/radius_mm");
    assert!((25.0..40.0).contains(&radius_mm), "{radius_mm}");
}

#[test]
fn a_contact_in_the_air_brings_its_tip_and_leans_as_promised() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    // Below the centre of mass the surface lies 0.6 mm above the lowest point.
    let sheet = make_kit(&kit, "--goal top --wall 1mm --up 1,1,0 --contact center");
    let [tip] = list(&sheet, "hardware") else {
        panic!("{}", sheet["hardware"])
    };
    assert_eq!(tip["what"], "tip");
    assert!(check(&sheet, "lean").unwrap().0 >= 10.0);
    assert!(check(&sheet, "contact").unwrap().0 < 0.05);
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn without_a_tip_no_lean_is_promised_and_the_sheet_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let options = "--goal top --wall 1.5mm --tip none";
    let sheet = make_kit(&folder.path().join("kit"), options);
    assert_eq!(check(&sheet, "lean"), None);
    assert!(list(&sheet, "hardware").is_empty());
}

#[test]
fn a_top_that_spins_on_nothing_is_refused_whatever_lean_it_waives() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    for lean in ["", "--least-lean 0"] {
        let options =
            format!("{QUICK} --goal top --wall 1mm --up 1,1,0 --contact center --tip none {lean}");
        let line = [
            &["prepare", ELLIPSOID, "--out", path(&kit)],
            &words(&options)[..],
        ]
        .concat();
        let output = equipoise(&line);
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains("0.6 mm below the model"), "{said}");
        assert!(said.contains("--tip=auto") && !kit.exists(), "{said}");
    }
}

#[test]
fn a_tip_that_is_too_short_for_the_lean_is_refused_with_the_one_that_does_it() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let refuses = |more: &str, least_deg: u32| {
        let rod = format!("--contact center --tip 4mmx10mmx6mm --least-lean {least_deg}");
        let options = format!("{QUICK} --goal top --wall 1mm {rod} {more}");
        let line = [
            &["prepare", ELLIPSOID, "--out", path(&kit)],
            &words(&options)[..],
        ]
        .concat();
        let output = equipoise(&line);
        assert_exit(&output, 2);
        assert!(!kit.exists());
        let said = printed(&output);
        let asked = format!("and {least_deg}° are asked for");
        assert!(said.contains(&asked), "{said}");
        said
    };
    let said = refuses("--up y", 30);
    assert!(said.contains("--tip="), "{said}");
    // Without an axis the tip is held against the natural one, on which the top leans by 32°, and
    // no other is taken for it.
    refuses("", 40);
}

#[test]
fn a_toppling_angle_that_is_missed_by_a_tenth_of_a_degree_breaks_the_promise() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    // With this wall no hollowing reaches more than 5.05°.
    let options = "--goal stand --up y --wall 1.5mm --least-angle 5.1";
    assert_exit(&prepare_quickly(&kit, options), 1);
    let (angle_deg, kept) = check(&checklist(&kit), "standing").unwrap();
    assert!(!kept && (4.9..5.1).contains(&angle_deg), "{angle_deg}");
}
