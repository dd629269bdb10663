//! Bad input ends in clear words and exit code 2, and leaves nothing behind.

#![allow(clippy::unwrap_used, reason = "a test whose input cannot be had has failed")]

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
        .args(["prepare", model.to_str().unwrap(), "--printer", "objet-connex350", "--goal", "top", "--out"])
        .arg(folder.join("kit"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.starts_with("error: ") && !said.contains("panicked"), "{said}");
    assert_eq!(fs::read_dir(folder).unwrap().count(), before, "something was left behind: {said}");
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
    assert!(said.contains("does not bound a solid") && said.contains("hole"), "{said}");
}

#[test]
fn a_truncated_stl_says_how_many_triangles_are_missing() {
    let whole = stl(&FACES);
    let said = refused("cut.stl", &whole[..whole.len() - 30]);
    assert!(said.contains('4') && said.contains('3'), "{said}");
}

#[test]
fn a_text_called_stl_is_said_to_be_no_model() {
    let said = refused("letter.stl", b"Dear shop, please print the attached elephant.\n");
    assert!(said.contains("neither STL nor OBJ"), "{said}");
}

#[test]
fn a_coordinate_that_is_not_a_number_is_named() {
    let mut faces = FACES;
    faces[2][1][0] = f32::NAN;
    let said = refused("nan.stl", &stl(&faces));
    assert!(said.to_lowercase().contains("nan") || said.contains("finite"), "{said}");
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

#[test]
fn a_target_that_cannot_be_written_is_told_before_any_work_is_done() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("taken");
    fs::write(&file, "not a folder").unwrap();
    let model = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/tilted-ellipsoid.stl");
    let output = Command::new(env!("CARGO_BIN_EXE_equipoise"))
        .args(["prepare", model, "--printer", "objet-connex350", "--goal", "top", "--out"])
        .arg(&file)
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(said.contains("is a file"), "{said}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "not a folder");
}
