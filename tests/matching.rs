//! Claims on matches: a dummy in one piece that has the mass, centre and inertia of another body.

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

use common::{
    ELLIPSOID, assert_exit, equipoise, equipoise_in, files, json, levels, list, number, path,
    printed, words,
};
use serde_json::Value;
use tempfile::TempDir;

/// The options of small kits.
const SMALL: &str = "--goal match --printer prusa-mk4 --size 40mm --pitch 0.4mm --interior graded";
/// The mass, g, of a body whose centre and axes are others than those of the model.
const MASS_G: f64 = 20.0;
/// Its centre, mm.
const CENTER_MM: [f64; 3] = [0.4, -0.3, 0.2];
/// The tensor XX, YY, ZZ, XY, XZ, YZ about its centre, g·mm².
const INERTIA: [f64; 6] = [2500.0, 3000.0, 2750.0, -60.0, 150.0, 40.0];
/// A density, g/cm³, at which the model itself can be matched.
const LIKE_G_CM3: &str = "0.8";

/// A kit with its sheet.
struct Bench {
    kit: PathBuf,
    sheet: Value,
}

fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("matching_{name}"));
    if folder.exists() {
        fs::remove_dir_all(&folder).unwrap();
    }
    folder
}

/// Returns the kit of typed numbers, which is made once.
fn typed() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| bench("typed", &numbers(MASS_G, CENTER_MM, INERTIA)))
}

/// Returns the kit that is like a file, which is made once.
fn like() -> &'static Bench {
    static BENCH: OnceLock<Bench> = OnceLock::new();
    BENCH.get_or_init(|| bench("like", &format!("--like {ELLIPSOID}@{LIKE_G_CM3}")))
}

fn bench(name: &str, options: &str) -> Bench {
    let kit = folder(name);
    let output = prepare(&kit, options);
    assert_exit(&output, 0);
    let sheet = json(&output);
    Bench { kit, sheet }
}

fn prepare(out: &Path, options: &str) -> Output {
    let options = format!("{SMALL} {options}");
    let usual = ["--json", "prepare", ELLIPSOID, "--out", path(out)];
    equipoise(&[&usual[..], &words(&options)].concat())
}

/// Words mass properties as options, with all their digits.
fn numbers(mass_g: f64, center_mm: [f64; 3], inertia: [f64; 6]) -> String {
    let list = |numbers: &[f64]| {
        let words: Vec<String> = numbers.iter().map(|it| format!("{it:?}")).collect();
        words.join(",")
    };
    let (center, inertia) = (list(&center_mm), list(&inertia));
    format!("--mass {mass_g:?} --center {center} --inertia {inertia}")
}

/// Prepares a job that is refused; returns what was said.
fn refuse(options: &str) -> String {
    common::refused(|kit| prepare(kit, options))
}

/// Returns the integrals of 1, x, y, z, xx, yy, zz, xy, xz and yz over the solid in an STL file. A
/// pose is undone first. They are sums of tetrahedra over the triangles.
fn integrals(file: &Path, pose: &Value) -> [f64; 10] {
    let bytes = fs::read(file).unwrap();
    let float = |at: usize| f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()));
    let entry = |row: usize, column: usize| pose[row][column].as_f64().unwrap();
    let corner = |at: usize| {
        let print = [0, 1, 2].map(|axis| float(at + 4 * axis) - entry(axis, 3));
        [0, 1, 2].map(|axis| (0..3).map(|row| entry(row, axis) * print[row]).sum::<f64>())
    };
    let count = (bytes.len() - 84) / 50;
    let mut sums = [0.0; 10];
    for index in 0..count {
        let first = 84 + 50 * index + 12;
        let [a, b, c] = [0, 1, 2].map(|it| corner(first + 12 * it));
        let cross = [
            b[1] * c[2] - b[2] * c[1],
            b[2] * c[0] - b[0] * c[2],
            b[0] * c[1] - b[1] * c[0],
        ];
        let volume = (0..3).map(|axis| a[axis] * cross[axis]).sum::<f64>() / 6.0;
        let sum = [0, 1, 2].map(|axis| a[axis] + b[axis] + c[axis]);
        // Over a tetrahedron with a corner in the origin: V/20 (Σ vᵢvⱼ + (Σ vᵢ)(Σ vⱼ)).
        let pair = |i: usize, j: usize| {
            volume / 20.0 * (a[i] * a[j] + b[i] * b[j] + c[i] * c[j] + sum[i] * sum[j])
        };
        let [x, y, z] = sum.map(|sum| 0.25 * volume * sum);
        let own = [
            volume,
            x,
            y,
            z,
            pair(0, 0),
            pair(1, 1),
            pair(2, 2),
            pair(0, 1),
            pair(0, 2),
            pair(1, 2),
        ];
        for (sum, own) in sums.iter_mut().zip(own) {
            *sum += own;
        }
    }
    sums
}

