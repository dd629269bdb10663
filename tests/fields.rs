//! Claims on kits whose infill follows a field: fitted to the goal, or given with its numbers.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::sync::OnceLock;

use common::{ELLIPSOID, assert_exit, equipoise, json, levels, number, path, printed, words};
use serde_json::Value;
use tempfile::TempDir;

/// The options of small kits, for a tilt that uniform infill does not bear.
const SMALL: &str = "--goal stand --up y --least-angle 3.5 --printer prusa-mk4 --size 40mm \
    --pitch 0.4mm --interior graded";

/// A kit with its sheet.
struct Bench {
    kit: PathBuf,
    sheet: Value,
}

fn prepare(out: &Path, options: &str) -> Output {
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words(options)].concat())
}

fn bench(name: &str, options: &str) -> Bench {
    bench_of(name, &format!("{SMALL} {options}"))
}

fn bench_of(name: &str, options: &str) -> Bench {
    let kit = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("fields_{name}"));
    if kit.exists() {
        fs::remove_dir_all(&kit).unwrap();
    }
    let output = prepare(&kit, options);
    assert_exit(&output, 0);
    let sheet = json(&output);
    Bench { kit, sheet }
}

/// Returns the kit of a fitted ramp, which is made once.
fn ramp() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    let options = "--infill 40% --levels 3 --density 15%..70% --field ramp";
    BENCH.get_or_init(|| bench("ramp", options))
}

/// Returns the kit of a fitted wave, which is made once.
fn sine() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    let options = "--infill 40% --levels 3 --density 15%..70% --field sine";
    BENCH.get_or_init(|| bench("sine", options))
}

fn field(bench: &Bench) -> &str {
    bench.sheet["infill"]["field"].as_str().unwrap()
}

#[test]
fn a_fitted_field_keeps_the_promise_in_its_written_regions() {
    for (bench, name) in [(ramp(), "ramp:"), (sine(), "sine:")] {
        assert!(field(bench).starts_with(name), "{}", field(bench));
        assert!(levels(&bench.sheet).len() >= 2);
        let (code, said) = common::verify(&bench.kit);
        assert_eq!(code, Some(0), "{name} {said}");
        let reached_deg = number(&bench.sheet, "/assembly/topples_deg");
        assert!(reached_deg >= 3.5, "{reached_deg}");
    }
}

#[test]
fn a_field_changes_the_infill_no_less_than_the_best_densities_and_says_both() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("best");
    let options = format!("{SMALL} --infill 40% --levels 3 --density 15%..70%");
    let output = prepare(&kit, &options);
    assert_exit(&output, 0);
    let best = json(&output);
    for bench in [ramp(), sine()] {
        let [value, bound] =
            ["/certificate/value", "/certificate/bound"].map(|at| number(&bench.sheet, at));
        assert!(value >= bound - 1e-6, "{value} {bound}");
        let least = number(&best, "/certificate/bound");
        assert!((bound - least).abs() < 0.01, "{bound} {least}");
    }
    let output = equipoise(
        &[
            &["prepare", ELLIPSOID, "--out", path(&kit), "--force"],
            &words(&format!("{options} --field ramp"))[..],
        ]
        .concat(),
    );
    assert_exit(&output, 0);
    let said = printed(&output).replace('\n', " ");
    assert!(said.contains("the field ramp:"), "{said}");
    assert!(
        said.contains("no densities that do what was asked differ by less than"),
        "{said}"
    );
    let sheet = fs::read_to_string(kit.join("certificate.html")).unwrap();
    assert!(sheet.contains("The field that was ordered has"));
}

#[test]
fn the_words_of_a_fitted_field_can_be_inspected_and_ordered_again() {
    let bench = ramp();
    let model = ["--json", "inspect", ELLIPSOID, "--size", "40mm"];
    let output = equipoise(&[&model[..], &["--field", field(bench)]].concat());
    assert_exit(&output, 0);
    let mean = number(&json(&output), "/field/mean_density_ratio");
    assert!((0.1..0.7).contains(&mean), "{mean}");
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("again");
    let options = format!("{SMALL} --infill 40% --levels 3 --field {}", field(bench));
    let output = prepare(&kit, &options);
    assert_exit(&output, 0);
    let again = json(&output);
    let masses = [&bench.sheet, &again].map(|sheet| number(sheet, "/assembly/mass_g"));
    assert!((masses[0] / masses[1] - 1.0).abs() < 2e-3, "{masses:?}");
    assert_eq!(common::verify(&kit).0, Some(0));
}

