//! `verify` tells what became of a kit's files: saved again, changed, scaled, mirrored, exchanged,
//! replaced, missing.

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use equipoise::geom::{Matrix, Point, Vector};
use equipoise::io::{decode_model, stl};
use equipoise::mesh::primitives::cylinder;
use equipoise::mesh::{Csg, TriMesh};
use equipoise::repair::weld;
use serde_json::Value;

/// A kit of the shipped model in two parts with pins, made once; the folder lives as long as the
/// tests.
fn made() -> &'static Path {
    static MADE: OnceLock<PathBuf> = OnceLock::new();
    MADE.get_or_init(|| {
        let kit = tempfile::tempdir().unwrap().keep().join("kit");
        let (code, _) = common::prepared(&kit, "1.5mm", &["--goal", "top"]);
        assert_eq!(code, Some(0));
        kit
    })
}

/// A kit of one's own, and the files of its parts.
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
        let sheet: Value =
            serde_json::from_slice(&fs::read(folder.join("checklist.json")).unwrap()).unwrap();
        Self {
            _room: room,
            folder,
            parts: sheet["parts"].as_array().unwrap().clone(),
        }
    }

    fn file(&self, part: usize) -> &str {
        self.parts[part]["file"].as_str().unwrap()
    }

    fn mesh(&self, part: usize) -> TriMesh {
        decode_model(&fs::read(self.folder.join(self.file(part))).unwrap()).unwrap()
    }

    fn write(&self, part: usize, mesh: &TriMesh) {
        fs::write(
            self.folder.join(self.file(part)),
            stl::encode(mesh, "edited"),
        )
        .unwrap();
    }

    /// The exit code of `verify`, and what it prints.
    fn verified(&self) -> (Option<i32>, String) {
        let output = common::equipoise(&["verify", self.folder.to_str().unwrap()]);
        let said = [output.stdout, output.stderr].concat();
        (
            output.status.code(),
            String::from_utf8_lossy(&said).into_owned(),
        )
    }

    /// Asserts that the kit is refused with these words about the part's file.
    fn must_tell(&self, part: usize, words: &str) {
        let (code, said) = self.verified();
        assert_eq!(code, Some(1), "{said}");
        let told = format!("{} {words}", self.file(part));
        assert!(said.contains(&told), "{told:?} is not told in\n{said}");
    }
}

fn copy(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let target = to.join(entry.file_name());
        if entry.path().is_dir() {
            copy(&entry.path(), &target);
        } else {
            fs::copy(entry.path(), target).unwrap();
        }
    }
}

fn mapped(mesh: &TriMesh, linear: Matrix) -> TriMesh {
    let moved = mesh.map_vertices(|p| Point::from(linear * p.coords));
    if linear.determinant() < 0.0 {
        moved.reversed()
    } else {
        moved
    }
}

#[test]
fn an_untouched_kit_passes_and_its_3mf_files_are_judged() {
    let (code, said) = Kit::new().verified();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("every 3MF file holds the parts"), "{said}");
}

#[test]
fn a_scaled_part_is_told_with_its_scale() {
    let kit = Kit::new();
    kit.write(0, &mapped(&kit.mesh(0), Matrix::identity() * 1.02));
    kit.must_tell(0, "was scaled to 102.000 % of its size");
    let (_, said) = kit.verified();
    // The cause stands first, with its remedy; what follows from it is one line, and no intact file
    // is blamed.
    let lines: Vec<&str> = said.lines().collect();
    assert!(
        lines[0].starts_with("FAIL parts/") && lines[1].starts_with("  remedy: "),
        "{said}"
    );
    assert!(
        said.matches("FAIL").count() == 1 && !said.contains("3MF files"),
        "{said}"
    );
}

#[test]
fn a_mirrored_part_is_told() {
    let kit = Kit::new();
    kit.write(
        1,
        &mapped(
            &kit.mesh(1),
            Matrix::from_diagonal(&Vector::new(-1.0, 1.0, 1.0)),
        ),
    );
    kit.must_tell(1, "was mirrored");
}

