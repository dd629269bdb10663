//! How parts are joined, as a user sees it: bosses where walls are too thin for pins, dowels, films
//! of glue, engraved ids.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(
    clippy::panic,
    reason = "a checklist without a key it must have fails the test"
)]

mod common;

use std::path::Path;

use common::{ELLIPSOID, equipoise, number};
use serde_json::Value;

/// The shipped model as a small top of molten filament: its walls are too thin for pins of 3 mm.
fn small_top(out: &Path, more: &[&str]) -> Value {
    let usual = [
        "--json",
        "prepare",
        ELLIPSOID,
        "--printer",
        "prusa-mk4",
        "--goal",
        "top",
        "--size",
        "40mm",
    ];
    let coarse = ["--pitch", "0.3mm", "--out", out.to_str().unwrap()];
    let output = equipoise(&[&usual[..], &coarse, more].concat());
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(0), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn list<'a>(sheet: &'a Value, key: &str) -> &'a [Value] {
    sheet[key].as_array().map_or(&[], Vec::as_slice)
}

#[test]
fn walls_too_thin_for_pins_get_bosses_and_the_sheet_says_what_they_cost() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let sheet = small_top(&kit, &[]);
    let rounds = list(&sheet, "rounds");
    assert!((1..=3).contains(&rounds.len()), "{rounds:?}");
    for round in rounds {
        // Less may be emptied, so no speed is lower but for what the optimum itself is found to.
        let [before, after] = ["/before", "/after"].map(|key| number(round, key));
        assert!(after >= before * (1.0 - 1e-6), "{before} {after}");
        assert!(number(round, "/gap_ratio").abs() < 1e-6 && number(round, "/kept_solid_mm3") > 0.0);
    }
    assert!(number(&sheet, "/certificate/bosses_mm3") > 0.0);
    let joints = list(&sheet, "joints");
    assert!(
        joints.iter().all(|joint| number(joint, "/pins") >= 2.0),
        "{joints:?}"
    );
    let page = std::fs::read_to_string(kit.join("checklist.html")).unwrap();
    assert!(page.contains("Boss round 1") && page.contains("solid in bosses around pins"));
    // The plan of the kit, given back, keeps the same bosses solid.
    let again = small_top(
        &folder.path().join("again"),
        &["--cut", kit.join("cuts.toml").to_str().unwrap()],
    );
    let hashes = |sheet: &Value| -> Vec<String> {
        list(sheet, "parts")
            .iter()
            .map(|part| part["sha256"].to_string())
            .collect()
    };
    assert_eq!(hashes(&sheet), hashes(&again));
}

#[test]
fn what_a_plan_keeps_solid_stays_so_and_the_kits_plan_makes_the_same_kit_again() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.toml");
    // The cap of the ellipsoid above z = 12 mm of its 18.
    let text = "[[cuts]]\nid = \"C1\"\npoint_mm = [0, 0, 0.013]\nnormal = [0, 0, 1]\n\n[[solid]]\nat_mm = [0, 0, 14]\nlow_mm = [-40, -40, 12]\nhigh_mm = [40, 40, 40]\n";
    std::fs::write(&plan, text).unwrap();
    let kit = folder.path().join("kit");
    let sheet = small_top(&kit, &["--cut", plan.to_str().unwrap()]);
    let rounds = sheet["certificate"]["cleaning_rounds"].as_array().unwrap();
    assert_eq!(
        (rounds.len(), &rounds[0]["by_plan"]),
        (1, &Value::Bool(true)),
        "{rounds:?}"
    );
    assert_eq!(rounds[0]["voids"][0]["why"], "the plan keeps it solid");
    let solid =
        equipoise::io::stl::decode(&std::fs::read(kit.join("hollowed.stl")).unwrap()).unwrap();
    let highest =
        |mesh: &equipoise::mesh::TriMesh| mesh.vertices().iter().map(|p| p.z).fold(0.0, f64::max);
    let void = equipoise::mesh::shells(&equipoise::repair::weld(&solid))
        .into_iter()
        .find(|shell| shell.signed_volume_mm3() < 0.0)
        .unwrap();
    assert!(
        highest(&void) < 12.0 && highest(&void) > 8.0,
        "{}",
        highest(&void)
    );
    let again = small_top(
        &folder.path().join("again"),
        &["--cut", kit.join("cuts.toml").to_str().unwrap()],
    );
    assert_eq!(sheet["parts"], again["parts"]);
}

#[test]
fn dowels_come_with_a_cut_list_and_their_mass_is_counted() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = small_top(&folder.path().join("kit"), &["--pins", "dowel"]);
    let dowels = list(&sheet, "dowels");
    let counted: f64 = list(&sheet, "cut_list")
        .iter()
        .map(|row| number(row, "/count"))
        .sum();
    assert!(
        dowels.len() >= 2 && counted == dowels.len() as f64,
        "{dowels:?}"
    );
    assert!(
        list(&sheet, "parts")
            .iter()
            .all(|part| list(part, "pins").is_empty())
    );
    let sum = |rows: &[Value], key: &str| rows.iter().map(|row| number(row, key)).sum::<f64>();
    let films: Vec<Value> = list(&sheet, "joints")
        .iter()
        .map(|joint| joint["glue"].clone())
        .collect();
    let all_g =
        sum(list(&sheet, "parts"), "/mass_g") + sum(dowels, "/mass_g") + sum(&films, "/mass_g");
    assert!((all_g / number(&sheet, "/assembly/mass_g") - 1.0).abs() < 1e-9);
    assert!(sum(&films, "/mass_g") > 0.0 && sum(dowels, "/mass_g") > 0.0);
}

#[test]
fn parts_bear_their_ids_where_there_is_room_and_none_where_none_are_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let prepared = |out: &str, more: &[&str]| {
        let (code, sheet) = common::prepared(&folder.path().join(out), "2.5mm", more);
        assert_eq!(code, Some(0));
        sheet
    };
    let sheet = prepared("engraved", &["--goal", "top"]);
    let marked = |sheet: &Value| -> Vec<String> {
        let parts = list(sheet, "parts").iter();
        parts
            .flat_map(|part| {
                list(part, "marks")
                    .iter()
                    .map(|mark| mark["text"].as_str().unwrap().to_owned())
            })
            .collect()
    };
    assert_eq!(marked(&sheet), ["P01", "P02"]);
    assert!(
        list(&sheet, "checks")
            .iter()
            .any(|check| check["name"] == "ids")
    );
    assert!(marked(&prepared("plain", &["--goal", "top", "--ids", "none"])).is_empty());
}
