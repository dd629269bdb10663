//! A model at its size, with its goal and shell, and columns of any pitch.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::{Context, Result};
use equipoise::base::watch::Watch;
use equipoise::goal::{Goal, Request, place};
use equipoise::hollow::Problem;
use equipoise::interior::Columns;
use equipoise::io::read_model;
use equipoise::mesh::{Solid, scaled};
use equipoise::repair::repair;
use equipoise::shell::Shell;

use super::models;

/// Every model's longest side and wall.
pub const SIZE_MM: f64 = 100.0;
const WALL_MM: f64 = 1.0;

/// A model at its size, with its goal and shell.
pub struct Scene {
    pub goal: Goal,
    pub shell: Shell,
}

impl Scene {
    /// A model, one of those made by code or a file of the larger ones; `None` if that is not
    /// there.
    pub fn of(model: &str, file: Option<&str>, request: &Request) -> Result<Option<Self>> {
        let Some(solid) = solid(model, file)? else {
            return Ok(None);
        };
        let placement = place(&solid, WALL_MM, &request.unpromised())?;
        let shell = Shell::new(&solid, &placement.goal.frame, WALL_MM, &placement.keeps)?;
        Ok(Some(Self {
            goal: placement.goal,
            shell,
        }))
    }

    pub fn columns(&self, pitch_mm: [f64; 2]) -> Result<Columns> {
        Ok(Columns::of_shell(&self.shell, pitch_mm, &Watch::silent())?)
    }

    /// Columns at the pitch at which the rays have about this many numbers, two for every stretch.
    pub fn columns_for(&self, variables: usize) -> Result<Columns> {
        let mut pitch_mm = self.shell.coarse_pitch(40);
        for _ in 0..2 {
            let stretches = self.columns(pitch_mm)?.intervals.len();
            let factor = (2.0 * stretches as f64 / variables as f64).sqrt();
            pitch_mm = pitch_mm.map(|pitch| pitch * factor);
        }
        self.columns(pitch_mm)
    }

    pub fn problem<'a>(&'a self, columns: &'a Columns) -> Problem<'a> {
        Problem {
            goal: &self.goal,
            fixed: self.goal.solid,
            columns,
        }
    }
}

fn solid(model: &str, file: Option<&str>) -> Result<Option<Solid>> {
    let Some(file) = file else {
        let made = models::MODELS.into_iter().find(|(name, _)| *name == model);
        let (_, make) = made.context("no such model")?;
        return Ok(Some(models::solid(make)?));
    };
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models");
    let path = std::env::var_os("EQUIPOISE_SHARED_MODELS")
        .map_or_else(|| PathBuf::from(beside), PathBuf::from)
        .join(file);
    if !path.is_file() {
        return Ok(None);
    }
    let (mesh, _) = repair(read_model(&path)?, &Watch::silent())?;
    Ok(Some(Solid::new(scaled(
        &mesh,
        SIZE_MM / mesh.longest_side_mm(),
    ))?))
}

/// What a run gives, and the shortest of the times of several, s.
pub fn timed<T>(runs: usize, mut run: impl FnMut() -> Result<T>) -> Result<(T, f64)> {
    let mut shortest = f64::INFINITY;
    let mut last = None;
    for _ in 0..runs {
        let start = Instant::now();
        last = Some(run()?);
        shortest = shortest.min(start.elapsed().as_secs_f64());
    }
    Ok((last.context("no run")?, shortest))
}
