//! The arguments of `telescope`, and the job they make.

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
use crate::job::telescope::{
    Bends, FootSize, JunctureKind, Lock, Opening, PoseChoice, Reach, Root, ShellCount, Stance,
    TelescopeJob, Twists,
};

/// The arguments of `telescope`.
#[derive(Debug, Clone, Args)]
pub struct TelescopeArgs {
    /// The curve: text with one x,y,z a line, OBJ with lines, PLY with edges, arc:R,DEG or
    /// helix:R,PITCH,TURNS. Or a skeleton: its file, or OBJ with lines that branch. Or a model
    #[arg(required_unless_present = "job")]
    pub input: Option<String>,
    /// A known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE")]
    pub printer: Option<String>,
    /// A material that the printer offers [default: the printer's]
    #[arg(long, value_name = "ID")]
    pub material: Option<String>,
    /// The size of the curve.
    #[command(flatten, next_help_heading = "Size")]
    pub scaling: ScalingArgs,
    /// The shells.
    #[command(flatten)]
    pub shells: ShellArgs,
    /// The limbs of a skeleton or a model.
    #[command(flatten)]
    pub limbs: LimbArgs,
    /// What the open telescope does.
    #[command(flatten)]
    pub stance: StanceArgs,
    /// The poses.
    #[command(flatten)]
    pub poses: PoseArgs,
    /// The folder of the kit [default: such as hook-telescope]
    #[arg(long, value_name = "DIR", help_heading = "Kit")]
    pub out: Option<PathBuf>,
    /// Overwrite an existing folder
    #[arg(long, help_heading = "Kit")]
    pub force: bool,
    /// Replay the run of this job.toml; INPUT, if given, replaces its curve
    #[arg(long, value_name = "FILE", help_heading = "Kit", conflicts_with_all = DECIDED_BY_JOB)]
    pub job: Option<PathBuf>,
}

/// The arguments of the shells and their joints.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Shells")]
pub struct ShellArgs {
    /// The number of shells, up to 40, or auto: the fewest that come near enough [default: auto]
    #[arg(long, value_name = "N|auto", allow_hyphen_values = true)]
    pub shells: Option<ShellCount>,
    /// The radius of the tip's body [default: the least that is sound]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub tip_radius: Option<Length>,
    /// The most that the radius of the root may be [default: any]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub root_radius: Option<Length>,
    /// The most that a shell may show [default: what the printer has room for]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub shell_length: Option<Length>,
    /// The deviation from the curve that is near enough [default: a hundredth of its length, at
    /// least 1mm]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub deviation: Option<Length>,
    /// The minimum wall, rounded up to whole pixels or lines [default: the printer's minimum]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub wall: Option<Length>,
    /// The clearance with which shells slide, on each side [default: the material's or printer's]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub clearance: Option<Length>,
    /// What stays inside of a shell that is all out [default: a fifth of the shell or the root's
    /// radius, less if shells turn]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub overlap: Option<Length>,
    /// One curvature for all shells, or its own for each [default: each, or one in place]
    #[arg(long, value_parser = words::<Bends>(Bends::WORDS))]
    pub curvature: Option<Bends>,
    /// One torsion for all shells, its own for each, or none [default: each, or one in place]
    #[arg(long, value_parser = words::<Twists>(Twists::WORDS))]
    pub torsion: Option<Twists>,
    /// Hold open shells by a ring that is pressed in, or not [default: press]
    #[arg(long, value_parser = words::<Lock>(Lock::WORDS))]
    pub lock: Option<Lock>,
    /// The order in which the joints open [default: auto]
    #[arg(long, value_parser = words::<Opening>(Opening::WORDS))]
    pub order: Option<Opening>,
    /// Print all shells in each other, in one go: one curvature and one torsion for all
    #[arg(
        long,
        value_name = "true|false",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "true"
    )]
    pub in_place: Option<bool>,
}

/// The arguments of skeletons and models.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Limbs")]
pub struct LimbArgs {
    /// The bodies in which limbs meet: the model's own pieces, balls, or hulls [default: model for
    /// a model, else ball]
    #[arg(long, value_parser = words::<JunctureKind>(JunctureKind::WORDS))]
    pub junctures: Option<JunctureKind>,
    /// Limbs thinner than this radius stay solid [default: those that carry no two shells]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub keep_solid: Option<Length>,
    /// The node that the limbs grow from: its number, or a place near it in mm [default: that of
    /// the skeleton]
    #[arg(long, value_name = "NODE|X,Y,Z", allow_hyphen_values = true)]
    pub root: Option<Root>,
}

