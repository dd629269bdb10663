//! `verify` tells how the files of a kit differ from those that were made: saved again, changed,
//! scaled, mirrored, exchanged, replaced or missing.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use common::{checklist, copy, list, make_kit, number, verify};
use equipoise::geom::{Frame, Matrix, Point, Vector};
use equipoise::io::{decode_model, stl};
use equipoise::mesh::primitives::cylinder;
use equipoise::mesh::{Csg, TriMesh};
use equipoise::repair::weld;
use serde_json::Value;

/// A kit of the shipped model in two parts with pins. It is made once and never changed.
fn made() -> &'static Path {
    static MADE: OnceLock<PathBuf> = OnceLock::new();
    MADE.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        make_kit(&kit, "--goal top --up z --wall 1.5mm");
        kit
    })
}

/// A copy of the kit that a test may change.
struct Kit {
    _room: tempfile::TempDir,
    folder: PathBuf,
    parts: Vec<Value>,
}

impl Kit {
    fn new() -> Self {
        let room = tempfile::tempdir().unwrap();
        let folder = room.path().join("kit");
        copy(made(), &folder);
        let parts = list(&checklist(&folder), "parts").to_vec();
        Self {
            _room: room,
            folder,
            parts,
        }
    }

    fn file(&self, part: usize) -> &str {
        self.parts[part]["file"].as_str().unwrap()
    }

    fn mesh(&self, part: usize) -> TriMesh {
        decode_model(&fs::read(self.folder.join(self.file(part))).unwrap()).unwrap()
    }

    fn write(&self, part: usize, mesh: &TriMesh) {
        let bytes = stl::encode(mesh, "edited");
        fs::write(self.folder.join(self.file(part)), bytes).unwrap();
    }

    /// Asserts that the kit fails with these words.
    fn assert_fails(&self, words: &str) {
        let (code, said) = verify(&self.folder);
        assert_eq!(code, Some(1), "{said}");
        assert!(said.contains(words), "{words:?} is missing in\n{said}");
    }

    /// Asserts that the kit fails with these words about the file of a part.
    fn assert_blames(&self, part: usize, words: &str) {
        self.assert_fails(&format!("{} {words}", self.file(part)));
    }
}

/// Maps a mesh by a matrix and keeps it turned outward.
fn transform(mesh: &TriMesh, matrix: Matrix) -> TriMesh {
    let moved = mesh.map_vertices(|p| Point::from(matrix * p.coords));
    if matrix.determinant() < 0.0 {
        moved.reversed()
    } else {
        moved
    }
}

#[test]
fn an_untouched_kit_passes_and_its_3mf_files_are_judged() {
    let (code, said) = verify(&Kit::new().folder);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("every 3MF file holds the parts"), "{said}");
}

#[test]
fn a_scaled_part_is_reported_with_its_scale() {
    let kit = Kit::new();
    kit.write(0, &transform(&kit.mesh(0), Matrix::identity() * 1.02));
    kit.assert_blames(0, "was scaled to 102.000 % of its size");
}

/// Everything that follows from the cause takes one line, and no intact file is blamed.
#[test]
fn the_cause_comes_first_with_its_remedy() {
    let kit = Kit::new();
    kit.write(0, &transform(&kit.mesh(0), Matrix::identity() * 1.02));
    let (_, said) = verify(&kit.folder);
    let lines: Vec<&str> = said.lines().collect();
    assert!(lines[0].starts_with("FAIL parts/"), "{said}");
    assert!(lines[1].starts_with("  remedy: "), "{said}");
    assert_eq!(said.matches("FAIL").count(), 1, "{said}");
    assert!(!said.contains("3MF files"), "{said}");
}

#[test]
fn a_mirrored_part_is_reported() {
    let kit = Kit::new();
    let mirror = Matrix::from_diagonal(&Vector::new(-1.0, 1.0, 1.0));
    kit.write(1, &transform(&kit.mesh(1), mirror));
    kit.assert_blames(1, "was mirrored");
}

#[test]
fn exchanged_files_are_reported_with_the_parts_that_they_hold() {
    let kit = Kit::new();
    let [first, second] = [kit.mesh(0), kit.mesh(1)];
    kit.write(0, &second);
    kit.write(1, &first);
    kit.assert_blames(0, "was exchanged: it holds part P02");
    kit.assert_blames(1, "was exchanged: it holds part P01");
}

