//! Densities that vary: exact mass properties of real models against reference values, and the
//! time that they take.
//!
//! The reference values come from an independent program with exact rational corners.
//! `cargo test --release --test density -- --ignored --nocapture` also measures the times.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stdout, reason = "the times are shown with --nocapture")]

use crate::common;

use std::time::Instant;

use common::{assert_exit, equipoise, json, path, printed, shared_model, words};
use equipoise::base::watch::Watch;
use equipoise::field::{Density, Linear, Order, Profile, Ramp, Sine, Skin, Uniform, measure};
use equipoise::geom::{Point, Vector};
use equipoise::io::read_model;
use equipoise::mass::{Cones, Moments, moments_of_mesh};
use equipoise::mesh::{Solid, TriMesh, primitives::cuboid};
use equipoise::repair::repair;

/// The models with about 12 000 faces, the size for which times are promised.
const MODELS: [&str; 7] = [
    "bunny.stl",
    "armadillo.obj",
    "rocker-arm.obj",
    "homer.obj",
    "cow.stl",
    "elephant.obj",
    "fertility.stl",
];

/// Returns a model with its longest side this long, in the axes of its file; `None` if absent.
fn shared(name: &str, size_mm: f64) -> Option<TriMesh> {
    let model = read_model(&shared_model(name)?).unwrap();
    let mesh = repair(model, &Watch::silent()).unwrap().0;
    let longest_mm = mesh.longest_side_mm();
    Some(mesh.map_vertices(|p| p * (size_mm / longest_mm)))
}

/// Returns the bunny of the reference values: 100 mm, its lowest corner at the origin.
fn bunny() -> Option<TriMesh> {
    let mesh = shared("bunny.stl", 100.0)?;
    let lowest = mesh.aabb().min;
    Some(mesh.map_vertices(|p| p - lowest.coords))
}

/// Fails unless a density has this mass and centre on the bunny, to 1e-9 of each.
fn assert_body(mesh: &TriMesh, density: &dyn Density, mass: f64, center: [f64; 3]) {
    let got = measure(mesh, density);
    // Reference values are given to four digits behind the point, and centres to seven.
    let error = (got.moments.volume() - mass).abs();
    assert!(error < 1e-4, "{} instead of {mass}", got.moments.volume());
    let off = got.center().unwrap() - Point::from(center);
    assert!(off.amax() < 1e-7, "{:?}", got.center());
    assert!(got.mass_error_ratio() < 1e-8);
}

#[test]
fn a_bunny_has_the_mass_and_the_centre_of_the_reference_for_every_field() {
    let Some(mesh) = bunny() else { return };
    let solid = moments_of_mesh(&mesh);
    let uniform = measure(&mesh, &Uniform(1.0)).moments;
    assert!(
        (uniform.volume() - 199_373.712_4).abs() < 1e-4,
        "{}",
        uniform.volume()
    );
    assert!((uniform.volume() / solid.volume() - 1.0).abs() < 1e-13);

    let line = Linear {
        at_origin: 1.0,
        gradient: Vector::new(1.0, 2.0, 3.0) / 374.0,
    };
    assert_body(
        &mesh,
        &line,
        336_358.963_4,
        [47.622_239_9, 35.545_077_2, 47.501_488_8],
    );

    let direction = Vector::new(1.0, 2.0, 2.0) / 3.0;
    let middle = direction.dot(&solid.centroid().coords);
    let ramp = Ramp::new(&direction, [middle - 10.0, middle + 10.0], [1.0, 5.0]).unwrap();
    assert_body(
        &mesh,
        &ramp,
        607_063.312_8,
        [49.068_557_2, 41.353_536_8, 50.327_479_9],
    );

    let center = solid.centroid() + Vector::new(10.0, -14.0, 26.0);
    let sine = Sine::new(center, std::f64::consts::TAU / 0.157, [0.0, 2.0]).unwrap();
    assert_body(
        &mesh,
        &sine,
        211_757.322_1,
        [47.587_704_1, 34.389_280_5, 43.745_623_5],
    );
}

