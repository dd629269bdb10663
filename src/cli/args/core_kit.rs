//! The arguments of `core`, and the job they make.

use std::path::{Path, PathBuf};

use clap::Args;

use super::beside::copy_beside;
use super::error::ArgsError;
use super::scaling::ScalingArgs;
use super::values::{angle, words};
use crate::ballast::Order as BallastOrder;
use crate::base::units::Length;
use crate::cli::shop::chosen_printer;
use crate::cli::wing::Order;
use crate::goal::Up;
use crate::job::base_choice::{BaseChoice, Dowel, Polyhedra};
use crate::job::base_method::BaseMethod;
use crate::job::core_kit::{CoreGoal, CoreJob, CoreJoints, CoreShell, CutChoice};
use crate::job::{GrainChoice, ModelChoice, StockList};

/// The arguments of `core`.
#[derive(Debug, Clone, Args)]
pub struct CoreArgs {
    /// The model: an STL, OBJ, PLY or 3MF file
    #[arg(required_unless_present = "job")]
    pub model: Option<PathBuf>,
    /// A known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE")]
    pub printer: Option<String>,
    /// A material that the printer offers [default: the printer's]
    #[arg(long, value_name = "ID")]
    pub material: Option<String>,
    /// A known laser cutter's id, or a profile file
    #[arg(long, value_name = "ID|FILE")]
    pub cutter: Option<String>,
    /// A known sheet's id, or a profile file
    #[arg(long, value_name = "ID|FILE")]
    pub sheet: Option<String>,
    /// The sheets at hand, in mm, the side along the grain first; *2 says that there are two, which
    /// are used first [default: the sizes of the sheet's profile]
    #[arg(long, value_name = "900x600,…", allow_hyphen_values = true)]
    pub stock: Option<StockList>,
    /// Panels that follow the grain, or lie any way [default: as the sheet's profile says]
    #[arg(long, value_parser = words::<GrainChoice>(GrainChoice::WORDS))]
    pub grain: Option<GrainChoice>,
    /// The size of the model.
    #[command(flatten, next_help_heading = "Size")]
    pub scaling: ScalingArgs,
    /// The base.
    #[command(flatten)]
    pub base: BaseArgs,
    /// The goal of the object.
    #[command(flatten)]
    pub stance: CoreStanceArgs,
    /// The folder of the kit [default: such as bunny-core]
    #[arg(long, value_name = "DIR", help_heading = "Kit")]
    pub out: Option<PathBuf>,
    /// Overwrite an existing folder
    #[arg(long, help_heading = "Kit")]
    pub force: bool,
    /// Replay the run of this job.toml; MODEL, if given, replaces its model
    #[arg(long, value_name = "FILE", help_heading = "Kit", conflicts_with_all = DECIDED_BY_JOB)]
    pub job: Option<PathBuf>,
}

/// The arguments of the base and the parts around it.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Base and shell")]
pub struct BaseArgs {
    /// The greatest number of panels of a polyhedron, from 4 to 32 [default: 12, or as many as
    /// the start of moved vertices has faces]
    #[arg(long, value_name = "N", allow_hyphen_values = true)]
    pub faces: Option<usize>,
    /// The way to find the base: planes that move, or vertices as in CofiFab [default: planes]
    ///
    /// Vertices start from a cube, a dodecahedron or an icosahedron, such as vertices:cube. They
    /// make one polyhedron. What they yield is not proved, so its faces move inward until
    /// it is. Without a start, those with no more faces than asked for are tried. The largest is
    /// kept, first of all of those that get panels.
    #[arg(long, value_name = "planes|vertices[:START]")]
    pub method: Option<BaseMethod>,
    /// The number of polyhedra inside, bolted or doweled together: auto, or 1 to 6 [default: 1]
    #[arg(long, value_name = "auto|N", allow_hyphen_values = true)]
    pub polyhedra: Option<Polyhedra>,
    /// The least radius of the disc in which two polyhedra bear on each other [default: 20mm, or
    /// what two bolts need]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub connector: Option<Length>,
    /// The rods between polyhedra that do not bear on each other: auto, none, or an id such as
    /// dowel-8 [default: auto]
    ///
    /// Auto takes the thickest on stock that have room. There are two of them at each neck, cut
    /// from beech rods and glued into a panel on either side.
    #[arg(long, value_name = "auto|none|ID")]
    pub dowel: Option<Dowel>,
    /// The base in this file, such as an edited base.toml of a kit; with a job, in place of its own
    #[arg(long, value_name = "FILE", conflicts_with_all = ["polyhedra", "faces", "method"])]
    pub base: Option<PathBuf>,
    /// Fingers where they fit and brackets elsewhere, or one of both on all edges [default: auto]
    #[arg(long, value_parser = words::<CoreJoints>(CoreJoints::WORDS))]
    pub joints: Option<CoreJoints>,
    /// The wall of the parts [default: 3mm, or the printer's minimum if that is more]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub wall: Option<Length>,
    /// Hollow parts, open to the base, or solid ones [default: cups]
    #[arg(long, value_parser = words::<CoreShell>(CoreShell::WORDS))]
    pub shell: Option<CoreShell>,
}