#[test]
fn a_part_that_lost_its_pin_is_reported_with_the_pin() {
    let kit = Kit::new();
    let pin_of = |part: &Value| list(part, "pins").first().cloned();
    let mut pins = kit.parts.iter().map(pin_of).enumerate();
    let (part, pin) = pins.find_map(|(part, pin)| Some((part, pin?))).unwrap();
    let around = pin_in_print(&kit.parts[part], &pin);
    let body = Csg::of_mesh(&weld(&kit.mesh(part))).unwrap();
    let without = body.subtract(&Csg::of_mesh(&around).unwrap()).unwrap();
    kit.write(part, &without.to_mesh().unwrap());
    let id = pin["id"].as_str().unwrap();
    kit.assert_blames(part, &format!("has another shape: it lacks the pins {id}"));
}

/// The pin of a part and a little around it, as the part's file has it.
fn pin_in_print(part: &Value, pin: &Value) -> TriMesh {
    let vector = |key: &str| Vector::from([0, 1, 2].map(|i| pin[key][i].as_f64().unwrap()));
    let [diameter_mm, length_mm] = ["/diameter_mm", "/length_mm"].map(|key| number(pin, key));
    let rows = &part["print_from_model"];
    let cell = |row: usize, column: usize| rows[row][column].as_f64().unwrap();
    let turn = Matrix::from_fn(cell);
    let base = turn * vector("center_mm") + Vector::from_fn(|row, _| cell(row, 3));
    let frame = Frame::with_axis(Point::from(base), &(turn * vector("axis")));
    cylinder(diameter_mm, 2.0 * length_mm, 48).map_vertices(|p| frame.to_model(p))
}

#[test]
fn a_changed_byte_in_a_part_is_reported_by_what_it_changes() {
    let kit = Kit::new();
    let path = kit.folder.join(kit.file(0));
    let whole = fs::read(&path).unwrap();
    // The first byte is in the header and changes no triangle. The second moves a corner.
    for (at, words) in [
        (70, "was saved again: other bytes, the same triangles"),
        (84 + 12 + 1, "was changed a little"),
    ] {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x10;
        fs::write(&path, bytes).unwrap();
        kit.assert_blames(0, words);
    }
}

#[test]
fn a_changed_job_is_reported() {
    let kit = Kit::new();
    let job = kit.folder.join("job.toml");
    fs::write(&job, fs::read_to_string(&job).unwrap() + "\n").unwrap();
    kit.assert_fails("job.toml was changed: it has other bytes");
}

/// The text of an STL file with these triangles.
fn stl_text(mesh: &TriMesh) -> String {
    let corner = |p: Point| {
        let [x, y, z] = [p.x, p.y, p.z].map(|x| x as f32);
        format!("vertex {x:e} {y:e} {z:e}\n")
    };
    let facet = |corners: [Point; 3]| {
        let loop_ = corners.map(corner).concat();
        format!("facet normal 0 0 0\nouter loop\n{loop_}endloop\nendfacet\n")
    };
    let facets: String = mesh.iter_corners().map(facet).collect();
    format!("solid saved\n{facets}endsolid saved\n")
}

#[test]
fn a_part_saved_again_as_text_keeps_its_promises() {
    let kit = Kit::new();
    let text = stl_text(&kit.mesh(0));
    fs::write(kit.folder.join(kit.file(0)), text).unwrap();
    kit.assert_blames(0, "was saved again: other bytes, the same triangles");
    let (_, said) = verify(&kit.folder);
    assert_eq!(said.matches("FAIL").count(), 1, "{said}");
    assert!(said.contains("promises kept, 1 BROKEN"), "{said}");
}

#[test]
fn a_moved_part_is_reported_with_the_distance() {
    let kit = Kit::new();
    let moved = kit.mesh(0).map_vertices(|p| p + Vector::new(3.0, 4.0, 0.0));
    kit.write(0, &moved);
    kit.assert_blames(0, "was moved by 5.000 mm");
}

#[test]
fn a_missing_file_is_reported() {
    let kit = Kit::new();
    fs::remove_file(kit.folder.join("assembly.3mf")).unwrap();
    kit.assert_fails("assembly.3mf is missing");
    fs::remove_file(kit.folder.join(kit.file(1))).unwrap();
    kit.assert_fails(kit.file(1));
    kit.assert_fails("remedy: copy it again");
}

#[test]
fn a_file_without_a_mesh_is_reported() {
    let kit = Kit::new();
    fs::write(kit.folder.join(kit.file(1)), "no mesh").unwrap();
    kit.assert_blames(1, "holds no mesh");
}

#[test]
fn a_kit_without_its_checklist_is_damaged_and_a_folder_without_its_list_too_is_no_kit() {
    let kit = Kit::new();
    fs::remove_file(kit.folder.join("checklist.json")).unwrap();
    kit.assert_fails("checklist.json is missing");
    fs::remove_file(kit.folder.join("SHA256SUMS")).unwrap();
    assert_eq!(verify(&kit.folder).0, Some(2));
}

