//! An independent judge in Python weighs G-code of real slicers, and of texts in the manner of
//! others, as the program does.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]

use crate::common;

use std::ffi::OsString;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use common::{ELLIPSOID, printed};
use equipoise::base::watch::Watch;
use equipoise::geom::{Plane, Point, Vector};
use equipoise::io::gcode::{Options, Toolpath, read_gcode};
use equipoise::io::{read_model, stl};
use equipoise::mass::moments_of_mesh;
use equipoise::mesh::{Csg, primitives, scaled};
use equipoise::repair::weld;
use serde_json::{Value, json};

/// The judge of G-code.
const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/judge/judge_gcode.py");

/// Options of PrusaSlicer, a file for each: modes of E, supports, labels, copies, vases, volumes.
const PRUSA: [&[&str]; 6] = [
    &["--gcode-label-objects"],
    &["--support-material", "--brim-width", "3", "--skirts", "2"],
    &[
        "--use-relative-e-distances",
        "--layer-gcode",
        "G92 E0",
        "--duplicate",
        "2",
        "--gcode-label-objects",
    ],
    &[
        "--spiral-vase",
        "--top-solid-layers",
        "0",
        "--perimeters",
        "1",
        "--fill-density",
        "0%",
    ],
    &[
        "--use-volumetric-e",
        "--fill-pattern",
        "gyroid",
        "--raft-layers",
        "2",
    ],
    &[
        "--filament-diameter",
        "2.85",
        "--layer-height",
        "0.15",
        "--first-layer-height",
        "0.3",
    ],
];

/// Settings of CuraEngine, a file for each.
const CURA: [&[&str]; 3] = [
    &["adhesion_type=skirt", "infill_pattern=lines"],
    &[
        "adhesion_type=brim",
        "support_enable=true",
        "infill_pattern=gyroid",
    ],
    &[
        "adhesion_type=raft",
        "relative_extrusion=true",
        "layer_height_0=0.3",
    ],
];

/// Returns `EQUIPOISE_JUDGE_PYTHON`, or `python3`; `None`, with a message, if it lacks numpy.
fn find_python() -> Option<OsString> {
    let python = std::env::var_os("EQUIPOISE_JUDGE_PYTHON").unwrap_or_else(|| "python3".into());
    let output = Command::new(&python).args(["-c", "import numpy"]).output();
    let has_numpy = output.is_ok_and(|output| output.status.success());
    if !has_numpy {
        eprintln!("SKIPPED: no Python with numpy here; pip install it");
    }
    has_numpy.then_some(python)
}

/// Reads the only plate of a file.
fn read(path: &Path) -> Toolpath {
    let plates = read_gcode(path, &Options::default(), &Watch::silent()).unwrap();
    plates.into_iter().next().unwrap().toolpath
}

/// Writes what the program finds in a file, and lets the judge look at both.
fn judge(python: &OsString, path: &Path) -> (Option<i32>, String) {
    let toolpath = read(path);
    let object = |object: &equipoise::io::gcode::PrintedObject| {
        let label = object.label.as_ref().map(ToString::to_string);
        json!({"label": label, "moments": object.deposits.part_moments().0})
    };
    let claim = json!({
        "diameter_mm": toolpath.diameters_mm[0],
        "moments": toolpath.part_moments().0,
        "objects": toolpath.objects.iter().map(object).collect::<Vec<Value>>(),
    });
    let claimed = path.with_extension("json");
    fs::write(&claimed, claim.to_string()).unwrap();
    let mut command = Command::new(python);
    let command = command.arg(JUDGE).arg(path).arg(&claimed);
    let output = command
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .output()
        .unwrap();
    (output.status.code(), printed(&output))
}

fn assert_agreed(python: &OsString, path: &Path) {
    let (code, said) = judge(python, path);
    assert_eq!(code, Some(0), "{}: {said}", path.display());
    eprintln!("{}: {said}", path.file_name().unwrap().display());
}

/// Runs a slicer; returns false, with a message, if it is not there.
fn runs(command: &mut Command, install: &str) -> bool {
    match command.output() {
        Err(absent) if absent.kind() == std::io::ErrorKind::NotFound => {
            eprintln!("SKIPPED: {install}");
            false
        }
        output => {
            let output = output.unwrap();
            assert!(output.status.success(), "{}", printed(&output));
            true
        }
    }
}

