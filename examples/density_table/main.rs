//! Prints how far sampled densities are from exact ones, and which infill can balance a rotor or
//! make a model stand.
//!
//! `cargo run --release --example density_table -- [--deep] MODEL...` prints for each model four
//! fields, sampled on octrees and on tetrahedra, against the exact masses. `--deep` goes to octrees
//! of depth 8. For a model whose name begins with `rocker-arm` it also prints the greatest infill
//! by size and shell. For one that begins with `humpty` it prints what makes it stand on its head.

#![allow(clippy::print_stdout, reason = "the table is the program's purpose")]

mod balance;
mod octree;
mod tetrahedra;

use std::env;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result};
use equipoise::base::watch::Watch;
use equipoise::field::{Density, Linear, Measured, Ramp, Sine, Uniform, measure};
use equipoise::geom::Vector;
use equipoise::io::read_model;
use equipoise::mass::{Body, Moments, moments_of_mesh};
use equipoise::mesh::{Solid, TriMesh};
use equipoise::repair::repair;

/// Longest side of the models whose fields are sampled, mm.
const SIZE_MM: f64 = 100.0;
/// The option for deep octrees.
const DEEP: &str = "--deep";
/// Depths of the octrees: cells a side are 2 to this power.
const DEPTHS: [u32; 7] = [2, 3, 4, 5, 6, 7, 8];
/// How many of them are shown without the option.
const USUAL_DEPTHS: usize = 5;
/// Edges of the sampled tetrahedra along the axes, mm. The last one with the option only: the
/// surface's cones are cut at hundreds of planes.
const EDGES_MM: [f64; 2] = [40.0, 20.0];
/// Fields that are linear are sampled without an error.
const LINEAR: [&str; 2] = ["uniform", "linear"];

fn main() -> Result<()> {
    let (options, models): (Vec<String>, Vec<String>) =
        env::args().skip(1).partition(|word| word == DEEP);
    let depths = match options.is_empty() {
        true => &DEPTHS[..USUAL_DEPTHS],
        false => &DEPTHS[..],
    };
    for model in models {
        let path = Path::new(&model);
        let name = path
            .file_stem()
            .context("a model has a name")?
            .to_string_lossy();
        let mesh = repair(read_model(path)?, &Watch::silent())?.0;
        let longest_mm = mesh.longest_side_mm();
        let sized = |size_mm: f64| mesh.map_vertices(|p| p * (size_mm / longest_mm));
        println!("\n## {name}, {} faces\n", mesh.triangles().len());
        print_sampled(&sized(SIZE_MM), depths)?;
        if name.starts_with("rocker-arm") {
            balance::print_rocker_arms(&sized(1.0))?;
            balance::print_families(&balance::rotor(&sized(SIZE_MM))?);
        }
        if name.starts_with("humpty") {
            balance::print_families(&balance::on_its_head(&sized(SIZE_MM))?);
        }
    }
    Ok(())
}

/// A field with its name.
struct Named {
    name: &'static str,
    field: Box<dyn Density>,
}

/// Returns four fields about the middle of a mesh.
fn fields(mesh: &TriMesh) -> Vec<Named> {
    let center = moments_of_mesh(mesh).centroid();
    let direction = Vector::new(1.0, 2.0, 2.0) / 3.0;
    let middle = direction.dot(&center.coords);
    let line = Linear {
        at_origin: 0.5 - 0.004 * middle,
        gradient: direction * 0.004,
    };
    let ramp = Ramp::new(&direction, [middle - 10.0, middle + 10.0], [0.2, 1.0]);
    let wave = Sine::new(center + Vector::new(10.0, -14.0, 26.0), 40.0, [0.0, 1.0]);
    let named = |name: &'static str, field: Box<dyn Density>| Named { name, field };
    let mut fields = vec![
        named("uniform", Box::new(Uniform(1.0))),
        named("linear", Box::new(line)),
    ];
    fields.extend(ramp.map(|ramp| named("ramp", Box::new(ramp))));
    fields.extend(wave.map(|wave| named("sine", Box::new(wave))));
    fields
}

/// Prints the errors of sampled fields: mass, centre, and principal moments.
fn print_sampled(mesh: &TriMesh, depths: &[u32]) -> Result<()> {
    println!("| field | sampled | nodes | s | ε_M | ε_C mm | ε_Θ |");
    println!("|---|---|---|---|---|---|---|");
    let fields = fields(mesh);
    let measured = |field: &Named| measure(mesh, field.field.as_ref());
    let timed = |field: &Named| {
        let start = Instant::now();
        let Measured { moments, .. } = measured(field);
        (moments, start.elapsed().as_secs_f64())
    };
    let exact: Vec<(Moments, f64)> = fields.iter().map(timed).collect();
    for (field, (_, seconds)) in fields.iter().zip(&exact) {
        println!("| {} | exact | | {seconds:.4} | | | |", field.name);
    }
    let solid = Solid::new(mesh.clone())?;
    for depth in depths {
        let start = Instant::now();
        let tree = octree::Octree::of(&solid, *depth);
        let built_s = start.elapsed().as_secs_f64();
        for (field, (exact, _)) in fields.iter().zip(&exact) {
            let start = Instant::now();
            let found = tree.moments(field.field.as_ref());
            let row = Row {
                how: format!("octree, depth {depth}"),
                nodes: tree.nodes(),
                seconds: built_s + start.elapsed().as_secs_f64(),
            };
            row.print(field, &found, exact);
        }
    }
    let edges_mm = &EDGES_MM[..if depths.len() > USUAL_DEPTHS { 2 } else { 1 }];
    for edge_mm in edges_mm {
        let curved = fields.iter().zip(&exact);
        for (field, (exact, _)) in curved.filter(|(field, _)| !LINEAR.contains(&field.name)) {
            let lattice = tetrahedra::Lattice::new(field.field.as_ref(), mesh, *edge_mm);
            let start = Instant::now();
            let found = measure(mesh, &lattice).moments;
            let row = Row {
                how: format!("tetrahedra, {edge_mm} mm"),
                nodes: lattice.tetrahedra(),
                seconds: start.elapsed().as_secs_f64(),
            };
            row.print(field, &found, exact);
        }
    }
    Ok(())
}

/// A row of the table.
struct Row {
    how: String,
    nodes: usize,
    seconds: f64,
}

impl Row {
    fn print(&self, field: &Named, found: &Moments, exact: &Moments) {
        let [mass, center, principal] = errors(found, exact);
        let Self {
            how,
            nodes,
            seconds,
        } = self;
        println!(
            "| {} | {how} | {nodes} | {seconds:.3} | {mass:.1e} | {center:.4} | {principal:.1e} |",
            field.name
        );
    }
}

/// Returns the errors of mass (a share), centre (mm) and principal moments (a share).
fn errors(found: &Moments, exact: &Moments) -> [f64; 3] {
    let principal =
        |moments: &Moments| Vector::from(Body::new(moments, 1.0).principal().moments_g_mm2);
    let tensor = principal(found) - principal(exact);
    [
        (found.volume() / exact.volume() - 1.0).abs(),
        (found.centroid() - exact.centroid()).norm(),
        tensor.norm() / principal(exact).norm(),
    ]
}
