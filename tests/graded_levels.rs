//! Claims on graded kits of several densities: two across a quadric, and levels near a wished one.

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
    ELLIPSOID, assert_exit, equipoise, files, json, levels, list, number, path, printed, words,
};
use serde_json::Value;
use tempfile::TempDir;

/// The options of small kits.
const SMALL: &str = "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 40mm \
    --pitch 0.4mm --interior graded";
/// Two densities below solid print.
const TWO: &str = "--density 15%..60%";
/// Three densities near a wished one, for a tilt that uniform infill does not bear.
const NEAR: &str = "--infill 40% --levels 3 --density 15%..70% --least-angle 3.5";

/// A kit with its sheet.
struct Bench {
    kit: PathBuf,
    sheet: Value,
}

/// Returns the kit of two densities below solid print, which is made once.
fn two() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| bench("two", TWO))
}

/// Returns the kit of three densities near a wished one, which is made once.
fn near() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| bench("near", NEAR))
}

fn bench(name: &str, options: &str) -> Bench {
    let kit = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("graded_{name}"));
    if kit.exists() {
        fs::remove_dir_all(&kit).unwrap();
    }
    let output = prepare(&kit, &format!("{SMALL} {options}"));
    assert_exit(&output, 0);
    let sheet = json(&output);
    Bench { kit, sheet }
}

fn prepare(out: &Path, options: &str) -> Output {
    // Of an option that is given twice, the last one holds.
    let mut words = words(options);
    if let Some(last) = words.iter().rposition(|word| *word == "--least-angle") {
        let first = words
            .iter()
            .position(|word| *word == "--least-angle")
            .unwrap();
        if first < last {
            words.drain(first..first + 2);
        }
    }
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words].concat())
}

/// Prepares a job that is refused; returns what was said.
fn refuse(options: &str) -> String {
    common::refused(|kit| prepare(kit, options))
}

