//! The infill with which the rocker arm runs true and Humpty stands on his head, as the paper has
//! them.

use anyhow::Result;
use equipoise::base::verdict::Verdict;
use equipoise::base::watch::Watch;
use equipoise::field::DensityRange;
use equipoise::geom::{Frame, Matrix, Point, Quadric, Vector};
use equipoise::goal::{GoalKind, Objective, Request, Up, place};
use equipoise::hollow::{Family, Graded, Row, fit_smooth, greatest_low, least_change, rows};
use equipoise::interior::Columns;
use equipoise::mass::{Moments, moments_of_mesh};
use equipoise::mesh::{Solid, TriMesh};
use equipoise::shell::Shell;

/// A wall so thin that there is none, mm.
const NO_WALL_MM: f64 = 1e-4;
/// Sizes and walls of the rocker arm, mm.
const ROCKER_ARMS: [[f64; 2]; 6] = [
    [62.9, 0.45],
    [62.9, 0.8],
    [100.0, 0.8],
    [100.0, NO_WALL_MM],
    [150.0, 0.8],
    [200.0, 0.8],
];
/// Columns along a model whose thresholds are sought.
const COLUMNS: f64 = 200.0;
/// Columns along a model to which fields are fitted: sixty descents go over them.
const FITTED_COLUMNS: f64 = 60.0;
/// The least densities between which and solid print fields are fitted.
const LEAST: [f64; 4] = [0.0, 0.1, 0.15, 0.2];

/// A model as columns, and what it must meet.
pub struct Scene {
    columns: Columns,
    shell: Moments,
    rows: Vec<Row>,
}

impl Scene {
    fn graded(&self) -> Graded<'_> {
        Graded {
            shell: self.shell,
            columns: &self.columns,
            rows: &self.rows,
        }
    }
}

/// Returns a solid as columns in a frame in which no level set of a balanced rotor is upright.
fn scene(solid: &Solid, wall_mm: f64, columns: f64) -> Result<(Scene, Frame)> {
    let moments = moments_of_mesh(solid.mesh());
    let frame = Frame::with_axis(moments.centroid(), &Vector::new(0.35, -0.42, 0.84));
    let shell = Shell::new(solid, &frame, wall_mm, &[])?;
    let pitch_mm = solid.mesh().longest_side_mm() / columns;
    let columns = Columns::of_shell(&shell, [pitch_mm; 2], &Watch::silent())?;
    let scene = Scene {
        // Without a wall all has the density in question, so what columns miss is left out.
        shell: match wall_mm > NO_WALL_MM {
            true => moments.in_frame(&frame) - columns.moments(),
            false => Moments::default(),
        },
        columns,
        rows: Vec::new(),
    };
    Ok((scene, frame))
}

/// Returns the rows of a rotor about the rocker arm's axis, those of its centre first.
fn rotor_rows(size_mm: f64, frame: &Frame) -> Vec<Row> {
    let axis = Frame {
        origin: Point::new(0.0, 0.0669 * size_mm, 0.0850 * size_mm),
        axes: Matrix::new(0., 0., 1., 1., 0., 0., 0., 1., 0.),
    };
    let row = |index: usize| {
        let one = Quadric(std::array::from_fn(|i| f64::from(u8::from(i == index))));
        Row::zero(one.in_frame(&axis.inverse()).in_frame(frame))
    };
    [1, 2, 6, 5].map(row).to_vec()
}

/// Returns the rocker arm without a wall as a rotor.
pub fn rotor(mesh: &TriMesh) -> Result<Scene> {
    let (scene, frame) = scene(&Solid::new(mesh.clone())?, NO_WALL_MM, FITTED_COLUMNS)?;
    let rows = rotor_rows(mesh.longest_side_mm(), &frame);
    Ok(Scene { rows, ..scene })
}

/// Returns a model that stands on its head, with its centre over the middle of its support.
pub fn on_its_head(mesh: &TriMesh) -> Result<Scene> {
    let solid = Solid::new(mesh.clone())?;
    let request = Request {
        up: Up::Along((-Vector::y()).into()),
        objective: Objective::LowestCenter,
        ..Request::new(GoalKind::Stand)
    };
    let goal = place(&solid, 1.0, &request)?.goal;
    let (scene, frame) = scene(&solid, NO_WALL_MM, FITTED_COLUMNS)?;
    let moved = |row: Row| Row {
        quadric: row.quadric.in_frame(&goal.frame.inverse()).in_frame(&frame),
        ..row
    };
    let rows = rows(&goal, 0.0).into_iter().map(moved).collect();
    Ok(Scene { rows, ..scene })
}

/// Prints the greatest infill with which the rocker arm can be balanced, by size and shell.
pub fn print_rocker_arms(unit: &TriMesh) -> Result<()> {
    println!("\n| size mm | wall mm | static | dynamic | gap |\n|---|---|---|---|---|");
    for [size_mm, wall_mm] in ROCKER_ARMS {
        let solid = Solid::new(unit.map_vertices(|p| p * size_mm))?;
        let (scene, frame) = scene(&solid, wall_mm, COLUMNS)?;
        let rows = rotor_rows(size_mm, &frame);
        let low = |rows| {
            let graded = Graded {
                rows,
                ..scene.graded()
            };
            greatest_low(&graded, 1.0)
        };
        let (still, turning) = (low(&rows[..2]), low(&rows));
        let (a, b, gap) = (still.density, turning.density, turning.gap);
        println!("| {size_mm} | {wall_mm} | {a:.3} | {b:.3} | {gap:.1e} |");
    }
    Ok(())
}

/// Prints the price of the least change, and of the fields that were fitted.
pub fn print_families(scene: &Scene) {
    let graded = scene.graded();
    let greatest = greatest_low(&graded, 1.0).density;
    println!("\nDensities from {greatest:.3} to 1 can do it.\n");
    println!("| from | least price | ramps found | price | waves found | price |");
    println!("|---|---|---|---|---|---|");
    for low in LEAST {
        let Ok(range) = DensityRange::new(low, 1.0) else {
            continue;
        };
        let wished = 0.5 * (low + 1.0);
        let least = match least_change(&graded, range, wished) {
            Verdict::Found(least) => format!("{:.5}", least.cost),
            Verdict::No(_) => "none".to_owned(),
        };
        let fitted = [Family::Ramp, Family::Sine].map(|family| {
            let fit = fit_smooth(&graded, family, range, wished);
            let price = match fit.found {
                0 => format!("none, {:.1e} off", fit.miss),
                _ => format!("{:.5}", fit.cost),
            };
            format!("{} of {} | {price}", fit.found, fit.starts)
        });
        println!("| {low} | {least} | {} | {} |", fitted[0], fitted[1]);
    }
}
