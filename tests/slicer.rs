//! A real slicer takes every part of a kit as it is: PrusaSlicer finds nothing to repair and
//! measures the same volume.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use common::{ELLIPSOID, list, make_kit, number, printed};
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
    for package in ["assembly.3mf", "plate.3mf"] {
        let objects = slice_all(&kit.join(package)).unwrap();
        assert_eq!(objects.len(), parts.len(), "{package}: {objects:?}");
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
