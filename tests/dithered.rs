//! A model in two materials: its images keep the mass, the centre and the inertia of a field.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::Path;
use std::process::Command;

use common::{ELLIPSOID, assert_exit, equipoise, equipoise_in, files, json, list, number};
use common::{path, printed, words};
use serde_json::Value;

const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_dithered.py");
/// A shop's jet with a second material, of half the density so that a test sees errors.
const JET: &str = "id = \"jet\"\nname = \"Jet\"\ninherits = \"objet-connex350\"\n\n\
    [[material]]\nid = \"light\"\nname = \"Light\"\n\
    density_g_cm3 = { value = 0.5875, source = \"a test\", sure = \"own-choice\" }\n";
/// The same with a rubber-like material.
const TANGO: &str = "id = \"tango-jet\"\nname = \"Jet\"\ninherits = \"objet-connex350\"\n\n\
    [[material]]\nid = \"tango\"\nname = \"Tango\"\n\
    density_g_cm3 = { value = 1.13, source = \"a test\", sure = \"own-choice\" }\n";

/// Writes the profiles, and a model of coarse pixels.
fn bench() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("jet.toml"), JET).unwrap();
    fs::write(folder.path().join("tango.toml"), TANGO).unwrap();
    folder
}

/// Dithers the ellipsoid of this size into a folder.
fn dither(folder: &Path, options: &str, out: &str) -> std::process::Output {
    let usual = ["--json", "slice", ELLIPSOID, "--out", out];
    equipoise_in(folder, &[&usual[..], &words(options)].concat())
}

/// Returns the differences that the command found in its own images.
fn off(found: &Value) -> [f64; 3] {
    ["/off/mass_ratio", "/off/center_mm", "/off/inertia_ratio"]
        .map(|pointer| number(found, pointer).abs())
}

#[test]
fn two_stacks_share_the_pixels_and_weigh_what_the_field_does() {
    let folder = bench();
    for (name, profile, field) in [
        (
            "ramp",
            "jet.toml --materials vero-white,light",
            "ramp:1,0,1@1mm..5mm:0.55..0.95",
        ),
        (
            "wave",
            "jet.toml --materials light,vero-white",
            "sine:3,2,2@4mm:0.5..1",
        ),
        (
            "even",
            "jet.toml --materials vero-white,light",
            "uniform:0.7",
        ),
        (
            "tango",
            "tango.toml --materials vero-white,tango",
            "ramp:0,0,1@0mm..5mm:0.97..0.99",
        ),
    ] {
        let options = format!("--size 7mm --printer {profile} --field {field}");
        let output = dither(folder.path(), &options, name);
        let found = json(&output);
        let [mass, center_mm, inertia] = off(&found);
        eprintln!("{name}: mass {mass:.1e}, centre {center_mm:.1e} mm, inertia {inertia:.1e}");
        assert_exit(&output, 0);
        assert!(
            mass <= 1e-5 && center_mm <= 1e-4 && inertia <= 2e-5,
            "{name}"
        );
        // What the program measures by `inspect` is what the images are held against.
        let options = format!("--size 7mm --field {field}");
        let told = equipoise(&[&["--json", "inspect", ELLIPSOID][..], &words(&options)].concat());
        let told = json(&told);
        let wanted = &found["dithered"]["wanted"];
        let density = number(&found["dithered"]["materials"][0], "/density_g_cm3");
        let told_g = number(&told, "/field/mass_g") / number(&told, "/field/material_g_cm3");
        let ratio = number(wanted, "/mass_g") / (told_g * density);
        assert!((ratio - 1.0).abs() < 1e-8, "{name}: {ratio}");
        for axis in 0..3 {
            let at = format!("/center_mm/{axis}");
            let shift = number(&found["dithered"], &format!("/origin_mm/{axis}"));
            let told_mm = number(&told["field"]["body"], &at) + shift;
            assert!((number(wanted, &at) - told_mm).abs() < 1e-6, "{name}");
        }
    }
    let found = dither(
        folder.path(),
        "--size 7mm --printer jet.toml --materials vero-white,light --field uniform:1",
        "pure",
    );
    // Nothing can be changed in pure material: the pixels of the surface are what is off.
    let volumes = &json(&found)["dithered"]["materials"];
    assert_eq!(number(volumes, "/1/volume_mm3"), 0.0);
}

