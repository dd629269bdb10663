//! Prints how far sampled densities are from exact ones, and which infill can balance a rotor.
//!
//! `cargo run --release --example density_table -- MODEL...` prints for each model four fields on
//! octrees of several depths against the exact masses. For a model whose name begins with
//! `rocker-arm` it also prints the greatest infill by size and shell.

#![allow(clippy::print_stdout, reason = "the table is the program's purpose")]

use std::env;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result};
use equipoise::base::watch::Watch;
use equipoise::field::{Density, Linear, Ramp, Sine, Uniform, measure};
use equipoise::geom::{Frame, Matrix, Point, Quadric, Vector};
use equipoise::hollow::{Graded, Row, greatest_low};
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mass::{Body, Moments, moments_of_mesh};
use equipoise::mesh::{Solid, TriMesh, WindingNumbers};
use equipoise::repair::repair;
use equipoise::shell::Shell;

/// Longest side of the models on octrees, mm.
const SIZE_MM: f64 = 100.0;
/// Depths of the octrees: cells a side are 2 to this power.
const DEPTHS: [u32; 5] = [2, 3, 4, 5, 6];
/// Winding number above which a point is inside.
const INSIDE: f64 = 0.5;
/// Sizes and walls of the rocker arm, mm.
const ROCKER_ARMS: [[f64; 2]; 6] = [
    [62.9, 0.45],
    [62.9, 0.8],
    [100.0, 0.8],
    [100.0, 1e-4],
    [150.0, 0.8],
    [200.0, 0.8],
];
/// Columns along the rocker arm.
const COLUMNS: f64 = 200.0;

fn main() -> Result<()> {
    for model in env::args().skip(1) {
        let path = Path::new(&model);
        let name = path
            .file_stem()
            .context("a model has a name")?
            .to_string_lossy();
        let mesh = repair(read_model(path)?, &Watch::silent())?.0;
        println!("\n## {name}\n");
        let longest_mm = mesh.longest_side_mm();
        print_octrees(&mesh.map_vertices(|p| p * (SIZE_MM / longest_mm)));
        if name.starts_with("rocker-arm") {
            print_rocker_arms(&mesh.map_vertices(|p| p / longest_mm))?;
        }
    }
    Ok(())
}

/// Returns four fields about the middle of a mesh, with their names.
fn fields(mesh: &TriMesh) -> Vec<(&'static str, Box<dyn Density>)> {
    let center = moments_of_mesh(mesh).centroid();
    let direction = Vector::new(1.0, 2.0, 2.0) / 3.0;
    let middle = direction.dot(&center.coords);
    let line = Linear {
        at_origin: 0.5 - 0.004 * middle,
        gradient: direction * 0.004,
    };
    let ramp = Ramp::new(&direction, [middle - 10.0, middle + 10.0], [0.2, 1.0]);
    let wave = Sine::new(center + Vector::new(10.0, -14.0, 26.0), 40.0, [0.0, 1.0]);
    let mut fields: Vec<(&str, Box<dyn Density>)> = vec![
        ("uniform", Box::new(Uniform(1.0))),
        ("linear", Box::new(line)),
    ];
    fields.extend(ramp.map(|ramp| ("ramp", Box::new(ramp) as Box<dyn Density>)));
    fields.extend(wave.map(|wave| ("sine", Box::new(wave) as Box<dyn Density>)));
    fields
}

/// Prints the errors of octrees with one sample a cell: mass, centre, and principal moments.
fn print_octrees(mesh: &TriMesh) {
    println!("| field | depth | cells | s | mass error | centre error mm | moment error |");
    println!("|---|---|---|---|---|---|---|");
    let inside = WindingNumbers::new(mesh.iter_corners());
    for (name, field) in fields(mesh) {
        let start = Instant::now();
        let exact = measure(mesh, field.as_ref()).moments;
        println!(
            "| {name} | exact | | {:.4} | | | |",
            start.elapsed().as_secs_f64()
        );
        for depth in DEPTHS {
            let start = Instant::now();
            let (moments, cells) = octree(mesh, field.as_ref(), &inside, depth);
            let [mass, center, principal] = errors(&moments, &exact);
            println!(
                "| {name} | {depth} | {cells} | {:.3} | {mass:.1e} | {center:.3} | {principal:.1e} |",
                start.elapsed().as_secs_f64()
            );
        }
    }
}

/// Returns the moments by the cells of the finest depth whose middle is inside, and their number.
fn octree(
    mesh: &TriMesh,
    field: &dyn Density,
    inside: &WindingNumbers,
    depth: u32,
) -> (Moments, usize) {
    let count = 1_usize << depth;
    let side_mm = mesh.longest_side_mm() / count as f64;
    let start = mesh.aabb().center() - Vector::repeat(0.5 * side_mm * (count as f64 - 1.0));
    let (mut sum, mut cells) = (Moments::default(), 0);
    for index in 0..count.pow(3) {
        let place = [index % count, index / count % count, index / count / count];
        let at = start + Vector::from(place.map(|i| i as f64 * side_mm));
        if inside.at(&at) > INSIDE {
            let mut cell = Moments(Moments::monomials(at.x, at.y, at.z));
            cell.0[7..]
                .iter_mut()
                .for_each(|square| *square += side_mm * side_mm / 12.0);
            sum += cell * (field.at(&at) * side_mm.powi(3));
            cells += 1;
        }
    }
    (sum, cells)
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

/// Prints the greatest infill with which the rocker arm can be balanced, by size and shell.
fn print_rocker_arms(unit: &TriMesh) -> Result<()> {
    println!("\n| size mm | wall mm | static | dynamic | gap |\n|---|---|---|---|---|");
    for [size_mm, wall_mm] in ROCKER_ARMS {
        let solid = Solid::new(unit.map_vertices(|p| p * size_mm))?;
        let axis = Frame {
            origin: Point::new(0.0, 0.0669 * size_mm, 0.0850 * size_mm),
            axes: Matrix::new(0., 0., 1., 1., 0., 0., 0., 1., 0.),
        };
        let solid_moments = moments_of_mesh(solid.mesh());
        // No level set of a balanced rotor is upright in a tilted frame.
        let frame = Frame::with_axis(solid_moments.centroid(), &Vector::new(0.35, -0.42, 0.84));
        let shell = Shell::new(&solid, &frame, wall_mm, &[])?;
        let columns = Columns::of_shell(&shell, [size_mm / COLUMNS; 2], &Watch::silent())?;
        let shell = solid_moments.in_frame(&frame) - columns.moments();
        let row = |index: usize| {
            let one = Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
            Row::zero(one.in_frame(&axis.inverse()).in_frame(&frame))
        };
        let rows = [1, 2, 6, 5].map(row);
        let low = |rows| {
            let columns = &columns;
            greatest_low(
                &Graded {
                    shell,
                    columns,
                    rows,
                },
                1.0,
            )
        };
        let (still, turning) = (low(&rows[..2]), low(&rows));
        let (a, b, gap) = (still.density, turning.density, turning.gap);
        println!("| {size_mm} | {wall_mm} | {a:.3} | {b:.3} | {gap:.1e} |");
    }
    Ok(())
}
