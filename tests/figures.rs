//! Models become figures whose junctures are the model's own pieces. Nothing of a hand or a foot is
//! lost, and two judges hold every piece against the model.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

use crate::common;
#[path = "figures/lies.rs"]
mod lies;

use std::fs;
use std::path::{Path, PathBuf};

use common::{
    assert_exit, checklist, equipoise, judge_telescope, list, number, path, printed, shared_model,
    telescope_judge_says, text, verify, words,
};
use equipoise::geom::{Plane, Point, Vector};
use equipoise::io::stl;
use equipoise::mesh::primitives::{self, ball};
use equipoise::mesh::{Csg, Solid, TriMesh, bodies};
use equipoise::repair::weld;
use lies::{LIES, Lie, assert_found, lie_about_a_part};
use serde_json::Value;

/// A ball of the figure: its centre and its radius, mm.
type Ball = [f64; 4];

/// The figure as hulls of two balls each: a trunk, a leg with a foot whose heel hangs back, an arm
/// with a hand.
const FIGURE: [[Ball; 2]; 6] = [
    [[0.0, 0.0, 0.0, 22.0], [0.0, 0.0, 45.0, 22.0]],
    [[0.0, 0.0, 0.0, 13.0], [0.0, 0.0, -85.0, 9.0]],
    [[-8.0, 0.0, -98.0, 11.0], [26.0, 0.0, -100.0, 8.0]],
    [[-8.0, 0.0, -98.0, 11.0], [-19.0, 0.0, -88.0, 6.0]],
    [[0.0, 0.0, 38.0, 12.0], [80.0, 0.0, 48.0, 9.0]],
    [[92.0, 0.0, 50.0, 13.0], [96.0, 0.0, 56.0, 12.0]],
];

/// Writes the figure as a file.
fn write_figure(folder: &Path) -> (PathBuf, TriMesh) {
    let hull = |pair: &[Ball; 2]| {
        let balls = pair.map(|[x, y, z, radius]| ball(&Point::new(x, y, z), radius, 3));
        let points = balls.iter().flat_map(|mesh| mesh.vertices()).copied();
        Csg::convex_hull(&points.collect::<Vec<_>>()).unwrap()
    };
    let (first, others) = FIGURE.split_first().unwrap();
    let whole = others
        .iter()
        .fold(hull(first), |whole, pair| whole.union(&hull(pair)).unwrap());
    let mesh = whole.without_slivers().to_mesh().unwrap();
    let file = folder.join("figure.stl");
    fs::write(&file, stl::encode(&mesh, "figure")).unwrap();
    (file, mesh)
}

#[test]
fn a_figure_keeps_its_hand_and_foot_and_both_judges_pass_it() {
    let folder = tempfile::tempdir().unwrap();
    let (model, mesh) = write_figure(folder.path());
    let kit = folder.path().join("kit");
    let order = ["telescope", path(&model), "--printer", "formlabs-form4"];
    let output = equipoise(&[&order[..], &["--out", path(&kit)]].concat());
    assert_exit(&output, 0);
    let sheet = checklist(&kit);
    assert_eq!(sheet["model"], "model.stl");
    assert!(!list(&sheet, "limbs").is_empty(), "{}", printed(&output));
    // All out it is as large as the model: no toe, no heel and no finger is lost.
    let size = mesh.aabb().size();
    for (axis, side) in [size.x, size.y, size.z].into_iter().enumerate() {
        let made = number(&sheet, &format!("/extended_mm/{axis}"));
        assert!((made - side).abs() < 0.05, "{made} of {side} along {axis}");
    }
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    judge_telescope(&kit);
    cut_off_a_hand(&kit);
    lie_about_the_model(&kit);
}