#[test]
fn a_swapped_pair_is_told_by_the_parts_that_the_files_hold() {
    let kit = Kit::new();
    let [first, second] = [kit.mesh(0), kit.mesh(1)];
    kit.write(0, &second);
    kit.write(1, &first);
    kit.must_tell(0, "was exchanged: it holds part P02");
    kit.must_tell(1, "was exchanged: it holds part P01");
}

#[test]
fn a_part_replaced_by_one_without_its_pin_is_told_with_the_pin() {
    let kit = Kit::new();
    let (index, pin) = kit
        .parts
        .iter()
        .enumerate()
        .find_map(|(index, part)| Some((index, part["pins"].as_array()?.first()?.clone())))
        .unwrap();
    let vector = |key: &str| Vector::from([0, 1, 2].map(|i| pin[key][i].as_f64().unwrap()));
    let [diameter, length] = ["/diameter_mm", "/length_mm"].map(|key| common::number(&pin, key));
    let rows = &kit.parts[index]["print_from_model"];
    let cell = |row: usize, column: usize| rows[row][column].as_f64().unwrap();
    let turn = Matrix::from_fn(cell);
    let base = turn * vector("center_mm") + Vector::from_fn(|row, _| cell(row, 3));
    let axis = turn * vector("axis");
    // What stands out of the cut face about the pin, and a little around it, is cut away.
    let frame = equipoise::geom::Frame::with_axis(Point::from(base), &axis);
    let around = cylinder(diameter, 2.0 * length, 48).map_vertices(|p| frame.to_model(p));
    let body = Csg::of_mesh(&weld(&kit.mesh(index))).unwrap();
    let without = body
        .subtract(&Csg::of_mesh(&around).unwrap())
        .unwrap()
        .to_mesh()
        .unwrap();
    kit.write(index, &without);
    kit.must_tell(
        index,
        &format!(
            "has another shape: it lacks the pins {}",
            pin["id"].as_str().unwrap()
        ),
    );
}

#[test]
fn a_changed_byte_is_told_and_a_corner_moved_by_it_too() {
    let kit = Kit::new();
    let path = kit.folder.join(kit.file(0));
    let whole = fs::read(&path).unwrap();
    // A byte of the header changes no triangle; the highest byte of a coordinate's fraction moves a
    // corner.
    for (at, words) in [
        (70, "was saved again: other bytes, the same triangles"),
        (84 + 12 + 1, "was changed a little"),
    ] {
        let mut bytes = whole.clone();
        bytes[at] ^= 0x10;
        fs::write(&path, bytes).unwrap();
        kit.must_tell(0, words);
    }
    fs::write(&path, &whole).unwrap();
    let job = kit.folder.join("job.toml");
    fs::write(&job, fs::read_to_string(&job).unwrap() + "\n").unwrap();
    let (code, said) = kit.verified();
    assert!(
        code == Some(1) && said.contains("job.toml was changed: it has other bytes"),
        "{said}"
    );
}

#[test]
fn a_part_saved_again_as_text_is_told_apart_from_a_changed_one_and_keeps_its_promises() {
    let kit = Kit::new();
    let corner = |p: Point| {
        format!(
            "vertex {:e} {:e} {:e}\n",
            p.x as f32, p.y as f32, p.z as f32
        )
    };
    let facet = |corners: [Point; 3]| {
        format!(
            "facet normal 0 0 0\nouter loop\n{}endloop\nendfacet\n",
            corners.map(corner).concat()
        )
    };
    let facets: String = kit.mesh(0).iter_corners().map(facet).collect();
    fs::write(
        kit.folder.join(kit.file(0)),
        format!("solid saved\n{facets}endsolid saved\n"),
    )
    .unwrap();
    kit.must_tell(0, "was saved again: other bytes, the same triangles");
    let (_, said) = kit.verified();
    assert_eq!(said.matches("FAIL").count(), 1, "{said}");
    assert!(said.contains("promises kept, 1 BROKEN"), "{said}");
}

