//! `equipoise cells`: a model divided into cells, relaxed under L∞ or L2, for meshing and walls.

use std::io::Write;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use serde::Serialize;

use super::args::CellsArgs;
pub use super::cells_error::CellsCommandError;
use super::cells_order::Ordered;
use super::cells_picture::{Look, pictures, plot};
use super::cells_printed::{PrintedFacts, comb_order, printed, rows as printed_rows};
use super::exit::Exit;
use super::show::table;
use super::signals::Stop;
use super::voice::Voice;
use crate::base::numbers::quantity;
use crate::base::units::{format_count, show_mm, show_mm3};
use crate::base::watch::Watch;
use crate::cells::{
    Beyond, Body, Cell, CellFigures, Chebyshev, Face, Norm, Order, Step, StepFigures, Weight,
    bodies, cells, encode_obj, encode_sites, encode_steps, encode_vtk, nearest_axes, relax,
};
use crate::geom::{Matrix, Point};
use crate::goal::find_upright;
use crate::kit::{CELLS_FILE, Kit};

/// A cell lacks this share of its volume at least if the surface cuts it.
const SAME_RATIO: f64 = 1e-9;

/// The facts of the cells that are printed.
#[derive(Debug, Serialize)]
struct Findings {
    /// The folder.
    folder: PathBuf,
    norm: Norm,
    cells: usize,
    /// The number of cells that the surface cuts.
    at_surface: usize,
    /// The volume of the model, mm³.
    volume_mm3: f64,
    /// The sum of the volumes of the written cells over it, less one.
    volume_error_ratio: f64,
    /// The mean size of a cell: the side of a cube of its volume, mm.
    size_mm: f64,
    /// The wall between cells, mm; `None` if neither a wall nor a printer was named.
    wall_mm: Option<f64>,
    /// The density that the walls would make between cubes of the mean size.
    density: Option<f64>,
    steps: usize,
    /// The energy over that of cubes, before the first step and after the last one.
    energy_ratio: [f64; 2],
    /// The mean and the greatest movement in the last step, mm.
    movement_mm: [f64; 2],
    /// The printable solid; `None` without a printer.
    #[serde(skip_serializing_if = "Option::is_none")]
    printed: Option<PrintedFacts>,
}

/// Relaxed cells.
struct Relaxed {
    steps: Vec<StepFigures>,
    /// The cells, in the frame.
    cells: Vec<Cell>,
    /// The sites, in the model.
    sites: Vec<Point>,
    /// The cells as bodies, in the model.
    bodies: Vec<Body>,
    figures: Vec<CellFigures>,
    at_surface: usize,
}

/// Divides a model into cells and writes them into a folder; says on `out` what came of it.
pub fn divide(
    args: &CellsArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, CellsCommandError> {
    let target = args
        .out
        .clone()
        .unwrap_or_else(|| default_folder(&args.model));
    args.existing().allows(&target)?;
    let watch = Watch::silent_until(stop.flag());
    let found = write(args, &target, &watch);
    if found.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let findings = found?;
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&findings)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&findings))?;
    }
    Ok(Exit::Kept)
}

fn default_folder(model: &Path) -> PathBuf {
    let stem = model.file_stem().unwrap_or_default().to_string_lossy();
    PathBuf::from(format!("{stem}-cells"))
}

