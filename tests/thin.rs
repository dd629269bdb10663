//! Thin features of real models.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stdout, reason = "the table is shown with --nocapture")]

use crate::common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;
use std::time::Instant;

use common::{assert_exit, checklist, equipoise, number, path, printed, words};
use equipoise::base::watch::Watch;
use equipoise::geom::Point;
use equipoise::io::{read_model, stl};
use equipoise::mesh::{Csg, primitives};
use equipoise::repair::repair;
use equipoise::thin::find_thin;

/// Writes a block with an antenna of 0.5 × 0.5 mm that is 8 mm long.
fn write_block_with_antenna(folder: &Path) -> PathBuf {
    let cuboid = |min: [f64; 3], max: [f64; 3]| {
        Csg::of_mesh(&primitives::cuboid(&Point::from(min), &Point::from(max))).unwrap()
    };
    let block = cuboid([-12.0, -12.0, 0.0], [12.0, 12.0, 30.0]);
    let antenna = cuboid([5.0, -0.25, 25.0], [5.5, 0.25, 38.0]);
    let mesh = block.union(&antenna).unwrap().to_mesh().unwrap();
    let model = folder.join("block.stl");
    fs::write(&model, stl::encode(&mesh, "block")).unwrap();
    model
}

fn stand(model: &Path, out: &Path, options: &str) -> Output {
    let usual = "--goal stand --up z --printer objet-connex350 --wall 1.5mm --pitch 0.5mm --force";
    let line = ["prepare", path(model), "--out", path(out)];
    equipoise(&[&line[..], &words(usual), &words(options)].concat())
}

#[test]
fn a_thin_antenna_breaks_a_promise_until_it_is_thickened() {
    let folder = tempfile::tempdir().unwrap();
    let model = write_block_with_antenna(folder.path());
    let kit = folder.path().join("kit");
    let thin = stand(&model, &kit, "");
    assert_exit(&thin, 1);
    assert!(printed(&thin).contains("--thicken"), "{}", printed(&thin));

    let thick = stand(&model, &kit, "--thicken");
    assert_exit(&thick, 0);
    let sheet = checklist(&kit);
    // From half of 0.5 mm to half of a wall of 1 mm, and the bumps of the balls.
    let moved_mm = number(&sheet, "/model/thickened/moved_mm");
    assert!((0.25..0.6).contains(&moved_mm), "{moved_mm}");
    let (again, job) = (folder.path().join("again"), kit.join("job.toml"));
    let (verified, replayed) = rayon::join(
        || equipoise(&["verify", path(&kit), "--model", path(&model)]),
        || equipoise(&["prepare", "--job", path(&job), "--out", path(&again)]),
    );
    assert_exit(&verified, 0);
    assert_exit(&replayed, 0);
    let parts = |kit: &Path| fs::read(kit.join("SHA256SUMS")).unwrap();
    assert!(
        parts(&kit) == parts(&again),
        "the job replays to other bytes"
    );
}

#[test]
#[ignore = "prints a table of models that are not part of the project"]
fn real_models_at_100_mm() {
    for name in [
        "elephant.obj",
        "homer.obj",
        "humpty.obj",
        "bunny.stl",
        "armadillo.obj",
        "cheburashka.obj",
        "heart.obj",
        "teapot.obj",
        "fertility.stl",
        "tilted-ellipsoid.obj",
        "rocker-arm.obj",
        "cow.stl",
        "knight.stl",
        "three-spheres.obj",
    ] {
        let mesh = repair(
            read_model(&common::shared_folder().join(name)).unwrap(),
            &Watch::silent(),
        )
        .unwrap()
        .0;
        let longest = mesh.aabb().size().max();
        let mesh = mesh.map_vertices(|p| p * (100.0 / longest));
        for wall_mm in [0.6, 1.0] {
            let start = Instant::now();
            let found = find_thin(&mesh, wall_mm, &Watch::silent()).unwrap();
            let lengths = |places: &[equipoise::thin::ThinPlace]| {
                let lengths = places.iter().map(|place| format!("{:.1}", place.length_mm));
                lengths.take(8).collect::<Vec<_>>().join(" ")
            };
            println!(
                "{name} {wall_mm}: {:.1?} lost {} ends {} necks {}",
                start.elapsed(),
                lengths(&found.lost),
                lengths(&found.ends),
                lengths(&found.necks)
            );
        }
    }
}