#[test]
fn another_reader_finds_no_pixel_of_both_materials_and_the_same_weight() {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let output = Command::new(&python).args(["-c", "import numpy"]).output();
    if !output.is_ok_and(|output| output.status.success()) {
        eprintln!("SKIPPED: no Python with numpy here; pip install it");
        return;
    }
    let folder = bench();
    let options = "--size 8mm --printer jet.toml --materials vero-white,light \
        --field ramp:1,0,0@1mm..6mm:0.55..0.95";
    assert_exit(&dither(folder.path(), options, "stack"), 0);
    let stack = folder.path().join("stack");
    let judge = || {
        let mut command = Command::new(&python);
        command.arg(JUDGE).arg(&stack);
        command
            .env("PYTHONDONTWRITEBYTECODE", "1")
            .output()
            .unwrap()
    };
    let judged = judge();
    assert_eq!(judged.status.code(), Some(0), "{}", printed(&judged));
    eprintln!("{}", printed(&judged));
    // A layer that is there twice is seen.
    let image = |material: &str| stack.join(material).join("00100.png");
    fs::copy(image("vero-white"), image("light")).unwrap();
    let judged = judge();
    assert_eq!(judged.status.code(), Some(1), "{}", printed(&judged));
}

#[test]
fn the_same_model_is_the_same_bytes_on_any_number_of_threads() {
    let folder = bench();
    let options = "--size 6mm --printer jet.toml --materials vero-white,light \
        --field ramp:0,1,0@1mm..4mm:0.55..0.95";
    for threads in ["1", "2"] {
        let options = format!("{options} --threads {threads}");
        assert_exit(&dither(folder.path(), &options, threads), 0);
    }
    let written = ["1", "2"].map(|name| files(&folder.path().join(name)));
    assert!(written[0] == written[1], "other bytes on two threads");
    let found: Value =
        serde_json::from_slice(&fs::read(folder.path().join("1/layers.json")).unwrap()).unwrap();
    let layers = number(&list(&found, "plates")[0], "/layers");
    assert_eq!(written[0].len() as f64, 2.0 * layers + 2.0);
    // It is one of ours, and is replaced only when that is asked for.
    assert_exit(&dither(folder.path(), options, "1"), 2);
    assert_exit(
        &dither(folder.path(), &format!("{options} --force"), "1"),
        0,
    );
}

#[test]
fn what_cannot_be_set_in_two_materials_is_refused_and_nothing_is_written() {
    let folder = bench();
    let right = "--size 6mm --printer jet.toml --materials vero-white,light --field uniform:0.7";
    for (from, to, said) in [
        ("jet.toml", "prusa-mk4", "it lays lines"),
        ("jet.toml", "prusa-sl1s", "one material at a time"),
        (
            "jet.toml",
            "objet-connex350",
            "has one material, vero-white",
        ),
        ("vero-white,light", "vero-white,heavy", "heavy"),
        ("vero-white,light", "light,light", "the same density"),
        ("vero-white,light", "light", "the ids of two materials"),
        ("uniform:0.7", "uniform:0.4", "print from 0.5000 to 1"),
        (
            "uniform:0.7",
            "ramp:0,0,1@0mm..4mm:0.2..1",
            "the field is 0.",
        ),
        ("--materials vero-white,light", "", "--materials"),
        (
            "--size 6mm",
            "--size 6mm --slicer cura",
            "--slicer says nothing",
        ),
        (
            "--size 6mm",
            "--size 6mm --format sl1",
            "--field says nothing",
        ),
        (" --field uniform:0.7", "", "--field"),
        ("--size 6mm", "--size 2m", "remedy: a smaller size"),
    ] {
        let output = dither(folder.path(), &right.replace(from, to), "none");
        assert_exit(&output, 2);
        assert!(
            printed(&output).contains(said),
            "{said}: {}",
            printed(&output)
        );
        assert!(!folder.path().join("none").exists(), "{said}");
    }
    let no_model = equipoise_in(folder.path(), &words(&format!("slice none.stl {right}")));
    assert_exit(&no_model, 2);
    assert_exit(
        &equipoise(&["slice", path(folder.path()), "--size", "6mm"]),
        2,
    );
}
