//! Puts a model that is larger than the printer on a laser-cut base, and says what comes of it.
//!
//! `cargo run --release --example large_object -- examples/models/tilted-ellipsoid.stl`

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use equipoise::base::watch::Watch;
use equipoise::core_kit::prepare;
use equipoise::job::core_kit::{CoreGoal, CoreJob, CutChoice};
use equipoise::job::{ModelChoice, PrinterChoice, Scaling};
use equipoise::wing::Outcome;

fn main() -> anyhow::Result<()> {
    let usual = "examples/models/tilted-ellipsoid.stl".to_owned();
    let model = ModelChoice {
        path: std::env::args().nth(1).unwrap_or(usual).into(),
        sha256: None,
        scaling: Scaling::Size("400mm".parse()?),
    };
    let printer = PrinterChoice {
        id: "prusa-mk4".to_owned(),
        material: None,
    };
    let cutting = CutChoice::new("makerspace-900x600", "birch-3");
    let mut job = CoreJob::new(model, printer, cutting);
    // An ellipsoid stands on a point.
    job.goal = CoreGoal::None;
    match prepare(&job, &Watch::silent())? {
        Outcome::Prepared(prepared) => {
            let sheet = &prepared.checklist;
            println!(
                "{} panels on {} sheets, {} printed parts, {:.0} g; solid it would be {:.0} g",
                sheet.base.panels,
                sheet.cut_sheets.len(),
                sheet.parts.len(),
                sheet.mass_g,
                sheet.masses.if_solid_g
            );
            for check in &sheet.checks {
                println!(
                    "{} {}",
                    if check.pass { "kept" } else { "BROKEN" },
                    check.promise
                );
            }
        }
        Outcome::Impossible(why) => println!("{}", why.reason),
    }
    Ok(())
}
