//! Hollow prints in one uncut piece: their voids drain through holes that the program places,
//! counts and judges.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use common::{
    ELLIPSOID, assert_exit, checklist, equipoise, files, json, list, number, path, prepare,
    printed, verify, words,
};
use equipoise::base::watch::Watch;
use equipoise::cut::{GoalAxis, Hollowed, PlanRequest, drain};
use equipoise::geom::{Frame, Point, Vector};
use equipoise::mesh::primitives::{cuboid, cylinder};
use equipoise::mesh::{Csg, Solid, TriMesh};
use equipoise::printer::Printer;
use equipoise::verify::{Check, Evidence, PromisedHole, judge, read_kit};
use serde_json::Value;

/// A small standing model in one piece.
const WHOLE: &str = "--size 60mm --pitch 0.3mm --goal stand --up z --cut never";

/// Prepares the shipped model in one piece.
fn prepare_whole(out: &Path, options: &str) -> Output {
    prepare(out, &words(&format!("{WHOLE} {options}")))
}

/// Makes a kit of the shipped model in one piece. It must keep its promises. Returns its checklist.
fn make(out: &Path, options: &str) -> Value {
    let output = prepare_whole(out, options);
    assert_exit(&output, 0);
    json(&output)
}

/// A kit of sintered powder, and its checklist. It is made once and never changed.
fn sintered() -> &'static (PathBuf, Value) {
    static MADE: OnceLock<(PathBuf, Value)> = OnceLock::new();
    MADE.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let sheet = make(&kit, "--printer formlabs-fuse1");
        (kit, sheet)
    })
}

/// Returns the outward way of a hole on a checklist, with its outer end, mm.
fn way(hole: &Value) -> (Point, Vector) {
    let point = |key: &str| {
        let number = |i: usize| number(hole, &format!("/{key}/{i}"));
        Point::new(number(0), number(1), number(2))
    };
    let (from, to) = (point("from_mm"), point("to_mm"));
    (from, (from - to).normalize())
}

/// Asserts that an order is refused with these words, and that nothing is written.
fn assert_refused(options: &str, says: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("kit");
    let output = prepare(&out, &words(options));
    assert_exit(&output, 2);
    for words in says {
        let said = printed(&output);
        assert!(said.contains(words), "{words:?} is missing in\n{said}");
    }
    assert_eq!(files(folder.path()).len(), 0);
}

