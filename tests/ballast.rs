//! Ballast as a user orders it: an impossible rotor becomes a kit, and a false weight on its sheet
//! is found.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use common::{
    assert_exit, checklist, equipoise, glue_g, json, list, number, path, prepare_quickly, printed,
    sum, verify, words,
};
use equipoise::geom::Point;
use equipoise::io::stl;
use equipoise::mesh::primitives::cuboid;

/// Writes a block of 40 × 24 × 30 mm as a model.
fn write_block(folder: &Path) -> PathBuf {
    let path = folder.join("block.stl");
    let mesh = cuboid(&Point::origin(), &Point::new(40.0, 24.0, 30.0));
    fs::write(&path, stl::encode(&mesh, "block")).unwrap();
    path
}

/// Prepares a rotor about an axis 2.5 mm above the middle of the block. Hollowing behind a wall of
/// 3 mm cannot move the centre so far.
fn prepare_rotor(model: &Path, out: &Path, ballast: &[&str]) -> Output {
    let rotor =
        "--printer objet-connex350 --goal balance --up x --spin-point 20,12,17.5 --bore 2mm";
    let usual = ["--json", "prepare", path(model), "--out", path(out)];
    let sizes = words("--wall 3mm --pitch 0.2mm");
    equipoise(&[&usual[..], &words(rotor), &sizes, ballast].concat())
}

#[test]
fn a_rotor_that_hollowing_cannot_balance_is_impossible_without_ballast() {
    let folder = tempfile::tempdir().unwrap();
    let (model, kit) = (write_block(folder.path()), folder.path().join("kit"));
    let refused = prepare_rotor(&model, &kit, &[]);
    assert_exit(&refused, 1);
    assert!(!kit.exists());
    assert_eq!(json(&refused)["verdict"], "impossible");
}

#[test]
fn balls_balance_the_rotor_and_a_false_mass_on_the_sheet_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let (model, kit) = (write_block(folder.path()), folder.path().join("kit"));
    assert_exit(&prepare_rotor(&model, &kit, &["--ballast", "auto"]), 0);
    let mut sheet = checklist(&kit);
    let rows = list(&sheet, "ballast");
    assert!(!rows.is_empty());
    for row in rows {
        assert!(row["part"].as_str().unwrap().starts_with("ball-"));
        assert!(!list(row, "opened_by").is_empty() && row["sources"][1].is_string());
    }
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    let place = |step: &str| page.find(step).unwrap();
    assert!(place(". Lay in the ballast</h2>") < place(". Glue</h2>"));

    assert_eq!(verify(&kit).0, Some(0));
    sheet["ballast"][0]["mass_g"] = (1.02 * number(&sheet, "/ballast/0/mass_g")).into();
    fs::write(kit.join("checklist.json"), sheet.to_string()).unwrap();
    assert_eq!(verify(&kit).0, Some(1));
}

#[test]
fn orders_that_cannot_be_met_are_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let (model, kit) = (write_block(folder.path()), folder.path().join("kit"));
    for (order, code, words) in [
        ("ball 4", 2, "such as ball-4x3"),
        ("bal-4", 2, "did you mean `ball-4`?"),
        ("ball-12x1", 1, "no places were found for `ballast = "),
    ] {
        let output = prepare_rotor(&model, &kit, &["--ballast", order]);
        assert_exit(&output, code);
        let said = printed(&output);
        assert!(said.contains(words), "{order}: {said}");
    }
}

/// Fills the voids of a top; its masses must add up.
fn assert_filled(density_g_cm3: f64) {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let sheet = common::make_kit(&kit, &format!("--goal top --up z --fill {density_g_cm3}"));
    let printed_g = sum(list(&sheet, "parts"), "/mass_g");
    let filled_g = density_g_cm3 * sum(list(&sheet, "voids"), "/volume_mm3") / 1000.0;
    let mass_g = number(&sheet, "/assembly/mass_g");
    let rest_g = mass_g - printed_g - filled_g - glue_g(&sheet);
    // Files keep 24 bits of a coordinate.
    assert!(rest_g.abs() < 1e-4 * mass_g, "{rest_g} {mass_g}");
    assert_eq!(verify(&kit).0, Some(0));
}

#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn voids_are_filled_with_something_heavier_than_the_print() {
    assert_filled(5.0);
}

#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn voids_are_filled_with_something_lighter_than_the_print() {
    assert_filled(0.4);
}

#[test]
fn a_filling_as_heavy_as_the_print_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let refused = prepare_quickly(&folder.path().join("kit"), "--goal top --up z --fill 1.175");
    assert_exit(&refused, 2);
}
