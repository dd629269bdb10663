//! Runs the rows.

use std::path::{Path, PathBuf};
use std::time::Instant;

use equipoise::base::units::Length;
use equipoise::base::watch::Watch;
use equipoise::goal::{Request, Water};
use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
use equipoise::prepare::{Outcome, prepare};
use serde_json::Value;

use super::corpus::{CORPUS, Claim, Row};

/// Declares a test for each row.
macro_rules! rows {
    ($($name:ident)+) => {
        $(#[test]
        #[ignore = "takes minutes and needs the shared models"]
        fn $name() {
            run(stringify!($name));
        })+

        #[test]
        fn every_row_has_its_test() {
            let names = [$(stringify!($name)),+];
            let rows = CORPUS.row.iter().map(|row| row.name.as_str());
            assert_eq!(rows.collect::<Vec<_>>(), names);
        }
    };
}

rows! {
    homer_stands_on_filament
    fertility_spins_on_form3
    elephant_spins_on_filament
    homer_spins_on_filament
    heart_spins_on_filament
}

/// The shared model of a row; `None`, with a message, if it is not there.
fn find_model(row: &Row) -> Option<PathBuf> {
    let folder = std::env::var_os("EQUIPOISE_SOAK_MODELS");
    let path = folder.map(|folder| Path::new(&folder).join(&row.model));
    let found = path.filter(|path| path.is_file());
    if found.is_none() {
        eprintln!(
            "SKIPPED {}: no {} in EQUIPOISE_SOAK_MODELS",
            row.name, row.model
        );
    }
    found
}

/// Runs a row and checks what it claims.
fn run(name: &str) {
    let row = CORPUS.row.iter().find(|row| row.name == name).unwrap();
    let Some(path) = find_model(row) else {
        return;
    };
    let start = Instant::now();
    let outcome = prepare(&job(row, path), &Watch::silent()).unwrap();
    let Outcome::Prepared(prepared) = outcome else {
        panic!("{name}: the goal is impossible")
    };
    let sheet = serde_json::to_value(&prepared.checklist).unwrap();
    let without = joints_without_pins(&sheet);
    let joints = sheet["joints"].as_array().unwrap().len();
    let seconds = start.elapsed().as_secs_f64();
    let recorded = &row.recorded;
    eprintln!("{name} ({recorded}): {without} of {joints} joints lack pins, {seconds:.0} s");
    let found = row
        .claims
        .iter()
        .map(|claim| (claim, figure(&sheet, &claim.at)));
    let found: Vec<(&Claim, f64)> = found.collect();
    found
        .iter()
        .for_each(|(claim, value)| eprintln!("    {} {value}", claim.at));

    assert!(prepared.passes(), "{name}: a promise is broken");
    let most = row.joints_without_pins.unwrap_or(joints);
    assert!(without <= most, "{name}: {without} joints lack pins");
    for (Claim { at, least, most }, value) in found {
        let range = least.unwrap_or(f64::NEG_INFINITY)..=most.unwrap_or(f64::INFINITY);
        assert!(
            range.contains(&value),
            "{name}: {at} is {value}, not in {range:?}"
        );
    }
}

fn job(row: &Row, path: PathBuf) -> Job {
    let length = |mm: f64| Length::from_mm(mm).unwrap();
    let model = ModelChoice {
        path,
        sha256: Some(row.sha256.clone()),
        scaling: Scaling::Size(length(row.size_mm)),
    };
    let printer = PrinterChoice {
        id: row.printer.clone(),
        material: None,
    };
    // The rows were recorded without tips.
    let goal = Request::new(row.goal.parse().unwrap()).unpromised();
    let up = row.up.as_ref().map(|up| up.parse().unwrap());
    let contact = row.contact.as_ref().map(|contact| contact.parse().unwrap());
    let water = row.liquid.as_ref().map(|liquid| Water {
        liquid: liquid.parse().unwrap(),
        ..Water::default()
    });
    let goal = Request {
        up: up.unwrap_or(goal.up),
        contact: contact.or(goal.contact),
        water: water.or(goal.water),
        ..goal
    };
    Job {
        wall: row.wall_mm.map(length),
        pitch: Some(length(row.pitch_mm)),
        ..Job::new(model, printer, goal)
    }
}

/// Counts the joints that the sheet has a note about: they have not their two one-way pins.
fn joints_without_pins(sheet: &Value) -> usize {
    let joints = sheet["joints"].as_array().unwrap().iter();
    joints.filter(|joint| joint["note"].is_string()).count()
}

/// A number of the checklist, or the length of a list on it.
fn figure(sheet: &Value, pointer: &str) -> f64 {
    let found = sheet.pointer(pointer).unwrap_or(&Value::Null);
    let length = found.as_array().map(|list| list.len() as f64);
    found
        .as_f64()
        .or(length)
        .unwrap_or_else(|| panic!("{pointer} is missing"))
}