/// Returns mass, centre and tensor of what a kit prints: the part in solid print, and in each
/// region its own density.
fn weigh(bench: &Bench) -> (f64, [f64; 3], [f64; 6]) {
    let part = &list(&bench.sheet, "parts")[0];
    let pose = &part["print_from_model"];
    let of = |row: &Value| integrals(&bench.kit.join(row["file"].as_str().unwrap()), pose);
    let mut sums = of(part);
    let mut around = 1.0;
    for level in levels(&bench.sheet) {
        let laid = number(&level, "/laid_ratio");
        let region = of(&level);
        for (sum, region) in sums.iter_mut().zip(region) {
            *sum += (laid - around) * region;
        }
        around = laid;
    }
    let density = number(&bench.sheet, "/material/density_g_cm3") / 1000.0;
    let [volume, x, y, z, xx, yy, zz, xy, xz, yz] = sums;
    let [x, y, z] = [x, y, z].map(|first| first / volume);
    let central = |second: f64, i: f64, j: f64| density * (second - volume * i * j);
    let [xx, yy, zz] = [central(xx, x, x), central(yy, y, y), central(zz, z, z)];
    let [xy, xz, yz] = [central(xy, x, y), central(xz, x, z), central(yz, y, z)];
    let tensor = [yy + zz, xx + zz, xx + yy, -xy, -xz, -yz];
    (density * volume, [x, y, z], tensor)
}

/// Asserts that mass properties are wanted ones, within the limits that kits promise.
fn assert_near(found: (f64, [f64; 3], [f64; 6]), wanted: (f64, [f64; 3], [f64; 6])) {
    let (mass_g, center_mm, tensor) = found;
    assert!((mass_g / wanted.0 - 1.0).abs() < 1e-3, "{found:?}");
    let off = center_mm.iter().zip(wanted.1);
    let off_mm = off
        .map(|(is, want)| (is - want).powi(2))
        .sum::<f64>()
        .sqrt();
    assert!(off_mm < 5e-3, "{off_mm}: {found:?}");
    let trace: f64 = wanted.2[..3].iter().sum();
    for (is, want) in tensor.iter().zip(wanted.2) {
        assert!((is - want).abs() < 1e-3 * trace, "{found:?}");
    }
}

#[test]
fn a_match_passes_with_its_three_promises_and_several_densities() {
    let bench = typed();
    assert!(levels(&bench.sheet).len() >= 3);
    let checks = list(&bench.sheet, "checks");
    for kind in ["match-mass", "match-center", "match-inertia"] {
        let check = checks.iter().find(|check| check["kind"] == kind);
        assert_eq!(check.unwrap()["pass"], true, "{kind}");
    }
    assert_eq!(number(&bench.sheet, "/goal/wanted/mass_g"), MASS_G);
    let (code, said) = common::verify(&bench.kit);
    assert_eq!(code, Some(0), "{said}");
    let page = fs::read_to_string(bench.kit.join("certificate.html")).unwrap();
    assert!(page.contains("Wanted and reached"));
}

#[test]
fn the_written_files_have_the_wanted_mass_centre_and_tensor_by_sums_of_our_own() {
    assert_near(weigh(typed()), (MASS_G, CENTER_MM, INERTIA));
}

/// Returns the numbers that a kit's job holds.
fn target(kit: &Path) -> (f64, [f64; 3], [f64; 6]) {
    let job = fs::read_to_string(kit.join("job.toml")).unwrap();
    let job: toml::Value = toml::from_str(&job).unwrap();
    let target = &job["goal"]["target"];
    let list = |key: &str| -> Vec<f64> {
        let numbers = target[key].as_array().unwrap().iter();
        numbers.map(|it| it.as_float().unwrap()).collect()
    };
    let mass_g = target["mass_g"].as_float().unwrap();
    let [center, inertia] = ["center_mm", "inertia_g_mm2"].map(list);
    (
        mass_g,
        center.try_into().unwrap(),
        inertia.try_into().unwrap(),
    )
}

#[test]
fn a_file_and_its_density_are_the_numbers_of_that_body() {
    let bench = like();
    let wanted = target(&bench.kit);
    // The file is scaled as the model, which is 40 mm long; the body is the model itself.
    let solid_g = number(&bench.sheet, "/solid/mass_g");
    let density = number(&bench.sheet, "/material/density_g_cm3");
    // The sheet has the solid as it is written, in single precision.
    assert!((wanted.0 - solid_g * 0.8 / density).abs() < 1e-6 * solid_g);
    assert_near(weigh(bench), wanted);
    let (mass_g, center_mm, inertia) = wanted;
    let again = bench_of_numbers(mass_g, center_mm, inertia);
    let regions = |bench: &Bench| {
        let level = |level: &Value| fs::read(bench.kit.join(level["file"].as_str().unwrap()));
        let levels = levels(&bench.sheet);
        levels
            .iter()
            .map(|it| level(it).unwrap())
            .collect::<Vec<_>>()
    };
    assert!(regions(bench) == regions(&again));
}