/// Divides the model and writes the folder, or nothing.
fn write(args: &CellsArgs, target: &Path, watch: &Watch) -> Result<Findings, CellsCommandError> {
    let mut ordered = Ordered::of(args, watch)?;
    let norm = args.relaxation.norm.unwrap_or_default();
    if let (Some(_), Some(wall_mm)) = (&ordered.printer, ordered.wall_mm) {
        comb_order(&ordered, wall_mm)?;
    }
    let relaxed = relaxed(args, &mut ordered, watch)?;
    let name = args.model.file_name().unwrap_or_default().to_string_lossy();
    let up = find_upright(&ordered.solid, watch)?
        .first()
        .map(|pose| pose.up);
    let mut kit = Kit::default();
    kit.add("sites.csv", encode_sites(&relaxed.sites).into_bytes());
    kit.add("cells.obj", encode_obj(&relaxed.bodies).into_bytes());
    let vtk = encode_vtk(&relaxed.bodies, &relaxed.figures);
    kit.add(CELLS_FILE, vtk.into_bytes());
    kit.add("steps.csv", encode_steps(&relaxed.steps).into_bytes());
    let drawn = plot(&relaxed.steps, norm);
    let alt = format!("the relaxation of the cells of {name}");
    kit.add("steps.svg", drawn.to_file(&alt).into_bytes());
    for (look, file) in [
        (Look::Apart, "cells-apart.png"),
        (Look::Open, "cells-open.png"),
    ] {
        kit.add(file, pictures(&relaxed.bodies, up, look)?);
    }
    let printed = printed(&ordered, &relaxed.cells, &mut kit, watch)?;
    watch.check()?;
    kit.write_watched(target, args.existing(), watch)?;
    Ok(Findings {
        folder: target.to_owned(),
        norm,
        printed,
        ..findings(&ordered, &relaxed)
    })
}

/// Relaxes the sites, and makes the cells of the relaxed ones.
fn relaxed(
    args: &CellsArgs,
    ordered: &mut Ordered,
    watch: &Watch,
) -> Result<Relaxed, CellsCommandError> {
    let mut sites = std::mem::take(&mut ordered.sites);
    let weight = |at: &Point| {
        let graded = ordered.graded.as_ref();
        graded.map_or(1.0, |graded| graded.size_mm(at).powi(-4))
    };
    let turned = |at: &Point| nearest_axes(&ordered.placed, at);
    let order = Order {
        norm: args.relaxation.norm.unwrap_or_default(),
        steps: args.relaxation.iterations as usize,
        still_mm: args.relaxation.stop.map_or(0.0, |stop| stop.mm()),
        frame: (!ordered.placed.is_empty()).then_some(&turned),
        weight: ordered.graded.is_some().then_some(&weight),
    };
    let room = &ordered.room;
    let taken = relax(&mut sites, room, &order, || watch.is_cancelled());
    watch.check()?;
    let cells = cells(&sites, room);
    let energies = [None, order.weight].map(|weight| energies(&cells, &sites, &order, weight));
    let cubes = cubes_energy(sites.len() as f64, ordered.wished);
    let volumes = cells.iter().map(|cell| cell.part.volume_mm3());
    let figures = volumes.zip(&energies[0]);
    let figures = figures.map(|(volume_mm3, &energy_mm4)| CellFigures {
        volume_mm3,
        energy_mm4,
    });
    let figures = figures.collect();
    let bodies = bodies(&cells, &ordered.mesh, watch)?;
    let is_cut = |cell: &&Cell| {
        let touches = |face: &Face| matches!(face.beyond, Beyond::Room);
        let whole_mm3 = cell.polytope.chain().volume_mm3();
        cell.polytope.faces().iter().any(touches)
            || cell.part.volume_mm3() < whole_mm3 * (1.0 - SAME_RATIO)
    };
    let at_surface = cells.iter().filter(is_cut).count();
    let in_model = |at: &Point| ordered.axes.to_model(at);
    Ok(Relaxed {
        steps: step_figures(&taken, energies[1].iter().sum(), cubes),
        sites: sites.iter().map(in_model).collect(),
        bodies: bodies
            .into_iter()
            .map(|body| body.mapped(in_model))
            .collect(),
        figures,
        at_surface,
        cells,
    })
}

/// Returns the energy of each cell, with or without a weight.
fn energies(
    cells: &[Cell],
    sites: &[Point],
    order: &Order<'_>,
    weight: Option<&Weight<'_>>,
) -> Vec<f64> {
    let pairs = cells.par_iter().zip(sites);
    let energy = |(cell, site): (&Cell, &Point)| {
        let frame = order.frame.map_or(Matrix::identity(), |frame| frame(site));
        Chebyshev::of(&cell.part, site, &frame, weight).energy
    };
    pairs.map(energy).collect()
}

