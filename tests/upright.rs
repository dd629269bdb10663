//! The natural up of figures and vessels from outside, however their files are turned.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a skipped test says so")]
#![allow(clippy::print_stdout, reason = "a long run reports its figures")]

use crate::common;

use std::collections::BTreeMap;
use std::path::Path;

use equipoise::base::watch::Watch;
use equipoise::geom::{Matrix, Point, Vector};
use equipoise::goal::{Up, find_upright};
use equipoise::io::{read_model, stl};
use equipoise::mesh::{Csg, Solid};
use equipoise::repair::repair;
use serde::Deserialize;

/// The least lead over the second best pose. Rounding and the phase of samples move a lead by 0.03.
const LEAST_LEAD: f64 = 0.08;

/// The up that a person gave a model.
#[derive(Deserialize)]
struct Known {
    file: String,
    up: String,
    up_vector: Option<[f64; 3]>,
}

/// The greatest angle at which an answer is right, degrees. The known ups are axes of files, given
/// by eye.
const RIGHT_DEG: f64 = 10.0;

impl Known {
    fn up(&self) -> Vector {
        let axis = self.up.parse::<Up>().unwrap().direction().unwrap();
        self.up_vector
            .map_or(axis, |vector| Vector::from(vector).normalize())
    }
}

/// Returns the models with a known up; empty if they are not there.
fn known() -> BTreeMap<String, Known> {
    let list = common::shared_folder().join("faces.toml");
    let Ok(text) = std::fs::read_to_string(&list) else {
        eprintln!("SKIPPED: there is no {}", list.display());
        return BTreeMap::new();
    };
    toml::from_str(&text).unwrap()
}

fn read(path: &Path) -> Solid {
    Solid::new(
        repair(read_model(path).unwrap(), &Watch::silent())
            .unwrap()
            .0,
    )
    .unwrap()
}

/// Returns the turns that map the axes to axes.
fn axis_turns() -> Vec<Matrix> {
    let axes = [Vector::x(), Vector::y(), Vector::z()];
    let signed: Vec<Vector> = axes.iter().flat_map(|axis| [*axis, -*axis]).collect();
    let pairs = signed
        .iter()
        .flat_map(|x| signed.iter().map(move |y| (x, y)));
    let across = pairs.filter(|(x, y)| x.dot(y) == 0.0);
    across
        .map(|(x, y)| Matrix::from_columns(&[*x, *y, x.cross(y)]))
        .collect()
}

/// Returns three turns about no axis in particular, by Rodrigues' formula.
fn odd_turns() -> Vec<Matrix> {
    let turns = [
        ([1.0, 2.0, 3.0], 0.7),
        ([-2.0, 0.3, 1.1], 2.1),
        ([0.4, -1.7, 0.9], -1.3),
    ];
    let turn = |(axis, angle): ([f64; 3], f64)| {
        let cross = Vector::from(axis).normalize().cross_matrix();
        Matrix::identity() + cross * angle.sin() + cross * cross * (1.0 - angle.cos())
    };
    turns.into_iter().map(turn).collect()
}

fn turned(solid: &Solid, turn: &Matrix) -> Solid {
    Solid::new(solid.mesh().map_vertices(|p| turn * p)).unwrap()
}

/// Asserts that the natural up of the models of these files, or of all, is found by a lead however
/// they are turned.
fn assert_found(files: Option<&[&str]>, turns: &[Matrix]) {
    let is_asked = |known: &Known| files.is_none_or(|files| files.contains(&known.file.as_str()));
    for (name, known) in known().iter().filter(|(_, known)| is_asked(known)) {
        let solid = read(&common::shared_folder().join(&known.file));
        let (mut least_lead, mut most_deg) = (f64::INFINITY, 0.0_f64);
        for turn in turns {
            let found = find_upright(&turned(&solid, turn), &Watch::silent()).unwrap();
            let off_deg = (turn * known.up()).angle(&found[0].up).to_degrees();
            assert!(off_deg <= RIGHT_DEG, "{name} is {off_deg}° off: {found:#?}");
            (least_lead, most_deg) = (least_lead.min(found[0].lead), most_deg.max(off_deg));
        }
        println!("{name}: leads by {least_lead:.2}, {most_deg:.1}° off");
        assert!(least_lead >= LEAST_LEAD, "{name} leads by {least_lead}");
    }
}

#[test]
fn the_natural_up_turns_with_the_model() {
    let mut turns = vec![Matrix::identity()];
    turns.extend(odd_turns());
    assert_found(None, &turns);
}

#[test]
fn the_axes_of_the_file_do_not_matter() {
    let small = [
        "knight.stl",
        "cow.stl",
        "teapot.obj",
        "bunny.stl",
        "cheburashka.obj",
    ];
    assert_found(Some(&small), &axis_turns());
}

#[test]
#[ignore = "a minute of the same on larger models"]
fn the_axes_of_no_file_matter() {
    assert_found(None, &axis_turns());
}

#[test]
fn a_kit_without_an_ordered_up_says_which_way_was_taken_and_what_to_type_for_another() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("boat");
    let sheet = common::make_kit(&kit, "--wall 1.5mm --goal float --liquid seawater");
    let choice = sheet["goal"]["choice"].as_str().unwrap();
    assert!(choice.contains("was taken as the natural up"), "{choice}");
    // The ellipsoid is as good upside down.
    assert!(choice.contains("About as likely is `"), "{choice}");
    let job = std::fs::read_to_string(kit.join("job.toml")).unwrap();
    assert!(job.contains("up = \"natural\""), "{job}");
    let axis: Vec<f64> = serde_json::from_value(sheet["goal"]["axis"].clone()).unwrap();
    assert!(axis.iter().all(|part| part.is_finite()));
}

#[test]
fn a_model_on_a_point_is_told_which_up_to_try() {
    let folder = tempfile::tempdir().unwrap();
    let model = folder.path().join("cone.stl");
    let ring = (0..24).map(|i| (std::f64::consts::TAU * f64::from(i) / 24.0).sin_cos());
    let ring = ring.map(|(sin, cos)| Point::new(20.0 * cos, 20.0 * sin, 40.0));
    let points: Vec<Point> = ring.chain([Point::origin()]).collect();
    let cone = Csg::convex_hull(&points).unwrap().to_mesh().unwrap();
    std::fs::write(&model, stl::encode(&cone, "cone")).unwrap();
    let usual = "--json prepare --printer objet-connex350 --goal stand --up z --out";
    let mut line = common::words(usual);
    let out = folder.path().join("kit");
    line.extend([common::path(&out), common::path(&model)]);
    let refused = common::equipoise(&line);
    common::assert_exit(&refused, 2);
    let said = common::printed(&refused);
    assert!(
        said.contains("with z up") && said.contains("try --up=-z"),
        "{said}"
    );
}