#[test]
fn a_dent_of_a_hundredth_of_a_millimetre_is_named_with_its_place() {
    let kit = Kit::new();
    let mesh = kit.mesh(0);
    let highest = mesh.vertices().iter().map(|p| p.x).fold(0.0, f64::max);
    let dented = mesh.map_vertices(|p| {
        if p.x == highest {
            p - Vector::x() * 0.01
        } else {
            *p
        }
    });
    kit.write(0, &dented);
    kit.assert_fails("part surfaces");
}

#[test]
fn a_strange_part_in_the_folder_is_reported() {
    let kit = Kit::new();
    fs::copy(
        kit.folder.join(kit.file(0)),
        kit.folder.join("parts/P03.stl"),
    )
    .unwrap();
    kit.assert_fails("parts/P03.stl does not belong to the kit");
}

impl Kit {
    /// Verifies the kit with some words of a file replaced, and then puts the file back.
    fn verify_replaced(&self, file: &str, [from, to]: [&str; 2]) -> (Option<i32>, String) {
        let path = self.folder.join(file);
        let whole = fs::read_to_string(&path).unwrap();
        assert!(whole.contains(from), "{file} has no {from}");
        fs::write(&path, whole.replacen(from, to, 1)).unwrap();
        let verified = verify(&self.folder);
        fs::write(&path, whole).unwrap();
        verified
    }
}

#[test]
fn a_false_number_on_the_checklist_is_reported_with_the_true_one() {
    let kit = Kit::new();
    for key in ["mass_g", "volume_mm3"] {
        let stated = &kit.parts[1][key];
        let lie = [stated.to_string(), "29.5".into()].map(|value| format!("\"{key}\": {value}"));
        let (code, said) =
            kit.verify_replaced("checklist.json", lie.each_ref().map(String::as_str));
        assert_eq!(code, Some(1), "{said}");
        let words = format!("parts[P02].{key} states 29.5, the files have ");
        let (_, rest) = said
            .split_once(&words)
            .unwrap_or_else(|| panic!("{words:?}: {said}"));
        let found: f64 = rest
            .split([')', ',', '\n'])
            .next()
            .unwrap()
            .parse()
            .unwrap();
        // The last digit depends on the order of the sums.
        let stated = stated.as_f64().unwrap();
        assert!((found - stated).abs() < 1e-12 * stated, "{found} {stated}");
    }
    assert_eq!(verify(&kit.folder).0, Some(0));
}

#[test]
fn a_changed_word_on_the_sheet_is_reported() {
    let kit = Kit::new();
    let (code, said) = kit.verify_replaced("job.html", ["rpm", "rpn"]);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("job.html was changed"), "{said}");
}

#[test]
fn packages_with_other_parts_are_reported() {
    let kit = Kit::new();
    let [first, second] = [0, 1].map(|part| kit.folder.join(kit.file(part)).with_extension("3mf"));
    fs::copy(&first, &second).unwrap();
    let [plate, assembly] = ["plate.3mf", "assembly.3mf"].map(|file| kit.folder.join(file));
    fs::copy(&plate, &assembly).unwrap();
    kit.assert_fails("holds P02 0 times");
    kit.assert_fails(
        "assembly.3mf: P01 differs from the part in its own file, or is not in its place",
    );
}

#[test]
fn a_bound_that_a_hollowing_beats_is_reported() {
    let kit = Kit::new();
    let bound = |figure: f64| format!("\"bound\": {figure}");
    let proof = &checklist(&kit.folder)["certificate"]["proof"];
    let stated = proof["bound"].as_f64().unwrap();
    let (_, said) = verify(&kit.folder);
    assert!(
        said.contains("the best of all hollowings with its wall"),
        "{said}"
    );
    // A top is better the slower it spins: a bound of 3 % more can be beaten.
    let text = fs::read_to_string(kit.folder.join("checklist.json")).unwrap();
    let (before, after) = text.split_once("\"proof\"").unwrap();
    let lie = after.replacen(&bound(stated), &bound(1.03 * stated), 1);
    assert_ne!(lie, after);
    fs::write(
        kit.folder.join("checklist.json"),
        format!("{before}\"proof\"{lie}"),
    )
    .unwrap();
    let (code, said) = verify(&kit.folder);
    let line = said
        .lines()
        .find(|line| line.contains("the best of all hollowings"));
    assert_eq!(code, Some(1), "{said}");
    assert!(line.is_some_and(|line| line.contains("FAIL")), "{said}");
}