/// Cuts either end off a piece of the model at the tip of a limb, and puts it back. Both judges
/// must miss both.
fn cut_off_a_hand(kit: &Path) {
    let sheet = checklist(kit);
    let limbs = list(&sheet, "limbs");
    let tip = limbs.iter().map(|limb| limb["to"].as_u64().unwrap()).max();
    let hand = &list(&sheet, "junctures")[tip.unwrap() as usize - 1];
    let file = kit.join(hand["parts"][0]["file"].as_str().unwrap());
    let right = fs::read(&file).unwrap();
    let mesh = weld(&stl::decode(&right).unwrap());
    let (low, size) = (mesh.aabb().min, mesh.aabb().size());
    let axis = size.imax();
    let mut normal = Vector::zeros();
    normal[axis] = 1.0;
    for (share, is_top) in [(0.2, true), (0.8, false)] {
        let offset_mm = low[axis] + share * size[axis];
        let whole = Csg::of_mesh(&mesh).unwrap();
        let (above, below) = whole.split_by_plane(&Plane { normal, offset_mm }).unwrap();
        let rest = if is_top { above } else { below };
        fs::write(&file, stl::encode(&rest.to_mesh().unwrap(), "hand")).unwrap();
        let (code, said) = verify(kit);
        assert_eq!(code, Some(1), "{said}");
        let line = said
            .lines()
            .find(|line| line.contains("keep the model's surface"));
        assert!(line.unwrap().contains("FAIL"), "{said}");
        if let Some(output) = telescope_judge_says(kit) {
            assert_exit(&output, 1);
        }
    }
    fs::write(&file, right).unwrap();
}

/// Puts a model into the kit that is a little thicker: the judge must find that the pieces are not
/// of it.
fn lie_about_the_model(kit: &Path) {
    let file = kit.join("model.stl");
    let right = stl::decode(&fs::read(&file).unwrap()).unwrap();
    let thicker = right.map_vertices(|p| Point::from(p.coords * 1.001));
    fs::write(&file, stl::encode(&thicker, "model")).unwrap();
    let (code, said) = verify(kit);
    assert_eq!(code, Some(1), "{said}");
    assert!(said.contains("keep the model's surface"), "{said}");
}

/// A printer whose room is too small for the figure's trunk.
const SMALL: &str = r#"id = "small"
name = "A small one"
inherits = "formlabs-form4"
build_volume_mm = { value = [70, 62, 62], source = "a test", sure = "own-choice" }
"#;

/// Prepares the figure for the small printer, whose profile lies in the folder.
fn prepare_small(folder: &Path, name: &str, more: &str) -> PathBuf {
    let (model, profile) = (folder.join("figure.stl"), folder.join("small.toml"));
    fs::write(&profile, SMALL).unwrap();
    let kit = folder.join(name);
    let order = ["telescope", path(&model), "--printer", path(&profile)];
    let more = [&words(more)[..], &["--out", path(&kit)]].concat();
    let output = equipoise(&[&order[..], &more].concat());
    assert_exit(&output, 0);
    kit
}

/// Returns the parts of the first juncture that is cut.
fn cut_parts(sheet: &Value) -> &Vec<Value> {
    let mut junctures = list(sheet, "junctures").iter();
    let cut = junctures.find(|own| own.get("divided").is_some());
    cut.unwrap()["parts"].as_array().unwrap()
}

#[test]
fn a_trunk_larger_than_the_printer_is_cut_and_the_judge_finds_what_is_wrong_with_a_part() {
    let folder = tempfile::tempdir().unwrap();
    write_figure(folder.path());
    let kit = prepare_small(folder.path(), "kit", "--threads 2");
    let sheet = checklist(&kit);
    let ids: Vec<&str> = cut_parts(&sheet)
        .iter()
        .map(|part| part["id"].as_str().unwrap())
        .collect();
    assert!(ids.len() > 1 && ids[0] == "N01-P01", "{ids:?}");
    let page = fs::read_to_string(kit.join("job.html")).unwrap();
    assert!(page.contains("Parts of N01") && page.contains("N01-P02"));
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    // Those that cost little; the others are told in the long test.
    for lie in [Lie::NoCuts, Lie::NoPins] {
        let untrue = lie_about_a_part(folder.path(), &kit, lie);
        assert_found(&untrue, lie);
    }
    let older = folder.path().join("older");
    common::copy(&kit, &older);
    let list = older.join("checklist.json");
    let mut sheet: Value = serde_json::from_slice(&fs::read(&list).unwrap()).unwrap();
    sheet["schema"] = 1.into();
    fs::write(&list, sheet.to_string()).unwrap();
    let (code, said) = verify(&older);
    assert!(code == Some(2) && said.contains("make it again"), "{said}");
}

