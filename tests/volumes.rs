//! Volume meshes on the command line: what `inspect` tells of them, and what it refuses.
//!
//! Meshes made by Gmsh, meshio and TetGen have the mass that numpy finds in them.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(
    clippy::print_stderr,
    clippy::print_stdout,
    reason = "a skipped test says so, and figures are shown with --nocapture"
)]

use crate::common;

use std::ffi::OsString;
use std::fs;
use std::path::Path;
use std::process::Command;

use common::{ELLIPSOID, assert_exit, equipoise, json, path, printed};
use equipoise::io::{DataChoice, read_volume};
use equipoise::mass::Body;
use equipoise::mass::Moments;
use serde_json::Value;

/// The mesher and judge of volume meshes.
const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/volume_meshes.py");
/// The Python packages that it imports; TetGen is one more where it is there.
const PACKAGES: &str = "gmsh, meshio, numpy";

/// A box of 10 × 10 × 10 mm as five tetrahedra, with a density that rises along x.
const BOX: &str = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 10 0 0\n3 0 10 0\n\
    4 10 10 0\n5 0 0 10\n6 10 0 10\n7 0 10 10\n8 10 10 10\n$EndNodes\n$Elements\n5\n\
    1 4 2 1 1 1 2 3 5\n2 4 2 1 1 4 2 3 8\n3 4 2 1 1 6 5 2 8\n4 4 2 1 1 7 3 5 8\n\
    5 4 2 1 1 2 3 5 8\n$EndElements\n";
const RISING: &str = "$NodeData\n1\n\"density\"\n1\n0\n3\n0\n1\n8\n1 0.2\n2 0.6\n3 0.2\n4 0.6\n\
    5 0.2\n6 0.6\n7 0.2\n8 0.6\n$EndNodeData\n";

/// Writes a file and returns what `inspect` says of it.
fn inspect(name: &str, text: &str, options: &[&str]) -> std::process::Output {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, text).unwrap();
    equipoise(&[&["inspect", path(&file)], options].concat())
}

#[test]
fn inspect_tells_mass_centre_moments_shapes_and_sampling_of_a_volume_mesh() {
    let output = inspect("box.msh", &format!("{BOX}{RISING}"), &["--json"]);
    assert_exit(&output, 0);
    let facts = json(&output);
    let near = |value: &Value, expected: f64| {
        let value = value.as_f64().unwrap();
        assert!(
            (value - expected).abs() <= 1e-9 * expected.abs().max(1.0),
            "{value} {expected}"
        );
    };
    assert_eq!(
        (&facts["tetrahedra"], &facts["corners"]),
        (&5.into(), &8.into())
    );
    assert_eq!(facts["boundary_triangles"], 12);
    near(&facts["volume_mm3"], 1000.0);
    // 0.2 + 0.04 x over the box, of 1.2 g/cm³.
    near(&facts["mass_g"], 0.4 * 1.2);
    near(&facts["mean_density_ratio"], 0.4);
    // ∫ x (0.2 + 0.04 x) / ∫ (0.2 + 0.04 x).
    near(
        &facts["body"]["center_mm"][0],
        (0.1 * 100.0 + 0.04 / 3.0 * 1000.0) / 4.0,
    );
    near(&facts["body"]["center_mm"][1], 5.0);
    let across = 1000.0 * 0.4 * 1.2e-3 * 100.0 / 6.0;
    near(&facts["body"]["principal_moments_g_mm2"][2], across);
    near(&facts["sampling"]["greatest_jump"], 0.4);
    assert!(
        facts["sampling"]["estimated_error"]["mass_ratio"]
            .as_f64()
            .unwrap()
            < 1e-12
    );
    near(&facts["shape"]["greatest_angle_deg"], 90.0);
    let said = printed(&inspect("box.msh", &format!("{BOX}{RISING}"), &[]));
    for words in [
        "a volume mesh of 5 tetrahedra, 8 corners, 12 boundary triangles",
        "density: density at each corner, linear between, from 0.2 to 0.6",
        "mass 0.48 g of 1.2 g/cm³ material, mean density 40 %",
        "centre of mass (5.833, 5.000, 5.000) mm",
        "no slivers (an angle below 5° or above 175°)",
        "the density changes by at most 0.4 within a tetrahedron",
    ] {
        assert!(said.contains(words), "{said}\n{words}");
    }
    let solid = printed(&inspect("box.msh", BOX, &["--unit", "cm"]));
    assert!(
        solid.contains("none in the file, so it is solid"),
        "{solid}"
    );
    assert!(solid.contains("volume 1000000 mm³"), "{solid}");
}

