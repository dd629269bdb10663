//! Prints how near telescopes come to curves, and how many shells walls leave room for.
//!
//! `cargo run --release --example telescope_table -- MODEL` prints two tables. The first is of
//! Viviani's curve, a sine and a trefoil knot. It has the deviation of chains whose shells have
//! a torsion of their own, and of chains that only turn between shells. That is Fig. 7 of Yu,
//! Crane and Coros (2017). The second is of a model at 300 mm on three printers: its shells by
//! the wall (Fig. 10). Without a model the second is left out.

#![allow(clippy::print_stdout, reason = "the tables are the program's purpose")]

use std::env;
use std::f64::consts::{PI, TAU};

use anyhow::Result;
use equipoise::base::units::Length;
use equipoise::base::watch::Watch;
use equipoise::curve::{Curve, FitRequest, Freedom, fit};
use equipoise::geom::Point;
use equipoise::job::telescope::TelescopeJob;
use equipoise::job::{PrinterChoice, Scaling};
use equipoise::sheet::network::AnyTelescopeSheet;
use equipoise::telescope::prepare;
use equipoise::wing::Outcome;

/// Numbers of shells of the first table.
const SHELLS: [usize; 4] = [4, 6, 8, 12];
/// Points of a curve.
const EDGES: u32 = 3000;
/// The greatest curvature and torsion of a fit to a curve of 300 mm, 1/mm.
const USUAL_BOUNDS: [f64; 2] = [0.04, 0.02];
/// The same for the trefoil of 900 mm, whose root would be 14 mm in radius.
const TREFOIL_BOUNDS: [f64; 2] = [0.75 / 14.0, 0.01];

/// A curve to fit shells to.
struct Row {
    name: &'static str,
    length_mm: f64,
    /// The greatest curvature and torsion, 1/mm.
    bounds: [f64; 2],
    curve: Curve,
}

/// The longest side of the model, mm.
const SIZE_MM: f64 = 300.0;
/// The printers of the second table.
const PRINTERS: [&str; 3] = ["formlabs-form4", "formlabs-fuse1", "prusa-mk4"];
/// The walls of the second table, mm.
const WALLS_MM: [f64; 3] = [1.0, 1.5, 2.0];

fn main() -> Result<()> {
    print_fits()?;
    if let Some(model) = env::args().nth(1) {
        print_walls(&model)?;
    }
    Ok(())
}

/// Prints the rms deviations of chains with and without torsion.
fn print_fits() -> Result<()> {
    println!(
        "| curve | length | shells | own torsion | turns alone | one curvature, turns alone |"
    );
    println!("| --- | --- | --- | --- | --- | --- |");
    for row in curves()? {
        let (name, length_mm) = (row.name, row.length_mm);
        let curve = row.curve.scaled_to(length_mm);
        let [most_curvature, most_torsion] = row.bounds;
        for shells in SHELLS {
            let rms_mm = |curvature, torsion| -> Result<f64> {
                let request = FitRequest {
                    curvature,
                    torsion,
                    ..FitRequest::new(shells, most_curvature, most_torsion)
                };
                Ok(fit(&curve, &request)?.deviation.rms_mm)
            };
            let own = rms_mm(Freedom::Each, Freedom::Each)?;
            let turns = rms_mm(Freedom::Each, Freedom::Zero)?;
            let one = rms_mm(Freedom::One, Freedom::Zero)?;
            println!(
                "| {name} | {length_mm:.0} mm | {shells} | {own:.2} mm | {turns:.2} mm | {one:.2} mm |"
            );
        }
    }
    Ok(())
}

/// Returns the curves.
fn curves() -> Result<Vec<Row>> {
    Ok(vec![
        Row {
            name: "Viviani",
            length_mm: 300.0,
            bounds: USUAL_BOUNDS,
            curve: sampled(-0.95 * PI, 0.95 * PI, |t| {
                [1.0 + t.cos(), t.sin(), 2.0 * (0.5 * t).sin()]
            })?,
        },
        Row {
            name: "sine",
            length_mm: 300.0,
            bounds: USUAL_BOUNDS,
            curve: sampled(0.0, TAU, |t| [t, t.sin(), 0.0])?,
        },
        Row {
            name: "trefoil",
            length_mm: 900.0,
            bounds: TREFOIL_BOUNDS,
            curve: sampled(0.25, TAU - 0.25, |t| {
                [
                    t.sin() + 2.0 * (2.0 * t).sin(),
                    t.cos() - 2.0 * (2.0 * t).cos(),
                    -(3.0 * t).sin(),
                ]
            })?,
        },
    ])
}

fn sampled(from: f64, to: f64, at: impl Fn(f64) -> [f64; 3]) -> Result<Curve> {
    let share = |i: u32| f64::from(i) / f64::from(EDGES);
    let points = (0..=EDGES).map(|i| Point::from(at(from + (to - from) * share(i))));
    Ok(Curve::of_polyline(points.collect())?)
}

/// Prints the shells of a model by the wall.
fn print_walls(model: &str) -> Result<()> {
    println!();
    println!("| printer | wall | limbs | shells | all in | all out |");
    println!("| --- | --- | --- | --- | --- | --- |");
    for printer in PRINTERS {
        for wall_mm in WALLS_MM {
            println!(
                "| {printer} | {wall_mm} mm | {} |",
                shells(model, printer, wall_mm)?
            );
        }
    }
    Ok(())
}

/// Returns the limbs, the shells and the boxes of a model's telescopes, as cells of a table.
fn shells(model: &str, printer: &str, wall_mm: f64) -> Result<String> {
    let printer = PrinterChoice {
        id: printer.to_owned(),
        material: None,
    };
    let scaling = Scaling::Size(Length::from_mm(SIZE_MM)?);
    let job = TelescopeJob {
        wall: Some(Length::from_mm(wall_mm)?),
        ..TelescopeJob::new(model, scaling, printer)
    };
    let sheet = match prepare(&job, &Watch::silent())? {
        Outcome::Prepared(prepared) => prepared.checklist,
        Outcome::Impossible(why) => return Ok(format!("none: {} | | |", why.reason)),
    };
    let AnyTelescopeSheet::Network(sheet) = sheet else {
        return Ok("a curve | | |".to_owned());
    };
    let counts: Vec<String> = sheet
        .limbs
        .iter()
        .map(|limb| limb.sheet.shells.len().to_string())
        .collect();
    let size = |size: [f64; 3]| size.map(|mm| format!("{mm:.0}")).join(" × ") + " mm";
    Ok(format!(
        "{} | {} | {} | {}",
        counts.len(),
        counts.join(" + "),
        size(sheet.collapsed_mm),
        size(sheet.extended_mm)
    ))
}
