//! The flow of a filament: slicers lay it as the profile says, and it changes no promise. And the
//! shop's own profile in the rounds of a kit.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use common::{
    ELLIPSOID, assert_exit, cura_definitions, equipoise, has_slicer, json, list, number, path,
    printed, words,
};
use serde_json::Value;

/// An MK4 whose filament needs 4 % less than its lines' volume.
const LESS: &str = r#"
id = "calibrated"
name = "MK4 with a calibrated filament"
inherits = "prusa-mk4"

[[material]]
id = "weighed-pla"
name = "PLA, weighed"
density_g_cm3 = { value = 1.24, source = "a test", sure = "read" }
flow_ratio = { value = 0.96, source = "weighed cubes", sure = "read" }
"#;

/// Returns a kit for that printer, which is made once.
fn kit() -> &'static Path {
    static KIT: OnceLock<PathBuf> = OnceLock::new();
    KIT.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("flow");
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        fs::create_dir_all(&folder).unwrap();
        let printer = folder.join("calibrated.toml");
        fs::write(&printer, LESS).unwrap();
        let kit = folder.join("kit");
        let options = "--goal stand --up y --least-angle 2 --size 40mm --pitch 0.4mm \
            --material weighed-pla";
        let usual = ["prepare", ELLIPSOID, "--printer", path(&printer)];
        let all = [&usual[..], &["--out", path(&kit)], &words(options)].concat();
        assert_exit(&equipoise(&all), 0);
        kit
    })
}

/// Asserts that sliced toolpaths keep the kit's promise, that they weigh less than its parts by the
/// flow, and that they say so.
fn assert_calibrated(found: &Value, name: &str) {
    let judgement = &found["judgement"];
    // Support in a void is told, and is no fault.
    let mut causes = list(judgement, "causes").iter();
    assert!(
        causes.all(|cause| cause["is_wrong"] == false),
        "{judgement}"
    );
    let says = |note: &Value| note.as_str().unwrap_or_default().contains("96.0 %");
    assert!(list(judgement, "notes").iter().any(says), "{judgement}");
    let laid_g = number(judgement, "/toolpaths/mass_g");
    let written_g = number(judgement, "/written/mass_g");
    assert!(
        (laid_g / written_g - 1.0).abs() < 0.02,
        "{name}: {laid_g} {written_g}"
    );
}

#[test]
fn prusaslicer_lays_the_flow_of_the_filament_and_the_judge_takes_it_off() {
    if !has_slicer() {
        return;
    }
    let out = kit().with_file_name("prusa");
    let output = equipoise(&["--json", "slice", path(kit()), "--out", path(&out)]);
    assert_exit(&output, 0);
    assert_calibrated(&json(&output), "PrusaSlicer");
    let text = fs::read_to_string(out.join("plate.gcode")).unwrap();
    assert!(text.contains("; extrusion_multiplier = 0.96"));
}

#[test]
fn curaengine_lays_the_flow_of_the_filament_and_the_judge_takes_it_off() {
    let Some(definitions) = cura_definitions() else {
        return;
    };
    let out = kit().with_file_name("cura");
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    command.env("CURA_ENGINE_SEARCH_PATH", definitions);
    command.args([
        "--json",
        "slice",
        path(kit()),
        "--slicer",
        "cura",
        "--out",
        path(&out),
    ]);
    let output = command.output().unwrap();
    assert_exit(&output, 0);
    assert_calibrated(&json(&output), "CuraEngine");
}

#[test]
fn the_shops_profile_decides_the_speeds_in_the_rounds_and_the_sheet_says_so() {
    let folder = tempfile::tempdir().unwrap();
    let profile = folder.path().join("shop.ini");
    fs::write(&profile, "perimeter_speed = 17\nlayer_height = 0.3\n").unwrap();
    let make = |name: &str, more: &[&str]| {
        let out = folder.path().join(name);
        let options = "--goal stand --up y --least-angle 2 --size 40mm --pitch 0.4mm \
            --printer prusa-mk4 --interior graded";
        let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&out)];
        let output = equipoise(&[&usual[..], &words(options), more].concat());
        (output, out)
    };
    let profile = path(&profile).to_owned();
    let (refused, _) = make("alone", &["--slicer-profile", &profile]);
    assert_exit(&refused, 2);
    assert!(
        printed(&refused).contains("--slice"),
        "{}",
        printed(&refused)
    );
    let (refused, _) = make("absent", &["--slice", "--slicer-profile", "no-such.ini"]);
    assert_exit(&refused, 2);
    assert!(
        printed(&refused).contains("no-such.ini"),
        "{}",
        printed(&refused)
    );
    if !has_slicer() {
        return;
    }
    let (output, kit) = make("kit", &["--slice", "--slicer-profile", &profile]);
    assert_exit(&output, 0);
    let sheet = json(&output);
    assert_eq!(sheet["print_time"]["has_profile"], true);
    let sha256 = sheet["toolpaths"]["profile_sha256"].as_str().unwrap();
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    assert!(page.contains(&sha256[..12]));
    assert!(page.contains("the speeds of the shop's profile"));
    // Its job makes the same kit again, without a slicer and without the profile.
    let again = folder.path().join("again");
    let job = kit.join("job.toml");
    let output = equipoise(&["prepare", "--job", path(&job), "--out", path(&again)]);
    assert_exit(&output, 0);
    let job = |kit: &Path| fs::read(kit.join("job.toml")).unwrap();
    assert_eq!(job(&kit), job(&again));
}
