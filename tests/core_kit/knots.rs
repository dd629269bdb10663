//! Parts that hook into each other: the answer names them, and a cut that frees them.

use std::fs;
use std::path::{Path, PathBuf};

use equipoise::geom::Point;
use equipoise::io::stl;
use equipoise::mesh::{Csg, primitives};

use super::common::{assert_exit, json, list, path};
use super::core;

/// Writes a block with an arm from its side over its top, and a hook from its top over that arm.
fn knotted(folder: &Path) -> PathBuf {
    let blocks = [
        ([-100.0, -101.0, -102.0], [100.0, 101.0, 102.0]),
        ([90.0, -12.0, -12.0], [180.0, 12.0, 12.0]),
        ([165.0, -11.0, 0.0], [179.0, 11.0, 214.0]),
        ([-20.0, -10.0, 200.0], [178.0, 10.0, 215.0]),
        ([-12.0, 40.0, 95.0], [12.0, 60.0, 245.0]),
        ([-11.0, -13.0, 228.0], [11.0, 59.0, 244.0]),
    ];
    let bodies = blocks.map(|(low, high): ([f64; 3], [f64; 3])| {
        Csg::of_mesh(&primitives::cuboid(&Point::from(low), &Point::from(high))).unwrap()
    });
    let whole = bodies.into_iter().reduce(|a, b| a.union(&b).unwrap());
    let mesh = whole.unwrap().to_mesh().unwrap();
    let file = folder.join("knot.stl");
    fs::write(&file, stl::encode(&mesh, "knot")).unwrap();
    file
}

/// Writes a base of one box.
fn base(folder: &Path) -> PathBuf {
    let mut text = "[[polyhedron]]\n".to_owned();
    for (axis, half_mm) in [70.0, 65.0, 60.0].into_iter().enumerate() {
        for sign in [1.0, -1.0] {
            let mut normal = [0.0; 3];
            normal[axis] = sign;
            text += &format!(
                "[[polyhedron.face]]\nnormal = {normal:?}\noffset_mm = {half_mm:?}\nlocked = false\n"
            );
        }
    }
    let file = folder.join("base.toml");
    fs::write(&file, text).unwrap();
    file
}

#[test]
fn parts_that_hook_into_each_other_are_named_with_a_cut_that_was_tried() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let base = base(folder.path());
    let options = format!("--up z --goal none --base {} --json", path(&base));
    let output = core(&knotted(folder.path()), &kit, &options);
    assert_exit(&output, 1);
    let answer = json(&output);
    let reason = answer["reason"].as_str().unwrap();
    assert!(
        reason.contains("In each other's way are the part over face"),
        "{answer}"
    );
    let hint = list(&answer, "hints")[0].as_str().unwrap();
    for said in [
        "frees them, as was tried: part the piece about (",
        "along the plane",
        "It leaves first",
    ] {
        assert!(hint.contains(said), "{said}: {hint}");
    }
    assert!(!kit.exists());
}
