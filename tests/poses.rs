//! The poses of filament parts need as little support as the best of 26 others, by a slicer that is
//! not ours.
//!
//! Make kits for a printer of filament, name them, and run the ignored test. A part is sliced 27
//! times, each in five seconds or more:
//! ```sh
//! export EQUIPOISE_KITS=homer-kit:bunny-kit
//! cargo test --release --test kits poses -- --ignored --nocapture
//! ```
//! It slices with an MK4-like profile, `tests/printers/mk4-like.ini`, and with the support settings
//! that the packages of a kit carry.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stdout, reason = "the grams are shown with --nocapture")]

use std::fs;
use std::path::Path;
use std::process::Command;

use equipoise::geom::{Matrix, Point, Vector, orthonormal_basis};
use equipoise::io::{decode_model, stl};
use equipoise::mesh::TriMesh;
use equipoise::poses::{Columns, Peg, Shape, Side, Support, SupportRule};
use serde_json::Value;

/// Most support of a part over that of the best of 26 poses.
const LIMIT_RATIO: f64 = 1.1;
/// Mass below which a difference is a strand or two, g.
const STRAND_G: f64 = 0.05;
/// Least area of a first layer, mm²: a slicer refuses a part that begins with less than a line.
const FOOT_MM2: f64 = 1.0;
/// Area of a section of filament, mm², and its density, g/mm³.
const FILAMENT_MM2: f64 = std::f64::consts::PI * 1.75 * 1.75 / 4.0;
const DENSITY_G_MM3: f64 = 1.24e-3;
/// The rule by which the slicer supports, as in the profile.
const RULE: SupportRule = SupportRule {
    overhang_deg: 45.0,
    layer_mm: 0.2,
};

/// A part in the model frame.
struct Part {
    id: String,
    mesh: TriMesh,
    up: Vector,
    pegs: Vec<Peg>,
}

fn vector(value: &Value) -> Vector {
    Vector::from([0, 1, 2].map(|i| value[i].as_f64().unwrap()))
}

/// Reads the parts of a kit.
fn parts(kit: &Path) -> Vec<Part> {
    let sheet = fs::read(kit.join("checklist.json")).unwrap();
    let sheet: Value = serde_json::from_slice(&sheet).unwrap();
    let part = |row: &Value| {
        let rows = &row["print_from_model"];
        let turn = Matrix::from_fn(|i, j| rows[i][j].as_f64().unwrap());
        let shift = Vector::from([0, 1, 2].map(|i| rows[i][3].as_f64().unwrap()));
        let file = fs::read(kit.join(row["file"].as_str().unwrap())).unwrap();
        let printed = decode_model(&file).unwrap();
        let peg = |pin: &Value| Peg {
            center: Point::from(vector(&pin["center_mm"])),
            axis: vector(&pin["axis"]),
            length_mm: pin["length_mm"].as_f64().unwrap(),
            diameter_mm: pin["diameter_mm"].as_f64().unwrap(),
        };
        Part {
            id: row["id"].as_str().unwrap().to_owned(),
            mesh: printed.map_vertices(|p| Point::from(turn.transpose() * (p.coords - shift))),
            up: turn.transpose() * Vector::z(),
            pegs: row["pins"].as_array().unwrap().iter().map(peg).collect(),
        }
    };
    sheet["parts"]
        .as_array()
        .unwrap()
        .iter()
        .map(part)
        .collect()
}

/// Returns the 26 directions toward the faces, edges and corners of a cube.
fn directions() -> Vec<Vector> {
    let steps = [-1.0, 0.0, 1.0];
    let all = steps.into_iter().flat_map(|x| {
        let of_x = steps.into_iter();
        of_x.flat_map(move |y| steps.into_iter().map(move |z| Vector::new(x, y, z)))
    });
    all.filter_map(|direction| direction.try_normalize(0.0))
        .collect()
}

/// Slices a part with `up` pointing up; returns the mass of its support, g, or `None` if the slicer
/// refuses the pose.
fn support_g(mesh: &TriMesh, up: &Vector) -> Option<f64> {
    let folder = tempfile::tempdir().unwrap();
    let (part, code) = (
        folder.path().join("part.stl"),
        folder.path().join("part.gcode"),
    );
    let (u, v) = orthonormal_basis(up);
    let turn = Matrix::from_rows(&[u.transpose(), v.transpose(), up.transpose()]);
    fs::write(&part, stl::encode(&mesh.map_vertices(|p| turn * p), "part")).unwrap();
    let profile = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/printers/mk4-like.ini");
    let slicer = Command::new("prusa-slicer")
        .args(["--export-gcode", "--center", "125,105", "--load"])
        .arg(profile)
        .args(["--fill-density", "0%", "--top-solid-layers", "0"])
        .args(["--bottom-solid-layers", "0", "-o"])
        .arg(&code)
        .arg(&part)
        .output()
        .unwrap();
    let text = fs::read_to_string(&code).ok();
    text.map(|text| support_in(&text)).or_else(|| {
        println!("  refused: {}", String::from_utf8_lossy(&slicer.stderr));
        None
    })
}

/// Returns the mass of the support in a file with absolute extrusion, g.
fn support_in(code: &str) -> f64 {
    let (mut is_support, mut last_mm, mut support_mm) = (false, 0.0, 0.0);
    for line in code.lines() {
        if let Some(kind) = line.strip_prefix(";TYPE:") {
            is_support = kind.starts_with("Support");
        }
        let word = line
            .split(';')
            .next()
            .unwrap_or_default()
            .split_whitespace();
        let extruder = word.filter_map(|word| word.strip_prefix('E')).next();
        if let Some(end_mm) = extruder.and_then(|end| end.parse::<f64>().ok()) {
            let is_move = line.starts_with("G1 ");
            support_mm += if is_support && is_move {
                end_mm - last_mm
            } else {
                0.0
            };
            last_mm = end_mm;
        }
    }
    support_mm * FILAMENT_MM2 * DENSITY_G_MM3
}

/// Returns whether a pose keeps the rules: a foot that holds, and no pin below the part.
fn keeps_rules(shape: &Shape, up: &Vector) -> bool {
    let found = Support::of(shape, &Columns::of(shape, up, 0.5), up, &RULE);
    found.foot_mm2 >= FOOT_MM2 && !shape.rests_on_peg(up, RULE.layer_mm)
}

#[test]
#[ignore = "needs kits and prusa-slicer, and takes minutes"]
fn no_part_needs_a_tenth_more_support_than_in_the_best_of_26_poses() {
    let kits = std::env::var("EQUIPOISE_KITS").unwrap();
    let mut worse = Vec::new();
    for kit in kits.split(':') {
        for part in parts(Path::new(kit)) {
            let shape = Shape::new(&part.mesh, part.pegs.clone(), |_| Side::Outside);
            let columns = Columns::of(&shape, &part.up, 0.5);
            let estimate = Support::of(&shape, &columns, &part.up, &RULE).material_mm3();
            let posed_g = support_g(&part.mesh, &part.up).unwrap();
            let others = directions()
                .into_iter()
                .filter(|up| keeps_rules(&shape, up));
            let others = others.filter_map(|up| support_g(&part.mesh, &up));
            let best_g = others.fold(f64::INFINITY, f64::min);
            println!(
                "{kit} {}: {posed_g:.2} g of support, {:.2} g by our estimate, best of 26 {best_g:.2} g",
                part.id,
                estimate * DENSITY_G_MM3
            );
            if posed_g > LIMIT_RATIO * best_g + STRAND_G {
                worse.push(part.id);
            }
        }
    }
    assert!(worse.is_empty(), "{worse:?}");
}
