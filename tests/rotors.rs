//! The bores and shafts that rotors turn on, and the axles that yo-yos hold.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

use common::{assert_exit, checklist, equipoise, list, path, printed, shared_model, words};
use equipoise::base::watch::Watch;
use equipoise::geom::{Point, Vector};
use equipoise::goal::{ShaftAxis, find_shafts};
use equipoise::io::{read_model, stl};
use equipoise::mesh::{Csg, Solid, TriMesh, primitives};
use equipoise::repair::repair;

/// Returns a pulley: a disc of 60 mm and 20 mm width, heavier on one side, with bores along z.
fn pulley(bores: &[[f64; 3]]) -> TriMesh {
    let rod = |[x, y, radius_mm]: [f64; 3], [low, high]: [f64; 2]| {
        let upright = primitives::cylinder(radius_mm, high - low, 48);
        let turned = |p: &Point| {
            let (sin, cos) = (TAU / 100.0).sin_cos();
            Point::new(
                x + cos * p.x - sin * p.y,
                y + sin * p.x + cos * p.y,
                low + p.z,
            )
        };
        Csg::of_mesh(&upright.map_vertices(turned)).unwrap()
    };
    let disc = rod([0.0, 0.0, 30.0], [0.0, 20.0]);
    let lug = rod([9.0, 0.0, 24.0], [0.0, 20.5]);
    let whole = disc.union(&lug).unwrap();
    let bored = bores.iter().try_fold(whole, |whole, bore| {
        whole.subtract(&rod(*bore, [-5.0, 25.0]))
    });
    bored.unwrap().to_mesh().unwrap()
}

fn write(folder: &Path, mesh: &TriMesh) -> PathBuf {
    let model = folder.join("pulley.stl");
    fs::write(&model, stl::encode(mesh, "pulley")).unwrap();
    model
}

fn balance(model: &Path, out: &Path, options: &str) -> std::process::Output {
    let usual = "--goal balance --printer objet-connex350 --wall 2mm --pitch 1mm";
    let line = [
        &["prepare", path(model), "--out", path(out)][..],
        &words(usual),
        &words(options),
    ];
    equipoise(&line.concat())
}

#[test]
fn a_rotor_turns_on_its_only_bore_and_its_sheet_names_the_shaft() {
    let folder = tempfile::tempdir().unwrap();
    let model = write(folder.path(), &pulley(&[[3.0, 2.0, 4.0]]));
    let looked_at = equipoise(&["inspect", path(&model), "--wall", "2mm"]);
    let advised = printed(&looked_at);
    let typed = advised.lines().find(|line| line.contains("--goal=balance"));
    assert_eq!(typed.map(str::trim), Some("--goal=balance"), "{advised}");
    let kit = folder.path().join("kit");
    let done = balance(&model, &kit, "");
    assert_exit(&done, 0);
    assert!(
        printed(&done).contains("bore of 8.0 mm diameter"),
        "{}",
        printed(&done)
    );
    let sheet = checklist(&kit);
    let surface = &sheet["goal"]["turns_on"][0];
    assert_eq!(surface["kind"], "bore");
    assert!((surface["diameter_mm"].as_f64().unwrap() - 8.0).abs() < 0.05);
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    assert!(
        page.contains("straight shaft of 8"),
        "the page names no shaft"
    );
}

#[test]
fn a_model_with_two_bores_is_refused_with_both_axes_to_type() {
    let folder = tempfile::tempdir().unwrap();
    let model = write(
        folder.path(),
        &pulley(&[[3.0, 2.0, 4.0], [-18.0, 0.0, 3.0]]),
    );
    let kit = folder.path().join("kit");
    let refused = balance(&model, &kit, "");
    assert_exit(&refused, 2);
    assert!(!kit.exists());
    let said = printed(&refused);
    assert!(said.contains("can turn on 2 axes"), "{said}");
    let remedies: Vec<&str> = said
        .lines()
        .filter_map(|line| line.trim().strip_prefix("remedy: "))
        .collect();
    assert_eq!(remedies.len(), 2, "{said}");
    // The larger bore, near the middle; on the other the disc shakes whatever is hollowed.
    let typed = remedies[0].split_once(" (").unwrap().0;
    assert_exit(&balance(&model, &kit, typed), 0);
}