#[test]
fn a_job_of_a_field_makes_the_same_parts_again() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("replayed");
    let job = sine().kit.join("job.toml");
    let output = equipoise(&["prepare", "--job", path(&job), "--out", path(&kit)]);
    assert_exit(&output, 0);
    let [first, again] = [&sine().kit, &kit].map(|kit| common::files(kit));
    let parts = |files: &std::collections::BTreeMap<PathBuf, Vec<u8>>| {
        let is_part = |file: &&PathBuf| file.extension().is_some_and(|end| end == "stl");
        let names = files.keys().filter(is_part);
        names.map(|name| files[name].clone()).collect::<Vec<_>>()
    };
    assert_eq!(parts(&first), parts(&again));
}

#[test]
fn a_given_field_that_does_not_do_it_is_an_answer_with_how_far_it_is_off() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    // Dense above and sparse below, and the same everywhere.
    for field in ["ramp:0,1,0@-15mm..15mm:0.2..0.6", "uniform:40%"] {
        let output = prepare(&kit, &format!("{SMALL} --infill 40% --field {field}"));
        assert_exit(&output, 1);
        let answer = json(&output);
        let reason = answer["reason"].as_str().unwrap();
        assert!(reason.starts_with("Not met: the field"), "{reason}");
        assert!(reason.contains("3.51° are asked"), "{reason}");
        assert!(!kit.exists());
    }
}

/// The options of a rotor that is balanced by its infill.
const ROTOR: &str = "--goal balance --up y --bore 6mm --printer prusa-mk4 --size 60mm \
    --pitch 0.6mm --interior graded --levels 4 --density 15%..90% --infill 50%";

#[test]
fn where_a_field_does_not_do_it_and_the_best_densities_do_they_are_offered() {
    let folder = TempDir::new().unwrap();
    let kit = folder.path().join("kit");
    let output = prepare(&kit, &format!("{ROTOR} --field ramp"));
    assert_exit(&output, 1);
    let answer = json(&output);
    let reason = answer["reason"].as_str().unwrap();
    assert!(reason.starts_with("Not met: no ramp"), "{reason}");
    assert!(reason.contains("mm beside the axis"), "{reason}");
    let hints = answer["hints"].to_string();
    assert!(hints.contains("leave `field"), "{answer}");
    // What is offered works.
    assert_exit(&prepare(&kit, ROTOR), 0);
}

#[test]
fn a_wave_balances_a_rotor_that_no_ramp_does_and_is_told_beside_the_best() {
    let bench = bench_of("rotor", &format!("{ROTOR} --field sine"));
    assert!(field(&bench).starts_with("sine:"));
    let off_mm = number(&bench.sheet, "/assembly/axis_offset_mm");
    assert!(off_mm < 0.005, "{off_mm}");
    let [value, bound] =
        ["/certificate/value", "/certificate/bound"].map(|at| number(&bench.sheet, at));
    assert!(value > 2.0 * bound, "{value} {bound}");
    assert_eq!(common::verify(&bench.kit).0, Some(0));
}

#[test]
fn orders_that_do_not_fit_a_field_are_refused_with_what_to_type() {
    let stand = "--goal stand --up y --printer prusa-mk4 --size 40mm --pitch 0.4mm";
    for (options, said) in [
        ("--field ramp", "--interior=graded"),
        ("--interior graded --field waves", "is not a field"),
        (
            "--interior graded --field skin:4mm:gauss:0.05..1",
            "densities from 0.142",
        ),
        ("--interior graded --field uniform:15", "15%"),
        ("--interior graded --field ramp --levels 2", "--levels=3"),
        (
            "--interior graded --field sine --density 15%..100%",
            "--density=15%..90%",
        ),
        (
            "--interior graded --field ramp:0,0,1@0mm..9mm:0.01..0.5",
            "densities from 0.142",
        ),
        (
            "--interior graded --field ramp:0,0,1@0mm..9mm:0.2..0.5 --density 15%..60%",
            "leave one of them out",
        ),
        (
            "--interior graded --field sine:0,0,0@5mm:0.2..0.6",
            "a longer wave",
        ),
    ] {
        let error = common::refused(|kit| prepare(kit, &format!("{stand} {options}")));
        let error = error.replace('\n', " ");
        assert!(error.contains(said), "{options}: {error}");
    }
}
