//! An independent judge in Python, which shares no code with the program, finds in a kit's files
//! what the checklist promises.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use common::{assert_exit, checklist, copy, list, make_kit, number, prepare, printed, words};

/// The judge of a kit's folder.
const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_kit.py");
/// The judge of the bound that its certificate states.
const JUDGE_BOUND: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_bound.py");
/// The judge of its 3MF packages.
const JUDGE_3MF: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_3mf.py");
/// The Python packages that each of them imports.
const PACKAGES: &str = "networkx, numpy, rtree, scipy, shapely, trimesh";
const PACKAGES_3MF: &str = "lib3mf, numpy";

/// Returns `EQUIPOISE_JUDGE_PYTHON`, or `python3`; `None`, with a message, if it lacks a package.
fn find_python(packages: &str) -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let import = format!("import {packages}");
    let output = Command::new(&python).args(["-c", &import]).output();
    let has_packages = output.is_ok_and(|output| output.status.success());
    if !has_packages {
        eprintln!("SKIPPED: no Python with {packages} here; pip install them");
    }
    has_packages.then_some(python)
}

/// Lets a judge look at a kit; returns its exit code and everything that it printed.
fn judge(judge: &str, python: &OsString, kit: &Path) -> (Option<i32>, String) {
    let mut command = Command::new(python);
    let command = command.arg(judge).arg(kit);
    let output = command
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    (output.status.code(), printed(&output))
}

/// Replaces a text on a kit's checklist.
fn replace(kit: &Path, stated: &str, lie: &str) {
    let sheet = kit.join("checklist.json");
    let text = fs::read_to_string(&sheet).unwrap();
    assert!(text.contains(stated) && stated != lie, "{stated}");
    fs::write(&sheet, text.replacen(stated, lie, 1)).unwrap();
}

/// States a density of steel on a checklist that is false by a thousandth.
fn state_false_density(kit: &Path) {
    let [density, lie] = [7.85, 7.84].map(|value| format!("\"density_g_cm3\": {value}"));
    replace(kit, &density, &lie);
}

/// Makes a yo-yo on an axle.
fn make_yoyo(folder: &Path) -> PathBuf {
    let kit = folder.join("yoyo");
    let rods = "--string-gap 3mm --axle 4mmx15mm --hardware-mass 2";
    make_kit(&kit, &format!("--wall 1mm --up y --goal yoyo {rods}"));
    kit
}

#[test]
#[ignore = "long: 45 s, and tests/hardware.rs holds its masses; run with -- --ignored"]
fn an_independent_judge_weighs_the_axle_of_a_yoyo() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let (code, said) = judge(JUDGE, &python, &make_yoyo(folder.path()));
    assert!(code == Some(0) && said.contains("H2"), "{said}");
}

#[test]
#[ignore = "long: half a minute, and the same lie is found on a top; run with -- --ignored"]
fn an_independent_judge_finds_a_false_density_of_the_axle_of_a_yoyo() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = make_yoyo(folder.path());
    state_false_density(&kit);
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(code == Some(1) && said.contains("FAIL mass"), "{said}");
}

#[test]
#[ignore = "half a minute; run before a change of tips"]
fn an_independent_judge_weighs_the_tip_and_the_stem_of_a_top_and_finds_a_false_lean() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let rods = "--tip 4mmx12mmx8mm --stem 4mmx16mm";
    let options = format!("--goal top --contact center {rods}");
    make_kit(&kit, &format!("--wall 1mm --up y {options}"));
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(code == Some(0) && said.contains("H2"), "{said}");
    assert!(said.contains("lean promised"), "{said}");
    state_false_density(&kit);
    // The lean follows from shapes alone, so that both lies are found side by side.
    let lean_deg = number(&checklist(&kit), "/goal/spins_on/lean_deg");
    let [lean, lie] = [lean_deg, lean_deg + 0.01].map(|value| format!("\"lean_deg\": {value}"));
    replace(&kit, &lean, &lie);
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(code == Some(1) && said.contains("FAIL mass"), "{said}");
    assert!(said.contains("FAIL lean, °"), "{said}");
}

#[test]
fn an_independent_judge_feels_the_drain_holes_of_an_uncut_piece_and_finds_a_wider_one_false() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let whole = "--size 60mm --pitch 0.3mm --goal stand --up z --cut never";
    let options = format!("{whole} --printer hp-mjf-5200 --least-angle 3");
    assert_exit(&prepare(&kit, &words(&options)), 0);
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(code == Some(0) && said.contains("D2 free, mm"), "{said}");
    let [diameter, lie] = ["2.0", "2.1"].map(|mm| format!("\"diameter_mm\": {mm}"));
    replace(&kit, &diameter, &lie);
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(
        code == Some(1) && said.contains("FAIL D1 free, mm"),
        "{said}"
    );
}

