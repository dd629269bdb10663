//! A real slicer takes every part of a kit as it is: PrusaSlicer finds nothing to repair and
//! measures the same volume.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a test that is skipped says so")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

const MODEL: &str = concat!(
    env!("CARGO_MANIFEST_DIR"),
    "/examples/models/tilted-ellipsoid.stl"
);

/// The slicer sums single-precision tetrahedra: up to 4e-6 on parts that were cut elsewhere, 3e-6
/// on ours.
const VOLUME_RATIO: f64 = 1e-5;

/// What the slicer prints only of a mesh that it had to repair; its exit code is 0 all the same.
const REPAIRS: [&str; 6] = [
    "open_edges",
    "degenerate_facets",
    "edges_fixed",
    "facets_removed",
    "facets_reversed",
    "backwards_edges",
];

/// What the slicer says of an object, by key.
type Said = BTreeMap<String, String>;

/// What `prusa-slicer --info` says of the only object of a file; none without the slicer.
fn sliced(file: &Path) -> Option<Said> {
    let mut objects = objects_sliced(file)?;
    assert_eq!(objects.len(), 1, "{}: {objects:?}", file.display());
    objects.pop()
}

/// What `prusa-slicer --info` says of each object of a file; none without the slicer.
fn objects_sliced(file: &Path) -> Option<Vec<Said>> {
    let output = match Command::new("prusa-slicer")
        .arg("--info")
        .arg(file)
        .output()
    {
        Err(absent) if absent.kind() == std::io::ErrorKind::NotFound => return None,
        output => output.unwrap(),
    };
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{}: {said}", file.display());
    let mut objects: Vec<Said> = Vec::new();
    for line in said.lines() {
        if line.starts_with('[') && line.ends_with(']') {
            objects.push(Said::new());
        } else if let (Some(object), Some((key, value))) =
            (objects.last_mut(), line.split_once('='))
        {
            object.insert(key.trim().into(), value.trim().into());
        }
    }
    Some(objects)
}

/// Asserts that the slicer takes a part and agrees with the checklist on its triangles and its
/// volume.
fn assert_taken(part: &Value, said: &Said) {
    let number = |key: &str| said[key].parse::<f64>().unwrap();
    assert_eq!(said["manifold"], "yes", "{said:?}");
    let repaired: Vec<_> = REPAIRS
        .iter()
        .filter(|key| said.contains_key(**key))
        .collect();
    assert!(
        repaired.is_empty(),
        "the slicer repaired {repaired:?}: {said:?}"
    );
    assert_eq!(number("number_of_parts"), 1.0, "{said:?}");
    assert_eq!(said["number_of_facets"], part["triangles"].to_string());
    let volume_mm3 = part["volume_mm3"].as_f64().unwrap();
    let off_ratio = number("volume") / volume_mm3 - 1.0;
    assert!(off_ratio.abs() < VOLUME_RATIO, "{off_ratio:e}: {said:?}");
}

fn assert_rests(said: &Said) {
    let lowest = said["min_z"].parse::<f64>().unwrap();
    assert!(
        lowest.abs() < 1e-4,
        "it does not rest on the plate: {said:?}"
    );
}

#[test]
fn a_slicer_takes_every_part_of_a_kit_without_repair() {
    if sliced(Path::new(MODEL)).is_none() {
        eprintln!(
            "SKIPPED: no prusa-slicer here; apt-get install --no-install-recommends prusa-slicer"
        );
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let printed = [
        "--printer",
        "objet-connex350",
        "--goal",
        "top",
        "--size",
        "60mm",
        "--wall",
        "1.5mm",
    ];
    let prepared = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args(["-q", "prepare", MODEL, "--pitch", "0.3mm"])
        .args(printed)
        .arg("--out")
        .arg(&kit)
        .output()
        .unwrap();
    assert!(
        prepared.status.success(),
        "{}",
        String::from_utf8_lossy(&prepared.stderr)
    );
    let checklist: Value =
        serde_json::from_slice(&fs::read(kit.join("checklist.json")).unwrap()).unwrap();
    let parts = checklist["parts"].as_array().unwrap();
    assert!(parts.len() > 1, "{parts:?}");
    for part in parts {
        let file = kit.join(part["file"].as_str().unwrap());
        for file in [file.clone(), file.with_extension("3mf")] {
            let said = sliced(&file).unwrap();
            assert_taken(part, &said);
            assert_rests(&said);
        }
    }
    for package in ["assembly.3mf", "plate.3mf"] {
        let said = objects_sliced(&kit.join(package)).unwrap();
        assert_eq!(said.len(), parts.len(), "{package}: {said:?}");
        parts
            .iter()
            .zip(&said)
            .for_each(|(part, said)| assert_taken(part, said));
    }
}

#[test]
fn a_hole_is_found_by_the_slicer() {
    let folder = tempfile::tempdir().unwrap();
    let holed = folder.path().join("holed.stl");
    let mut bytes = fs::read(MODEL).unwrap();
    let is_binary = bytes.len() > 84 && !bytes.starts_with(b"solid");
    assert!(is_binary, "the shipped model is a binary STL");
    // One triangle, of 50 bytes, less: the count stands in bytes 80 to 84.
    bytes.truncate(bytes.len() - 50);
    let count = u32::try_from((bytes.len() - 84) / 50).unwrap();
    bytes[80..84].copy_from_slice(&count.to_le_bytes());
    fs::write(&holed, bytes).unwrap();
    match sliced(&holed) {
        Some(said) => assert_eq!(said["manifold"], "no", "{said:?}"),
        None => eprintln!("SKIPPED: no prusa-slicer here"),
    }
}