/// The arguments of standing.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct CoreStanceArgs {
    /// Stand on its own foot, or promise nothing [default: stand]
    #[arg(long, value_parser = words::<CoreGoal>(CoreGoal::WORDS))]
    pub goal: Option<CoreGoal>,
    /// The lean at which it still stands [default: 5°]
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true)]
    pub least_angle: Option<f64>,
    /// Lay steel discs on the lowest panel inside: auto, none, or a part such as disc-50-10x3
    /// [default: none]
    ///
    /// Auto lays the least mass of one kind with which the object leans as far as promised.
    #[arg(long, value_name = "auto|ID[xN]|none")]
    pub ballast: Option<BallastOrder>,
    /// The direction of the model that points up: x, y, z, -x, -y, -z, X,Y,Z or natural
    /// [default: natural]
    #[arg(long, value_name = "UP", allow_hyphen_values = true)]
    pub up: Option<Up>,
}

/// The arguments that a replayed job decides.
const DECIDED_BY_JOB: [&str; 21] = [
    "printer",
    "material",
    "cutter",
    "sheet",
    "stock",
    "grain",
    "size",
    "scale",
    "unit",
    "faces",
    "method",
    "polyhedra",
    "connector",
    "dowel",
    "joints",
    "wall",
    "shell",
    "goal",
    "least_angle",
    "ballast",
    "up",
];

impl CoreArgs {
    /// Returns the job that was ordered, and the target of its kit.
    ///
    /// # Errors
    /// A machine or the sheet is missing, or a file they name cannot be used.
    pub fn order(self) -> Result<Order<CoreJob>, ArgsError> {
        let (out, force) = (self.out.clone(), self.force);
        let base = self.base.base.clone();
        let job = match &self.job {
            Some(path) => replay(path, self.model)?,
            None => self.new_job()?,
        };
        let base = base.map(|path| BaseChoice::read(&path)).transpose()?;
        let job = CoreJob {
            base: base.or(job.base),
            ..job
        };
        let usual = || PathBuf::from(format!("{}-core", job.name()));
        Ok(Order {
            out: out.unwrap_or_else(usual),
            force,
            job,
        })
    }

    fn new_job(self) -> Result<CoreJob, ArgsError> {
        let path = self.model.unwrap_or_default();
        let chosen = chosen_printer(self.printer.as_deref(), self.material, &path)?;
        let (Some(printer), Some(cutter), Some(sheet)) = (chosen, self.cutter, self.sheet) else {
            return Err(ArgsError::NoMachines {
                model: path.display().to_string(),
            });
        };
        let model = ModelChoice {
            path,
            sha256: None,
            scaling: self.scaling.scaling(),
        };
        let cutting = CutChoice {
            stock: self.stock.unwrap_or_default(),
            grain: self.grain,
            ..CutChoice::new(cutter, sheet)
        };
        let default = CoreJob::new(model, printer, cutting);
        let (base, stance) = (self.base, self.stance);
        let method = base.method.unwrap_or_default();
        let faces = method.most_faces().unwrap_or(default.faces);
        Ok(CoreJob {
            faces: base.faces.unwrap_or(faces),
            method,
            polyhedra: base.polyhedra.unwrap_or(default.polyhedra),
            connector: base.connector,
            dowel: base.dowel.unwrap_or_default(),
            joints: base.joints.unwrap_or(default.joints),
            wall: base.wall,
            shell: base.shell.unwrap_or(default.shell),
            goal: stance.goal.unwrap_or(default.goal),
            least_angle_deg: stance.least_angle.unwrap_or(default.least_angle_deg),
            ballast: stance.ballast.unwrap_or_default(),
            up: stance.up.unwrap_or(default.up),
            ..default
        })
    }
}

/// Returns the job in a file, with another model if one is given. Else the model is read from the
/// kit of the job, or from the file's folder.
fn replay(file: &Path, model: Option<PathBuf>) -> Result<CoreJob, ArgsError> {
    let mut job = CoreJob::read(file)?;
    match model {
        Some(model) => job.model.path = model,
        None => {
            let sha256 = job.model.sha256.as_deref();
            job.model_copy = copy_beside(file, &job.model.path, sha256);
        }
    }
    Ok(job)
}
