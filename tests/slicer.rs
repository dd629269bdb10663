//! A real slicer takes every part of a kit as it is: PrusaSlicer finds nothing to repair and
//! measures the same volume.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use common::{ELLIPSOID, list, make_kit, number, prepare, printed, words};
use equipoise::base::watch::Watch;
use equipoise::io::gcode::{Options, read_gcode};
use serde_json::Value;

/// Relative error of the slicer's volumes, which it sums in single precision. It reaches 4e-6 on
/// parts that other programs cut, and 3e-6 on ours.
const VOLUME_RATIO: f64 = 1e-5;

/// The keys that the slicer prints only for a mesh that it had to repair. Its exit code stays 0.
const REPAIRS: [&str; 6] = [
    "open_edges",
    "degenerate_facets",
    "edges_fixed",
    "facets_removed",
    "facets_reversed",
    "backwards_edges",
];

/// The facts that the slicer prints about an object.
type Facts = BTreeMap<String, String>;

/// Runs `prusa-slicer --info` on a file with one object; `None`, with a message, if there is no
/// slicer.
fn slice(file: &Path) -> Option<Facts> {
    let mut objects = slice_all(file)?;
    assert_eq!(objects.len(), 1, "{}: {objects:?}", file.display());
    objects.pop()
}

/// Runs `prusa-slicer --info` on a file; `None`, with a message, if there is no slicer.
fn slice_all(file: &Path) -> Option<Vec<Facts>> {
    let output = match Command::new("prusa-slicer")
        .arg("--info")
        .arg(file)
        .output()
    {
        Err(absent) if absent.kind() == std::io::ErrorKind::NotFound => {
            let install = "apt-get install --no-install-recommends prusa-slicer";
            eprintln!("SKIPPED: no prusa-slicer here; {install}");
            return None;
        }
        output => output.unwrap(),
    };
    assert!(output.status.success(), "{}", printed(&output));
    let mut objects: Vec<Facts> = Vec::new();
    for line in common::text(&output.stdout).lines() {
        let fact = line.split_once('=');
        if line.starts_with('[') && line.ends_with(']') {
            objects.push(Facts::new());
        } else if let (Some(object), Some((key, value))) = (objects.last_mut(), fact) {
            object.insert(key.trim().into(), value.trim().into());
        }
    }
    Some(objects)
}

/// Asserts that the slicer takes a part as it is, and that it agrees with the checklist on its
/// triangles and its volume.
fn assert_taken(part: &Value, facts: &Facts) {
    let fact = |key: &str| facts[key].parse::<f64>().unwrap();
    assert_eq!(facts["manifold"], "yes", "{facts:?}");
    let is_repaired = REPAIRS.iter().any(|key| facts.contains_key(*key));
    assert!(!is_repaired, "the slicer repaired it: {facts:?}");
    assert_eq!(fact("number_of_parts"), 1.0, "{facts:?}");
    assert_eq!(facts["number_of_facets"], part["triangles"].to_string());
    let off_ratio = fact("volume") / number(part, "/volume_mm3") - 1.0;
    assert!(off_ratio.abs() < VOLUME_RATIO, "{off_ratio:e}: {facts:?}");
}

fn assert_on_plate(facts: &Facts) {
    let lowest_mm = facts["min_z"].parse::<f64>().unwrap();
    assert!(lowest_mm.abs() < 1e-4, "it is not on the plate: {facts:?}");
}

#[test]
fn a_slicer_takes_every_part_of_a_kit_without_repair() {
    if slice(Path::new(ELLIPSOID)).is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let sheet = make_kit(&kit, "--goal top --up z --wall 1.5mm");
    let parts = list(&sheet, "parts");
    assert!(parts.len() > 1, "{parts:?}");
    for part in parts {
        let file = kit.join(part["file"].as_str().unwrap());
        for file in [file.clone(), file.with_extension("3mf")] {
            let facts = slice(&file).unwrap();
            assert_taken(part, &facts);
            assert_on_plate(&facts);
        }
    }
    let jigs = sheet["jigs"].as_array().map_or(0, Vec::len);
    for (package, more) in [("assembly.3mf", 0), ("plate.3mf", jigs)] {
        let objects = slice_all(&kit.join(package)).unwrap();
        assert_eq!(objects.len(), parts.len() + more, "{package}: {objects:?}");
        parts
            .iter()
            .zip(&objects)
            .for_each(|(part, facts)| assert_taken(part, facts));
    }
}

