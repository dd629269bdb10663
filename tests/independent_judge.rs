//! A judge in another language, with nothing of ours, finds in a kit's files what the checklist
//! promises.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const MODEL: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);
const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_kit.py");
const JUDGE_3MF: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_3mf.py");

/// The Python to judge with: `EQUIPOISE_JUDGE_PYTHON`, or `python3`; none where it lacks the
/// judge's packages.
fn python() -> Option<OsString> {
    python_with("numpy, rtree, scipy, shapely, trimesh")
}

/// The Python to judge with; none where it lacks these packages.
fn python_with(packages: &str) -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let imports = Command::new(&python)
        .args(["-c", &format!("import {packages}")])
        .output();
    imports
        .is_ok_and(|output| output.status.success())
        .then_some(python)
}

fn judged(python: &OsString, kit: &Path) -> (Option<i32>, String) {
    judged_by(JUDGE, python, kit)
}

fn judged_by(judge: &str, python: &OsString, kit: &Path) -> (Option<i32>, String) {
    let Output {
        status,
        stdout,
        stderr,
    } = Command::new(python)
        .arg(judge)
        .arg(kit)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    (
        status.code(),
        String::from_utf8_lossy(&[stdout, stderr].concat()).into_owned(),
    )
}

#[test]
fn an_independent_judge_agrees_on_what_is_not_printed() {
    let Some(python) = python() else {
        eprintln!("SKIPPED: no Python with numpy, rtree, scipy, shapely and trimesh here");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let yoyo = [
        "--goal",
        "yoyo",
        "--up",
        "y",
        "--string-gap",
        "3mm",
        "--axle",
        "4mmx15mm",
        "--hardware-mass",
        "2",
    ];
    let top = [
        "--goal",
        "top",
        "--up",
        "y",
        "--contact",
        "center",
        "--tip",
        "4mmx12mmx8mm",
        "--stem",
        "4mmx16mm",
    ];
    for (name, goal) in [("yoyo", yoyo), ("top", top)] {
        let kit = folder.path().join(name);
        let prepared = Command::new(env!("CARGO_BIN_EXE_equipoise"))
            .args([
                "-q",
                "prepare",
                MODEL,
                "--printer",
                "objet-connex350",
                "--size",
                "60mm",
            ])
            .args(["--wall", "1mm", "--pitch", "0.3mm", "--out"])
            .arg(&kit)
            .args(goal)
            .output()
            .unwrap();
        assert!(
            prepared.status.success(),
            "{}",
            String::from_utf8_lossy(&prepared.stderr)
        );
        let (code, said) = judged(&python, &kit);
        assert!(code == Some(0) && said.contains("H2"), "{said}");
        let sheet = kit.join("checklist.json");
        let told = fs::read_to_string(&sheet).unwrap();
        let lie = told.replacen("\"density_g_cm3\": 7.85", "\"density_g_cm3\": 7.84", 1);
        assert_ne!(told, lie);
        fs::write(&sheet, lie).unwrap();
        let (code, said) = judged(&python, &kit);
        assert!(code == Some(1) && said.contains("FAIL mass"), "{said}");
    }
}

#[test]
fn an_independent_judge_agrees_with_the_checklist_and_finds_a_lie_in_it() {
    let Some(python) = python() else {
        eprintln!("SKIPPED: no Python with numpy, rtree, scipy, shapely and trimesh here");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let prepared = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "-q",
            "prepare",
            MODEL,
            "--printer",
            "objet-connex350",
            "--goal",
            "top",
            "--size",
            "60mm",
        ])
        .args(["--wall", "1.5mm", "--pitch", "0.3mm", "--out"])
        .arg(&kit)
        .output()
        .unwrap();
    assert!(
        prepared.status.success(),
        "{}",
        String::from_utf8_lossy(&prepared.stderr)
    );
    let (code, said) = judged(&python, &kit);
    assert_eq!(code, Some(0), "{said}");
    let sheet = kit.join("checklist.json");
    let mut checklist: serde_json::Value =
        serde_json::from_slice(&fs::read(&sheet).unwrap()).unwrap();
    let mass_g = checklist["assembly"]["mass_g"].as_f64().unwrap();
    checklist["assembly"]["mass_g"] = (mass_g * 1.000_01).into();
    fs::write(&sheet, checklist.to_string()).unwrap();
    let (code, said) = judged(&python, &kit);
    assert!(
        code == Some(1) && said.contains("FAIL mass"),
        "{code:?} {said}"
    );
}

#[test]
fn the_consortiums_own_library_takes_every_package_of_a_kit_in_strict_mode_and_finds_what_is_wrong()
{
    let Some(python) = python_with("lib3mf, numpy") else {
        eprintln!("SKIPPED: no Python with lib3mf and numpy here; pip install lib3mf numpy");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    for (printer, format) in [("objet-connex350", "both"), ("prusa-mk4", "3mf")] {
        let kit = folder.path().join(format);
        let prepared = Command::new(env!("CARGO_BIN_EXE_equipoise"))
            .args([
                "-q",
                "prepare",
                MODEL,
                "--printer",
                printer,
                "--goal",
                "top",
                "--size",
                "60mm",
            ])
            .args([
                "--wall", "1.5mm", "--pitch", "0.3mm", "--format", format, "--out",
            ])
            .arg(&kit)
            .output()
            .unwrap();
        assert!(
            prepared.status.success(),
            "{}",
            String::from_utf8_lossy(&prepared.stderr)
        );
        let (code, said) = judged_by(JUDGE_3MF, &python, &kit);
        assert_eq!(code, Some(0), "{said}");
        assert!(
            said.contains("assembly.3mf") && said.contains("plate.3mf") && said.contains("parts/"),
            "{said}"
        );
        if let Some(python) = python_with("numpy, rtree, scipy, shapely, trimesh") {
            let (code, said) = judged(&python, &kit);
            assert_eq!(code, Some(0), "{said}");
        }
    }
    let kit = folder.path().join("3mf");
    fs::copy(kit.join("assembly.3mf"), kit.join("plate.3mf")).unwrap();
    let (code, said) = judged_by(JUDGE_3MF, &python, &kit);
    assert!(
        code == Some(1) && said.contains("not in print pose"),
        "{said}"
    );
}
