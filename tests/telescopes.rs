//! Curves become kits of telescopes, which two judges find right; what cannot be is told with its
//! figures, and bad input leaves nothing behind.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod common;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::Command;

use common::{
    assert_exit, checklist, equipoise, files, json, list, number, path, printed, text, verify,
    words,
};

/// The judge of a telescope's kit in Python.
const JUDGE: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/tests/judge/judge_telescope.py"
);
/// The packages that it imports.
const PACKAGES: &str = "manifold3d, numpy, scipy, trimesh, networkx";
/// A quarter of a circle of 80 mm, in three shells: small and quick.
const SMALL: &str = "telescope arc:80,90 --printer prusa-mk4 --shells 3";

/// Makes a kit with these arguments, which must be right.
fn make(kit: &Path, line: &str) {
    let output = equipoise(&[&words(line)[..], &["--out", path(kit)]].concat());
    assert_exit(&output, 0);
}

#[test]
fn an_arc_becomes_a_kit_that_stands_and_passes_both_judges() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    make(&kit, &format!("{SMALL} --goal stand --least-angle 8"));
    let sheet = checklist(&kit);
    assert_eq!(sheet["kind"], "telescope");
    assert_eq!(list(&sheet, "parts").len(), 6);
    // An arc is a chain of arcs: what is left is the rounding of the fit.
    assert!(number(&sheet, "/deviation/max_mm") < 0.05);
    assert!(number(&sheet, "/worst_toppling_deg") >= 8.0);
    for file in [
        "plate.3mf",
        "collapsed.3mf",
        "extended.3mf",
        "motion.json",
        "curve.csv",
        "telescope.toml",
        "job.toml",
        "job.html",
        "certificate.html",
        "pictures/joint.svg",
        "SHA256SUMS",
    ] {
        assert!(kit.join(file).is_file(), "{file}");
    }
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    judge_in_python(&kit);
    replay(folder.path(), &kit);
    lie_about_a_stop(&kit);
}

/// Lets the Python judge look at a kit, if there is a Python with its packages.
fn judge_in_python(kit: &Path) {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let run = |arguments: &[OsString]| Command::new(&python).args(arguments).output();
    let import = run(&["-c".into(), format!("import {PACKAGES}").into()]);
    if !import.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: no Python with {PACKAGES} here; pip install them");
        return;
    }
    let output = run(&[JUDGE.into(), kit.into()]).unwrap();
    assert_exit(&output, 0);
}

/// Makes the kit again from its job: the bytes are the same, but for nothing.
fn replay(folder: &Path, kit: &Path) {
    let again = folder.join("again");
    let job = kit.join("job.toml");
    let output = equipoise(&[
        "telescope",
        "--job",
        path(&job),
        "--out",
        path(&again),
        "--threads",
        "1",
    ]);
    assert_exit(&output, 0);
    assert_eq!(files(kit), files(&again));
}

/// Moves a stop in the checklist: the judge must find that the shell is held before it.
fn lie_about_a_stop(kit: &Path) {
    let file = kit.join("checklist.json");
    let mut sheet: serde_json::Value = serde_json::from_slice(&fs::read(&file).unwrap()).unwrap();
    let stop = sheet["joints"][0]["stop_mm"].as_f64().unwrap();
    sheet["joints"][0]["stop_mm"] = (stop + 1.0).into();
    fs::write(&file, serde_json::to_string(&sheet).unwrap()).unwrap();
    let (code, said) = verify(kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("held before its stop"), "{said}");
}

#[test]
fn a_root_too_thin_for_its_shells_is_impossible_and_told_what_helps() {
    let output = equipoise(&words(
        "telescope arc:80,90 --printer prusa-mk4 --shells 4 --root-radius 6mm --json",
    ));
    assert_exit(&output, 1);
    let answer = json(&output);
    assert_eq!(answer["is_proved"], true);
    assert!(
        answer["reason"]
            .as_str()
            .unwrap()
            .contains("4 shells need a root")
    );
    let settings = &answer["remedies"][0]["settings"][0];
    assert_eq!(settings["key"], "root_radius");
}

#[test]
fn shells_longer_than_they_may_be_are_told_how_many_do() {
    let output = equipoise(&words(
        "telescope arc:80,90 --printer prusa-mk4 --shells 3 --shell-length 35mm",
    ));
    assert_exit(&output, 1);
    let said = printed(&output);
    assert!(
        said.contains("impossible: 3 shells would show 41.9 mm each"),
        "{said}"
    );
    assert!(said.contains("--shells=4"), "{said}");
}

/// Runs on a curve of these bytes, which must be refused; returns the message.
fn refuse(name: &str, bytes: &[u8], options: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let curve = folder.path().join(name);
    fs::write(&curve, bytes).unwrap();
    let kit = folder.path().join("kit");
    let start = [
        "telescope",
        path(&curve),
        "--printer",
        "prusa-mk4",
        "--out",
        path(&kit),
    ];
    let output = equipoise(&[&start[..], &words(options)].concat());
    assert_exit(&output, 2);
    let said = text(&output.stderr);
    assert!(
        said.contains("error: ") && !said.contains("panicked"),
        "{said}"
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "{said}");
    said
}

#[test]
fn curves_that_are_none_are_refused_with_their_place() {
    let cases: [(&str, &[u8], &str); 7] = [
        ("two.csv", b"0,0,0\n1,0,0\n", "2 points"),
        ("nan.csv", b"0,0,0\n1,nan,0\n2,0,0\n", "line 2"),
        ("same.csv", b"0,0,0\n9,0,0\n9,0,0\n20,1,0\n", "points 2 and 3"),
        ("y.obj", b"v 0 0 0\nv 50 0 0\nv 0 50 0\nv 0 0 50\nl 1 2\nl 1 3\nl 1 4\n", "3 lines meet"),
        ("o.obj", b"v 0 0 0\nv 50 0 0\nv 0 50 0\nl 1 2 3 1\n", "closed"),
        ("two.obj", b"v 0 0 0\nv 50 0 0\nv 0 50 0\nv 9 9 9\nl 1 2\nl 3 4\n", "2 curves"),
        ("m.stl", b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid x\n", "model with faces"),
    ];
    for (name, bytes, expected) in cases {
        let said = refuse(name, bytes, "");
        assert!(said.contains(expected), "{name}: {said}");
    }
}

#[test]
fn measures_that_contradict_each_other_are_refused() {
    let curve = b"0,0,0\n50,5,0\n100,20,0\n150,50,0\n";
    for (options, expected) in [
        ("--shells 0", "number of shells"),
        ("--clearance 2mm", "at most the wall"),
        (
            "--tip-radius 9mm --root-radius 6mm",
            "thicker than the root",
        ),
        ("--wall 0.1mm", "wall"),
    ] {
        let said = refuse("curve.csv", curve, options);
        assert!(said.contains(expected), "{options}: {said}");
    }
}

#[test]
fn a_name_that_is_no_curve_says_how_one_is_written() {
    for (source, expected) in [
        ("arc:60", "arc:R,DEG"),
        ("helix:60,10,-1", "above 0"),
        ("spiral:3", "arc:R,DEG or helix:R,PITCH,TURNS"),
        ("nowhere.csv", "no such file"),
    ] {
        let output = equipoise(&["telescope", source, "--printer", "prusa-mk4"]);
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains(expected), "{source}: {said}");
    }
}