/// Slices the shipped ellipsoid by PrusaSlicer; `None` if it is not there.
fn slice_by_prusa(folder: &Path, number: usize) -> Option<PathBuf> {
    let path = folder.join(format!("prusa-{number}.gcode"));
    let mut command = Command::new("prusa-slicer");
    command.arg("--export-gcode").args(PRUSA[number]);
    command.args(["--scale-to-fit", "25,25,25", "--output"]);
    command.arg(&path).arg(ELLIPSOID);
    let install = "no prusa-slicer here; apt-get install --no-install-recommends prusa-slicer";
    runs(&mut command, install).then_some(path)
}

/// Shrinks a binary STL to a quarter, so that it slices in a second.
fn shrink(bytes: &[u8]) -> Vec<u8> {
    let mut small = bytes.to_vec();
    // 84 bytes of header, then twelve numbers and two bytes for each triangle.
    for triangle in small[84..].chunks_exact_mut(50) {
        for number in triangle[12..48].chunks_exact_mut(4) {
            let mm = f32::from_le_bytes(number.try_into().unwrap());
            number.copy_from_slice(&(0.25 * mm).to_le_bytes());
        }
    }
    small
}

/// Slices the shipped ellipsoid by CuraEngine; `None` if it or its definitions are not there.
fn slice_by_cura(folder: &Path, number: usize) -> Option<PathBuf> {
    let path = folder.join(format!("cura-{number}.gcode"));
    let tool = ["material_diameter=1.75", "infill_line_distance=3"];
    let model = folder.join("small.stl");
    fs::write(&model, shrink(&fs::read(ELLIPSOID).unwrap())).unwrap();
    let settings = [&["center_object=true"], CURA[number]].concat();
    run_cura(
        &settings,
        &[&tool[..], CURA[number]].concat(),
        &model,
        &path,
    )
    .then_some(path)
}

/// Slices a model by CuraEngine with settings of the machine and of its tool. Returns false if it
/// or its definitions are not there.
fn run_cura(machine: &[&str], tool: &[&str], model: &Path, out: &Path) -> bool {
    let Some(definitions) = common::cura_definitions() else {
        return false;
    };
    let extruders = definitions.with_file_name("extruders");
    let search = [definitions.clone(), extruders];
    let mut command = Command::new("CuraEngine");
    command.env(
        "CURA_ENGINE_SEARCH_PATH",
        std::env::join_paths(search).unwrap(),
    );
    command.arg("slice").arg("-j");
    command.arg(definitions.join("fdmprinter.def.json"));
    let usual = [
        "machine_width=300",
        "machine_depth=300",
        "machine_height=300",
        "layer_height=0.2",
        "machine_center_is_zero=true",
    ];
    for setting in usual.iter().chain(machine) {
        command.args(["-s", setting]);
    }
    command.arg("-e0");
    for setting in tool {
        command.args(["-s", setting]);
    }
    command.arg("-l").arg(model).arg("-o").arg(out);
    runs(
        &mut command,
        "no CuraEngine here; apt-get install cura-engine",
    )
}

/// A slicer in whose manner a text is written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Manner {
    Orca,
    OrcaAbsolute,
    Bambu,
    Cura,
}

/// Writes two objects of rounded walls and infill, with a skirt, a tower and retractions.
fn write_program(manner: Manner) -> String {
    let is_absolute = matches!(manner, Manner::OrcaAbsolute | Manner::Cura);
    let (mut text, mut e) = (String::new(), 0.0);
    text += match manner {
        Manner::Bambu => "; BambuStudio 01.09.07.52\n; FEATURE: Custom\n",
        Manner::Cura => {
            ";FLAVOR:Marlin\n;Layer height: 0.2\n;Generated with Cura_SteamEngine 5.2\n"
        }
        _ => "; generated by OrcaSlicer 2.1.1 on 2026-01-01\n;TYPE:Custom\n",
    };
    text += if is_absolute {
        "G90\nM82\n"
    } else {
        "G90\nM83\n"
    };
    let mut lay = |text: &mut String, command: &str, by: f64| {
        e += by;
        writeln!(text, "{command} E{:.5}", if is_absolute { e } else { by }).unwrap();
    };
    lay(&mut text, "G1 X90 Y3 F1000", 9.0);
    for layer in 0..12 {
        let z = 0.2 * f64::from(layer + 1);
        text += &match manner {
            Manner::Bambu => format!("; CHANGE_LAYER\n; Z_HEIGHT: {z:.3}\n; LAYER_HEIGHT: 0.2\n"),
            Manner::Cura => format!(";LAYER:{layer}\n"),
            _ => format!(";LAYER_CHANGE\n;Z:{z:.3}\n;HEIGHT:0.2\n"),
        };
        writeln!(text, "G1 Z{z:.3} F9000").unwrap();
        text += feature(manner, "Skirt");
        lay(&mut text, "G1 X5 Y5", 2.0);
        for (number, name) in ["left.stl", "right.stl"].into_iter().enumerate() {
            text += &begin(manner, number, name);
            let [x, y] = [40.0 + 50.0 * number as f64, 30.0 + f64::from(layer) * 0.37];
            writeln!(text, "G0 X{x:.3} Y{y:.3}").unwrap();
            text += feature(manner, "Outer wall");
            lay(&mut text, &format!("G1 X{:.3}", x + 20.0), 0.7);
            lay(
                &mut text,
                &format!("G3 X{:.3} Y{:.3} I0 J4", x + 24.0, y + 4.0),
                0.2,
            );
            lay(
                &mut text,
                &format!("G2 X{:.3} Y{:.3} R5.5", x + 30.0, y + 9.0),
                0.3,
            );
            text += feature(manner, "Sparse infill");
            for row in 0..8 {
                lay(
                    &mut text,
                    &format!(
                        "G1 X{:.3} Y{:.3}",
                        x + 3.3 * f64::from(row % 2),
                        y + f64::from(row)
                    ),
                    0.4,
                );
            }
            lay(&mut text, &format!("G1 X{:.3}", x + 2.0), -0.4);
            lay(&mut text, "G1", -0.4);
            text += &end(manner, number, name);
            lay(&mut text, "G1", 0.8);
        }
        text += feature(manner, "Prime tower");
        lay(&mut text, "G1 X150 Y150", 1.5);
    }
    text
}

