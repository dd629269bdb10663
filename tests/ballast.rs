//! Ballast as a user orders it: an impossible rotor becomes a kit, and a lie about its ballast is
//! found.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::panic, reason = "a test whose input cannot be had has failed")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use common::{equipoise, glue_g};
use equipoise::geom::Point;
use equipoise::io::stl;
use equipoise::mesh::primitives::cuboid;
use serde_json::Value;

/// A block of 40 × 16 × 30 mm, written as a model.
fn block(folder: &Path) -> PathBuf {
    let path = folder.join("block.stl");
    let mesh = cuboid(&Point::origin(), &Point::new(40.0, 16.0, 30.0));
    fs::write(&path, stl::encode(&mesh, "block")).unwrap();
    path
}

/// Turns it about an axis 3 mm above its middle: further than hollowing behind a wall of 3 mm
/// brings its centre.
fn prepare(model: &Path, out: &Path, more: &[&str]) -> Output {
    let usual = [
        "--json",
        "prepare",
        model.to_str().unwrap(),
        "--printer",
        "objet-connex350",
        "--goal",
        "balance",
    ];
    let goal = [
        "--up",
        "x",
        "--spin-point",
        "20,8,18",
        "--wall",
        "3mm",
        "--pitch",
        "0.2mm",
    ];
    equipoise(&[&usual[..], &goal, &["--out", out.to_str().unwrap()], more].concat())
}

fn json(bytes: &[u8]) -> Value {
    serde_json::from_slice(bytes).unwrap()
}

#[test]
fn a_rotor_beyond_hollowing_gets_balls_and_a_lie_about_them_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let (model, kit) = (block(folder.path()), folder.path().join("kit"));
    let refused = prepare(&model, &kit, &[]);
    assert_eq!((refused.status.code(), kit.exists()), (Some(1), false));
    assert_eq!(json(&refused.stdout)["verdict"], "impossible");

    let made = prepare(&model, &kit, &["--ballast", "auto"]);
    assert_eq!(
        made.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&made.stderr)
    );
    let sheet = kit.join("checklist.json");
    let mut checklist = json(&fs::read(&sheet).unwrap());
    let rows = checklist["ballast"].as_array().unwrap().clone();
    assert!(!rows.is_empty());
    for row in &rows {
        assert!(row["part"].as_str().unwrap().starts_with("ball-"));
        assert!(!row["opened_by"].as_array().unwrap().is_empty() && row["sources"][1].is_string());
    }
    let page = fs::read_to_string(kit.join("checklist.html")).unwrap();
    let step = |name: &str| page.find(name).unwrap();
    assert!(step(". Lay in the ballast</h2>") < step(". Glue</h2>"));

    let path = kit.to_str().unwrap();
    assert_eq!(equipoise(&["verify", path]).status.code(), Some(0));
    let mass_g = rows[0]["mass_g"].as_f64().unwrap();
    checklist["ballast"][0]["mass_g"] = (1.02 * mass_g).into();
    fs::write(&sheet, checklist.to_string()).unwrap();
    let verdict = equipoise(&["--json", "verify", path]);
    assert_eq!(verdict.status.code(), Some(1));
}

#[test]
fn orders_that_cannot_be_met_are_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let (model, kit) = (block(folder.path()), folder.path().join("kit"));
    for (order, code, said) in [
        ("ball 4", 2, "such as ball-4x3"),
        ("bal-4", 2, "did you mean `ball-4`?"),
        (
            "ball-12x1",
            1,
            "no places were found for --ballast=ball-12x1",
        ),
    ] {
        let output = prepare(&model, &kit, &["--ballast", order]);
        let told = [&output.stdout[..], &output.stderr[..]].concat();
        let told = String::from_utf8_lossy(&told);
        assert!(
            output.status.code() == Some(code) && told.contains(said),
            "{order}: {told}"
        );
    }
}

/// The shipped ellipsoid as a top with something in its voids, coarse, which is quick.
fn filled_top(out: &Path, fill: &str) -> Output {
    let model = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/tilted-ellipsoid.stl"
    );
    let usual = [
        "--json",
        "prepare",
        model,
        "--printer",
        "objet-connex350",
        "--goal",
        "top",
        "--size",
        "60mm",
    ];
    equipoise(
        &[
            &usual[..],
            &[
                "--pitch",
                "0.3mm",
                "--fill",
                fill,
                "--out",
                out.to_str().unwrap(),
            ],
        ]
        .concat(),
    )
}

#[test]
fn voids_are_filled_with_something_lighter_or_heavier_than_the_print() {
    let folder = tempfile::tempdir().unwrap();
    for (fill, density) in [("0.4", 0.4), ("5", 5.0)] {
        let kit = folder.path().join(fill);
        let made = filled_top(&kit, fill);
        assert_eq!(
            made.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&made.stderr)
        );
        let sheet = json(&made.stdout);
        let printed_g: f64 = sheet["parts"]
            .as_array()
            .unwrap()
            .iter()
            .map(|part| part["mass_g"].as_f64().unwrap())
            .sum();
        let void_cm3 = |void: &Value| void["volume_mm3"].as_f64().unwrap() / 1000.0;
        let filled_g = density
            * sheet["voids"]
                .as_array()
                .unwrap()
                .iter()
                .map(void_cm3)
                .sum::<f64>();
        let mass_g = sheet["assembly"]["mass_g"].as_f64().unwrap();
        // Files keep 24 bits of a coordinate.
        let glue_g = glue_g(&sheet);
        assert!(
            (mass_g - printed_g - filled_g - glue_g).abs() < 1e-4 * mass_g,
            "{mass_g} {printed_g} {filled_g} {glue_g}"
        );
        assert_eq!(
            equipoise(&["verify", kit.to_str().unwrap()]).status.code(),
            Some(0)
        );
    }
    let like_the_print = filled_top(&folder.path().join("none"), "1.175");
    assert_eq!(like_the_print.status.code(), Some(2));
}
