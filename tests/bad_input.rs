//! Bad input ends in clear words and exit code 2, and leaves nothing behind.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use std::fs;
use std::path::Path;

use assert_cmd::Command;

/// Runs `prepare` on a file of these bytes; gives what it said on the standard error.
fn refused(name: &str, bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join(name);
    fs::write(&model, bytes).unwrap();
    refused_path(folder.path(), &model)
}

fn refused_path(folder: &Path, model: &Path) -> String {
    let before = fs::read_dir(folder).unwrap().count();
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "prepare",
            model.to_str().unwrap(),
            "--printer",
            "objet-connex350",
            "--goal",
            "top",
            "--out",
        ])
        .arg(folder.join("kit"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.starts_with("error: ") && !said.contains("panicked"),
        "{said}"
    );
    assert_eq!(
        fs::read_dir(folder).unwrap().count(),
        before,
        "something was left behind: {said}"
    );
    said
}

/// A binary STL of these triangles.
fn stl(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0u8; 12]);
        bytes.extend(triangle.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0, 0]);
    }
    bytes
}

/// The box between two corners, turned outward.
fn cuboid(low: [f32; 3], high: [f32; 3]) -> Vec<[[f32; 3]; 3]> {
    let corner = |bits: usize| {
        [0, 1, 2].map(|axis| {
            if bits >> axis & 1 == 1 {
                high[axis]
            } else {
                low[axis]
            }
        })
    };
    let sides = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let halves = sides
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]);
    halves.map(|triangle| triangle.map(corner)).collect()
}

/// The faces of the tetrahedron at the origin; the first three leave it open.
const FACES: [[[f32; 3]; 3]; 4] = [
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

#[test]
fn an_open_mesh_is_refused_with_its_holes() {
    let said = refused("open.stl", &stl(&FACES[..3]));
    assert!(
        said.contains("does not bound a solid") && said.contains("hole"),
        "{said}"
    );
    assert_eq!(said.matches("does not bound a solid").count(), 1, "{said}");
}

#[test]
fn inspect_ends_as_prepare_does_and_tells_holes_where_they_are_in_the_file_even_when_quiet() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("open.stl");
    fs::write(&model, stl(&FACES[..3])).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args(["-q", "inspect", model.to_str().unwrap(), "--size", "80mm"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(
        (output.status.code(), output.stdout.len()),
        (Some(2), 0),
        "{said}"
    );
    // The middle of the rim's first edge, which is (40, 40, 0) mm in the print.
    assert!(
        said.contains("(0.500000, 0.500000, 0.00) in the file's own coordinates"),
        "{said}"
    );
}

#[test]
fn a_model_of_a_millimetre_is_told_with_what_to_do_about_it() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.stl");
    fs::write(&model, stl(&FACES)).unwrap();
    let inspected = |more: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
            .args(["inspect", model.to_str().unwrap()])
            .args(more)
            .output()
            .unwrap();
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let said = inspected(&[]);
    assert!(
        said.contains("warning: its longest side would be 1 mm") && said.contains("--unit"),
        "{said}"
    );
    assert!(said.contains("a solid of 0.1667 mm³"), "{said}");
    assert!(!inspected(&["--size", "80mm"]).contains("warning: its longest side"));
}

#[test]
fn a_cavity_in_the_model_is_refused_with_its_place_and_volume() {
    let hole = cuboid([6.0, 6.0, 6.0], [16.0, 16.0, 16.0])
        .into_iter()
        .map(|[a, b, c]| [a, c, b]);
    let holed: Vec<_> = cuboid([0.0; 3], [40.0; 3])
        .into_iter()
        .chain(hole)
        .collect();
    let said = refused("holed.stl", &stl(&holed));
    assert!(
        said.contains("a cavity of 1000.000 mm³ about (11.00, 11.00, 11.00) mm"),
        "{said}"
    );
    assert!(said.contains("remedy: remove the inner surfaces"), "{said}");
}

#[test]
fn bodies_beside_each_other_in_each_other_and_through_each_other_are_refused_before_any_work() {
    let body = cuboid([0.0; 3], [40.0; 3]);
    let with = |low: f32, high: f32| stl(&[&body[..], &cuboid([low; 3], [high; 3])].concat());
    let beside = refused("beside.stl", &with(50.0, 60.0));
    assert!(
        beside.contains("it has 2 surfaces") && beside.contains("join the separate bodies"),
        "{beside}"
    );
    let within = refused("within.stl", &with(10.0, 20.0));
    assert!(
        within.contains("a body (inside the material of another)"),
        "{within}"
    );
    let through = refused("through.stl", &with(30.0, 60.0));
    assert!(
        through.contains("pass through each other") && through.contains("boolean union"),
        "{through}"
    );
}

#[test]
fn a_truncated_stl_says_how_many_triangles_are_missing() {
    let whole = stl(&FACES);
    let said = refused("cut.stl", &whole[..whole.len() - 30]);
    assert!(said.contains('4') && said.contains('3'), "{said}");
}

#[test]
fn a_text_called_stl_is_said_to_be_no_model() {
    let said = refused(
        "letter.stl",
        b"Dear shop, please print the attached elephant.\n",
    );
    assert!(said.contains("not STL, OBJ, PLY or 3MF"), "{said}");
}

#[test]
fn a_coordinate_that_is_not_a_number_is_named() {
    let mut faces = FACES;
    faces[2][1][0] = f32::NAN;
    let said = refused("nan.stl", &stl(&faces));
    assert!(
        said.to_lowercase().contains("nan") || said.contains("finite"),
        "{said}"
    );
}

#[test]
fn an_empty_obj_is_said_to_be_empty() {
    assert!(refused("empty.obj", b"").contains("empty"));
    assert!(refused("comment.obj", b"# nothing here\n").contains("error"));
}

#[test]
fn a_missing_file_is_said_to_be_missing() {
    let folder = tempfile::tempdir().unwrap();
    let said = refused_path(folder.path(), &folder.path().join("absent.obj"));
    assert!(said.contains("no such file"), "{said}");
}

/// Runs `prepare` on the shipped model with more arguments; gives what it said on the standard
/// error.
fn refused_arguments(more: &[&str]) -> String {
    let model = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/tilted-ellipsoid.stl"
    );
    let folder = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "prepare",
            model,
            "--printer",
            "objet-connex350",
            "--goal",
            "top",
            "--out",
        ])
        .arg(folder.path().join("kit"))
        .args(more)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{more:?}: {said}");
    assert_eq!(
        fs::read_dir(folder.path()).unwrap().count(),
        0,
        "{more:?} left something behind"
    );
    assert!(said.lines().all(|line| line.len() < 400), "{said}");
    said
}