#[test]
fn a_moved_part_is_told_with_the_way_it_went() {
    let kit = Kit::new();
    kit.write(
        0,
        &kit.mesh(0).map_vertices(|p| p + Vector::new(3.0, 4.0, 0.0)),
    );
    kit.must_tell(0, "was moved by 5.000 mm");
}

#[test]
fn a_missing_file_breaks_a_promise_whatever_it_is_and_no_kit_is_another_thing() {
    let kit = Kit::new();
    fs::remove_file(kit.folder.join("assembly.3mf")).unwrap();
    let (code, said) = kit.verified();
    assert!(
        code == Some(1) && said.contains("assembly.3mf is missing"),
        "{said}"
    );
    fs::remove_file(kit.folder.join(kit.file(1))).unwrap();
    let (code, said) = kit.verified();
    assert!(
        code == Some(1) && said.contains(kit.file(1)) && said.contains("remedy: copy it again"),
        "{said}"
    );
    fs::write(kit.folder.join(kit.file(1)), "no mesh").unwrap();
    let (code, said) = kit.verified();
    assert!(
        code == Some(1) && said.contains(&format!("{} holds no mesh", kit.file(1))),
        "{said}"
    );
    fs::remove_file(kit.folder.join("checklist.json")).unwrap();
    assert_eq!(kit.verified().0, Some(2));
}

#[test]
fn a_changed_number_of_the_checklist_and_a_changed_word_of_the_sheet_are_told() {
    let kit = Kit::new();
    let replaced = |file: &str, from: &str, to: &str| {
        let path = kit.folder.join(file);
        let whole = fs::read_to_string(&path).unwrap();
        assert!(whole.contains(from), "{file} has no {from}");
        fs::write(&path, whole.replacen(from, to, 1)).unwrap();
        let told = kit.verified();
        fs::write(&path, whole).unwrap();
        told
    };
    for key in ["mass_g", "volume_mm3"] {
        let stated = &kit.parts[1][key];
        let (code, said) = replaced(
            "checklist.json",
            &format!("\"{key}\": {stated}"),
            &format!("\"{key}\": 29.5"),
        );
        let words = format!("parts[P02].{key} states 29.5, the files have ");
        let found = said
            .split_once(&words)
            .map(|(_, rest)| rest.split([')', ',', '\n']).next().unwrap());
        let found: f64 = found
            .unwrap_or_else(|| panic!("{words:?} is not told in {said}"))
            .parse()
            .unwrap();
        // The last digit depends on how the sums were taken.
        let stated = stated.as_f64().unwrap();
        assert!(
            code == Some(1) && (found - stated).abs() < 1e-12 * stated,
            "{found} {stated}"
        );
    }
    let (code, said) = replaced("checklist.html", "rpm", "rpn");
    assert!(
        code == Some(1) && said.contains("checklist.html was changed"),
        "{said}"
    );
    assert_eq!(kit.verified().0, Some(0));
}

#[test]
fn a_package_that_holds_other_parts_is_told() {
    let kit = Kit::new();
    let [first, second] = [0, 1].map(|part| kit.folder.join(kit.file(part)).with_extension("3mf"));
    fs::copy(&first, &second).unwrap();
    fs::copy(
        kit.folder.join("plate.3mf"),
        kit.folder.join("assembly.3mf"),
    )
    .unwrap();
    let (code, said) = kit.verified();
    assert_eq!(code, Some(1), "{said}");
    for words in [
        "holds P02 0 times",
        "assembly.3mf: P01 differs from the part in its own file, or is not in its place",
    ] {
        assert!(said.contains(words), "{words:?} is not told in\n{said}");
    }
}