#[test]
fn a_piece_of_powder_stands_uncut_and_its_hole_is_counted_and_judged() {
    let (kit, sheet) = sintered();
    assert_eq!(list(sheet, "parts").len(), 1);
    assert_eq!(list(sheet, "cuts").len(), 0);
    let [hole] = list(sheet, "drains") else {
        panic!("one hole: {}", sheet["drains"])
    };
    assert_eq!(hole["diameter_mm"], 5.0);
    assert_eq!(sheet["voids"][0]["drained_by"][0], "D1");
    let opening_mm = number(sheet, "/voids/0/opening_mm");
    assert!((opening_mm - 5.0).abs() < 1e-3, "{opening_mm}");
    // It looks down, and keeps off the foot that the model stands on.
    assert!(way(hole).1.z < -0.3, "{hole}");
    let kinds: Vec<&str> = list(sheet, "checks")
        .iter()
        .filter_map(|check| check["kind"].as_str())
        .collect();
    assert!(kinds.contains(&"drain-holes") && kinds.contains(&"void-open"));
    let (code, said) = verify(kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn what_holes_take_is_missing_from_the_mass_that_is_promised() {
    let (_, sheet) = sintered();
    let taken_mm3 = number(sheet, "/drains/0/volume_mm3");
    let [hollowed, assembly] = ["hollowed", "assembly"];
    let volume = |of: &str| number(sheet, &format!("/{of}/volume_mm3"));
    let lost_mm3 = volume(hollowed) - volume(assembly);
    assert!(taken_mm3 > 10.0);
    assert!(
        (lost_mm3 / taken_mm3 - 1.0).abs() < 1e-3,
        "{lost_mm3} {taken_mm3}"
    );
}

#[test]
fn the_sheet_says_how_many_holes_there_are_and_to_blow_the_powder_out() {
    let page = std::fs::read_to_string(sintered().0.join("job.html")).unwrap();
    for words in ["1 drain hole of 5", "D1 on its", "no more powder comes"] {
        assert!(page.contains(words), "{words:?} is missing");
    }
    assert!(!page.contains("opened by no cut"));
}

#[test]
fn a_replayed_job_with_wider_holes_gives_the_same_bytes_on_one_thread() {
    let folder = tempfile::tempdir().unwrap();
    let [first, again] = ["first", "again"].map(|name| folder.path().join(name));
    let sheet = make(&first, "--printer formlabs-fuse1 --drain 6mm");
    assert_eq!(sheet["drains"][0]["diameter_mm"], 6.0);
    let job = first.join("job.toml");
    assert!(
        std::fs::read_to_string(&job)
            .unwrap()
            .contains("drain = \"6mm\"")
    );
    let replay = ["prepare", "--threads", "1", "--job", path(&job)];
    let output = equipoise(&[&replay[..], &["--out", path(&again)]].concat());
    assert_exit(&output, 0);
    assert!(files(&first) == files(&again));
}

#[test]
fn two_small_holes_far_apart_let_powder_out_where_the_process_says_so() {
    let folder = tempfile::tempdir().unwrap();
    // Its walls are thick: the model is less hollow, and topples sooner.
    let options = "--printer hp-mjf-5200 --least-angle 3";
    let sheet = make(&folder.path().join("kit"), options);
    let [one, other] = list(&sheet, "drains") else {
        panic!("two holes: {}", sheet["drains"])
    };
    assert_eq!([&one["diameter_mm"], &other["diameter_mm"]], [2.0, 2.0]);
    let apart_mm = (way(one).0 - way(other).0).norm();
    assert!(apart_mm > 20.0, "{apart_mm}");
}

#[test]
fn resin_gets_a_drain_below_and_a_vent_above() {
    let folder = tempfile::tempdir().unwrap();
    let sheet = make(&folder.path().join("kit"), "--printer formlabs-form4");
    let [drain, vent] = list(&sheet, "drains") else {
        panic!("two holes: {}", sheet["drains"])
    };
    assert_eq!([&drain["diameter_mm"], &vent["diameter_mm"]], [3.5, 3.5]);
    let [(low, down), (high, up)] = [drain, vent].map(way);
    assert!(high.z - low.z > 20.0 && down.z < 0.0 && up.z > 0.0);
    let cups = list(&sheet, "checks").iter();
    assert_eq!(cups.filter(|check| check["kind"] == "cups").count(), 1);
}

#[test]
fn filament_is_refused_and_told_of_sparse_infill_in_one_piece() {
    let says = ["drain hole", "--interior=graded", "--cut=auto"];
    assert_refused(&format!("{WHOLE} --printer prusa-mk4"), &says);
}

#[test]
fn gel_support_and_what_floats_are_refused() {
    let says = ["support", "--cut=auto"];
    assert_refused(&format!("{WHOLE} --printer objet-connex350"), &says);
    let float = "--size 60mm --pitch 0.3mm --goal float --up z --cut never";
    let says = ["take in water", "--cut=auto"];
    assert_refused(&format!("{float} --printer formlabs-form4"), &says);
}

#[test]
fn narrow_holes_and_holes_in_what_is_cut_are_refused_and_none_leaves_voids_closed() {
    let fuse = "--printer formlabs-fuse1";
    assert_refused(&format!("{WHOLE} {fuse} --drain 3mm"), &["--drain=5mm"]);
    assert_refused(
        &format!("{WHOLE} {fuse} --drain never"),
        &["1 void in the uncut piece", "--cut=auto"],
    );
    let cut = WHOLE.replace("--cut never", "--cut auto");
    let says = ["one uncut piece", "--cut=never"];
    assert_refused(&format!("{cut} {fuse} --drain 6mm"), &says);
    let says = ["is not a length", "or write auto, or never"];
    assert_refused(&format!("{WHOLE} {fuse} --drain some"), &says);
}

#[test]
fn a_top_in_one_piece_runs_true_with_what_its_holes_take() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let top = "--printer formlabs-fuse1 --size 60mm --pitch 0.3mm --goal top --up z --cut never";
    let output = equipoise(
        &[
            &["--json", "prepare", ELLIPSOID, "--out", path(&kit)],
            &words(top)[..],
        ]
        .concat(),
    );
    assert_exit(&output, 0);
    let sheet = json(&output);
    assert!(!list(&sheet, "drains").is_empty());
    assert!(number(&sheet, "/assembly/axis_offset_mm") < 5e-4);
    assert!(number(&sheet, "/assembly/axis_tilt_deg") < 5e-3);
}

/// Returns the evidence of the kit with another part: its uncut body less these prisms. Each has
/// two ends and a radius, mm.
fn bored(bores: &[(Point, Point, f64)]) -> Evidence {
    let mut evidence = read_kit(&sintered().0).unwrap();
    let mut body = Csg::of_mesh(&equipoise::repair::weld(&evidence.hollowed)).unwrap();
    for (from, to, radius_mm) in bores {
        let along = to - from;
        let frame = Frame::with_axis(*from, &along);
        let prism: TriMesh =
            cylinder(*radius_mm, along.norm(), 48).map_vertices(|p| frame.to_model(p));
        body = body.subtract(&Csg::of_mesh(&prism).unwrap()).unwrap();
    }
    let pose = evidence.parts[0].pose;
    let mesh = body.to_mesh().unwrap();
    evidence.parts[0].mesh = mesh.map_vertices(|p| pose.to_print(p));
    evidence
}

/// Returns the ends of the promised hole, and two directions across it.
fn promised() -> (Point, Point, [Vector; 2]) {
    let evidence = read_kit(&sintered().0).unwrap();
    let PromisedHole { from_mm, to_mm, .. } = evidence.promise.drains[0];
    let (from, to) = (Point::from(from_mm), Point::from(to_mm));
    let across = (to - from).cross(&Vector::z()).normalize();
    (from, to, [across, across.cross(&(to - from)).normalize()])
}

/// Returns the broken checks of some evidence, by their keys, with what they name.
pub fn broken(evidence: &Evidence) -> Vec<(String, String)> {
    let found = judge(evidence, &Watch::silent()).unwrap();
    let broken = found.checks.into_iter().filter(|check| !check.pass);
    let named = |check: Check| {
        let kind = serde_json::to_value(&check.kind).unwrap();
        (
            kind["kind"].as_str().unwrap().to_owned(),
            check.detail.unwrap_or_default(),
        )
    };
    broken.map(named).collect()
}

pub fn assert_blamed(evidence: &Evidence, kind: &str, says: &str) {
    let broken = broken(evidence);
    let is_told = |(found, at): &&(String, String)| found == kind && at.contains(says);
    assert!(broken.iter().any(|check| is_told(&check)), "{broken:?}");
}

#[test]
fn the_judge_blames_a_hole_that_is_smaller_than_stated() {
    let (from, to, _) = promised();
    let evidence = bored(&[(from, to, 2.0)]);
    assert_blamed(&evidence, "drain-holes", "D1: 3.9");
    assert_blamed(&evidence, "part-surfaces", "P01");
}

#[test]
fn the_judge_blames_a_missing_hole_and_the_void_that_it_leaves_closed() {
    let evidence = bored(&[]);
    assert_blamed(&evidence, "drain-holes", "D1: 0.00 mm free");
    assert_blamed(&evidence, "closed-cavities", "P01: 1");
}

#[test]
fn the_judge_blames_a_hole_that_was_moved_and_one_too_many() {
    let (from, to, [aside, along]) = promised();
    let wide_mm = 2.5 / (std::f64::consts::PI / 48.0).cos();
    let moved = aside * 1.0;
    let evidence = bored(&[(from + moved, to + moved, wide_mm)]);
    assert_blamed(&evidence, "drain-holes", "D1: 3.");
    let beside = along * 8.0;
    let evidence = bored(&[(from, to, wide_mm), (from + beside, to + beside, 1.0)]);
    assert_blamed(&evidence, "part-surfaces", "P01");
}

#[test]
fn an_unchanged_hole_of_another_hand_is_blamed_for_nothing() {
    let kept = read_kit(&sintered().0).unwrap();
    assert_eq!(broken(&kept), []);
    let sheet = checklist(&sintered().0);
    assert_eq!(list(&sheet, "drains").len(), kept.promise.drains.len());
}

/// Returns the union of two bars that form a T, each made smaller by this on all sides, mm.
fn tee(less_mm: f64) -> Solid {
    let bars = [
        [[0.0, 0.0, 0.0], [200.0, 20.0, 20.0]],
        [[90.0, 0.0, 0.0], [110.0, 140.0, 20.0]],
    ];
    let bars = bars.map(|[low, high]| {
        let (low, high) = (low.map(|x| x + less_mm), high.map(|x| x - less_mm));
        Csg::of_mesh(&cuboid(&low.into(), &high.into())).unwrap()
    });
    bars[0].union(&bars[1]).unwrap().to_solid().unwrap()
}

#[test]
fn a_long_void_gets_more_holes_until_all_of_it_is_within_reach() {
    let hollowed = Hollowed::new(tee(0.0), vec![tee(2.0)]);
    let printer = Printer::find("formlabs-form4").unwrap();
    let axis = GoalAxis {
        point: Point::new(100.0, 70.0, 0.0),
        direction: Vector::z(),
    };
    let mut request = PlanRequest::for_printer(&printer, 200.0, axis);
    let need = printer.drain_need(None).unwrap();
    let count = |request: &PlanRequest| drain(&hollowed, request, &need).unwrap().plan;
    assert_eq!(count(&request).drains.len(), 2);
    request.cleaning.reach_mm = Some(60.0);
    let found = count(&request);
    assert!(found.drains.len() > 2, "{:?}", found.drains);
    assert!(found.voids[0].depth_mm <= 60.0);
}