#[test]
fn below_solid_print_all_of_the_interior_is_a_region_and_the_sparse_one_lies_in_it() {
    let bench = two();
    let regions = levels(&bench.sheet);
    let set: Vec<f64> = regions
        .iter()
        .map(|it| number(it, "/nominal_ratio"))
        .collect();
    assert_eq!(set, [0.6, 0.15]);
    let [outer, inner] = [0, 1].map(|index: usize| number(&regions[index], "/volume_mm3"));
    assert!(inner > 0.05 * outer && inner < outer, "{inner} {outer}");
    let (code, said) = common::verify(&bench.kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
fn the_mass_is_that_of_the_solid_less_what_each_region_lacks() {
    for Bench { sheet, .. } in [two(), near()] {
        let regions = levels(sheet);
        let density_g_mm3 = number(sheet, "/material/density_g_cm3") / 1000.0;
        let mut expected_g = number(sheet, "/solid/mass_g");
        for (index, region) in regions.iter().enumerate() {
            let within = regions
                .get(index + 1)
                .map_or(0.0, |next| number(next, "/volume_mm3"));
            let own_mm3 = number(region, "/volume_mm3") - within;
            expected_g -= (1.0 - number(region, "/laid_ratio")) * own_mm3 * density_g_mm3;
        }
        let mass_g = number(sheet, "/assembly/mass_g");
        assert!(
            (mass_g / expected_g - 1.0).abs() < 1e-5,
            "{mass_g} {expected_g}"
        );
    }
}

#[test]
fn levels_near_a_wished_infill_bear_the_tilt_that_was_promised_and_change_little() {
    let bench = near();
    let sheet = &bench.sheet;
    let set: Vec<f64> = levels(sheet)
        .iter()
        .map(|it| number(it, "/nominal_ratio"))
        .collect();
    assert_eq!(set, [0.7, 0.4, 0.15]);
    assert_eq!(sheet["certificate"]["figure"], "infill_change_ratio");
    let [value, bound] = ["/certificate/value", "/certificate/bound"].map(|key| number(sheet, key));
    assert!(
        value > 0.01 && value < 0.3 && bound <= value * (1.0 + 1e-6),
        "{value} {bound}"
    );
    // The least change bears what it must, and no more.
    let topples_deg = number(sheet, "/assembly/topples_deg");
    assert!((3.5..3.53).contains(&topples_deg), "{topples_deg}");
    let (code, said) = common::verify(&bench.kit);
    assert_eq!(code, Some(0), "{said}");
}

#[test]
#[ignore = "a minute: an elephant at several shares; run before a change of levels"]
fn near_a_wished_infill_the_share_of_the_best_that_is_ordered_is_kept() {
    let folder = TempDir::new().unwrap();
    let reached = |options: &str, figure: &str| {
        let output = prepare(&folder.path().join("kit"), &format!("{options} --force"));
        assert_exit(&output, 0);
        number(&json(&output), figure)
    };
    let stand = |more: &str| {
        let options = format!("{SMALL} --density 15%..70% {more}");
        reached(&options, "/assembly/topples_deg")
    };
    let [best, kept, free] = [
        "",
        "--infill 40% --levels 3 --keep 90%",
        "--infill 40% --levels 3",
    ]
    .map(stand);
    // What drawing the regions costs, the best lost as well.
    assert!(kept > 0.99 * 0.9 * best && kept < best, "{kept} of {best}");
    assert!(free < 0.6 * best, "{free} of {best}");
    let top = |more: &str| {
        let options = format!(
            "--goal top --up z --contact center --printer prusa-mk4 --size 40mm --pitch 0.4mm \
             --interior graded {more}"
        );
        reached(&options, "/assembly/critical_speed_rpm")
    };
    let [best, kept, usual] = [
        "",
        "--infill 50% --levels 3 --keep 95%",
        "--infill 50% --levels 3",
    ]
    .map(top);
    assert!(kept < 1.01 * best / 0.95 && kept > best, "{kept} of {best}");
    assert!(
        usual < 1.01 * best / 0.8 && usual > kept,
        "{usual} of {best}"
    );
}

#[test]
fn the_kits_own_job_makes_the_same_bytes() {
    let folder = TempDir::new().unwrap();
    let again = folder.path().join("again");
    let job = near().kit.join("job.toml");
    let text = fs::read_to_string(&job).unwrap();
    for said in [
        "density = \"15%..70%\"",
        "infill = \"40%\"",
        "levels = \"3\"",
    ] {
        assert!(text.contains(said), "{said}: {text}");
    }
    let output = equipoise(&[
        "--json",
        "prepare",
        "--job",
        path(&job),
        "--out",
        path(&again),
    ]);
    assert_exit(&output, 0);
    assert_eq!(files(&again), files(&near().kit));
}

#[test]
fn a_region_that_was_moved_out_of_the_one_around_it_is_told() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    common::copy(&two().kit, &kit);
    let inner = levels(&two().sheet)[1]["file"].as_str().unwrap().to_owned();
    // Every corner of the binary file moves by a millimetre.
    let mut bytes = fs::read(kit.join(&inner)).unwrap();
    for triangle in bytes[84..].chunks_exact_mut(50) {
        for at in [12, 24, 36] {
            let x = f32::from_le_bytes(triangle[at..at + 4].try_into().unwrap()) + 1.0;
            triangle[at..at + 4].copy_from_slice(&x.to_le_bytes());
        }
    }
    fs::write(kit.join(&inner), bytes).unwrap();
    let (code, said) = common::verify(&kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(
        said.contains("every region of sparse infill is there") && said.contains("modifiers/"),
        "{said}"
    );
}

#[test]
fn densities_that_mean_nothing_are_refused_with_the_place_and_what_to_type() {
    let graded = "--goal stand --size 40mm --printer prusa-mk4 --interior graded";
    for (options, place, remedy) in [
        (
            "--density 15..60%",
            "--density",
            "with the sign, such as 15%",
        ),
        ("--density 1.5", "--density", "such as 15%..60%"),
        (
            "--density 60%..15%",
            "--density",
            "the lesser density first",
        ),
        ("--density 15%..120%", "--density", "give 0% to 100%"),
        ("--density 5%..60%", "5%", "--density=15%..60%"),
        ("--infill 40", "--infill", "with the sign"),
        ("--infill 10%", "--infill=10%", "--density"),
        ("--infill 40% --levels 2", "--infill=40%", "--levels=3"),
        ("--infill 40% --levels 13", "--levels", "2 to 12"),
        ("--infill 40% --keep 100%", "--keep", "1% to 99%"),
        ("--keep 90%", "--keep=90%", "--infill=40%"),
        (
            "--infill 40% --levels smooth",
            "--levels",
            "a modifier has one density",
        ),
        ("--levels 4", "--levels=4", "--infill=40%"),
        ("--density 15%..60% --format 3mf", "3MF", "--format=both"),
    ] {
        let said = refuse(&format!("{graded} {options}"));
        assert!(
            said.contains(place) && said.contains(remedy),
            "{options}: {said}"
        );
    }
    let hollow = "--goal stand --size 40mm --printer prusa-mk4 --density 15%..60%";
    let said = refuse(hollow);
    assert!(said.contains("--interior=graded"), "{said}");
    let afloat = "--goal float --size 50mm --interior graded --printer prusa-mk4 --infill 40%";
    assert!(refuse(afloat).contains("--infill=40%"));
}

#[test]
fn toolpaths_of_three_densities_lay_what_the_sheet_says() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
        return;
    }
    let bench = near();
    let folder = TempDir::new().unwrap();
    let toolpaths = folder.path().join("toolpaths");
    let output = equipoise(&[
        "--json",
        "slice",
        path(&bench.kit),
        "--out",
        path(&toolpaths),
    ]);
    // A kit that was not prepared with its toolpaths may break its promise of 3.5° by a little. The
    // exit may be 1 then.
    assert!(
        matches!(output.status.code(), Some(0 | 1)),
        "{}",
        printed(&output)
    );
    let gcode = toolpaths.join("plate.gcode");
    let output = equipoise(&[
        "--json",
        "verify",
        path(&bench.kit),
        "--gcode",
        path(&gcode),
    ]);
    let found = json(&output);
    let off_mm = number(&list(&found, "parts")[0], "/center_off_mm");
    assert!(off_mm < 0.2, "{off_mm}");
}