#[test]
fn a_field_over_a_volume_mesh_is_told_with_the_error_of_its_samples() {
    let exact = inspect(
        "box.msh",
        BOX,
        &["--json", "--field", "ramp:1,0,0@0mm..10mm:0.2..0.6"],
    );
    assert_exit(&exact, 0);
    let error = &json(&exact)["field"]["sampling_error"];
    assert!(error["mass_ratio"].as_f64().unwrap() < 1e-12, "{error}");
    let bent = inspect(
        "box.msh",
        BOX,
        &["--json", "--field", "ramp:1,0,0@0mm..5mm:0.2..0.6"],
    );
    let bent = json(&bent);
    // Exact: 0.2 to 0.6 over half the box, then 0.6. The corners see only 0.2 and 0.6.
    let ratio = bent["field"]["exact"]["mean_density_ratio"]
        .as_f64()
        .unwrap();
    assert!((ratio - 0.5).abs() < 1e-12, "{ratio}");
    let error = bent["field"]["sampling_error"]["mass_ratio"]
        .as_f64()
        .unwrap();
    assert!((error - 0.2).abs() < 1e-12, "{error}");
    let said = printed(&inspect(
        "box.msh",
        BOX,
        &["--field", "ramp:1,0,0@0mm..5mm:0.2..0.6"],
    ));
    assert!(
        said.contains("sampled at the corners of this mesh it is off by 2.0e1 %"),
        "{said}"
    );
}

#[test]
fn what_cannot_be_inspected_is_refused_in_words_with_what_to_type() {
    let refused = |name: &str, text: &str, options: &[&str]| {
        let output = inspect(name, text, options);
        assert_exit(&output, 2);
        printed(&output)
    };
    let two = RISING.replace("density", "rho") + &RISING.replace("density", "sigma");
    let said = refused("box.msh", &format!("{BOX}{two}"), &[]);
    assert!(
        said.contains("--data=rho") && said.contains("--data=none"),
        "{said}"
    );
    let chosen = inspect("box.msh", &format!("{BOX}{two}"), &["--data", "rho"]);
    assert_exit(&chosen, 0);
    let wrong = RISING.replace("8 0.6", "8 1240");
    let said = refused("box.msh", &format!("{BOX}{wrong}"), &[]);
    assert!(
        said.contains("line 39: the density of corner 8 is 1240"),
        "{said}"
    );
    let doubled = BOX.replace("5\n1 4 2 1 1", "6\n9 4 2 1 1 4 2 3 8\n1 4 2 1 1");
    assert!(
        refused("box.msh", &doubled, &[]).contains("tetrahedron"),
        "{doubled}"
    );
    let said = refused("box.msh", BOX, &["--repair", "fill"]);
    assert!(said.contains("--repair is for surfaces"), "{said}");
    let said = refused("box.node", "1 3 0 0\n0 0 0 0\n", &[]);
    assert!(said.contains("box.ele is not beside it"), "{said}");
    let said = refused("box.stl", BOX, &[]);
    assert!(said.contains("a Gmsh mesh"), "{said}");
    let said = refused("box.msh", "solid x\nendsolid x\n", &[]);
    assert!(said.contains("begins neither"), "{said}");
    let surface = equipoise(&["inspect", ELLIPSOID, "--data", "rho"]);
    assert_exit(&surface, 2);
    assert!(printed(&surface).contains("--data is for volume meshes"));
    let missing = equipoise(&["inspect", "no-such.msh"]);
    assert_exit(&missing, 2);
    assert!(printed(&missing).contains("no such file"));
}