/// Returns the energy of so many cubes whose sizes are in proportion to the wished ones.
///
/// A cube of side c·a has 3/8 (c a)⁴. The weight is a⁻⁴ where sizes are wished; else a is 1. They
/// fill the model if count · c³ is ∫ 1/a³.
fn cubes_energy(count: f64, wished: f64) -> f64 {
    0.375 * count * (wished / count).powf(4.0 / 3.0)
}

/// Returns the figures of all steps, and of the end.
fn step_figures(taken: &[Step], last: f64, cubes: f64) -> Vec<StepFigures> {
    let figures = taken.iter().map(|step| StepFigures {
        energy_ratio: step.chebyshev / cubes,
        mean_mm: step.mean_mm,
        most_mm: step.most_mm,
    });
    let end = StepFigures {
        energy_ratio: last / cubes,
        mean_mm: 0.0,
        most_mm: 0.0,
    };
    figures.chain([end]).collect()
}

/// Returns the facts of relaxed cells; the folder, the norm and the print are not known here.
fn findings(ordered: &Ordered, relaxed: &Relaxed) -> Findings {
    let volume_mm3 = ordered.solid.mesh().signed_volume_mm3();
    let sum_mm3: f64 = relaxed.bodies.iter().map(Body::volume_mm3).sum();
    let count = relaxed.sites.len();
    let size_mm = (volume_mm3 / count as f64).cbrt();
    let ends = [0, relaxed.steps.len() - 1].map(|k| relaxed.steps[k].energy_ratio);
    let before = relaxed.steps.len().saturating_sub(2);
    let last = relaxed.steps[before];
    let density = |wall_mm: f64| 1.0 - (1.0 - wall_mm / size_mm).powi(3);
    Findings {
        folder: PathBuf::new(),
        norm: Norm::default(),
        cells: count,
        at_surface: relaxed.at_surface,
        volume_mm3,
        volume_error_ratio: sum_mm3 / volume_mm3 - 1.0,
        size_mm,
        wall_mm: ordered.wall_mm,
        density: ordered.wall_mm.map(density),
        steps: relaxed.steps.len() - 1,
        energy_ratio: ends,
        movement_mm: [last.mean_mm, last.most_mm],
        printed: None,
    }
}

fn text(findings: &Findings) -> String {
    let [first, last] = findings
        .energy_ratio
        .map(|ratio| quantity(100.0 * ratio, "%"));
    let [mean, most] = findings.movement_mm.map(show_mm);
    let mut rows = vec![
        [
            "cells".to_owned(),
            format!(
                "{}, {} of them cut by the surface, each {} in the mean",
                format_count(findings.cells, "cell"),
                findings.at_surface,
                show_mm(findings.size_mm)
            ),
        ],
        [
            "volume".to_owned(),
            format!(
                "{}; the cells differ from it by {:.1e} of it",
                show_mm3(findings.volume_mm3),
                findings.volume_error_ratio.abs()
            ),
        ],
        [
            "energy".to_owned(),
            format!("{first} of that of cubes at first, {last} at last"),
        ],
        [
            "movement".to_owned(),
            format!(
                "{mean} in the mean and {most} at most, in the last of {}",
                format_count(findings.steps, "step")
            ),
        ],
    ];
    if let (Some(wall_mm), Some(density)) = (findings.wall_mm, findings.density) {
        let words = format!(
            "{} between them make cubes of that size {} dense",
            show_mm(wall_mm),
            quantity(100.0 * density, "%")
        );
        rows.push(["walls".to_owned(), words]);
    }
    if let Some(printed) = &findings.printed {
        rows.extend(printed_rows(printed));
    }
    rows.push(["folder".to_owned(), findings.folder.display().to_string()]);
    table(&rows)
}
