//! The papers' tables beside the quadric, as Markdown: rays (Wu et al. 2016, Table 1), voxels (their Table 2) and the
//! octree of level 9 (Spin-It §5), all on the same columns, in one run on one machine:
//!
//! ```text
//! cargo run --release --example solver_table
//! ```
//!
//! `EQUIPOISE_MODELS` names a folder with the larger models; those that are not there are left out.

#![allow(clippy::print_stdout, reason = "an example talks to the person who runs it")]

#[path = "make_models/models.rs"]
mod models;

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use equipoise::goal::{Contact, Goal, GoalKind, Objective, Request, Up, place};
use equipoise::hollow::{ByOctree, ByQuadric, ByRays, ByVoxels, Found, Method, Problem};
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mesh::{Solid, repair, scaled};
use equipoise::progress::Progress;
use equipoise::shell::Shell;

/// Every model's longest side and wall.
const SIZE_MM: f64 = 100.0;
const WALL_MM: f64 = 1.0;

/// Columns along the longest side for an octree of level 9.
const LEVEL_9: usize = 512;

/// Runs of which the shortest counts: the quadric's take milliseconds, which another program easily doubles.
const QUADRIC_RUNS: usize = 9;
const RAYS_RUNS: usize = 3;

/// A row of the tables.
struct Row {
    model: &'static str,
    /// A file of the larger models; the shipped ones are made by code.
    file: Option<&'static str>,
    request: Request,
    /// About how many numbers the rays choose; Wu et al. have 1.4 to 9 thousand.
    variables: usize,
}

impl Row {
    fn title(&self) -> String {
        format!("{} | {} {}", self.model, self.request.kind, self.request.objective)
    }
}

fn rows() -> Vec<Row> {
    let functional = Objective::SpinIt { gamma_c: 0.0, gamma_i: 1.0 };
    let top = Request { objective: functional, ..Request::new(GoalKind::Top) };
    let centered = Request { contact: Some(Contact::Center), ..top };
    let yoyo = Request { objective: functional, ..Request::new(GoalKind::Yoyo) };
    let slowest = Request { objective: Objective::CriticalSpeed, ..centered };
    let lowest = Request { objective: Objective::LowestCenter, ..Request::new(GoalKind::Stand) };
    let row = |model, file, request, variables| Row { model, file, request, variables };
    vec![
        row("tilted-ellipsoid", None, top, 2886),
        row("three-spheres", None, Request { up: Up::Principal, ..yoyo }, 1400),
        row("elephant", Some("elephant.obj"), centered, 9000),
        row("cheburashka", Some("cheburashka.obj"), yoyo, 4000),
        row("fertility", Some("fertility.stl"), slowest, 6000),
        row("elephant", Some("elephant.obj"), Request { up: Up::Y, ..lowest }, 4000),
        row("balancing-figure", None, lowest, 4000),
    ]
}

/// A model at its size, with its goal and shell.
struct Scene {
    goal: Goal,
    shell: Shell,
}

impl Scene {
    fn of(row: &Row) -> Result<Option<Self>> {
        let Some(solid) = solid(row)? else { return Ok(None) };
        let placement = place(&solid, WALL_MM, &row.request)?;
        let shell = Shell::new(&solid, &placement.goal.frame, WALL_MM, &placement.keeps)?;
        Ok(Some(Self { goal: placement.goal, shell }))
    }

    fn columns(&self, pitch_mm: [f64; 2]) -> Result<Columns> {
        Ok(Columns::of_shell(&self.shell, pitch_mm, &Progress::silent())?)
    }

    /// Columns at the pitch at which the rays have about this many numbers, two for every stretch.
    fn columns_for(&self, variables: usize) -> Result<Columns> {
        let mut pitch_mm = self.shell.coarse_pitch(40);
        for _ in 0..2 {
            let stretches = self.columns(pitch_mm)?.intervals.len();
            let factor = (2.0 * stretches as f64 / variables as f64).sqrt();
            pitch_mm = pitch_mm.map(|pitch| pitch * factor);
        }
        self.columns(pitch_mm)
    }

    fn problem<'a>(&'a self, columns: &'a Columns) -> Problem<'a> {
        Problem { goal: &self.goal, fixed: self.goal.solid, columns }
    }
}

