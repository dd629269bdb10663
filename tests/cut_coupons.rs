//! Coupons of a laser cutter: a reader of other people finds the drawings right. What was measured
//! on them ends up in the shop's own profiles.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use common::{assert_exit, printed};

/// The judge of drawings.
const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_cut.py");

/// Runs the program in a folder.
fn run(folder: &Path, line: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    let command = command.current_dir(folder).args(line.split_whitespace());
    command.output().unwrap()
}

/// Returns `EQUIPOISE_JUDGE_PYTHON`, or `python3`; `None`, with a message, if it lacks a package.
fn find_python() -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let output = Command::new(&python)
        .args(["-c", "import ezdxf, manifold3d, shapely, trimesh"])
        .output();
    let has_packages = output.is_ok_and(|output| output.status.success());
    if !has_packages {
        eprintln!(
            "SKIPPED: no Python with ezdxf, manifold3d, shapely, trimesh here; pip install them"
        );
    }
    has_packages.then_some(python)
}

/// Lets the judge look at coupons; returns its exit code and what it printed.
fn judge(python: &OsString, folder: &Path) -> (Option<i32>, String) {
    let mut command = Command::new(python);
    let command = command.arg(JUDGE).arg(folder);
    let output = command
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    (output.status.code(), printed(&output))
}

#[test]
fn an_independent_judge_finds_slots_and_squares_as_named_and_joints_that_go_together() {
    let Some(python) = find_python() else { return };
    let folder = tempfile::tempdir().unwrap();
    for (cutter, sheet) in [
        ("makerspace-900x600", "birch-5"),
        ("speedy-400", "acrylic-3"),
        ("glowforge", "mdf-6"),
    ] {
        let line = format!("coupon --cutter {cutter} --sheet {sheet} --out {cutter}");
        assert_exit(&run(folder.path(), &line), 0);
        let (code, said) = judge(&python, &folder.path().join(cutter));
        assert_eq!(code, Some(0), "{cutter}: {said}");
    }
    // A slot of another width, a joint at another angle, and a scaled picture, are found.
    let coupons = folder.path().join("glowforge");
    let sizes = fs::read_to_string(coupons.join("coupon.json")).unwrap();
    let wrong = sizes.replacen(
        "\"number\": 3,\n      \"width_mm\": 5.9",
        "\"number\": 3,\n      \"width_mm\": 5.8",
        1,
    );
    assert_ne!(sizes, wrong);
    let wrong = wrong.replacen("\"angle_deg\": 60.0", "\"angle_deg\": 55.0", 1);
    fs::write(coupons.join("coupon.json"), wrong).unwrap();
    let svg = fs::read_to_string(coupons.join("coupon.svg")).unwrap();
    let scaled = svg.replacen("viewBox=\"0 0 ", "viewBox=\"0 0 1", 1);
    fs::write(coupons.join("coupon.svg"), scaled).unwrap();
    let (code, said) = judge(&python, &coupons);
    assert_eq!(code, Some(1));
    assert!(
        said.contains("slot 3 is")
            && said.contains("the panels of A1 overlap")
            && said.contains("the view box scales"),
        "{said}"
    );
}

#[test]
fn the_same_coupons_are_the_same_bytes_and_nothing_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let line = "coupon --cutter thunder-nova-51 --sheet birch-3 --out";
    for name in ["one", "two"] {
        assert_exit(&run(folder.path(), &format!("{line} {name}")), 0);
    }
    for file in ["coupon.dxf", "coupon.svg", "coupon.html", "coupon.json"] {
        let [one, two] = ["one", "two"].map(|name| fs::read(folder.path().join(name).join(file)));
        assert_eq!(one.unwrap(), two.unwrap(), "{file}");
    }
    let again = run(folder.path(), &format!("{line} one"));
    assert_exit(&again, 2);
    assert!(printed(&again).contains("--force"), "{}", printed(&again));
}

#[test]
fn measurements_end_up_in_the_shops_own_profiles_and_in_the_next_coupons() {
    let folder = tempfile::tempdir().unwrap();
    let run = |line: &str| run(folder.path(), line);
    assert_exit(
        &run("cutters new --from makerspace-900x600 --out laser.toml"),
        0,
    );
    assert_exit(&run("cutters new --from birch-5 --out birch.toml"), 0);
    let calibrate = "cutters calibrate laser.toml --sheet birch.toml --lot B7 --date 2026-11-26";
    let output = run(&format!(
        "{calibrate} --row 197.5 --thickness 5.2 --thickness 5.1 --weighed 14"
    ));
    assert_exit(&output, 0);
    assert!(
        printed(&output).contains("kerf in plywood: 0.250 mm"),
        "{}",
        printed(&output)
    );
    assert_exit(
        &run("coupon --cutter laser.toml --sheet birch.toml --out coupons"),
        0,
    );
    let sizes = fs::read_to_string(folder.path().join("coupons/coupon.json")).unwrap();
    assert!(sizes.contains("\"kerf_mm\": 0.25,") && sizes.contains("\"thickness_mm\": 5.15,"));
    // What cannot be leaves both files as they are.
    let before =
        ["laser.toml", "birch.toml"].map(|file| fs::read(folder.path().join(file)).unwrap());
    for wrong in [
        "--row 201 --thickness 5",
        "--row 198 --thickness 5 --thickness 50",
        "--row 198 --thickness 5 --weighed 0",
    ] {
        let output = run(&format!("{calibrate} {wrong}"));
        assert_exit(&output, 2);
        assert!(printed(&output).contains("remedy"), "{}", printed(&output));
    }
    let after =
        ["laser.toml", "birch.toml"].map(|file| fs::read(folder.path().join(file)).unwrap());
    assert_eq!(before, after);
}

#[test]
fn a_coupon_needs_a_printer_or_a_cutter_with_its_sheet() {
    let folder = tempfile::tempdir().unwrap();
    for (line, said) in [
        ("coupon", "--printer"),
        ("coupon --cutter glowforge", "--sheet"),
        (
            "coupon --cutter glowforge --sheet pvc-3",
            "there is no sheet `pvc-3`",
        ),
        (
            "coupon --cutter glow --sheet mdf-3",
            "there is no cutter `glow`",
        ),
        (
            "coupon --cutter glowforge --sheet mdf-3 --printer prusa-mk4",
            "cannot be used with",
        ),
        (
            "cutters calibrate glowforge --sheet mdf-3 --lot A --row 198 --thickness 3",
            "is no file of yours",
        ),
    ] {
        let output = run(folder.path(), line);
        assert_exit(&output, 2);
        assert!(
            printed(&output).contains(said),
            "{line}: {}",
            printed(&output)
        );
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0, "{line}");
    }
}