#[test]
#[ignore = "takes a minute; run before a change of junctures"]
fn both_judges_agree_on_a_cut_trunk_and_its_bytes_are_those_of_one_thread() {
    let folder = tempfile::tempdir().unwrap();
    write_figure(folder.path());
    let kit = prepare_small(folder.path(), "kit", "--threads 2");
    let again = prepare_small(folder.path(), "again", "--threads 1");
    for part in cut_parts(&checklist(&kit)) {
        let file = part["file"].as_str().unwrap();
        assert_eq!(
            fs::read(kit.join(file)).unwrap(),
            fs::read(again.join(file)).unwrap()
        );
    }
    for file in ["SHA256SUMS", "checklist.json", "motion.json", "job.html"] {
        assert_eq!(
            fs::read(kit.join(file)).unwrap(),
            fs::read(again.join(file)).unwrap()
        );
    }
    judge_telescope(&kit);
}

#[test]
#[ignore = "takes minutes; run before a change of junctures"]
fn both_judges_find_every_lie_about_a_cut_trunk() {
    let folder = tempfile::tempdir().unwrap();
    write_figure(folder.path());
    let kit = prepare_small(folder.path(), "kit", "--threads 2");
    let lies = LIES.map(|lie| (lie, lie_about_a_part(folder.path(), &kit, lie)));
    for (lie, untrue) in &lies {
        assert_found(untrue, *lie);
    }
    for (lie, untrue) in lies {
        if let Some(output) = telescope_judge_says(&untrue) {
            assert_exit(&output, 1);
            // The Python judge needs no cuts. That its list was changed is not enough for the rest.
            let said = printed(&output);
            let is_found = said.lines().any(|line| {
                let is_of_part = line.contains("N0") || line.contains("pin ");
                line.starts_with("FAIL") && is_of_part
            });
            assert!(is_found || matches!(lie, Lie::Elsewhere), "{lie:?}: {said}");
        }
    }
}

#[test]
#[ignore = "takes minutes; run before a change of junctures"]
fn the_torso_of_an_armadillo_of_300_mm_is_cut_for_a_form_4() {
    let Some(model) = shared_model("armadillo.obj") else {
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let order = ["telescope", path(&model), "--out", path(&kit)];
    let more = words("--printer formlabs-form4 --size 300mm");
    assert_exit(&equipoise(&[&order[..], &more].concat()), 0);
    let sheet = checklist(&kit);
    assert!(cut_parts(&sheet).len() > 1);
    let (code, said) = verify(&kit);
    assert_eq!(code, Some(0), "{said}");
    judge_telescope(&kit);
}

#[test]
fn a_model_still_gets_balls_if_they_are_ordered() {
    let folder = tempfile::tempdir().unwrap();
    let (model, _) = write_figure(folder.path());
    let kit = folder.path().join("kit");
    let order = ["telescope", path(&model), "--printer", "formlabs-form4"];
    let balls = ["--junctures", "ball", "--out", path(&kit)];
    assert_exit(&equipoise(&[&order[..], &balls].concat()), 0);
    assert!(checklist(&kit).get("model").is_none());
    assert!(!kit.join("model.stl").exists());
    // Its own pieces get no foot.
    let standing = folder.path().join("standing");
    let stands = ["--goal", "stand", "--out", path(&standing)];
    let output = equipoise(&[&order[..], &stands].concat());
    assert_exit(&output, 2);
    let said = text(&output.stderr);
    assert!(
        said.contains("get no foot") && said.contains("--junctures=ball"),
        "{said}"
    );
    assert!(!standing.exists());
}

#[test]
fn junctures_of_a_model_need_one() {
    let folder = tempfile::tempdir().unwrap();
    let skeleton = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/examples/models/figure-skeleton.toml"
    );
    let lines = folder.path().join("y.obj");
    let branching = "v 0 0 0\nv 0 0 70\nv 60 0 110\nv -60 0 110\nl 1 2\nl 2 3\nl 2 4\n";
    fs::write(&lines, branching).unwrap();
    for (source, expected) in [
        (skeleton, "--junctures=ball"),
        (path(&lines), "--junctures=ball"),
        ("arc:80,90", "has no limbs"),
    ] {
        let kit = folder.path().join("kit");
        let order = ["telescope", source, "--printer", "formlabs-form4"];
        let more = words("--junctures model");
        let output = equipoise(&[&order[..], &more, &["--out", path(&kit)]].concat());
        assert_exit(&output, 2);
        let said = text(&output.stderr);
        assert!(said.contains(expected) && said.contains("remedy"), "{said}");
        assert!(!kit.exists());
    }
}

