//! Prints how much of a model the base of a large object fills, and how long it takes to find.
//!
//! `cargo run --release --example core_table -- MODELS` reads the models of the reference from a
//! folder. They are made 600 mm long, and polyhedra keep 5 mm from their surface. Three tables come
//! of it: one polyhedron without and with the limits of joints, two polyhedra, and growing planes
//! beside the paper's moving vertices. A model that is not in the folder is left out. Seconds are
//! processor time of all threads.

#![allow(clippy::print_stdout, reason = "the tables are the program's purpose")]

mod methods;
mod processor;

use std::env;
use std::path::Path;

use anyhow::{Context, Result, bail};
use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::io::read_model;
use equipoise::mesh::Solid;
use equipoise::polyhedra::{
    BasePlan, ConnectorRequest, Count, Ground, Limits, Polyhedron, Request, Several,
    grow_polyhedra, grow_polyhedron,
};
use equipoise::repair::repair;
use processor::timed;

/// The longest side of the models, mm.
const SIZE_MM: f64 = 600.0;
/// The distance from the surface, mm.
const DISTANCE_MM: f64 = 5.0;
/// The thickness of the sheet and the heads of its screws, mm, where limits are kept.
const SHEET_MM: f64 = 5.0;
/// The sides of the largest panel, mm.
const ROOM_MM: [f64; 2] = [890.0, 590.0];

/// A model of the reference, and the shares of its volume that are held against.
struct Row {
    file: &'static str,
    /// The share that a prototype filled with one polyhedron of 12 faces.
    one: f64,
    /// The share that two must fill; `None` if they are not asked.
    two: Option<f64>,
}

const fn row(file: &'static str, one: f64) -> Row {
    Row {
        file,
        one,
        two: None,
    }
}

const ROWS: [Row; 6] = [
    Row {
        two: Some(0.55),
        ..row("bunny.stl", 0.473)
    },
    Row {
        two: Some(0.37),
        ..row("homer.obj", 0.293)
    },
    row("humpty.obj", 0.406),
    row("elephant.obj", 0.229),
    row("fertility.stl", 0.175),
    row("cheburashka.obj", 0.197),
];

fn main() -> Result<()> {
    let folder = env::args()
        .nth(1)
        .context("usage: core_table MODELS, the folder with the models")?;
    let mut grounds = Vec::new();
    for row in &ROWS {
        let path = Path::new(&folder).join(row.file);
        if path.is_file() {
            grounds.push((row, ground(&path)?));
        }
    }
    if grounds.is_empty() {
        bail!("none of the models is in {folder}");
    }
    print_one(&grounds)?;
    print_two(&grounds)?;
    methods::print(&grounds)
}

/// Reads a model at the size of the tables.
fn ground(path: &Path) -> Result<Ground> {
    let mesh = repair(read_model(path)?, &Watch::silent())?.0;
    let factor = SIZE_MM / mesh.longest_side_mm();
    let solid = Solid::new(mesh.map_vertices(|p| p * factor))?;
    Ground::new(&solid).context("the rounded model bounds no solid")
}

/// Returns the order without the limits of joints and sheets.
fn without_limits() -> Request {
    Request::new(DISTANCE_MM, Limits::NONE)
}

fn with_limits() -> Request {
    Request::new(DISTANCE_MM, Limits::for_sheet(SHEET_MM, SHEET_MM, ROOM_MM))
}

fn grown(ground: &Ground, request: &Request) -> Result<(Polyhedron, f64)> {
    timed(
        || match grow_polyhedron(ground, request, &Watch::silent())? {
            Verdict::Found(polyhedron) => Ok(polyhedron),
            Verdict::No(why) => bail!("{why}"),
        },
    )
}

fn print_one(grounds: &[(&Row, Ground)]) -> Result<()> {
    println!("\n## One polyhedron of at most 12 faces\n");
    println!(
        "| model | reference | without limits | of it | s | with limits | of it | limits broken | s |"
    );
    println!("|---|---|---|---|---|---|---|---|---|");
    for (row, ground) in grounds {
        let share = |polyhedron: &Polyhedron| polyhedron.volume_mm3() / ground.volume_mm3();
        let (free, free_s) = grown(ground, &without_limits())?;
        let (bound, bound_s) = grown(ground, &with_limits())?;
        let breaches = bound.breaches().iter();
        let mut kinds: Vec<String> = breaches.map(|breach| breach.kind.to_string()).collect();
        kinds.sort();
        kinds.dedup();
        println!(
            "| {} | {} | {:.3} | {:.3} | {free_s:.1} | {:.3} | {:.3} | {} | {bound_s:.1} |",
            row.file,
            row.one,
            share(&free),
            share(&free) / row.one,
            share(&bound),
            share(&bound) / row.one,
            if kinds.is_empty() {
                "none".to_owned()
            } else {
                kinds.join(", ")
            },
        );
    }
    Ok(())
}

fn print_two(grounds: &[(&Row, Ground)]) -> Result<()> {
    println!("\n## Two polyhedra without limits\n");
    println!("| model | asked | found | disc, mm | s |");
    println!("|---|---|---|---|---|");
    for (row, ground) in grounds {
        let Some(asked) = row.two else { continue };
        let (plan, seconds) = timed(|| two(ground))?;
        let share = plan.volume_mm3() / ground.volume_mm3();
        let discs = plan.connections.iter();
        let disc_mm = discs.map(|joint| joint.radius_mm).fold(0.0, f64::max);
        println!(
            "| {} | {asked} | {share:.3} | {disc_mm:.0} | {seconds:.1} |",
            row.file
        );
    }
    Ok(())
}

fn two(ground: &Ground) -> Result<BasePlan> {
    let several = Several {
        count: Count::Exactly(2),
        connector: ConnectorRequest {
            radius_mm: 20.0,
            gap_mm: 1.0,
            rods: None,
        },
    };
    match grow_polyhedra(ground, &without_limits(), &several, &Watch::silent())? {
        Verdict::Found(plan) => Ok(plan),
        Verdict::No(why) => bail!("{why:?}"),
    }
}
