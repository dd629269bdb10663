//! `equipoise slice`: a kit's plates become toolpaths by a real slicer, and are judged at once.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{ELLIPSOID, assert_exit, equipoise, files, list, number, path, printed, sum, words};
use serde_json::Value;

/// A kit for a filament printer.
struct Bench {
    folder: PathBuf,
    sheet: Value,
}

/// Returns the kit of these tests, which is made once.
fn bench() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("slice");
        if folder.exists() {
            fs::remove_dir_all(&folder).unwrap();
        }
        fs::create_dir_all(&folder).unwrap();
        let kit = folder.join("kit");
        let options = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 40mm \
            --pitch 0.4mm";
        let usual = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
        let output = equipoise(&[&usual[..], &words(options)].concat());
        assert_exit(&output, 0);
        let sheet = common::json(&output);
        Bench { folder, sheet }
    })
}

impl Bench {
    fn kit(&self) -> PathBuf {
        self.folder.join("kit")
    }

    /// Slices the kit into the folder of this name.
    fn slice(&self, name: &str, options: &[&str]) -> (Output, PathBuf) {
        let out = self.folder.join(name);
        let kit = self.kit();
        let usual = ["--json", "slice", path(&kit), "--out", path(&out)];
        (equipoise(&[&usual[..], options].concat()), out)
    }
}

impl Bench {
    /// Slices the kit as it is, once.
    fn right(&self) -> &'static (Output, PathBuf) {
        static RIGHT: OnceLock<(Output, PathBuf)> = OnceLock::new();
        RIGHT.get_or_init(|| self.slice("right", &[]))
    }
}

/// Returns true if there is a slicer; says so if there is none.
fn has_slicer() -> bool {
    let is_there = Command::new("prusa-slicer").arg("--help").output().is_ok();
    if !is_there {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
    }
    is_there
}

#[test]
fn the_plates_of_a_kit_become_toolpaths_that_keep_its_promise() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let before = files(&bench.kit());
    let (output, folder) = bench.right();
    assert_exit(output, 0);
    let found = common::json(output);
    let causes = list(&found["judgement"], "causes");
    assert!(
        causes.iter().all(|cause| cause["is_wrong"] == false),
        "{causes:?}"
    );
    let plates = list(&found["slices"], "plates");
    assert_eq!(plates.len(), 1);
    assert!(folder.join("plate.gcode").is_file());
    let written = fs::read(folder.join("slices.json")).unwrap();
    let written: Value = serde_json::from_slice(&written).unwrap();
    assert_eq!(written, found["slices"]);
    // The plate weighs what the sheet says, jigs included.
    let jigs_g: f64 = list(&bench.sheet, "jigs")
        .iter()
        .map(|jig| number(jig, "/mass_g"))
        .sum();
    let sheet_g = sum(list(&bench.sheet, "parts"), "/mass_g") + jigs_g;
    let parts_g = number(&plates[0], "/parts_g");
    assert!(
        (parts_g / sheet_g - 1.0).abs() < 0.02,
        "{parts_g} {sheet_g}"
    );
    let rest_g = number(&plates[0], "/filament_g") - parts_g;
    let support_g = number(&plates[0], "/support_g");
    assert!(
        support_g > 0.0 && rest_g >= support_g - 0.05,
        "{support_g} {rest_g}"
    );
    assert!(number(&plates[0], "/minutes") > 5.0);
    assert_eq!(files(&bench.kit()), before, "the kit is as it was");
}

#[test]
fn a_profile_of_the_slicer_changes_no_size_line_or_layer_of_the_kit() {
    if !has_slicer() {
        return;
    }
    let bench = bench();
    let profile = bench.folder.join("shop.ini");
    let text = "# a shop's own\nlayer_height = 0.3\nfill_density = 15%\nfilament_density = 1.04\n\
        perimeter_extrusion_width = 0.7\nexternal_perimeter_extrusion_width = 0.7\n\
        xy_size_compensation = -0.2\nspiral_vase = 0\nperimeter_speed = 20\ninfill_speed = 20\nsolid_infill_speed = 20\n";
    fs::write(&profile, text).unwrap();
    let (usual, _) = bench.right();
    let (slow, _) = bench.slice("shop", &["--profile", path(&profile)]);
    assert_exit(&slow, 0);
    let [usual, slow] = [usual, &slow].map(common::json);
    let of = |found: &Value, pointer: &str| number(found, &format!("/slices/plates/0{pointer}"));
    assert_eq!(of(&usual, "/layers"), of(&slow, "/layers"));
    assert!((of(&usual, "/parts_g") / of(&slow, "/parts_g") - 1.0).abs() < 0.005);
    assert!(
        of(&slow, "/minutes") > 1.2 * of(&usual, "/minutes"),
        "its speeds hold"
    );
    assert!(slow["slices"]["profile_sha256"].is_string());
}

#[test]
fn what_cannot_be_sliced_is_told_with_a_remedy_and_writes_nothing() {
    let bench = bench();
    let remedy = "name the folder of a kit";
    let cases: [(&[&str], &str); 3] = [
        (
            &["--slicer", "no-such-slicer"],
            "install one (on Debian: apt-get install",
        ),
        (&["--slicer", "echo"], "does not name itself as PrusaSlicer"),
        (&["--profile", "no-such.ini"], "cannot read no-such.ini"),
    ];
    for (options, wanted) in cases {
        let (output, folder) = bench.slice("refused", options);
        assert_exit(&output, 2);
        assert!(printed(&output).contains(wanted), "{}", printed(&output));
        assert!(!folder.exists());
    }
    let empty = bench.folder.join("empty");
    fs::create_dir_all(&empty).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(printed(&output).contains(remedy), "{}", printed(&output));
    fs::write(empty.join("job.toml"), "schema = 1\n").unwrap();
    fs::write(empty.join("checklist.json"), r#"{"kind":"telescope"}"#).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(
        printed(&output).contains("a telescope's"),
        "{}",
        printed(&output)
    );
    fs::write(empty.join("checklist.json"), r#"{"kind":"core"}"#).unwrap();
    let output = equipoise(&["slice", path(&empty)]);
    assert_exit(&output, 2);
    assert!(printed(&output).contains("an object on a base"));
    // A folder of something else is not replaced.
    let other = bench.folder.join("other");
    fs::create_dir_all(&other).unwrap();
    fs::write(other.join("letter.txt"), "dear").unwrap();
    let (output, _) = bench.slice("other", &["--force"]);
    assert_exit(&output, 2);
    assert!(other.join("letter.txt").is_file());
}
