//! Every remedy that is printed for an impossible goal makes a kit that keeps its promises.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test whose input cannot be had has failed, and the table is shown with --nocapture"
)]

use crate::common;

use std::path::{Path, PathBuf};

use common::{ELLIPSOID, QUICK, assert_exit, equipoise, json, list, path, printed, words};
use rayon::prelude::*;
use serde_json::Value;

/// The acceptance table.
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/.ci/models");

/// Returns what to type for a setting of a remedy.
fn flag(setting: &Value) -> (String, String) {
    let key = setting["key"].as_str().unwrap().replace('_', "-");
    (
        format!("--{key}"),
        setting["value"].as_str().unwrap().to_owned(),
    )
}

/// Returns the options with those of a remedy in place of their own.
fn with_remedy(options: &[&str], remedy: &Value) -> Vec<String> {
    let mut all: Vec<String> = options.iter().map(ToString::to_string).collect();
    for (name, value) in list(remedy, "settings").iter().map(flag) {
        let is_it = |word: &String| *word == name || word.starts_with(&format!("{name}="));
        if let Some(at) = all.iter().position(is_it) {
            let words = if all[at] == name { 2 } else { 1 };
            all.drain(at..at + words);
        }
        all.push(format!("{name}={value}"));
    }
    all
}

/// Types every remedy that is offered for an impossible order; returns those that make no kit.
fn failures(model: &Path, options: &[&str]) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let run = |kit: &str, options: &[&str]| {
        let kit = folder.path().join(kit);
        let start = ["--json", "prepare", path(model), "--out", path(&kit)];
        equipoise(&[&start[..], options].concat())
    };
    let refused = run("none", options);
    assert_exit(&refused, 1);
    let told = json(&refused);
    let remedies = list(&told, "remedies").iter();
    let offered: Vec<&Value> = remedies
        .filter(|one| one["confirmed"].is_object())
        .collect();
    println!("{}: {} remedies", model.display(), offered.len());
    let try_one = |(index, remedy): (usize, &&Value)| {
        assert!(
            !list(remedy, "settings").is_empty(),
            "nothing to type: {remedy:#}"
        );
        let typed = with_remedy(options, remedy);
        let typed: Vec<&str> = typed.iter().map(String::as_str).collect();
        let output = run(&format!("kit{index}"), &typed);
        let line = typed.join(" ");
        println!("  exit {:?}: {line}", output.status.code());
        (output.status.code() != Some(0)).then(|| format!("{line}: {}", printed(&output)))
    };
    let all = offered.par_iter().enumerate();
    all.filter_map(try_one).collect()
}

#[test]
#[ignore = "long: 15 s; run with -- --ignored"]
fn every_remedy_for_a_wall_that_is_too_thick_makes_a_kit() {
    let options = format!("{QUICK} --goal top --up z --wall 12mm");
    let failed = failures(Path::new(ELLIPSOID), &words(&options));
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn ballast_that_was_just_refused_is_not_offered_again() {
    let folder = tempfile::tempdir().unwrap();
    let kit = folder.path().join("kit");
    let options = format!("{QUICK} --goal top --up z --wall 12mm --ballast ball-2x1");
    let start = ["--json", "prepare", ELLIPSOID, "--out", path(&kit)];
    let output = equipoise(&[&start[..], &words(&options)].concat());
    let told = json(&output);
    let is_ballast = |remedy: &Value| remedy["kind"] == "least-ballast";
    assert!(!list(&told, "remedies").iter().any(is_ballast), "{told:#}");
}

/// A row of the acceptance table: its name, its model and its options.
struct Row {
    name: String,
    model: PathBuf,
    options: String,
}

/// Returns the rows of the acceptance table that end with a proof.
fn impossible_rows() -> Vec<Row> {
    let table = std::fs::read_to_string(TABLE).unwrap();
    let usual = table.lines().find_map(|line| line.strip_prefix("usual="));
    let usual = usual.unwrap().trim_matches('"').to_owned();
    let folder = common::shared_folder();
    let row = |line: &str| {
        let line = line.strip_prefix("case_ no-")?.replace("$usual", &usual);
        let [name, _, model, options @ ..] = &words(&line)[..] else {
            return None;
        };
        Some(Row {
            name: (*name).to_owned(),
            model: folder.join(model),
            options: format!("--printer objet-connex350 {}", options.join(" ")),
        })
    };
    table.lines().filter_map(row).collect()
}

/// Run it with --nocapture. `EQUIPOISE_SHARED_MODELS` names the folder of models, and
/// `EQUIPOISE_ROWS` the rows by parts of their names, between commas.
#[test]
#[ignore = "takes half an hour, and needs models that are not part of the project"]
fn every_remedy_on_the_acceptance_table_makes_a_kit() {
    let asked = std::env::var("EQUIPOISE_ROWS").unwrap_or_default();
    let mut failed = Vec::new();
    for row in impossible_rows() {
        let is_asked = asked.split(',').any(|part| row.name.contains(part));
        if !is_asked {
            continue;
        }
        if !row.model.is_file() {
            println!("SKIPPED {}: {} is not there", row.name, row.model.display());
            continue;
        }
        failed.extend(failures(&row.model, &words(&row.options)));
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}
