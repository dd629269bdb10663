//! Bad input ends with a clear message and exit code 2, and leaves nothing behind.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::Path;

use common::{ELLIPSOID, assert_exit, equipoise, path, printed, text, words};

/// The options of every run.
const TOP: &str = "--printer objet-connex350 --goal top";

/// Runs `prepare` on a file of these bytes, which must be refused; returns the message.
fn refuse(name: &str, bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join(name);
    fs::write(&model, bytes).unwrap();
    refuse_path(folder.path(), &model)
}

/// Runs `prepare` on a file, which must be refused; returns the message.
fn refuse_path(folder: &Path, model: &Path) -> String {
    let before = fs::read_dir(folder).unwrap().count();
    let kit = folder.join("kit");
    let start = ["prepare", path(model), "--out", path(&kit)];
    let output = equipoise(&[&start[..], &words(TOP)].concat());
    assert_exit(&output, 2);
    let said = text(&output.stderr);
    assert!(
        said.lines().any(|line| line.starts_with("error: ")) && !said.contains("panicked"),
        "{said}"
    );
    let after = fs::read_dir(folder).unwrap().count();
    assert_eq!(after, before, "something was left behind: {said}");
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

/// The faces of the tetrahedron at the origin; the first two are a sheet.
const FACES: [[[f32; 3]; 3]; 4] = [
    [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]],
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]],
    [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
];

#[test]
fn an_open_mesh_is_refused_with_its_holes() {
    let said = refuse("open.stl", &stl(&FACES[..2]));
    assert!(
        said.contains("does not bound a solid") && said.contains("hole"),
        "{said}"
    );
    assert_eq!(said.matches("does not bound a solid").count(), 1, "{said}");
}

#[test]
fn a_quiet_inspect_refuses_an_open_mesh_and_places_its_holes_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("open.stl");
    fs::write(&model, stl(&FACES[..2])).unwrap();
    let output = equipoise(&["-q", "inspect", path(&model), "--size", "80mm"]);
    assert_exit(&output, 2);
    assert!(output.stdout.is_empty());
    // The middle of the rim's first edge, which is (0, 40, 0) mm in the print.
    let said = text(&output.stderr);
    let place = "(0.00, 0.500000, 0.00) in the file's own coordinates";
    assert!(said.contains(place), "{said}");
}

#[test]
fn a_model_one_millimetre_long_is_reported_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("small.stl");
    fs::write(&model, stl(&FACES)).unwrap();
    let inspect =
        |options: &[&str]| text(&equipoise(&[&["inspect", path(&model)], options].concat()).stdout);
    let said = inspect(&[]);
    for words in [
        "warning: its longest side would be 1 mm",
        "--unit",
        "a solid of 0.1667 mm³",
    ] {
        assert!(said.contains(words), "{said}");
    }
    assert!(!inspect(&["--size", "80mm"]).contains("warning: its longest side"));
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
    let said = refuse("holed.stl", &stl(&holed));
    assert!(
        said.contains("a cavity of 1000.000 mm³ about (11.00, 11.00, 11.00) mm"),
        "{said}"
    );
    assert!(
        said.contains("remedy: fill the inner surfaces (--repair=fill)")
            && said.contains("keep them as cavities (--repair=cavities)"),
        "{said}"
    );
}

#[test]
fn bodies_side_by_side_or_nested_are_refused_and_those_that_cross_are_united() {
    let body = cuboid([0.0; 3], [40.0; 3]);
    let with = |low: f32, high: f32| stl(&[&body[..], &cuboid([low; 3], [high; 3])].concat());
    let beside = refuse("beside.stl", &with(50.0, 60.0));
    assert!(
        beside.contains("it has 2 surfaces") && beside.contains("join the separate bodies"),
        "{beside}"
    );
    let within = refuse("within.stl", &with(10.0, 20.0));
    assert!(
        within.contains("a body (inside the material of another)"),
        "{within}"
    );
    let through = inspect_bytes(&with(30.0, 60.0));
    assert!(through.contains("overlap united: 2"), "{through}");
    assert!(through.contains("a solid of 90000 mm³"), "{through}");
}

#[test]
fn a_box_without_its_lid_is_closed_and_told() {
    let said = inspect_bytes(&stl(&cuboid([0.0; 3], [40.0; 3])[..10]));
    assert!(said.contains("1 hole filled, 20.00 %"), "{said}");
    assert!(said.contains("a solid of 64000 mm³"), "{said}");
}

/// Inspects a model of these bytes, which must be sound once repaired; returns what is said.
fn inspect_bytes(bytes: &[u8]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("model.stl");
    fs::write(&model, bytes).unwrap();
    let output = equipoise(&["inspect", path(&model)]);
    assert_exit(&output, 0);
    text(&output.stdout).replace('\u{202f}', "")
}

/// A box whose lid and floor are gone, and with them a triangle of a side: no rung closes it.
fn torn_box() -> Vec<u8> {
    let mut triangles = cuboid([0.0; 3], [40.0; 3]);
    let far = cuboid([10.0, 10.0, 30.0], [20.0, 20.0, 60.0]);
    triangles.drain(8..);
    triangles.remove(1);
    triangles.extend(&far[..7]);
    stl(&triangles)
}

#[test]
fn what_cannot_be_mended_is_refused_with_places_and_the_order_for_a_new_surface() {
    let said = refuse("torn.stl", &torn_box());
    assert!(said.contains("first at ("), "{said}");
    assert!(said.contains("--repair=remesh"), "{said}");
}