/// Names the kind of what follows.
fn feature(manner: Manner, name: &str) -> &'static str {
    match (manner, name) {
        (Manner::Cura, "Skirt") => ";TYPE:SKIRT\n",
        (Manner::Cura, "Outer wall") => ";TYPE:WALL-OUTER\n",
        (Manner::Cura, "Sparse infill") => ";TYPE:FILL\n",
        (Manner::Cura, _) => ";TYPE:PRIME-TOWER\n",
        (Manner::Bambu, "Skirt") => "; FEATURE: Skirt\n",
        (Manner::Bambu, "Outer wall") => "; FEATURE: Outer wall\n",
        (Manner::Bambu, "Sparse infill") => "; FEATURE: Sparse infill\n",
        (Manner::Bambu, _) => "; FEATURE: Prime tower\n",
        (_, "Skirt") => ";TYPE:Skirt\n",
        (_, "Outer wall") => ";TYPE:Outer wall\n",
        (_, "Sparse infill") => ";TYPE:Sparse infill\n",
        _ => ";TYPE:Prime tower\n",
    }
}

fn begin(manner: Manner, number: usize, name: &str) -> String {
    match manner {
        Manner::Bambu => format!(
            "; start printing object, unique label id: {}\n",
            15 + number
        ),
        Manner::Cura => format!(";MESH:{name}\n"),
        Manner::OrcaAbsolute => format!("M486 S{number}\nM486 A{name}\n"),
        Manner::Orca => format!(
            "; printing object {name} id:{number} copy 0\nEXCLUDE_OBJECT_START NAME={name}\n"
        ),
    }
}

fn end(manner: Manner, number: usize, name: &str) -> String {
    match manner {
        Manner::Bambu => format!("; stop printing object, unique label id: {}\n", 15 + number),
        Manner::Cura => ";MESH:NONMESH\n".to_owned(),
        Manner::OrcaAbsolute => "M486 S-1\n".to_owned(),
        Manner::Orca => format!(
            "EXCLUDE_OBJECT_END NAME={name}\n; stop printing object {name} id:{number} copy 0\n"
        ),
    }
}

#[test]
fn texts_in_the_manner_of_every_slicer_weigh_what_the_judge_finds() {
    let folder = tempfile::tempdir().unwrap();
    let mut volumes_mm3 = Vec::new();
    for manner in [
        Manner::Orca,
        Manner::OrcaAbsolute,
        Manner::Bambu,
        Manner::Cura,
    ] {
        let path = folder.path().join(format!("{manner:?}.gcode"));
        fs::write(&path, write_program(manner)).unwrap();
        let toolpath = read(&path);
        let named = toolpath
            .objects
            .iter()
            .filter(|object| object.label.is_some());
        assert_eq!(named.count(), 2, "{manner:?}");
        volumes_mm3.push(toolpath.part_moments().volume());
        if let Some(python) = find_python() {
            assert_agreed(&python, &path);
        }
    }
    let are_equal = volumes_mm3
        .iter()
        .all(|mm3| (mm3 / volumes_mm3[0] - 1.0).abs() < 1e-12);
    assert!(are_equal, "{volumes_mm3:?}");
}