#[test]
fn absurd_sizes_walls_pitches_points_and_threads_are_refused_at_once() {
    for (size, words) in [
        ("0", "above zero"),
        ("-1", "above zero"),
        ("nan", "above zero"),
        ("1e300", "1.0e300 mm long"),
    ] {
        assert!(
            refused_arguments(&["--size", size]).contains(words),
            "{size}"
        );
    }
    for (more, words) in [
        (["--size", "5m"], "for objet-connex350 may be"),
        (["--size", "0.5mm"], "leave nothing inside"),
        (["--wall", "200mm"], "leave nothing inside"),
        (["--pitch", "1e-9"], "larger --pitch"),
        (["--contact", "1e300,0,0"], "times the model's length away"),
        (["--threads", "100000"], "1..=256"),
    ] {
        let said = refused_arguments(&more);
        assert!(said.contains(words), "{more:?}: {said}");
    }
}

#[test]
fn a_target_inside_a_file_is_told_before_any_work_is_done() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let target = folder.path().join("file").join("kit");
    // The model is not read before the target is known to be writable.
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "prepare",
            "absent.stl",
            "--printer",
            "objet-connex350",
            "--goal",
            "top",
            "--out",
        ])
        .arg(&target)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("cannot write") && !said.contains("absent.stl"),
        "{said}"
    );
}

#[test]
fn a_target_that_cannot_be_written_is_told_before_any_work_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("taken");
    fs::write(&file, "not a folder").unwrap();
    let model = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/tilted-ellipsoid.stl"
    );
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args([
            "prepare",
            model,
            "--printer",
            "objet-connex350",
            "--goal",
            "top",
            "--out",
        ])
        .arg(&file)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("is a file"), "{said}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "not a folder");
}
