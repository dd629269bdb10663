//! Hollows a mesh so that it spins as a top: from a file to the bodies of air inside it.
//!
//! `cargo run --example hollow_a_mesh -- examples/models/tilted-ellipsoid.stl`

#![allow(clippy::print_stdout, reason = "an example prints what it found")]

use equipoise::base::watch::Watch;
use equipoise::goal::{GoalKind, Request, place};
use equipoise::hollow::{Problem, Settings, solve};
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mesh::Solid;
use equipoise::printer::Printer;
use equipoise::repair::repair;
use equipoise::shell::Shell;
use equipoise::voids::{Cavity, CavitySpec};

const WALL_MM: f64 = 1.5;

fn main() -> anyhow::Result<()> {
    let shipped = "examples/models/tilted-ellipsoid.stl".to_owned();
    let path = std::env::args().nth(1).unwrap_or(shipped);
    let watch = Watch::silent();
    let (mesh, _) = repair(read_model(path.as_ref())?, &Watch::silent())?;
    let solid = Solid::new(mesh)?;
    // On its own lowest point: a tip would have to be weighed in.
    let top = Request::new(GoalKind::Top).unpromised();
    let placed = place(&solid, WALL_MM, &top)?;
    let shell = Shell::new(&solid, &placed.goal.frame, WALL_MM, &placed.keeps)?;
    let columns = Columns::of_shell(&shell, shell.coarse_pitch(200), &watch)?;
    let problem = Problem {
        goal: &placed.goal,
        fixed: placed.goal.solid,
        columns: &columns,
    };
    let solution = solve(&problem, &Settings::default(), &watch);
    let printer = Printer::find("objet-connex350")?;
    let spec = CavitySpec::for_printer(&printer, WALL_MM, &placed.keeps);
    let cavity = Cavity::extract(&solid, &spec, &watch)?;
    let voids = cavity.void_bodies(&solution.quadric, &placed.goal.frame, &watch)?;
    let volume_mm3 = |void: &Solid| void.mesh().signed_volume_mm3();
    println!(
        "{} void(s), {:.0} mm³ of {:.0} mm³; spins upright from {:.0} rpm, at best {:.0} rpm",
        voids.bodies.len(),
        voids.bodies.iter().map(volume_mm3).sum::<f64>(),
        volume_mm3(&solid),
        solution.certificate.value,
        solution.certificate.bound,
    );
    Ok(())
}