#[test]
fn files_of_prusaslicer_weigh_what_the_judge_finds() {
    let folder = tempfile::tempdir().unwrap();
    let Some(python) = find_python() else {
        return;
    };
    for number in 0..PRUSA.len() {
        let Some(path) = slice_by_prusa(folder.path(), number) else {
            return;
        };
        assert_agreed(&python, &path);
        let facts = read(&path).facts;
        assert!(
            facts.print_time_s.is_some() && facts.layer_height_mm.is_some(),
            "{facts:?}"
        );
        let used_mm3: f64 = facts.filament_used_mm3.iter().sum();
        assert!(used_mm3 > 0.0, "{facts:?}");
    }
}

#[test]
fn files_of_cura_weigh_what_the_judge_finds() {
    let folder = tempfile::tempdir().unwrap();
    let Some(python) = find_python() else {
        return;
    };
    for number in 0..CURA.len() {
        let Some(path) = slice_by_cura(folder.path(), number) else {
            return;
        };
        assert_agreed(&python, &path);
        assert!(read(&path).facts.print_time_s.is_some());
    }
}

/// Lines of 0.4 mm without skins, which fill a body: the engine works out no setting from others.
const SOLID_CURA: [&str; 9] = [
    "layer_height_0=0.2",
    "adhesion_type=skirt",
    "relative_extrusion=true",
    "infill_pattern=lines",
    "infill_line_distance=0.4",
    "infill_overlap_mm=0.04",
    "top_layers=0",
    "bottom_layers=0",
    "initial_bottom_layers=0",
];

#[test]
fn toolpaths_of_cura_have_their_centre_where_the_solid_has_it() {
    const SIDE_MM: f64 = 40.0;
    const FOOT_MM: f64 = 0.4;
    let folder = tempfile::tempdir().unwrap();
    let ball = primitives::ball(&Point::new(3.0, -2.0, 20.0), 20.0, 5);
    let cuboid = primitives::cuboid(&Point::new(1.0, 2.0, 0.0), &Point::new(21.0, 32.0, 40.0));
    let mut solids = vec![("ball", ball), ("cuboid", cuboid)];
    if let Some(file) = common::shared_model("bunny.stl") {
        let bunny = read_model(&file).unwrap();
        let small = scaled(&bunny, SIDE_MM / bunny.longest_side_mm());
        // Of a bunny on its toes, the engine leaves out the empty first layer, and lays all others
        // lower by it. This one stands on a flat foot.
        let low = small.aabb().min + Vector::new(0.0, 0.0, FOOT_MM);
        let foot = Plane::through(&low, &Vector::z());
        let (bunny, _) = Csg::of_mesh(&weld(&small))
            .unwrap()
            .split_by_plane(&foot)
            .unwrap();
        let bunny = bunny.to_mesh().unwrap();
        solids.push(("bunny", bunny.map_vertices(|p| p - low.coords)));
    }
    for (name, mesh) in solids {
        let [model, path] =
            ["stl", "gcode"].map(|end| folder.path().join(name).with_extension(end));
        stl::write(&model, &mesh, name).unwrap();
        let tool = [&SOLID_CURA[..], &["material_diameter=1.75"]].concat();
        if !run_cura(&SOLID_CURA, &tool, &model, &path) {
            return;
        }
        let [laid, solid] = [read(&path).part_moments(), moments_of_mesh(&mesh)];
        let miss_mm = (laid.centroid() - solid.centroid()).norm();
        let heavier_ratio = laid.volume() / solid.volume() - 1.0;
        eprintln!("{name}: centre {miss_mm:.4} mm off, volume {heavier_ratio:+.4}");
        assert!(miss_mm < 0.03, "{name}: {miss_mm}");
        assert!(heavier_ratio.abs() < 0.02, "{name}: {heavier_ratio}");
    }
}

#[test]
fn the_judge_finds_a_false_claim() {
    let Some(python) = find_python() else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.gcode");
    fs::write(&path, write_program(Manner::Orca)).unwrap();
    judge(&python, &path);
    let claimed = path.with_extension("json");
    let mut claim: Value = serde_json::from_slice(&fs::read(&claimed).unwrap()).unwrap();
    let first = claim["objects"][1]["moments"][1].as_f64().unwrap();
    claim["objects"][1]["moments"][1] = json!(first * (1.0 + 1e-5));
    fs::write(&claimed, claim.to_string()).unwrap();
    let output = Command::new(&python)
        .arg(JUDGE)
        .args([&path, &claimed])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", printed(&output));
    assert!(
        printed(&output).contains("FAIL left.stl (0): centre"),
        "{}",
        printed(&output)
    );
}