fn solid(row: &Row) -> Result<Option<Solid>> {
    let Some(file) = row.file else {
        let made = models::MODELS.into_iter().find(|(name, _)| *name == row.model);
        let (_, make) = made.context("no such model")?;
        return Ok(Some(models::solid(make)?));
    };
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");
    let path =
        std::env::var_os("EQUIPOISE_MODELS").map_or_else(|| PathBuf::from(beside), PathBuf::from).join(file);
    if !path.is_file() {
        return Ok(None);
    }
    let (mesh, _) = repair(read_model(&path)?);
    Ok(Some(Solid::new(scaled(&mesh, SIZE_MM / mesh.longest_side_mm()))?))
}

/// What a method found, and the shortest of its times, s.
fn timed(method: &dyn Method, problem: &Problem, runs: usize) -> Result<(Found, f64)> {
    let mut shortest = f64::INFINITY;
    let mut last = None;
    for _ in 0..runs {
        let start = Instant::now();
        last = Some(method.find(problem, &Progress::silent())?);
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    Ok((last.context("no run")?, shortest))
}

/// By how much a void differs from the quadric's, in percent of that.
fn differs(found: &Found, best: &Found, problem: &Problem) -> f64 {
    let volume = problem.fixed.volume() - best.moments.volume();
    100.0 * found.emptied.difference_mm3(&best.emptied, problem.columns) / volume
}

fn rays_and_voxels(row: &Row, scene: &Scene) -> Result<()> {
    let columns = scene.columns_for(row.variables)?;
    let problem = scene.problem(&columns);
    let (best, best_s) = timed(&ByQuadric::default(), &problem, QUADRIC_RUNS)?;
    println!(
        "| {} | quadric | 10 | {} | {:.2} | 1 | {:.6} | {:.0e} | 0 | {:?} |",
        row.title(),
        best.iterations,
        best_s * 1e3,
        best.value,
        best.residual,
        best.outcome
    );
    let others: [(&dyn Method, usize); 2] = [(&ByRays::default(), RAYS_RUNS), (&ByVoxels::default(), 1)];
    for (method, runs) in others {
        let (found, seconds) = timed(method, &problem, runs)?;
        println!(
            "| | | {} | {} | {} | {:.1} | {:.0} | {:.6} | {:.0e} | {:.2} | {:?} |",
            method.name(),
            found.variables,
            found.iterations,
            seconds * 1e3,
            seconds / best_s,
            found.value,
            found.residual,
            differs(&found, &best, &problem),
            found.outcome
        );
    }
    Ok(())
}

fn level_9(row: &Row, scene: &Scene) -> Result<()> {
    let columns = scene.columns(scene.shell.coarse_pitch(LEVEL_9))?;
    let problem = scene.problem(&columns);
    let (best, best_s) = timed(&ByQuadric::default(), &problem, RAYS_RUNS)?;
    let (found, seconds) = timed(&ByOctree::default(), &problem, 1)?;
    let rounding = found.rounding.context("the octree rounds")?;
    println!(
        "| {} | {} | {} | {} | {seconds:.1} | {:.6} | {:.0e} | {:.6} | {:.0e} | {:.2} | {best_s:.3} | {:.6} | {:.0} |",
        row.title(),
        columns.len(),
        found.variables,
        found.iterations,
        rounding.value_before,
        rounding.residual_before,
        found.value,
        found.residual,
        differs(&found, &best, &problem),
        best.value,
        seconds / best_s
    );
    Ok(())
}

fn main() -> Result<()> {
    println!(
        "| model | goal | method | variables | evaluations | ms | × quadric | value | residual | void differs, % | end |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    let mut scenes = Vec::new();
    for row in rows() {
        if let Some(scene) = Scene::of(&row).with_context(|| row.model)? {
            rays_and_voxels(&row, &scene)?;
            scenes.push((row, scene));
        }
    }
    println!();
    println!(
        "| model | goal | columns | leaves | evaluations | s | value | residual | rounded: value | residual | void \
         differs, % | quadric s | value | × quadric |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    for (row, scene) in
        scenes.iter().filter(|(row, _)| row.file.is_none() && row.request.kind != GoalKind::Stand)
    {
        level_9(row, scene)?;
    }
    Ok(())
}
