//! Rounds: a hollow kit is sliced while it is prepared, and made again with what its toolpaths lay.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::OnceLock;

use common::{
    ELLIPSOID, assert_exit, equipoise, files, has_slicer, json, list, number, path, printed, words,
};
use serde_json::Value;
use tempfile::TempDir;

/// The options of a small top of two halves.
const SMALL: &str = "--goal top --up z --printer prusa-mk4 --size 40mm --pitch 0.4mm";

fn prepare(out: &Path, options: &str) -> Output {
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words(options)].concat())
}

/// A kit that was sliced while it was prepared.
struct Bench {
    folder: PathBuf,
    sheet: Value,
    /// The findings about toolpaths that it was sliced into afterwards.
    found: Value,
}

/// Returns the kit of these tests, which is made once; `None` without a slicer.
fn bench() -> Option<&'static Bench> {
    static BENCH: OnceLock<Option<Bench>> = OnceLock::new();
    let made = BENCH.get_or_init(|| {
        has_slicer().then(|| {
            let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("rounds");
            if folder.exists() {
                fs::remove_dir_all(&folder).unwrap();
            }
            fs::create_dir_all(&folder).unwrap();
            let [kit, toolpaths] = ["kit", "toolpaths"].map(|name| folder.join(name));
            let output = prepare(&kit, &format!("{SMALL} --slice"));
            assert_exit(&output, 0);
            let sheet = json(&output);
            let output = equipoise(&["--json", "slice", path(&kit), "--out", path(&toolpaths)]);
            assert_exit(&output, 0);
            Bench {
                folder,
                sheet,
                found: json(&output),
            }
        })
    });
    made.as_ref()
}

impl Bench {
    fn kit(&self) -> PathBuf {
        self.folder.join("kit")
    }

    /// Makes the kit again from its job, changed as text.
    fn again(&self, out: &Path, change: impl Fn(String) -> String) -> Output {
        let job = out.with_extension("toml");
        let own = fs::read_to_string(self.kit().join("job.toml")).unwrap();
        let own = own.replace("tilted-ellipsoid.stl", ELLIPSOID);
        fs::write(&job, change(own)).unwrap();
        let order = ["--json", "prepare", "--job", path(&job), "--out", path(out)];
        equipoise(&order)
    }
}

#[test]
fn the_halves_together_lay_what_the_kit_promises() {
    let Some(bench) = bench() else { return };
    assert!(list(&bench.sheet, "parts").len() > 1);
    let judgement = &bench.found["judgement"];
    let center = |of: &str| {
        let center = list(&judgement[of], "center_mm");
        [0, 1, 2].map(|axis| center[axis].as_f64().unwrap())
    };
    let [written, laid] = ["written", "toolpaths"].map(center);
    let miss_mm = (0..3).map(|axis| (laid[axis] - written[axis]).powi(2));
    let miss_mm = miss_mm.sum::<f64>().sqrt();
    assert!(miss_mm < 0.02, "{miss_mm}");
    let tilts = ["/written/axis_tilt_deg", "/toolpaths/axis_tilt_deg"];
    let [written, laid] = tilts.map(|key| number(judgement, key));
    assert!(laid - written < 0.1, "{written} {laid}");
    let masses = ["/written/mass_g", "/toolpaths/mass_g"].map(|key| number(judgement, key));
    assert!((masses[1] / masses[0] - 1.0).abs() < 5e-3, "{masses:?}");
}

#[test]
fn the_sheet_has_the_rounds_and_the_kits_own_toolpaths() {
    let Some(bench) = bench() else { return };
    let sheet = &bench.sheet;
    let misses_mm = list(&sheet["laid"], "misses_mm");
    assert!(!misses_mm.is_empty());
    let own = &sheet["toolpaths"];
    let last_mm = misses_mm.iter().map(|miss| miss.as_f64().unwrap());
    assert!(number(own, "/miss_mm") < last_mm.fold(0.0, f64::max));
    let slicer = own["slicer"].as_str().unwrap();
    assert_eq!(bench.found["slices"]["slicer"], slicer);
    let sliced = list(&bench.found["slices"], "plates");
    for (own, sliced) in list(own, "plates").iter().zip(sliced) {
        for key in ["/parts_g", "/support_g"] {
            let off = (number(own, key) - number(sliced, key)).abs();
            assert!(off <= 0.05, "{key}: {own} {sliced}");
        }
        let minutes = number(own, "/minutes") - number(sliced, "/minutes");
        assert!(minutes.abs() <= 1.0, "{own} {sliced}");
    }
    assert_eq!(list(own, "parts").len(), list(sheet, "parts").len());
    let page = fs::read_to_string(bench.kit().join("job.html")).unwrap();
    assert!(page.contains("Sliced and weighed") && page.contains(slicer));
    let (code, said) = common::verify(&bench.kit());
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn the_kits_own_job_makes_it_again_without_a_slicer() {
    let Some(bench) = bench() else { return };
    let folder = TempDir::new().unwrap();
    let again = folder.path().join("again");
    let job = bench.kit().join("job.toml");
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    let order = [
        "--json",
        "prepare",
        "--job",
        path(&job),
        "--out",
        path(&again),
    ];
    // Nothing is found on an empty path.
    let output = command.env("PATH", folder.path()).args(order).output();
    assert_exit(&output.unwrap(), 0);
    assert_eq!(files(&again), files(&bench.kit()));
}

#[test]
fn toolpaths_of_other_plates_and_of_other_prints_are_refused() {
    let Some(bench) = bench() else { return };
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("kit");
    let other_plate = |job: String| {
        let (before, hash) = job.rsplit_once("\nsha256 = \"").unwrap();
        format!("{before}\nsha256 = \"0{}", &hash[1..])
    };
    let no_mass = |job: String| job.replace("\nmass_g = ", "\nmass_g = -");
    let cases: [(&dyn Fn(String) -> String, &str); 2] = [
        (&other_plate, "those of other plates"),
        (&no_mass, "weighed for another print"),
    ];
    for (change, named) in cases {
        let output = bench.again(&out, change);
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(
            said.contains(named) && said.contains("[toolpaths]"),
            "{said}"
        );
        assert!(!out.exists());
    }
}

#[test]
fn a_figure_of_the_toolpaths_that_was_changed_is_told() {
    let Some(bench) = bench() else { return };
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    common::copy(&bench.kit(), &kit);
    let file = kit.join("checklist.json");
    let mut sheet = common::checklist(&kit);
    sheet["toolpaths"]["mass_g"] = 1.25.into();
    fs::write(&file, serde_json::to_string_pretty(&sheet).unwrap() + "\n").unwrap();
    let (code, said) = common::verify(&kit);
    assert_eq!(code, Some(1), "{said}");
}

#[test]
fn a_slicer_that_is_absent_or_of_no_use_is_named_before_the_model_is_read() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    let cases = [
        (
            "--printer prusa-mk4 --slicer no-such-slicer",
            "apt-get install --no-install-recommends prusa-slicer",
        ),
        ("--printer formlabs-form4", "prints no filament"),
        ("--printer prusa-mk4 --format stl", "no plates to slice"),
    ];
    for (options, named) in cases {
        let options = format!("--goal top --size 60mm --slice {options}");
        let order = ["prepare", "no-such-model.stl", "--out", path(&kit)];
        let output = equipoise(&[&order[..], &words(&options)].concat());
        assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains(named), "{options}: {said}");
        assert!(!said.contains("no-such-model"), "{said}");
        assert!(!kit.exists());
    }
}
