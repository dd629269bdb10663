//! The papers' tables beside the quadric, all on the same columns. They are rays (Wu et al. 2016,
//! Table 1), voxels (their Table 2), and the octree of level 9 (Spin-It §5).

use anyhow::{Context, Result};
use equipoise::base::watch::Watch;
use equipoise::goal::{Contact, GoalKind, Objective, Request, Up};
use equipoise::hollow::{ByOctree, ByQuadric, ByRays, ByVoxels, Found, Method, Problem};

use super::scene::{Scene, timed};

/// Columns along the longest side for an octree of level 9.
const LEVEL_9: usize = 512;

/// Runs of which the shortest counts: the quadric's take milliseconds, which another program easily
/// doubles.
const QUADRIC_RUNS: usize = 9;
const RAYS_RUNS: usize = 3;

/// The shortest time that Wu et al. report for 4000 to 9000 variables, on their machine of 2016, s;
/// their longest is 4 s.
const PUBLISHED_S: f64 = 0.5;
const PUBLISHED_VARIABLES: std::ops::RangeInclusive<usize> = 3900..=9100;

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
        format!(
            "{} | {} {}",
            self.model, self.request.kind, self.request.objective
        )
    }
}

fn rows() -> Vec<Row> {
    let functional = Objective::SpinIt {
        gamma_c: 0.0,
        gamma_i: 1.0,
    };
    let top = Request {
        objective: functional,
        ..Request::new(GoalKind::Top)
    };
    let centered = Request {
        contact: Some(Contact::Center),
        ..top
    };
    let yoyo = Request {
        objective: functional,
        ..Request::new(GoalKind::Yoyo)
    };
    let slowest = Request {
        objective: Objective::CriticalSpeed,
        ..centered
    };
    let lowest = Request {
        objective: Objective::LowestCenter,
        ..Request::new(GoalKind::Stand)
    };
    let row = |model, file, request, variables| Row {
        model,
        file,
        request,
        variables,
    };
    vec![
        row("tilted-ellipsoid", None, top, 2886),
        row(
            "three-spheres",
            None,
            Request {
                up: Up::Principal,
                ..yoyo
            },
            1400,
        ),
        row("elephant", Some("elephant.obj"), centered, 9000),
        row("cheburashka", Some("cheburashka.obj"), yoyo, 4000),
        row("fertility", Some("fertility.stl"), slowest, 6000),
        row(
            "elephant",
            Some("elephant.obj"),
            Request {
                up: Up::Y,
                ..lowest
            },
            4000,
        ),
        row("balancing-figure", None, lowest, 4000),
    ]
}

fn find(method: &dyn Method, problem: &Problem) -> Result<Found> {
    Ok(method.find(problem, &Watch::silent())?)
}

/// By how much a void differs from the quadric's, in percent of that.
fn differs(found: &Found, best: &Found, problem: &Problem) -> f64 {
    let volume = problem.fixed.volume() - best.moments.volume();
    100.0 * found.emptied.difference_mm3(&best.emptied, problem.columns) / volume
}

/// A value, where there is one.
fn shown(value: f64) -> String {
    if value.is_nan() {
        "none".into()
    } else {
        format!("{value:.6}")
    }
}

/// How many times the quadric's time Wu et al.'s own program took at least for as many rays; empty
/// where they report none.
fn published(method: &dyn Method, found: &Found, best_s: f64) -> String {
    let is_reported =
        method.name() == ByRays::default().name() && PUBLISHED_VARIABLES.contains(&found.variables);
    if is_reported {
        format!("≥ {:.0}", PUBLISHED_S / best_s)
    } else {
        String::new()
    }
}

fn rays_and_voxels(row: &Row, scene: &Scene) -> Result<()> {
    let columns = scene.columns_for(row.variables)?;
    let problem = scene.problem(&columns);
    let (best, best_s) = timed(QUADRIC_RUNS, || find(&ByQuadric::default(), &problem))?;
    println!(
        "| {} | quadric | 10 | {} | {:.2} | 1 | | {} | {:.0e} | 0 | {:?} |",
        row.title(),
        best.iterations,
        best_s * 1e3,
        shown(best.value),
        best.residual,
        best.outcome
    );
    let others: [(&dyn Method, usize); 2] =
        [(&ByRays::default(), RAYS_RUNS), (&ByVoxels::default(), 1)];
    for (method, runs) in others {
        let (found, seconds) = timed(runs, || find(method, &problem))?;
        println!(
            "| | | {} | {} | {} | {:.1} | {:.0} | {} | {:.6} | {:.0e} | {:.2} | {:?} |",
            method.name(),
            found.variables,
            found.iterations,
            seconds * 1e3,
            seconds / best_s,
            published(method, &found, best_s),
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
    let (best, best_s) = timed(RAYS_RUNS, || find(&ByQuadric::default(), &problem))?;
    let (found, seconds) = timed(1, || find(&ByOctree::default(), &problem))?;
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

/// Both tables.
pub fn print_tables() -> Result<()> {
    println!(
        "| model | goal | method | variables | evaluations | ms | × quadric | published × quadric | value | residual | \
         void differs, % | end |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    let mut scenes = Vec::new();
    for row in rows() {
        if let Some(scene) =
            Scene::of(row.model, row.file, &row.request).with_context(|| row.model)?
        {
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
    for (row, scene) in scenes
        .iter()
        .filter(|(row, _)| row.file.is_none() && row.request.kind != GoalKind::Stand)
    {
        level_9(row, scene)?;
    }
    Ok(())
}
