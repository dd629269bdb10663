//! Joints as a user sees them: bosses where walls are too thin for pins, dowels, glue films and
//! engraved ids.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use common::{assert_exit, json, list, make_kit, number, path, prepare, sum, words};
use equipoise::io::stl;
use equipoise::mesh::{TriMesh, shells};
use equipoise::repair::weld;
use serde_json::Value;

/// Makes the shipped model a small top of filament: its walls are too thin for pins of 3 mm.
fn make_small_top(out: &Path, options: &[&str]) -> Value {
    let usual = words("--printer prusa-mk4 --goal top --up z --size 40mm --pitch 0.3mm");
    let output = prepare(out, &[&usual[..], options].concat());
    assert_exit(&output, 0);
    json(&output)
}

/// A small top with bosses, as it comes, and its result. It is made once and never changed.
fn small_top() -> &'static (PathBuf, Value) {
    static TOP: OnceLock<(PathBuf, Value)> = OnceLock::new();
    TOP.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let sheet = make_small_top(&kit, &[]);
        (kit, sheet)
    })
}

/// Makes the kit again from its own plan.
fn make_again(kit: &Path, out: &Path) -> Value {
    make_small_top(out, &["--cut", path(&kit.join("cuts.toml"))])
}

#[test]
fn walls_too_thin_for_pins_get_bosses_and_the_sheet_states_their_cost() {
    let (kit, sheet) = small_top();
    let rounds = list(sheet, "rounds");
    assert!((1..=3).contains(&rounds.len()), "{rounds:?}");
    for round in rounds {
        // Less may be emptied, so the speed cannot fall by more than the optimum's accuracy.
        let [before, after] = ["/before", "/after"].map(|key| number(round, key));
        assert!(after >= before * (1.0 - 1e-6), "{before} {after}");
        assert!(number(round, "/gap_ratio").abs() < 1e-6, "{round}");
        assert!(number(round, "/kept_solid_mm3") > 0.0, "{round}");
    }
    assert!(number(sheet, "/certificate/bosses_mm3") > 0.0);
    let joints = list(sheet, "joints");
    let is_pinned = |joint: &Value| number(joint, "/pins") >= 2.0;
    assert!(joints.iter().all(is_pinned), "{joints:?}");
    let page = fs::read_to_string(kit.join("certificate.html")).unwrap();
    assert!(page.contains("Boss round 1") && page.contains("solid in bosses around pins"));
}

#[test]
fn a_kit_with_bosses_made_again_from_its_plan_has_the_same_parts() {
    let folder = tempfile::tempdir().unwrap();
    let (kit, sheet) = small_top();
    let again = make_again(kit, &folder.path().join("again"));
    let hashes = |sheet: &Value| -> Vec<Value> {
        let parts = list(sheet, "parts").iter();
        parts.map(|part| part["sha256"].clone()).collect()
    };
    assert_eq!(hashes(sheet), hashes(&again));
}

/// The cap of the ellipsoid above z = 12 mm of its 18 stays solid.
const SOLID_CAP: &str = "[[cuts]]\nid = \"C1\"\npoint_mm = [0, 0, 0.013]\nnormal = [0, 0, 1]\n\n\
    [[solid]]\nat_mm = [0, 0, 14]\nlow_mm = [-40, -40, 12]\nhigh_mm = [40, 40, 40]\n";

#[test]
#[ignore = "long: 15 s; run with -- --ignored"]
fn a_plan_may_keep_a_region_solid_and_makes_the_same_kit_again() {
    let folder = tempfile::tempdir().unwrap();
    let [plan, kit, again] = ["plan.toml", "kit", "again"].map(|name| folder.path().join(name));
    fs::write(&plan, SOLID_CAP).unwrap();
    let sheet = make_small_top(&kit, &["--cut", path(&plan)]);
    let rounds = list(&sheet["certificate"], "cleaning_rounds");
    assert_eq!(rounds.len(), 1, "{rounds:?}");
    assert_eq!(rounds[0]["by_plan"], true, "{rounds:?}");
    assert_eq!(rounds[0]["voids"][0]["why"], "the plan keeps it solid");
    let highest_mm = highest_void_mm(&kit);
    assert!((8.0..12.0).contains(&highest_mm), "{highest_mm}");
    assert_eq!(sheet["parts"], make_again(&kit, &again)["parts"]);
}

/// The height of the void in a kit with one void, mm.
fn highest_void_mm(kit: &Path) -> f64 {
    let mesh = stl::decode(&fs::read(kit.join("hollowed.stl")).unwrap()).unwrap();
    let is_void = |shell: &TriMesh| shell.signed_volume_mm3() < 0.0;
    let void = shells(&weld(&mesh)).into_iter().find(is_void).unwrap();
    void.aabb().max.z
}

#[test]
fn dowels_come_with_a_cut_list_and_their_mass_is_counted() {
    let folder = tempfile::tempdir().unwrap();
    let plan = write_middle_cut(folder.path());
    let options = ["--pins", "dowel", "--cut", path(&plan)];
    let sheet = make_small_top(&folder.path().join("kit"), &options);
    let (dowels, parts) = (list(&sheet, "dowels"), list(&sheet, "parts"));
    let counted = sum(list(&sheet, "cut_list"), "/count");
    assert!(
        dowels.len() >= 2 && counted == dowels.len() as f64,
        "{dowels:?}"
    );
    assert!(parts.iter().all(|part| list(part, "pins").is_empty()));
    let [dowels_g, glue_g] = [
        sum(dowels, "/mass_g"),
        sum(list(&sheet, "joints"), "/glue/mass_g"),
    ];
    assert!(dowels_g > 0.0 && glue_g > 0.0);
    let all_g = sum(parts, "/mass_g") + dowels_g + glue_g;
    assert!((all_g / number(&sheet, "/assembly/mass_g") - 1.0).abs() < 1e-9);
}

/// Writes a plan with one level cut through the middle, where there is room for pins and ids.
fn write_middle_cut(folder: &Path) -> PathBuf {
    let plan = folder.join("middle.toml");
    let cut = "[[cuts]]\nid = \"C1\"\npoint_mm = [0, 0, 0.013]\nnormal = [0, 0, 1]\n";
    fs::write(&plan, cut).unwrap();
    plan
}

/// The ids engraved in the parts.
fn marks(sheet: &Value) -> Vec<&str> {
    let marks = list(sheet, "parts")
        .iter()
        .flat_map(|part| list(part, "marks"));
    marks.map(|mark| mark["text"].as_str().unwrap()).collect()
}

#[test]
fn parts_bear_their_ids_unless_none_are_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let plan = write_middle_cut(folder.path());
    let make = |name: &str, ids: &str| {
        let cut = path(&plan);
        let goal = format!("--goal top --up z --wall 2.5mm --cut {cut} {ids}");
        make_kit(&folder.path().join(name), &goal)
    };
    let engraved = make("engraved", "");
    assert_eq!(marks(&engraved), ["P01", "P02"]);
    let checks = list(&engraved, "checks");
    assert!(checks.iter().any(|check| check["name"] == "ids"));
    assert!(marks(&make("plain", "--ids none")).is_empty());
}