fn level(height_mm: f64) -> Plane {
    Plane {
        normal: Vector::z(),
        offset_mm: height_mm,
    }
}

#[test]
fn only_the_branch_around_the_point_is_cut_through() {
    // A ring that stands: a plane across it meets both of its sides.
    let torus = primitives::torus(8.0, 3.0, 40, 24);
    let standing = torus.map_vertices(|p| Point::new(p.x, -p.z, p.y));
    let ring = standing
        .ring_around(&level(0.1), &Point::new(8.0, 0.0, 0.1))
        .unwrap();
    assert!(ring.reach_mm(&Point::new(8.0, 0.0, 0.1)) < 3.01);
    let cut = Solid::new(standing.cut_along(&ring)).unwrap();
    // It is still one body, of the same volume, and open to the side of the cut alone.
    assert_eq!(bodies(cut.mesh()).len(), 1);
    let volume = [&standing, cut.mesh()].map(TriMesh::signed_volume_mm3);
    assert!((volume[0] - volume[1]).abs() < 1e-9);
    let ring = cut
        .mesh()
        .ring_around(&level(0.1), &Point::new(-8.0, 0.0, 0.1))
        .unwrap();
    let apart = Solid::new(cut.mesh().cut_along(&ring)).unwrap();
    assert_eq!(bodies(apart.mesh()).len(), 2);
}

#[test]
fn what_hangs_back_across_the_plane_stays_whole() {
    // An L: a bar across, with a foot at one end that hangs down.
    let part = |min: [f64; 3], max: [f64; 3]| {
        Csg::of_mesh(&primitives::cuboid(&min.into(), &max.into())).unwrap()
    };
    let hook = part([0.0, 0.0, 0.0], [4.0, 4.0, 30.0])
        .union(&part([0.0, 0.0, 28.0], [20.0, 4.0, 34.0]))
        .unwrap();
    let hook = hook
        .union(&part([16.0, 0.0, 10.0], [20.0, 4.0, 30.0]))
        .unwrap();
    let mesh = hook.to_mesh().unwrap();
    let ring = mesh
        .ring_around(&level(15.0), &Point::new(2.0, 2.0, 15.0))
        .unwrap();
    let parts = bodies(&mesh.cut_along(&ring));
    let mut volumes: Vec<f64> = parts.iter().map(TriMesh::signed_volume_mm3).collect();
    volumes.sort_by(f64::total_cmp);
    // The plane passes through the foot too, which stays with the bar.
    let stump = 4.0 * 4.0 * 15.0;
    let rest = mesh.signed_volume_mm3() - stump;
    assert!((volumes[0] - stump).abs() < 1e-3 && (volumes[1] - rest).abs() < 1e-3);
}

#[test]
fn a_ring_with_a_hole_in_it_and_a_point_outside_have_no_disc() {
    let pipe = primitives::torus(8.0, 3.0, 40, 24);
    // Across the axis of a lying torus the section is a ring with a hole.
    assert!(
        pipe.ring_around(&level(0.1), &Point::new(8.0, 0.0, 0.1))
            .is_none()
    );
    assert!(
        pipe.ring_around(&level(0.1), &Point::new(0.0, 0.0, 0.1))
            .is_none()
    );
}