#[test]
fn a_slicer_finds_a_missing_triangle() {
    let folder = tempfile::tempdir().unwrap();
    let open = folder.path().join("open.stl");
    let mut bytes = fs::read(ELLIPSOID).unwrap();
    let is_binary = bytes.len() > 84 && !bytes.starts_with(b"solid");
    assert!(is_binary, "the shipped model is a binary STL");
    // A triangle has 50 bytes. Their number stands in bytes 80 to 84.
    bytes.truncate(bytes.len() - 50);
    let count = u32::try_from((bytes.len() - 84) / 50).unwrap();
    bytes[80..84].copy_from_slice(&count.to_le_bytes());
    fs::write(&open, bytes).unwrap();
    if let Some(facts) = slice(&open) {
        assert_eq!(facts["manifold"], "no", "{facts:?}");
    }
}

/// Makes a coarse standing kit for a filament printer, with more options. It keeps its promises.
fn make_standing(out: &Path, more: &str) -> Value {
    let options = format!(
        "--goal stand --up y --least-angle 2 --printer prusa-mk4 --size 60mm --pitch 0.5mm {more}"
    );
    let output = prepare(out, &words(&options));
    common::assert_exit(&output, 0);
    common::json(&output)
}

/// A printer's profile in which nobody thought of infill.
const SPARSE: &str = "layer_height = 0.2\nfirst_layer_height = 0.2\nnozzle_diameter = 0.4\n\
    filament_diameter = 1.75\nfilament_density = 1.24\nextrusion_width = 0.45\nfill_density = 15%\n\
    bed_shape = 0x0,250x0,250x210,0x210\nmax_print_height = 220\ngcode_flavor = marlin2\n\
    gcode_label_objects = 1\n";

/// Relative difference of masses between a plate as sliced and the sheet. PrusaSlicer lays 0.2 to
/// 1.5 % more than solid bodies have.
const MASS_RATIO: f64 = 0.02;

#[test]
#[ignore = "tests/slice.rs weighs a plate with such a profile by our own reader, and faster"]
fn a_plate_sliced_with_sparse_infill_still_weighs_what_the_sheet_says() {
    if slice(Path::new(ELLIPSOID)).is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let at = |file: &str| folder.path().join(file);
    let sheet = make_standing(&at("kit"), "");
    fs::write(at("sparse.ini"), SPARSE).unwrap();
    let output = Command::new("prusa-slicer")
        .args(["--export-gcode", "--dont-arrange", "--load"])
        .args([at("sparse.ini"), at("kit/plate.3mf")])
        .arg("-o")
        .arg(at("plate.gcode"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", printed(&output));
    let options = Options::default();
    let plates = read_gcode(&at("plate.gcode"), &options, &Watch::silent()).unwrap();
    for part in list(&sheet, "parts") {
        let id = part["id"].as_str().unwrap();
        let object = plates[0].toolpath.object(id).unwrap();
        let mass_g = object.deposits.part_moments().volume() * 1.24e-3;
        let off_ratio = mass_g / number(part, "/mass_g") - 1.0;
        assert!(off_ratio.abs() < MASS_RATIO, "{id}: {off_ratio}");
    }
}

#[test]
fn the_print_time_by_a_slicer_is_on_the_sheet_and_the_same_again() {
    if slice(Path::new(ELLIPSOID)).is_none() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let [one, two] = ["one", "two"].map(|name| folder.path().join(name));
    let make = |kit: &Path| make_standing(kit, "--slicer prusa-slicer");
    let (sheet, _) = rayon::join(|| make(&one), || make(&two));
    let minutes = number(&sheet["print_time"]["plates"][0], "/minutes");
    assert!((30.0..600.0).contains(&minutes), "{minutes}");
    let page = fs::read_to_string(one.join("job.html")).unwrap();
    assert!(page.contains("Print time") && page.contains("PrusaSlicer 2."));
    let job = fs::read_to_string(one.join("job.toml")).unwrap();
    assert!(job.contains("version = \"PrusaSlicer 2."), "{job}");
    let again = fs::read_to_string(two.join("checklist.json")).unwrap();
    assert_eq!(
        fs::read_to_string(one.join("checklist.json")).unwrap(),
        again
    );
    assert_eq!(common::verify(&one).0, Some(0));
}

#[test]
fn a_slicer_that_is_of_no_use_is_named_before_any_work() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("kit");
    for (options, expected) in [
        (
            "--printer prusa-mk4 --slicer no-such-slicer",
            "no-such-slicer cannot be started",
        ),
        (
            "--printer prusa-mk4 --slicer echo",
            "echo does not name itself",
        ),
        (
            "--printer objet-connex350 --slicer echo",
            "prints no filament",
        ),
        (
            "--printer prusa-mk4 --slicer echo --format stl",
            "no plates to slice",
        ),
    ] {
        let output = prepare(&out, &words(&format!("--goal stand --size 60mm {options}")));
        common::assert_exit(&output, 2);
        let said = printed(&output);
        assert!(said.contains(expected), "{options}: {said}");
        assert!(!out.exists(), "{options}");
    }
}
