//! Kits for every process, as a user makes them: each void open and clean by the process's rule;
//! and what that costs where the rule is hard to keep.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

const MODEL: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);

/// The checklist of the shipped model as a kit of 60 mm; fails where a promise is broken.
fn prepared(out: &Path, printer: &str, more: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "-q", "prepare", MODEL, "--size", "60mm", "--wall", "1.5mm", "--pitch", "0.5mm",
        ])
        .args(["--printer", printer, "--out"])
        .arg(out)
        .args(more)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success(),
        "{printer}: {said}{}",
        String::from_utf8_lossy(&output.stdout)
    );
    serde_json::from_slice(&fs::read(out.join("checklist.json")).unwrap()).unwrap()
}

fn check<'a>(sheet: &'a Value, name: &str) -> Option<&'a Value> {
    sheet["checks"]
        .as_array()
        .unwrap()
        .iter()
        .find(|check| check["name"] == name)
}

#[test]
fn every_process_opens_its_voids_and_cleans_them_by_its_own_rule() {
    let folder = tempfile::tempdir().unwrap();
    for (printer, rule) in [
        ("objet-connex350", "in-sight"),
        ("formlabs-form3", "in-sight"),
        ("formlabs-fuse1", "powder-escape"),
        ("prusa-mk4", "in-sight-or-self-supporting"),
        ("ultimaker-s5", "melt-out"),
    ] {
        let sheet = prepared(&folder.path().join(printer), printer, &["--goal", "top"]);
        assert_eq!(sheet["printer"]["cleaning"]["rule"], rule, "{printer}");
        let voids = sheet["voids"].as_array().unwrap();
        assert!(!voids.is_empty(), "{printer}");
        for void in voids {
            let id = void["id"].as_str().unwrap();
            assert_eq!(
                (void["is_clean"].as_bool(), void["opened_by"][0].as_str()),
                (Some(true), Some("C1"))
            );
            assert!(
                void["opening_mm"].as_f64() >= void["least_opening_mm"].as_f64(),
                "{printer}: {void}"
            );
            assert_eq!(
                check(&sheet, &format!("void {id} open")).unwrap()["pass"],
                true
            );
            let clean = check(&sheet, &format!("void {id} clean"));
            assert_eq!(clean.is_some(), rule.starts_with("in-sight"), "{printer}");
        }
        let page = fs::read_to_string(folder.path().join(printer).join("checklist.html")).unwrap();
        assert!(page.contains(voids[0]["method"].as_str().unwrap()) && page.contains("✓ open"));
    }
}

#[test]
fn what_a_short_tool_does_not_reach_stays_solid_and_the_sheet_says_what_that_costs() {
    let folder = tempfile::tempdir().unwrap();
    let stand = ["--goal", "stand", "--up", "y"];
    let free = prepared(&folder.path().join("free"), "objet-connex350", &stand);
    // The same cuts, without pins, for a tool that reaches less than half as deep as the void is.
    let cut = &free["cuts"][0];
    let numbers = |key: &str| cut[key].to_string();
    let plan = folder.path().join("cuts.toml");
    let text = format!(
        "[[cuts]]\nid = \"C1\"\npoint_mm = {}\nnormal = {}\n",
        numbers("point_mm"),
        numbers("normal")
    );
    fs::write(&plan, text).unwrap();
    let reach_mm = free["voids"][0]["depth_mm"].as_f64().unwrap() / 2.0;
    let shop = folder.path().join("shop.toml");
    let profile = format!(
        "id = \"shop-jet\"\nname = \"A jet with a short lance\"\ninherits = \"objet-connex350\"\n\n[numbers]\n\
         cleaning_reach_mm = {{ value = {reach_mm}, source = \"measured\", sure = \"read\" }}\n"
    );
    fs::write(&shop, profile).unwrap();
    let more = [&stand[..], &["--cut", plan.to_str().unwrap()]].concat();
    let sheet = prepared(&folder.path().join("short"), shop.to_str().unwrap(), &more);
    let proof = &sheet["certificate"];
    let rounds = proof["cleaning_rounds"].as_array().unwrap();
    assert!(!rounds.is_empty() && rounds.len() <= 8, "{proof}");
    assert!(
        rounds[0]["voids"][0]["why"]
            .as_str()
            .unwrap()
            .contains("in sight")
    );
    let value = |key: &str| proof[key].as_f64().unwrap();
    assert!(
        value("kept_solid_mm3") > 0.0 && value("value") <= value("value_before_cleaning"),
        "{proof}"
    );
    for void in sheet["voids"].as_array().unwrap() {
        assert!(
            void["is_clean"] == true && void["sight_ratio"].as_f64().unwrap() >= 0.95,
            "{void}"
        );
    }
    let page = fs::read_to_string(folder.path().join("short/checklist.html")).unwrap();
    assert!(page.contains("that could have been emptied stays solid"));
}