/// Returns `EQUIPOISE_JUDGE_PYTHON`, or `python3`; `None`, with a message, if it lacks a package.
fn find_python() -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let import = format!("import {PACKAGES}");
    let output = Command::new(&python).args(["-c", &import]).output();
    let has_packages = output.is_ok_and(|output| output.status.success());
    if !has_packages {
        eprintln!("SKIPPED: no Python with {PACKAGES} here; pip install them");
    }
    has_packages.then_some(python)
}

/// Lets Gmsh, meshio and TetGen mesh into a folder; returns what numpy finds in each file.
fn mesh_into(folder: &Path) -> Option<Vec<Value>> {
    let python = find_python()?;
    let output = Command::new(python)
        .arg(JUDGE)
        .arg(folder)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", printed(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    let claims = text.lines().last().unwrap();
    Some(serde_json::from_str(claims).unwrap())
}

#[test]
fn meshes_of_gmsh_meshio_and_tetgen_have_the_moments_that_numpy_finds() {
    let folder = tempfile::tempdir().unwrap();
    let Some(claims) = mesh_into(folder.path()) else {
        return;
    };
    assert!(claims.len() >= 18, "{}", claims.len());
    let mut worst = 0.0_f64;
    for claim in &claims {
        let file = folder.path().join(claim["file"].as_str().unwrap());
        let volume = read_volume(&file, &DataChoice::Auto).unwrap();
        assert_eq!(
            volume.tets.cells().len() as u64,
            claim["tetrahedra"].as_u64().unwrap()
        );
        let moments = claim["moments"].as_array().unwrap();
        let moments = std::array::from_fn(|index| moments[index].as_f64().unwrap());
        let [want, got] = [Moments(moments), volume.tets.moments()].map(|it| Body::new(&it, 1.0));
        let off = [
            got.mass_g / want.mass_g - 1.0,
            (got.center - want.center).norm() / 20.0,
            (got.inertia_g_mm2 - want.inertia_g_mm2).amax() / want.inertia_g_mm2.amax(),
        ];
        let off = off
            .into_iter()
            .fold(0.0, |most: f64, it| most.max(it.abs()));
        assert!(off < 1e-9, "{}: {off:.1e}", file.display());
        worst = worst.max(off);
        let output = equipoise(&["--json", "inspect", path(&file)]);
        assert_exit(&output, 0);
        let told = json(&output)["mass_g"].as_f64().unwrap();
        assert!((told / (want.mass_g * 1.2e-3) - 1.0).abs() < 1e-9);
    }
    println!("{} files, at most {worst:.1e} off", claims.len());
}

