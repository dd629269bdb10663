//! Everything a run rests on before it solves: the solid, the printer, the wall and the placed
//! goal.

use super::Error;
use super::advising::Means;
use crate::ballast::Load;
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::cut::{Rod, rods};
use crate::goal::{GoalKind, Placement, Request, Stock, place_made_of};
use crate::hardware::Fitted;
use crate::hollow::Fill;
use crate::io;
use crate::job::Job;
use crate::mass::Moments;
use crate::mesh::{Defects, Solid, scaled};
use crate::printer::{Material, Printer, WallChoice, leaves_room};
use crate::repair::{Repairs, one_body, repair};

/// The model as it is used: closed, in mm.
#[derive(Debug, Clone)]
pub struct Model {
    /// Its outside.
    pub solid: Solid,
    /// What had to be repaired.
    pub repairs: Repairs,
    /// SHA-256 of the file.
    pub sha256: String,
    /// What the file's numbers were multiplied by.
    pub scale_ratio: f64,
}

/// What a run rests on.
#[derive(Debug, Clone)]
pub struct Setup {
    /// The job, bound to the bytes of its model.
    pub job: Job,
    /// The model.
    pub model: Model,
    /// The printer.
    pub printer: Printer,
    /// What it prints.
    pub material: Material,
    /// The wall that is printed.
    pub wall: WallChoice,
    /// The pitch of the finest columns, mm.
    pub pitch_mm: [f64; 2],
    /// What is asked for: the job's goal with its axis settled.
    pub request: Request,
    /// How the axis was chosen, where the job left it open.
    pub choice: Option<String>,
    /// The goal in the model.
    pub placement: Placement,
    /// What is put into the model that is not printed; none where nothing is.
    pub fitted: Option<Fitted>,
    /// The model as it was before its hardware was put in; none without hardware.
    pub bare: Option<Solid>,
    /// The ballast that is laid in.
    pub load: Load,
    /// What is in the voids.
    pub fill: Fill,
    /// The rods that dowels are cut from; none where pins are printed.
    pub rods: Vec<Rod>,
}

impl Setup {
    /// Reads the model and the profiles and places the goal.
    pub fn of(job: &Job, progress: &Watch) -> Result<Self, Error> {
        progress.report(super::phase::LOAD, 0.0);
        let printer = Printer::find(&job.printer.id)?;
        let material = printer.material(job.printer.material.as_deref())?.clone();
        let (job, model) = load(job, &printer)?;
        let size_mm = model.solid.mesh().longest_side_mm();
        let wall = printer.quantised_wall(job.wall.map(|wall| wall.mm()), size_mm)?;
        let pitch_mm =
            printer.solve_pitch_mm(wall.wall_mm, size_mm, job.pitch.map(|pitch| pitch.mm()));
        leaves_room(size_mm, wall.wall_mm)?;
        let means = Means {
            model: &model,
            printer: &printer,
            material: &material,
            wall: &wall,
        };
        let (request, choice) = means.settled(&job.goal);
        let stock = Stock {
            wall_mm: wall.wall_mm,
            density_g_cm3: material.density_g_cm3.value,
        };
        let placement = place_made_of(&model.solid, &stock, &request)?;
        let fill = fill(&job, stock.density_g_cm3)?;
        let rods = if job.pins.is_printed() {
            Vec::new()
        } else {
            rods()?
        };
        Ok(Self {
            job,
            model,
            printer,
            material,
            wall,
            pitch_mm,
            request,
            choice,
            placement,
            fitted: None,
            bare: None,
            load: Load::default(),
            fill,
            rods,
        })
    }

    /// The moments of nothing emptied, goal frame: the solid's, and the ballast's less its
    /// pockets'.
    pub fn fixed(&self) -> Moments {
        let goal = &self.placement.goal;
        goal.solid + self.load.excess().in_frame(&goal.frame)
    }

    /// The name of the job in file names: the model's file name without its ending.
    pub fn name(&self) -> String {
        let stem = self
            .job
            .model
            .path
            .file_stem()
            .map(|stem| stem.to_string_lossy().into_owned());
        let is_plain = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
        stem.unwrap_or_default()
            .chars()
            .map(|c| if is_plain(c) { c } else { '-' })
            .collect()
    }
}

/// What is in the voids of a job's print.
fn fill(job: &Job, density_g_cm3: f64) -> Result<Fill, Error> {
    let Some(filling) = job.fill else {
        return Ok(Fill::AIR);
    };
    if !job.ballast.is_none() {
        return Err(Error::FillAndBallast {
            fill: filling,
            order: job.ballast.clone(),
        });
    }
    let fill = Fill::new(filling.density_g_cm3() / density_g_cm3).ok_or(Error::FillLikePrint {
        fill: filling,
        density_g_cm3,
    })?;
    if fill.is_heavier() && job.goal.kind == GoalKind::Balance {
        return Err(Error::HeavyFillInRotor { fill: filling });
    }
    Ok(fill)
}

/// The model of a job, and the job bound to it.
fn load(job: &Job, printer: &Printer) -> Result<(Job, Model), Error> {
    let bytes = io::read_bytes(&job.model.path)?;
    let mesh = io::decode_model(&bytes).map_err(|source| io::ReadError::Content {
        path: job.model.path.clone(),
        source,
    })?;
    let job = job.clone().bound_to(&bytes)?;
    let (mesh, repairs) = repair(mesh);
    let scale_ratio = job.model.scaling.factor(mesh.longest_side_mm());
    printer.allows_length(scale_ratio * mesh.longest_side_mm())?;
    // Defects are told where they are to be found: in the file.
    let solid = Solid::new(scaled(&mesh, scale_ratio)).map_err(|defects| {
        let source = Box::new(Defects::of(&mesh).unwrap_or(defects));
        Error::NotSolid {
            path: job.model.path.clone(),
            source,
        }
    })?;
    one_body(&solid).map_err(|source| Error::NotOneBody {
        path: job.model.path.clone(),
        source: Box::new(source),
    })?;
    Ok((
        job,
        Model {
            solid,
            repairs,
            sha256: sha256_hex(&[&bytes]),
            scale_ratio,
        },
    ))
}