/// The arguments of standing.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Goal")]
pub struct StanceArgs {
    /// Stand at every state on a foot below the root, or promise nothing [default: none]
    #[arg(long, value_parser = words::<Stance>(Stance::WORDS))]
    pub goal: Option<Stance>,
    /// The lean at which it still stands [default: 5°]
    #[arg(long, value_name = "DEG", value_parser = angle, allow_hyphen_values = true)]
    pub least_angle: Option<f64>,
    /// The radius of the foot, or auto: the least on which it stands [default: auto]
    #[arg(long, value_name = "LENGTH|auto", allow_hyphen_values = true)]
    pub foot: Option<FootSize>,
    /// Steel discs in a pocket under the foot: the lightest that hold it (auto), or those of an id
    /// such as disc-60-10x2 [default: none]
    #[arg(long, value_name = "auto|ID|IDxN|none")]
    pub ballast: Option<BallastOrder>,
}

/// The arguments of poses.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Poses")]
pub struct PoseArgs {
    /// Find the strokes and turns that bring a tip to a place, to within 1mm: `tip` of a curve, or
    /// the limb of a figure that ends there. May be given once for each tip
    #[arg(long, value_name = "TIP=X,Y,Z", allow_hyphen_values = true)]
    pub reach: Vec<Reach>,
    /// Add the pose in this file, such as one from the kit of an earlier run
    #[arg(long, value_name = "FILE")]
    pub pose: Option<PathBuf>,
}

/// The arguments that a replayed job decides.
const DECIDED_BY_JOB: [&str; 27] = [
    "printer",
    "material",
    "size",
    "scale",
    "unit",
    "shells",
    "tip_radius",
    "root_radius",
    "shell_length",
    "deviation",
    "wall",
    "clearance",
    "overlap",
    "curvature",
    "torsion",
    "lock",
    "order",
    "in_place",
    "junctures",
    "keep_solid",
    "root",
    "goal",
    "least_angle",
    "foot",
    "ballast",
    "reach",
    "pose",
];

impl TelescopeArgs {
    /// Returns the job that was ordered, and the target of its kit.
    ///
    /// # Errors
    /// The printer is missing, or a file they name cannot be used.
    pub fn order(self) -> Result<Order<TelescopeJob>, ArgsError> {
        let (out, force) = (self.out.clone(), self.force);
        let job = match &self.job {
            Some(path) => replay(path, self.input)?,
            None => self.new_job()?,
        };
        let usual = || PathBuf::from(format!("{}-telescope", job.name()));
        Ok(Order {
            out: out.unwrap_or_else(usual),
            force,
            job,
        })
    }

    fn new_job(self) -> Result<TelescopeJob, ArgsError> {
        let input = self.input.unwrap_or_default();
        let chosen = chosen_printer(self.printer.as_deref(), self.material, Path::new(&input))?;
        let Some(printer) = chosen else {
            return Err(ArgsError::NoPrinter { input });
        };
        let pose = self.poses.pose.as_deref().map(PoseChoice::read);
        let default = TelescopeJob::new(&input, self.scaling.scaling(), printer);
        let (shells, stance) = (self.shells, self.stance);
        let in_place = shells.in_place.unwrap_or(default.in_place);
        Ok(TelescopeJob {
            shells: shells.shells.unwrap_or(default.shells),
            tip_radius: shells.tip_radius,
            root_radius: shells.root_radius,
            shell_length: shells.shell_length,
            deviation: shells.deviation,
            wall: shells.wall,
            clearance: shells.clearance,
            overlap: shells.overlap,
            curvature: shells.curvature.unwrap_or(match in_place {
                true => Bends::One,
                false => default.curvature,
            }),
            torsion: shells.torsion.unwrap_or(match in_place {
                true => Twists::One,
                false => default.torsion,
            }),
            in_place,
            lock: shells.lock.unwrap_or(default.lock),
            order: shells.order.unwrap_or(default.order),
            junctures: self.limbs.junctures,
            keep_solid: self.limbs.keep_solid,
            root: self.limbs.root,
            goal: stance.goal.unwrap_or(default.goal),
            least_angle_deg: stance.least_angle.unwrap_or(default.least_angle_deg),
            foot: stance.foot.unwrap_or(default.foot),
            ballast: stance.ballast.unwrap_or_default(),
            reach: self.poses.reach,
            pose: pose.transpose()?,
            ..default
        })
    }
}

/// Returns the job in a file, with another curve if one is given. Else a curve's file is read from
/// the kit of the job, or from the file's folder.
fn replay(file: &Path, input: Option<String>) -> Result<TelescopeJob, ArgsError> {
    let mut job = TelescopeJob::read(file)?;
    match input {
        Some(input) => job.curve.source = input,
        None => {
            let sha256 = job.curve.sha256.as_deref();
            let copy = |named: &Path| copy_beside(file, named, sha256);
            job.curve_copy = job.curve_file().and_then(copy);
        }
    }
    Ok(job)
}
