//! Plugs: printed parts that close the drain holes of one uncut piece, once its voids are empty.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use common::{assert_exit, files, json, list, number, prepare, printed, verify, words};
use equipoise::base::watch::Watch;
use equipoise::geom::{Point, Vector};
use equipoise::verify::{Check, Evidence, judge, read_kit};
use serde_json::Value;

/// A small standing model of powder in one piece, with plugs.
const PLUGGED: &str = "--size 60mm --pitch 0.3mm --goal stand --up z --cut never --plugs \
                       --printer formlabs-fuse1";

/// A kit with a plug, and its checklist. It is made once and never changed.
fn plugged() -> &'static (PathBuf, Value) {
    static MADE: OnceLock<(PathBuf, Value)> = OnceLock::new();
    MADE.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let output = prepare(&kit, &words(PLUGGED));
        assert_exit(&output, 0);
        (kit, json(&output))
    })
}

/// Returns the evidence of the kit with its plug moved by a way of the model, and larger by a
/// ratio about its middle.
fn with_other_plug(ratio: f64, way: Vector) -> Evidence {
    let mut evidence = read_kit(&plugged().0).unwrap();
    let plug = &mut evidence.parts[1];
    let pose = plug.pose;
    let middle = plug.mesh.aabb().center();
    let moved = |p: &Point| {
        let larger = middle + (p - middle) * ratio;
        pose.to_print(&(pose.to_model(&larger) + way))
    };
    plug.mesh = plug.mesh.map_vertices(moved);
    evidence
}

/// Returns the broken checks of some evidence, by their keys.
fn broken(evidence: &Evidence) -> Vec<String> {
    let found = judge(evidence, &Watch::silent()).unwrap();
    let broken = found.checks.into_iter().filter(|check| !check.pass);
    let key = |check: Check| {
        let kind = serde_json::to_value(&check.kind).unwrap();
        kind["kind"].as_str().unwrap().to_owned()
    };
    broken.map(key).collect()
}