fn bench_of_numbers(mass_g: f64, center_mm: [f64; 3], inertia: [f64; 6]) -> Bench {
    bench("again", &numbers(mass_g, center_mm, inertia))
}

#[test]
fn a_job_replays_to_the_same_bytes_without_the_file_that_it_is_like() {
    let bench = like();
    let folder = TempDir::new().unwrap();
    // In a folder of its own there is no file to be like.
    common::copy(&bench.kit, &folder.path().join("old"));
    let output = equipoise_in(
        folder.path(),
        &["prepare", "--job", "old/job.toml", "--out", "new"],
    );
    assert_exit(&output, 0);
    let job = fs::read_to_string(bench.kit.join("job.toml")).unwrap();
    assert!(job.contains("[like]") && job.contains("sha256"), "{job}");
    let [old, new] = ["old", "new"].map(|name| files(&folder.path().join(name)));
    let names = |files: &std::collections::BTreeMap<PathBuf, Vec<u8>>| {
        files.keys().cloned().collect::<Vec<_>>()
    };
    assert_eq!(names(&old), names(&new));
    for (name, bytes) in &old {
        assert!(new[name] == *bytes, "{}", name.display());
    }
}

#[test]
fn a_body_that_cannot_be_is_refused_by_the_triangle_inequality_with_its_moments() {
    let said = refuse(&numbers(
        20.0,
        [0.0; 3],
        [1000.0, 1000.0, 2500.0, 0.0, 0.0, 0.0],
    ));
    assert!(said.contains("triangle inequality"), "{said}");
    assert!(said.contains("2500"), "{said}");
}

#[test]
fn what_is_too_heavy_is_impossible_with_the_masses_and_the_nearest() {
    let folder = TempDir::new().unwrap();
    let output = prepare(
        &folder.path().join("kit"),
        &numbers(40.0, [0.0; 3], [5000.0, 5800.0, 5300.0, 0.0, 0.0, 0.0]),
    );
    assert_exit(&output, 1);
    let answer = json(&output);
    assert_eq!(answer["verdict"], "impossible");
    let reason = answer["reason"].as_str().unwrap();
    // Its walls are solid, and its inside has infill of up to 90 %.
    for words in [
        "40.00 g",
        "at its densest it weighs 2",
        "The nearest",
        "proved",
    ] {
        assert!(reason.contains(words), "{reason}");
    }
    assert!(!list(&answer, "hints").is_empty());
}

#[test]
fn what_means_nothing_is_refused_with_what_to_type() {
    let outside = refuse(&numbers(20.0, [0.0, 0.0, 90.0], INERTIA));
    assert!(outside.contains("lies outside of the model"), "{outside}");
    let alone = refuse("--mass 20g");
    assert!(
        alone.contains("--center") && alone.contains("--inertia"),
        "{alone}"
    );
    let nothing = refuse("");
    assert!(nothing.contains("--like=original.stl@2.70"), "{nothing}");
    let turned = refuse(&format!("{} --up x", numbers(MASS_G, CENTER_MM, INERTIA)));
    assert!(turned.contains("up = x"), "{turned}");
    let solid = refuse(&format!(
        "{} --density 15%..100%",
        numbers(MASS_G, CENTER_MM, INERTIA)
    ));
    assert!(solid.contains("--density=15%..90%"), "{solid}");
    let wished = refuse(&format!(
        "{} --infill 40%",
        numbers(MASS_G, CENTER_MM, INERTIA)
    ));
    assert!(wished.contains("--infill=40%"), "{wished}");
    let missing = refuse("--like none.stl@2.7");
    assert!(missing.contains("none.stl"), "{missing}");
    let folder = TempDir::new().unwrap();
    let out = folder.path().join("kit");
    let line = format!(
        "--goal match --printer prusa-mk4 --size 40mm --like {ELLIPSOID}@{LIKE_G_CM3} --out {}",
        path(&out)
    );
    let hollow = equipoise(&[&["prepare", ELLIPSOID][..], &words(&line)].concat());
    assert_exit(&hollow, 2);
    assert!(
        printed(&hollow).contains("--interior=graded"),
        "{}",
        printed(&hollow)
    );
    let line = format!(
        "--goal stand --printer prusa-mk4 --size 40mm --like {ELLIPSOID}@{LIKE_G_CM3} --out {}",
        path(&out)
    );
    let other = equipoise(&[&["prepare", ELLIPSOID][..], &words(&line)].concat());
    assert_exit(&other, 2);
    assert!(
        printed(&other).contains("goal match"),
        "{}",
        printed(&other)
    );
}