#[test]
fn a_body_without_a_bore_is_refused_until_one_is_ordered() {
    let folder = tempfile::tempdir().unwrap();
    let model = write(folder.path(), &pulley(&[]));
    let looked_at = equipoise(&["inspect", path(&model), "--wall", "2mm"]);
    let advised = printed(&looked_at);
    assert!(
        advised.ends_with("needs a bore: --bore=8mm; you must say which axis\n"),
        "{advised}"
    );
    let kit = folder.path().join("kit");
    let refused = balance(&model, &kit, "");
    assert_exit(&refused, 2);
    assert!(
        printed(&refused).contains("--bore=6mm"),
        "{}",
        printed(&refused)
    );
    assert_exit(&balance(&model, &kit, "--up z --bore 6mm"), 0);
    assert_eq!(
        checklist(&kit)["goal"]["turns_on"][0]["kind"],
        "bore_to_make"
    );
}

#[test]
fn an_axis_beside_the_bore_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let model = write(folder.path(), &pulley(&[[3.0, 2.0, 4.0]]));
    let kit = folder.path().join("kit");
    let refused = balance(&model, &kit, "--up z --spin-point 0,0,10");
    assert_exit(&refused, 2);
    assert!(
        printed(&refused).contains("lies on the axis that was ordered"),
        "{}",
        printed(&refused)
    );
}

#[test]
#[ignore = "long: 10 s, and the axis of a model with two bores is typed too; run with -- --ignored"]
fn an_axis_along_the_bore_is_taken() {
    let folder = tempfile::tempdir().unwrap();
    let model = write(folder.path(), &pulley(&[[3.0, 2.0, 4.0]]));
    let kit = folder.path().join("kit");
    assert_exit(&balance(&model, &kit, "--up z --spin-point 3,2,10"), 0);
}

/// Spins a disc of 40 mm diameter and this width as a yo-yo on an axle.
fn yoyo(folder: &Path, width_mm: f64, axle: &str) -> std::process::Output {
    let disc = primitives::cylinder(20.0, width_mm, 64);
    let model = write(folder, &disc);
    let out = folder.join("kit");
    let usual =
        "--goal yoyo --up z --printer objet-connex350 --wall 1mm --pitch 0.5mm --string-gap 3mm";
    let line = [
        &["prepare", path(&model), "--force", "--out", path(&out)][..],
        &words(usual),
        &["--axle", axle],
    ];
    equipoise(&line.concat())
}

#[test]
#[ignore = "long: 20 s; run with -- --ignored"]
fn an_axle_sits_as_deep_as_it_is_thick_or_the_thickest_that_does_is_named() {
    let folder = tempfile::tempdir().unwrap();
    // Each half is 6 mm thick. With 1 mm of wall and the gap at its end, an axle of 5 mm would sit
    // less than 5 mm deep.
    let refused = yoyo(folder.path(), 12.0, "6mm");
    assert_exit(&refused, 2);
    assert!(
        printed(&refused).contains("--axle=4mm"),
        "{}",
        printed(&refused)
    );
    assert_exit(&yoyo(folder.path(), 12.0, "4mm"), 0);
    let sheet = checklist(&folder.path().join("kit"));
    let checks = list(&sheet, "checks");
    let grip = checks.iter().find(|check| check["kind"] == "grip").unwrap();
    assert!(grip["value"].as_f64().unwrap() >= 4.0 - 1e-3, "{grip}");
}

#[test]
fn an_axle_that_is_ordered_too_short_breaks_a_promise() {
    let folder = tempfile::tempdir().unwrap();
    let broken = yoyo(folder.path(), 30.0, "6mmx11mm");
    assert_exit(&broken, 1);
    assert!(
        printed(&broken).contains("holds the axle"),
        "{}",
        printed(&broken)
    );
}

fn shared(name: &str) -> Option<Vec<ShaftAxis>> {
    let model = shared_model(name)?;
    let mended = repair(read_model(&model).unwrap(), &Watch::silent())
        .unwrap()
        .0;
    let size_mm = mended.aabb().size().max();
    let solid = Solid::new(mended.map_vertices(|p| p * (100.0 / size_mm))).unwrap();
    Some(find_shafts(&solid, &Watch::silent()).unwrap())
}

#[test]
fn a_scanned_rocker_arm_turns_on_its_bore_and_figures_on_nothing() {
    if let Some(axes) = shared("rocker-arm.obj") {
        let [axis] = &axes[..] else {
            panic!("{axes:?}")
        };
        let at = Point::new(0.0, 6.7135, 8.4895);
        assert!(axis.is_along(&at, &Vector::x()), "{axis:?}");
    }
    if let Some(axes) = shared("bracket.stl") {
        assert_eq!(axes.len(), 9, "{axes:?}");
    }
    for name in ["elephant.obj", "homer.obj", "heart.obj", "cheburashka.obj"] {
        if let Some(axes) = shared(name) {
            assert!(axes.is_empty(), "{name}: {axes:?}");
        }
    }
}
