//! Reads a kit that was written before and judges its files, without knowing how it was made.
//!
//! `cargo run --example read_a_kit -- FOLDER`; without a folder a small kit is made first.

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use std::path::{Path, PathBuf};

use equipoise::base::watch::Watch;
use equipoise::goal::{GoalKind, Request};
use equipoise::job::{Job, ModelChoice, PrinterChoice, Scaling};
use equipoise::kit::Existing;
use equipoise::prepare::{Outcome, prepare};
use equipoise::verify::verify_kit;

fn main() -> anyhow::Result<()> {
    let made = tempfile::tempdir()?;
    let folder = match std::env::args().nth(1) {
        Some(folder) => PathBuf::from(folder),
        None => make_kit(&made.path().join("kit"))?,
    };
    let judgement = verify_kit(&folder, &Watch::silent())?;
    for check in &judgement.checks {
        let verdict = if check.pass { "kept  " } else { "broken" };
        println!("{verdict} {}", check.kind);
    }
    println!("{:.1} g in all", judgement.assembly.mass_g);
    Ok(())
}

/// Makes a kit of the shipped model.
fn make_kit(folder: &Path) -> anyhow::Result<PathBuf> {
    let model = ModelChoice {
        path: "examples/models/tilted-ellipsoid.stl".into(),
        sha256: None,
        scaling: Scaling::Size("60mm".parse()?),
    };
    let printer = PrinterChoice {
        id: "objet-connex350".into(),
        material: None,
    };
    let job = Job::new(model, printer, Request::new(GoalKind::Top));
    match prepare(&job, &Watch::silent())? {
        Outcome::Prepared(prepared) => prepared.kit.write(folder, Existing::Keep)?,
        Outcome::Impossible(why) => anyhow::bail!("{}", why.reason),
    }
    Ok(folder.to_owned())
}