#[test]
fn any_apex_gives_the_same_ten_moments_of_the_bunny() {
    let Some(mesh) = bunny() else { return };
    let density = |p: &Point| 1.0 + (p.x + 2.0 * p.y + 3.0 * p.z) / 374.0;
    let near = Cones::from_middle(&mesh).linear(density);
    let length = 50.0_f64;
    for apex in [
        [0.0; 3],
        [50.0, 40.0, 30.0],
        [300.0, 0.0, 0.0],
        [-100.0, 200.0, 200.0],
    ] {
        let moments = Cones::new(&mesh, Point::from(apex)).linear(density);
        for (index, (got, want)) in moments.0.iter().zip(near.0).enumerate() {
            let degree = [0, 1, 1, 1, 2, 2, 2, 2, 2, 2][index];
            let scale = near.volume() * length.powi(degree);
            assert!(
                (got - want).abs() < 1e-11 * scale,
                "{apex:?} {index}: {got} {want}"
            );
        }
    }
}

#[test]
fn a_skin_without_depth_is_the_core_and_a_deep_one_the_surface() {
    let Some(mesh) = shared("heart.obj", 60.0) else {
        return;
    };
    let solid = Solid::new(mesh).unwrap();
    let volume = moments_of_mesh(solid.mesh()).volume();
    let mean = |depth_mm| {
        let skin = Skin::new(&solid, depth_mm, Profile::Gauss, [0.2, 1.0]).unwrap();
        measure(solid.mesh(), &skin).moments.volume() / volume
    };
    assert!((mean(0.01) - 0.2).abs() < 2e-2 && (mean(1e4) - 1.0).abs() < 1e-6);
    assert!(mean(2.0) > 0.25 && mean(4.0) > mean(2.0));
}

/// Returns the shortest of five runs, s.
fn seconds(mut run: impl FnMut() -> Moments) -> f64 {
    let time = |_| {
        let start = Instant::now();
        assert!(run().volume().is_finite());
        start.elapsed().as_secs_f64()
    };
    (0..5).map(time).fold(f64::INFINITY, f64::min)
}

#[test]
#[ignore = "measures times; run in release"]
fn linear_fields_take_20_ms_and_waves_300_ms() {
    println!("model, faces, linear s, ramp s, wave s, error of the wave, skin s, its error");
    for name in MODELS {
        let Some(mesh) = shared(name, 100.0) else {
            continue;
        };
        let solid = Solid::new(mesh.clone()).unwrap();
        let middle = mesh.aabb().center();
        let line = Linear {
            at_origin: 0.5,
            gradient: Vector::new(1e-3, 2e-3, 0.0),
        };
        let ramp = Ramp::new(&Vector::y(), [middle.y - 10.0, middle.y + 10.0], [0.2, 1.0]);
        let ramp = ramp.unwrap();
        let center = middle + Vector::new(10.0, -14.0, 26.0);
        let wave = Sine::new(center, 40.0, [0.1, 1.0]).unwrap();
        let order: Order = "skin:4mm:gauss:0.2..1".parse().unwrap();
        let skin = order.on(&solid);
        let run = |density: &dyn Density| seconds(|| measure(&mesh, density).moments);
        let start = Instant::now();
        let of_skin = measure(&mesh, skin.as_ref());
        let (linear_s, wave_s) = (run(&line), run(&wave));
        println!(
            "{name}, {}, {linear_s:.4}, {:.4}, {wave_s:.3}, {:.1e}, {:.1}, {:.1e}",
            mesh.triangles().len(),
            run(&ramp),
            measure(&mesh, &wave).mass_error_ratio(),
            start.elapsed().as_secs_f64(),
            of_skin.mass_error_ratio(),
        );
        assert!(measure(&mesh, &wave).mass_error_ratio() <= 1e-9);
        let faces = mesh.triangles().len() as f64 / 12_000.0;
        assert!(linear_s <= 0.02 * faces.max(1.0) && wave_s <= 0.3 * faces.max(1.0));
    }
}