/// Moves one corner of a binary STL file, in all triangles that have it, mm.
fn dent(stl: &Path, by_mm: f32) {
    let mut bytes = fs::read(stl).unwrap();
    let corners = (84..bytes.len()).step_by(50).flat_map(|triangle| {
        let first = triangle + 12;
        [first, first + 12, first + 24]
    });
    let corners: Vec<usize> = corners.collect();
    let moved: [u8; 12] = bytes[corners[0]..][..12].try_into().unwrap();
    let z_mm = f32::from_le_bytes(moved[8..].try_into().unwrap()) + by_mm;
    for at in corners {
        if bytes[at..][..12] == moved {
            bytes[at + 8..][..4].copy_from_slice(&z_mm.to_le_bytes());
        }
    }
    fs::write(stl, bytes).unwrap();
}

/// Kits of a small top in both formats and as packages only, each made once and never changed.
static IN_BOTH: OnceLock<PathBuf> = OnceLock::new();
static IN_3MF: OnceLock<PathBuf> = OnceLock::new();

fn kit_in_both() -> &'static Path {
    IN_BOTH.get_or_init(|| make_packages("objet-connex350", "both"))
}

fn kit_in_3mf() -> &'static Path {
    IN_3MF.get_or_init(|| make_packages("prusa-mk4", "3mf"))
}

/// Makes a kit that states its parts in a format.
fn make_packages(printer: &str, format: &str) -> PathBuf {
    let kit = tempfile::tempdir().unwrap().keep().join(format);
    let sizes = "--goal top --up z --size 60mm --wall 1.5mm --pitch 0.3mm";
    let options = format!("{sizes} --printer {printer} --format {format}");
    assert_exit(&prepare(&kit, &words(&options)), 0);
    kit
}

/// Copies a kit so that a test may change it.
fn copy_of(kit: &Path, folder: &Path) -> PathBuf {
    let copied = folder.join("kit");
    copy(kit, &copied);
    copied
}

#[test]
fn an_independent_judge_agrees_with_the_checklist_and_finds_a_false_mass() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let (code, said) = judge(JUDGE, &python, kit_in_both());
    assert_eq!(code, Some(0), "{said}");
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_of(kit_in_both(), folder.path());
    let mut sheet = checklist(&kit);
    sheet["assembly"]["mass_g"] = (number(&sheet, "/assembly/mass_g") * 1.000_01).into();
    fs::write(kit.join("checklist.json"), sheet.to_string()).unwrap();
    let (code, said) = judge(JUDGE, &python, &kit);
    assert!(code == Some(1) && said.contains("FAIL mass"), "{said}");
}

#[test]
#[ignore = "long: 20 s, and tests/altered finds dents by our own judge; run with -- --ignored"]
fn an_independent_judge_finds_a_dent_of_a_tenth_in_one_part() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_of(kit_in_both(), folder.path());
    let part = list(&checklist(&kit), "parts")[0].clone();
    dent(&kit.join(part["file"].as_str().unwrap()), 0.1);
    let (code, said) = judge(JUDGE, &python, &kit);
    let complaint = format!("FAIL {} off its surfaces", part["id"].as_str().unwrap());
    assert!(code == Some(1) && said.contains(&complaint), "{said}");
}

#[test]
#[ignore = "long: half a minute, and .ci/run does it with README's kit; run with -- --ignored"]
fn an_independent_judge_proves_the_bound_of_a_kit() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let (code, said) = judge(JUDGE_BOUND, &python, kit_in_both());
    assert_eq!(code, Some(0), "{said}");
}

#[test]
#[ignore = "long: two minutes, and tests/verify.rs finds the same lie; run with -- --ignored"]
fn an_independent_judge_refuses_a_better_bound() {
    let Some(python) = find_python(PACKAGES) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_of(kit_in_both(), folder.path());
    let mut sheet = checklist(&kit);
    let bound = number(&sheet, "/certificate/proof/bound");
    // A top is better the slower it spins.
    sheet["certificate"]["proof"]["bound"] = (1.03 * bound).into();
    fs::write(kit.join("checklist.json"), sheet.to_string()).unwrap();
    let (code, said) = judge(JUDGE_BOUND, &python, &kit);
    assert!(
        code == Some(1) && said.contains("BETTER THAN STATED"),
        "{said}"
    );
}

/// Another test gives the kit in both formats to the judge of folders.
#[test]
fn lib3mf_reads_every_package_of_a_kit_in_strict_mode() {
    let Some(python) = find_python(PACKAGES_3MF) else {
        return;
    };
    for kit in [kit_in_both(), kit_in_3mf()] {
        let (code, said) = judge(JUDGE_3MF, &python, kit);
        assert_eq!(code, Some(0), "{said}");
        for file in ["assembly.3mf", "plate.3mf", "parts/"] {
            assert!(said.contains(file), "{file}: {said}");
        }
    }
    if let Some(python) = find_python(PACKAGES) {
        let (code, said) = judge(JUDGE, &python, kit_in_3mf());
        assert_eq!(code, Some(0), "{said}");
    }
}

#[test]
fn lib3mf_finds_parts_that_are_not_in_print_pose() {
    let Some(python) = find_python(PACKAGES_3MF) else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = copy_of(kit_in_3mf(), folder.path());
    fs::copy(kit.join("assembly.3mf"), kit.join("plate.3mf")).unwrap();
    let (code, said) = judge(JUDGE_3MF, &python, &kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("not in print pose"), "{said}");
}