#[test]
fn a_field_is_written_as_a_volume_mesh_that_reads_back_with_its_stated_error() {
    let folder = tempfile::tempdir().unwrap();
    let field = "ramp:0,0,1@-10mm..10mm:0.2..0.9";
    for name in ["ellipsoid.msh", "ellipsoid.vtk"] {
        let file = folder.path().join(name);
        let order = [
            "--size",
            "60mm",
            "--field",
            field,
            "--tets",
            path(&file),
            "--tets-edge",
            "3mm",
        ];
        let output = equipoise(&[&["--json", "inspect", ELLIPSOID], &order[..]].concat());
        assert_exit(&output, 0);
        let told = json(&output);
        let error = told["tets"]["error"].clone();
        let [mass, center] = ["mass_ratio", "center_mm"].map(|key| error[key].as_f64().unwrap());
        assert!(mass < 0.02 && center < 0.2, "{error}");
        assert!(
            told["tets"]["least_angle_deg"].as_f64().unwrap() > 5.0,
            "{told}"
        );
        let back = json(&equipoise(&["--json", "inspect", path(&file)]));
        let [got, exact] =
            [&back["mass_g"], &told["field"]["mass_g"]].map(|it| it.as_f64().unwrap());
        assert!(
            ((got / exact - 1.0).abs() - mass).abs() < 1e-9,
            "{got} {exact} {mass}"
        );
        assert_eq!(back["shape"]["slivers"], 0);
        assert!(back["density"].as_str().unwrap().contains("at each corner"));
        let again = equipoise(&[&["inspect", ELLIPSOID], &order[..]].concat());
        assert_exit(&again, 2);
        assert!(printed(&again).contains("exists"), "{}", printed(&again));
    }
    let refused = |options: &[&str]| {
        let output = equipoise(&[&["inspect", ELLIPSOID], options].concat());
        assert_exit(&output, 2);
        printed(&output)
    };
    assert!(
        refused(&["--tets", "a.stl", "--field", field]).contains("neither in .msh nor in .vtk")
    );
    assert!(refused(&["--tets", "a.msh"]).contains("none is given"));
    let fine = [
        "--size",
        "60mm",
        "--tets",
        "a.msh",
        "--field",
        field,
        "--tets-edge",
        "0.01mm",
    ];
    let said = refused(&fine);
    assert!(
        said.contains("too short") && !Path::new("a.msh").exists(),
        "{said}"
    );
}

#[test]
fn a_graded_print_is_written_as_a_volume_mesh_with_the_mass_of_its_levels() {
    let folder = tempfile::tempdir().unwrap();
    let [kit, file, other] = ["kit", "part.msh", "other.msh"].map(|name| folder.path().join(name));
    let options = "--printer prusa-mk4 --size 60mm --goal stand --least-angle 1.5 --interior graded \
                   --density 15%..60% --tets";
    let order = |kit: &Path, file: &Path, threads: &str| {
        let arguments = [
            "--threads",
            threads,
            "--json",
            "prepare",
            ELLIPSOID,
            "--out",
            path(kit),
        ];
        let options: Vec<&str> = options.split_whitespace().collect();
        equipoise(&[&arguments, &options[..], &[path(file)]].concat())
    };
    let output = order(&kit, &file, "2");
    assert_exit(&output, 0);
    let sheet = json(&output);
    let part_g = sheet["parts"][0]["mass_g"].as_f64().unwrap();
    let back = equipoise(&["--json", "inspect", path(&file), "--printer", "prusa-mk4"]);
    assert_exit(&back, 0);
    let back = json(&back);
    let mass_g = back["mass_g"].as_f64().unwrap();
    println!("{mass_g} g in the mesh, {part_g} g on the sheet");
    assert!((mass_g / part_g - 1.0).abs() < 0.03, "{mass_g} {part_g}");
    assert!(
        back["density"]
            .as_str()
            .unwrap()
            .contains("in each tetrahedron")
    );
    let [low, high] = [0, 1].map(|end| back["density_range"][end].as_f64().unwrap());
    assert!(low > 0.05 && low < 0.3 && high == 1.0, "{low} {high}");
    let again = order(&folder.path().join("again"), &other, "1");
    assert_exit(&again, 0);
    assert!(
        fs::read(&file).unwrap() == fs::read(&other).unwrap(),
        "other bytes"
    );
    let hollow = equipoise(&[
        "prepare",
        ELLIPSOID,
        "--goal",
        "top",
        "--printer",
        "prusa-mk4",
        "--size",
        "60mm",
        "--tets",
        path(&folder.path().join("hollow.msh")),
    ]);
    assert_exit(&hollow, 2);
    assert!(
        printed(&hollow).contains("--interior=graded"),
        "{}",
        printed(&hollow)
    );
}
