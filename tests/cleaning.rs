//! Kits for every process: each void is open and clean by the process's rule, and the sheet states
//! what a short tool costs.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::Path;

use common::{assert_exit, checklist, list, number, path, prepare, words};
use serde_json::Value;

/// Makes a kit of the shipped model, 60 mm long, on a printer; returns its checklist.
fn make_on(printer: &str, out: &Path, options: &[&str]) -> Value {
    let usual = words("--size 60mm --wall 1.5mm --pitch 0.5mm --printer");
    let output = prepare(out, &[&usual[..], &[printer], options].concat());
    assert_exit(&output, 0);
    checklist(out)
}

/// A check of a checklist by its name.
fn check<'a>(sheet: &'a Value, name: &str) -> Option<&'a Value> {
    list(sheet, "checks")
        .iter()
        .find(|check| check["name"] == name)
}

#[test]
fn powder_escapes() {
    assert_rule("formlabs-fuse1", "powder-escape");
}

#[test]
fn filament_needs_no_support_or_is_seen() {
    assert_rule("prusa-mk4", "in-sight-or-self-supporting");
}

#[test]
#[ignore = "long: 11 s; run with -- --ignored"]
fn support_melts_out() {
    assert_rule("ultimaker-s5", "melt-out");
}

/// Another test looks into the voids of an Objet.
#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn photopolymer_is_seen() {
    assert_rule("objet-connex350", "in-sight");
}

#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn resin_is_seen() {
    assert_rule("formlabs-form3", "in-sight");
}

/// Makes a kit for a process, which opens its voids and cleans them by its own rule.
fn assert_rule(printer: &str, rule: &str) {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join(printer);
    let sheet = make_on(printer, &kit, &["--goal", "top", "--up", "z"]);
    assert_eq!(sheet["printer"]["cleaning"]["rule"], rule, "{printer}");
    let voids = list(&sheet, "voids");
    assert!(!voids.is_empty(), "{printer}");
    voids
        .iter()
        .for_each(|void| assert_open_and_clean(void, &sheet, rule));
    let page = fs::read_to_string(kit.join("certificate.html")).unwrap();
    assert!(page.contains(voids[0]["method"].as_str().unwrap()) && page.contains("✓ kept"));
}

fn assert_open_and_clean(void: &Value, sheet: &Value, rule: &str) {
    assert!(
        void["is_clean"] == true && void["opened_by"][0] == "C1",
        "{void}"
    );
    let is_wide = number(void, "/opening_mm") >= number(void, "/least_opening_mm");
    assert!(is_wide, "{void}");
    let id = void["id"].as_str().unwrap();
    let open = check(sheet, &format!("void {id} open")).unwrap();
    assert_eq!(open["pass"], true, "{void}");
    let is_looked_into = check(sheet, &format!("void {id} clean")).is_some();
    assert_eq!(is_looked_into, rule.starts_with("in-sight"), "{rule}");
}

/// Makes a kit with one cut and no pins, for a tool that reaches less than half as deep as the
/// void.
fn make_with_short_tool(folder: &Path) -> Value {
    // On its end an ellipsoid topples at 1.6°.
    let stand = words("--goal stand --up y --least-angle 1");
    let plan = folder.join("cuts.toml");
    let text = "[[cuts]]\nid = \"C1\"\npoint_mm = [0.0, 0.0, 0.0]\nnormal = [1.0, 0.0, 0.0]\n";
    fs::write(&plan, text).unwrap();
    let options = [&stand[..], &["--cut", path(&plan)]].concat();
    let free = make_on("objet-connex350", &folder.join("free"), &options);
    let reach_mm = number(&free, "/voids/0/depth_mm") / 2.0;
    let shop = folder.join("shop.toml");
    let profile = format!(
        "id = \"shop-jet\"\nname = \"A jet with a short lance\"\ninherits = \"objet-connex350\"\n\n[numbers]\n\
         cleaning_reach_mm = {{ value = {reach_mm}, source = \"measured\", sure = \"read\" }}\n"
    );
    fs::write(&shop, profile).unwrap();
    make_on(path(&shop), &folder.join("short"), &options)
}

#[test]
fn voids_beyond_a_short_tool_stay_solid_and_the_sheet_states_the_cost() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = make_with_short_tool(folder.path());
    assert_eq!(sheet["printer"]["cleaning"]["rule"], "in-sight");
    let proof = &sheet["certificate"];
    let rounds = list(proof, "cleaning_rounds");
    assert!((1..=8).contains(&rounds.len()), "{proof}");
    let why = rounds[0]["voids"][0]["why"].as_str().unwrap();
    assert!(why.contains("in sight"), "{why}");
    assert!(number(proof, "/kept_solid_mm3") > 0.0, "{proof}");
    let [value, before] = ["/value", "/value_before_cleaning"].map(|key| number(proof, key));
    assert!(value <= before, "{value} {before}");
    for void in list(&sheet, "voids") {
        assert!(number(void, "/sight_ratio") >= 0.95, "{void}");
        assert_open_and_clean(void, &sheet, "in-sight");
    }
    let page = fs::read_to_string(folder.path().join("short/certificate.html")).unwrap();
    assert!(page.contains("that could have been emptied stays solid"));
}