#[test]
fn the_picture_of_a_refused_model_names_its_holes_and_no_model_is_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let [model, picture] = ["torn.stl", "torn.svg"].map(|name| folder.path().join(name));
    fs::write(&model, torn_box()).unwrap();
    let inspect = |picture: &Path| {
        let output = equipoise(&["inspect", path(&model), "--picture", path(picture)]);
        assert_exit(&output, 2);
        printed(&output)
    };
    assert!(inspect(&picture).contains("--repair=remesh"));
    assert!(fs::read_to_string(&picture).unwrap().contains(">hole<"));
    assert!(inspect(&model).contains("ends in .svg"));
    assert_eq!(fs::read(&model).unwrap(), torn_box());
}

#[test]
fn a_new_surface_of_a_torn_box_is_a_solid_and_says_how_far_it_moved() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("torn.stl");
    fs::write(&model, torn_box()).unwrap();
    let output = equipoise(&["inspect", path(&model), "--repair", "remesh:1mm"]);
    assert_exit(&output, 0);
    let said = printed(&output);
    assert!(
        said.contains("a new surface drawn within 1.000 mm"),
        "{said}"
    );
    assert!(said.contains("no point moved by more than 0."), "{said}");
}

#[test]
fn a_surface_inside_is_refused_until_it_is_ordered_filled() {
    let inner = cuboid([10.0; 3], [30.0; 3]);
    let nested = stl(&[cuboid([0.0; 3], [40.0; 3]), inner].concat());
    assert!(refuse("nested.stl", &nested).contains("--repair=fill"));
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("nested.stl");
    fs::write(&model, nested).unwrap();
    let output = equipoise(&["inspect", path(&model), "--repair", "fill"]);
    assert_exit(&output, 0);
    let said = printed(&output).replace('\u{202f}', "");
    assert!(said.contains("1 surface inside the model filled"), "{said}");
    assert!(said.contains("a solid of 64000 mm³"), "{said}");
}

#[test]
fn an_order_for_repairs_that_nobody_knows_is_refused_with_those_there_are() {
    for order in ["magic", "remesh:0mm", "fill,cavities"] {
        let said = refuse_options(&["--repair", order]);
        assert!(said.contains("remesh:0.1mm"), "{said}");
    }
}

#[test]
fn a_truncated_stl_says_how_many_triangles_are_missing() {
    let whole = stl(&FACES);
    let said = refuse("cut.stl", &whole[..whole.len() - 30]);
    assert!(said.contains('4') && said.contains('3'), "{said}");
}

#[test]
fn a_letter_called_stl_is_refused_as_no_model() {
    let said = refuse(
        "letter.stl",
        b"Dear shop, please print the attached elephant.\n",
    );
    assert!(said.contains("not STL, OBJ, PLY or 3MF"), "{said}");
}

#[test]
fn a_coordinate_that_is_not_a_number_is_named() {
    let mut faces = FACES;
    faces[2][1][0] = f32::NAN;
    let said = refuse("nan.stl", &stl(&faces));
    assert!(
        said.to_lowercase().contains("nan") || said.contains("finite"),
        "{said}"
    );
}

#[test]
fn an_empty_obj_is_refused_as_empty() {
    assert!(refuse("empty.obj", b"").contains("empty"));
    assert!(refuse("comment.obj", b"# nothing here\n").contains("error"));
}

#[test]
fn a_missing_file_is_reported_as_missing() {
    let folder = tempfile::tempdir().unwrap();
    let said = refuse_path(folder.path(), &folder.path().join("absent.obj"));
    assert!(said.contains("no such file"), "{said}");
}

/// Runs `prepare` on the shipped model with options that must be refused; returns the message.
fn refuse_options(options: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let start = ["prepare", ELLIPSOID, "--out", path(&kit)];
    let output = equipoise(&[&start[..], &words(TOP), options].concat());
    assert_exit(&output, 2);
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 0, "{options:?} left something behind");
    let said = text(&output.stderr);
    assert!(said.lines().all(|line| line.len() < 400), "{said}");
    said
}

#[test]
fn absurd_sizes_walls_pitches_points_and_threads_are_refused() {
    for (size, words) in [
        ("0", "above zero"),
        ("-1", "above zero"),
        ("nan", "above zero"),
        ("1e300", "1.0e300 mm long"),
    ] {
        assert!(refuse_options(&["--size", size]).contains(words), "{size}");
    }
    for (options, words) in [
        (["--size", "5m"], "for objet-connex350 may be"),
        (["--size", "0.5mm"], "leave nothing inside"),
        (["--wall", "200mm"], "leave nothing inside"),
        (["--pitch", "1e-9"], "larger pitch (--pitch)"),
        (["--contact", "1e300,0,0"], "times the model's length away"),
        (["--threads", "100000"], "1..=256"),
    ] {
        let said = refuse_options(&options);
        assert!(said.contains(words), "{options:?}: {said}");
    }
}

#[test]
fn a_target_inside_a_file_is_refused_before_the_model_is_read() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("file"), "").unwrap();
    let target = folder.path().join("file").join("kit");
    let start = ["prepare", "absent.stl", "--out", path(&target)];
    let output = equipoise(&[&start[..], &words(TOP)].concat());
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(
        said.contains("cannot write") && !said.contains("absent.stl"),
        "{said}"
    );
}

#[test]
fn a_target_that_is_a_file_is_refused_and_kept() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("taken");
    fs::write(&file, "not a folder").unwrap();
    let start = ["prepare", ELLIPSOID, "--out", path(&file)];
    let output = equipoise(&[&start[..], &words(TOP)].concat());
    assert_exit(&output, 2);
    let said = printed(&output);
    assert!(said.contains("is a file"), "{said}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "not a folder");
}