#[test]
#[ignore = "long: rounds of a slicer, as tests/rounds.rs has; run with -- --ignored"]
fn a_kit_of_three_densities_that_was_made_with_its_toolpaths_keeps_its_promise_by_them() {
    if Command::new("prusa-slicer").arg("--help").output().is_err() {
        let install = "apt-get install --no-install-recommends prusa-slicer";
        eprintln!("SKIPPED: no prusa-slicer here; {install}");
        return;
    }
    let folder = TempDir::new().unwrap();
    let [kit, toolpaths] = ["kit", "toolpaths"].map(|name| folder.path().join(name));
    let output = prepare(&kit, &format!("{SMALL} {NEAR} --slice"));
    assert_exit(&output, 0);
    let output = equipoise(&["--json", "slice", path(&kit), "--out", path(&toolpaths)]);
    assert_exit(&output, 0);
    // The slicer lays more than surfaces and regions have, which the kit knows. The mass is held
    // against both.
    let found = json(&output);
    let beyond_mm3 = number(&common::checklist(&kit), "/infill/beyond/0");
    let laid_mm3 = number(&found, "/judgement/parts/0/volume_mm3");
    assert!(beyond_mm3 > 0.01 * laid_mm3, "{beyond_mm3} {laid_mm3}");
    let checks = list(&found["judgement"], "checks");
    let mass = checks.iter().find(|check| check["kind"] == "printed-mass");
    let off_percent = number(mass.unwrap(), "/value");
    assert!(off_percent < 0.2, "{off_percent}");
}
