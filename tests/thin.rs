//! Thin features of real models.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stdout, reason = "the table is shown with --nocapture")]

use std::path::{Path, PathBuf};
use std::time::Instant;

use equipoise::base::watch::Watch;
use equipoise::io::read_model;
use equipoise::repair::repair;
use equipoise::thin::find_thin;

const SHARED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");

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
        let folder = std::env::var_os("EQUIPOISE_SHARED_MODELS");
        let folder = folder.map_or_else(|| PathBuf::from(SHARED), PathBuf::from);
        let mesh = repair(
            read_model(&Path::new(&folder).join(name)).unwrap(),
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