#[test]
fn a_hole_gets_a_plug_that_is_a_part_of_the_kit_and_closes_it_with_its_gap() {
    let (kit, sheet) = plugged();
    assert_eq!(list(sheet, "parts").len(), 2);
    let hole = &list(sheet, "drains")[0];
    assert_eq!(
        (&hole["plug"]["part"], &hole["plug"]["gap_mm"]),
        (&"P02".into(), &0.1.into())
    );
    // Flanks of 14° and more stop it in its hole.
    let wider_mm = number(hole, "/mouth_mm") - number(hole, "/diameter_mm");
    assert!(wider_mm > 0.5, "{wider_mm}");
    let part = &list(sheet, "parts")[1];
    assert_eq!(part["lies"], "narrow end down");
    // A small thing: some tenths of a gram.
    assert!((0.02..0.5).contains(&number(part, "/mass_g")), "{part}");
    let checks = list(sheet, "checks");
    assert!(
        checks
            .iter()
            .any(|check| check["kind"] == "plugs" && check["pass"] == true)
    );
    let (code, said) = verify(kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn the_mass_that_is_promised_has_lost_the_holes_and_won_the_plugs() {
    let (_, sheet) = plugged();
    let volume = |of: &str| number(sheet, &format!("/{of}/volume_mm3"));
    let taken_mm3 = number(sheet, "/drains/0/volume_mm3");
    let plug_mm3 = number(sheet, "/parts/1/volume_mm3");
    let lost_mm3 = volume("hollowed") - volume("assembly");
    assert!(plug_mm3 > 10.0 && taken_mm3 > 10.0);
    assert!(
        (lost_mm3 - taken_mm3 + plug_mm3).abs() < 0.05,
        "{lost_mm3} {taken_mm3} {plug_mm3}"
    );
}

#[test]
fn the_sheet_tells_to_close_the_holes_after_cleaning() {
    let page = fs::read_to_string(plugged().0.join("job.html")).unwrap();
    let at = |words: &str| {
        page.find(words)
            .unwrap_or_else(|| panic!("{words} is missing"))
    };
    let clean = at(". Clean and weigh</h2>");
    let close = at(". Close the drain holes</h2>");
    assert!(clean < close && close < at(". Test</h2>"));
    assert!(at("push the narrow end in until the outer end is flush") > close);
    assert!(page.contains("1 part, 1 plug, 1 drain hole, 1 void"));
    assert!(page.contains("narrow end down"));
}

#[test]
fn the_judge_blames_a_plug_that_is_shifted_or_larger_or_that_does_not_lie_in_its_hole() {
    assert_eq!(
        broken(&with_other_plug(1.0, Vector::zeros())),
        Vec::<String>::new()
    );
    for (ratio, way) in [(1.0, Vector::new(0.03, 0.0, 0.0)), (1.01, Vector::zeros())] {
        let found = broken(&with_other_plug(ratio, way));
        for kind in ["part-surfaces", "plugs"] {
            assert!(
                found.iter().any(|key| key == kind),
                "{ratio} {way}: {found:?}"
            );
        }
    }
    let far = broken(&with_other_plug(1.0, Vector::new(0.0, 0.0, 90.0)));
    assert!(far.iter().any(|key| key == "part-surfaces"), "{far:?}");
}

#[test]
fn the_judge_blames_a_plug_that_would_fall_in() {
    let mut evidence = read_kit(&plugged().0).unwrap();
    let hole = &mut evidence.promise.drains[0];
    hole.plug.as_mut().unwrap().gap_mm = 0.7;
    let found = judge(&evidence, &Watch::silent()).unwrap();
    let told = found.checks.iter().filter(|check| !check.pass);
    let told: Vec<String> = told.filter_map(|check| check.detail.clone()).collect();
    assert!(
        told.iter().any(|words| words.contains("P02 falls into D1")),
        "{told:?}"
    );
}

#[test]
fn the_judge_blames_a_plug_without_a_gap_and_one_that_is_said_to_close_two_holes() {
    let mut evidence = read_kit(&plugged().0).unwrap();
    evidence.promise.drains[0].plug.as_mut().unwrap().gap_mm = 0.0;
    assert!(broken(&evidence).iter().any(|key| key == "plugs"));
    let mut evidence = read_kit(&plugged().0).unwrap();
    let mut other = evidence.promise.drains[0].clone();
    other.id = "D2".to_owned();
    evidence.promise.drains.push(other);
    assert!(broken(&evidence).iter().any(|key| key == "plugs"));
}

#[test]
fn the_judge_blames_a_body_that_is_said_to_be_the_plug() {
    let mut evidence = read_kit(&plugged().0).unwrap();
    evidence.promise.drains[0].plug.as_mut().unwrap().part = "P01".to_owned();
    let found = broken(&evidence);
    for kind in ["drain-holes", "part-surfaces"] {
        assert!(found.iter().any(|key| key == kind), "{found:?}");
    }
}

#[test]
fn a_thing_of_powder_floats_in_one_piece_once_its_holes_are_closed() {
    let folder = tempfile::tempdir().unwrap();
    let float = PLUGGED.replace("--goal stand", "--goal float");
    let open = folder.path().join("open");
    let output = prepare(&open, &words(&float.replace("--plugs", "")));
    assert_exit(&output, 2);
    assert!(printed(&output).contains("--plugs"), "{}", printed(&output));
    assert_eq!(files(folder.path()).len(), 0);
    let kit = folder.path().join("kit");
    let output = prepare(&kit, &words(&float));
    assert_exit(&output, 0);
    assert!(!list(&json(&output), "drains").is_empty());
    // Without the plug, water gets in.
    let mut evidence = read_kit(&kit).unwrap();
    assert!(broken(&evidence).iter().all(|key| key != "plugs"));
    evidence.promise.drains[0].plug = None;
    assert!(broken(&evidence).iter().any(|key| key == "plugs"));
}

#[test]
fn what_sinks_without_a_void_that_has_no_place_for_holes_is_refused() {
    // Nylon is a little heavier than water: the void is too small for a hole of 12 mm.
    let folder = tempfile::tempdir().unwrap();
    let order = "--size 30mm --pitch 0.3mm --goal float --up z --cut never --plugs \
                 --printer formlabs-fuse1 --drain 12mm";
    let output = prepare(&folder.path().join("kit"), &words(order));
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("has no place for drain holes of 12 mm") && said.contains("--drain=auto"),
        "{said}"
    );
    assert_eq!(files(folder.path()).len(), 0);
}

#[test]
fn plugs_without_drain_holes_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cut = PLUGGED.replace("--cut never", "");
    let output = prepare(&folder.path().join("kit"), &words(&cut));
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("--plugs") && said.contains("--cut=never"),
        "{said}"
    );
    assert_eq!(files(folder.path()).len(), 0);
}