/// A cuboid of 40 × 30 × 20 mm beside the origin, as an STL file in a folder.
fn write_cuboid(folder: &std::path::Path) -> std::path::PathBuf {
    let mesh = cuboid(&Point::origin(), &Point::new(40.0, 30.0, 20.0));
    let mut text = "solid cuboid\n".to_owned();
    for corners in mesh.iter_corners() {
        text += "facet normal 0 0 0\nouter loop\n";
        for corner in corners {
            text += &format!("vertex {} {} {}\n", corner.x, corner.y, corner.z);
        }
        text += "endloop\nendfacet\n";
    }
    let file = folder.join("cuboid.stl");
    std::fs::write(&file, text + "endsolid cuboid\n").unwrap();
    file
}

#[test]
fn inspect_tells_mass_centre_and_moments_of_a_field_and_its_error() {
    let folder = tempfile::tempdir().unwrap();
    let model = write_cuboid(folder.path());
    let ramp = "ramp:1,0,0@0mm..40mm:0..1";
    let output = equipoise(&["--json", "inspect", path(&model), "--field", ramp]);
    assert_exit(&output, 0);
    let field = &json(&output)["field"];
    // 24 cm³ at a mean of one half and 1.2 g/cm³; the centre of a wedge.
    let close = |value: &serde_json::Value, want: f64| {
        let got = value.as_f64().unwrap();
        assert!((got - want).abs() < 1e-9 * want.abs(), "{got} {want}");
    };
    close(&field["mass_g"], 14.4);
    close(&field["mean_density_ratio"], 0.5);
    close(&field["body"]["center_mm"][0], 80.0 / 3.0);
    close(&field["body"]["center_mm"][1], 15.0);
    // About the long axis: m (b² + c²)/12, the least; the ramp changes only the other two.
    close(
        &field["body"]["principal_moments_g_mm2"][0],
        14.4 * 1300.0 / 12.0,
    );
    assert_eq!(field["mass_error_ratio"], 0.0);
    let output = equipoise(&[
        "inspect",
        path(&model),
        "--field",
        "sine:0,0,0@40mm:10%..90%",
    ]);
    assert_exit(&output, 0);
    let text = printed(&output);
    assert!(
        text.contains("with the field sine:0,0,0@40mm:10%..90%: "),
        "{text}"
    );
    assert!(
        text.contains("principal moments") && text.contains("error: at most"),
        "{text}"
    );
    // Massless: an answer.
    let output = equipoise(&["inspect", path(&model), "--field", "uniform:0"]);
    assert_exit(&output, 0);
    assert!(printed(&output).contains("no mass"), "{}", printed(&output));
}

#[test]
fn a_field_that_is_none_ends_with_2_a_place_and_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let model = write_cuboid(folder.path());
    let file = |name: &str, text: &str| {
        let file = folder.path().join(name);
        std::fs::write(&file, text).unwrap();
        path(&file).to_owned()
    };
    let steep = "[field]\nlinear = { at_origin = 0.0, gradient = [0.05, 0.0, 0.0] }\n";
    let misspelt = "[field]\nsun = [\"uniform:10%\"]\n";
    for (field, part) in [
        ("uniform:15".to_owned(), "write 15% or 0.15"),
        ("uniform:1.5".to_owned(), "from 0 to 1"),
        ("uniform:nan".to_owned(), "from 0 to 1"),
        ("ramp:0,0,1@0mm..9mm:0.5..0.5".to_owned(), "is not below"),
        ("wave:0.4".to_owned(), "is not a field"),
        ("nowhere.toml".to_owned(), "nowhere.toml"),
        (file("steep.toml", steep), "the field is 2.0000 at (40.00, "),
        (file("misspelt.toml", misspelt), "misspelt.toml:2:1: "),
    ] {
        let output = equipoise(&["inspect", path(&model), "--field", &field]);
        assert_exit(&output, 2);
        let text = printed(&output);
        assert!(
            text.contains(part) && text.contains("remedy"),
            "{field}: {text}"
        );
    }
    let line = format!("inspect {} --field", path(&model));
    assert_exit(&equipoise(&words(&line)), 2);
}
