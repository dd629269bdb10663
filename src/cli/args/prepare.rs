//! The arguments of `prepare`, and the job they make.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::Args;

use super::ballast::BallastArgs;
use super::beside::copy_beside;
use super::cut::{CutArg, CutArgs, FieldArg};
use super::decided::DECIDED_BY_JOB;
use super::error::ArgsError;
use super::goal::{HardwareArgs, MatchArgs, PromiseArgs, RotorArgs, WaterArgs};
use super::missing::Missing;
use super::scaling::ScalingArgs;
use super::tets::TetsArgs;
use super::values::{EXIT_CODES, GoalReader, PREPARE_EXAMPLES, words};
use crate::base::units::Length;
use crate::cli::shop::chosen_printer;
use crate::goal::{self, Contact, GoalKind, Objective, SpinPoint, Up};
use crate::job::{Job, ModelChoice, PartFormat, SlicerChoice};
use crate::repair::RepairOrder;

/// The usage: the required arguments, and the options.
const USAGE: &str = "equipoise prepare <MODEL> --goal <GOAL> --printer <ID|FILE> [OPTIONS]";

/// The heading of the arguments that come first in the help.
const FIRST: &str = "What to make";

/// The arguments of `prepare`.
#[derive(Debug, Args)]
#[command(
    after_help = PREPARE_EXAMPLES,
    after_long_help = [PREPARE_EXAMPLES, EXIT_CODES].join("\n\n"),
    override_usage = USAGE
)]
pub struct PrepareArgs {
    /// The answers to questions, as they would be typed.
    #[arg(skip)]
    pub answered: Vec<String>,
    /// The model: an STL, OBJ, PLY or 3MF file that bounds a solid
    #[arg(value_name = "MODEL")]
    pub model: Option<PathBuf>,

    /// The goal: top, yoyo, stand, float, balance or match
    ///
    /// A top spins on the table, a yo-yo freely about an axis. A rotor in balance runs true on its
    /// shaft. A match handles like another body (--like, or --mass, --center and --inertia).
    #[arg(long, value_parser = GoalReader, hide_possible_values = true, help_heading = FIRST)]
    pub goal: Option<GoalKind>,
    /// A printer's id, or a profile file
    ///
    /// `equipoise printers` lists the ids. Without one the printer in equipoise.toml is taken.
    #[arg(long, value_name = "ID|FILE", help_heading = FIRST)]
    pub printer: Option<String>,
    /// The size of the model.
    #[command(flatten, next_help_heading = FIRST)]
    pub scaling: ScalingArgs,
    /// The side up, such as y or -x [default: natural]
    ///
    /// It is x, y, z, -x, -y, -z, a vector X,Y,Z, natural, principal or auto. Natural is the way
    /// the model stands by itself. Tops and yo-yos take the axis nearest to it that works.
    /// Rotors turn on their bore or shaft. Principal is the axis easiest to spin about, auto the
    /// best of all.
    #[arg(
        long,
        value_name = "AXIS",
        allow_hyphen_values = true,
        help_heading = FIRST
    )]
    pub up: Option<Up>,
    /// Never ask, not even on a terminal
    #[arg(long, help_heading = FIRST)]
    pub no_questions: bool,

    /// Repair the model beyond what moves nothing: cavities, fill, remesh or remesh:TOLERANCE
    /// [default: auto]
    ///
    /// Surfaces inside the model bound cavities, or they are filled. Remesh draws a new surface,
    /// for files that cannot be mended. Two are joined by a comma: remesh:0.1mm,fill.
    #[arg(long, value_name = "HOW", help_heading = FIRST)]
    pub repair: Option<RepairOrder>,

    /// A material that the printer offers [default: the printer's]
    #[arg(long, value_name = "ID", help_heading = "Printer")]
    pub material: Option<String>,
    /// The minimum wall, rounded up to whole pixels or lines [default: the printer's minimum]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Printer"
    )]
    pub wall: Option<Length>,
    /// Thicken what of the model is thinner than the printer's least wall, in place of a refusal
    #[arg(long, help_heading = "Printer")]
    pub thicken: bool,

    /// The point where a top touches the ground: lowest, center, X,Y,Z in mm, or auto. Center is
    /// below the centre of mass; auto is lowest if it spins there, else center [default: auto]
    #[arg(
        long,
        value_name = "POINT",
        allow_hyphen_values = true,
        help_heading = "Goal"
    )]
    pub contact: Option<Contact>,
    /// A point on the axis of a yo-yo or rotor: center (of mass) or X,Y,Z in mm
    /// [default: center; a rotor's bore]
    #[arg(
        long,
        value_name = "POINT",
        allow_hyphen_values = true,
        help_heading = "Goal"
    )]
    pub spin_point: Option<SpinPoint>,
    /// The quantity to optimise [default: the first of its goal]. Top: critical-speed, spin-it.
    /// Yoyo: spin-it, dominance. Stand: toppling-angle, lowest-center. Float: metacentric-height.
    /// Balance: least-removed, least-unbalance. Match: least-change. Spin-It's functional takes two
    /// weights, that of a low centre first: spin-it:γc,γI [default: 1,1]
    #[arg(
        long,
        value_name = "OBJECTIVE",
        allow_hyphen_values = true,
        help_heading = "Goal"
    )]
    pub objective: Option<Objective>,
    /// The promises of lean and toppling angle.
    #[command(flatten)]
    pub promises: PromiseArgs,
    /// The speed and grade of a rotor.
    #[command(flatten)]
    pub rotor: RotorArgs,
    /// The liquid and the waterline.
    #[command(flatten)]
    pub water: WaterArgs,
    /// The body that a match is like.
    #[command(flatten)]
    pub like: MatchArgs,
    /// The hardware.
    #[command(flatten)]
    pub hardware: HardwareArgs,

    /// Grid spacing of the solver [default: the printer's pixel, at most a quarter of the wall]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Method"
    )]
    pub pitch: Option<Length>,
    /// The cuts and joints.
    #[command(flatten)]
    pub cutting: CutArgs,
    /// The ballast or filling.
    #[command(flatten)]
    pub load: BallastArgs,

    /// The volume mesh to write.
    #[command(flatten)]
    pub tets: TetsArgs,

    /// The folder of the kit [default: such as elephant-top]
    #[arg(long, value_name = "DIR", help_heading = FIRST)]
    pub out: Option<PathBuf>,
    /// Overwrite an existing folder
    #[arg(long, help_heading = "Kit")]
    pub force: bool,
    /// Write this many plans of cuts side by side, 1 to 4, in place of a kit [default: 3 with the
    /// command cuts]
    #[arg(
        long,
        value_name = "N",
        value_parser = clap::value_parser!(u8).range(1..=4),
        help_heading = "Kit"
    )]
    pub plans: Option<u8>,
    /// The file format of the parts; 3mf writes the assembly and the build plates too [default:
    /// both]
    #[arg(long, value_parser = words::<PartFormat>(PartFormat::WORDS), help_heading = "Kit")]
    pub format: Option<PartFormat>,
    /// Ask this slicer (PrusaSlicer, SuperSlicer or cura, by name or path) what the plates take,
    /// and put its time and filament on the sheet
    #[arg(long, value_name = "CMD", help_heading = "Kit")]
    pub slicer: Option<String>,
    /// Slice the kit, and make it again with what its toolpaths lay until they keep the promise
    #[arg(long, help_heading = "Kit", conflicts_with = "plans")]
    pub slice: bool,
    /// With --slice: a configuration exported by the slicer, as `slice --profile` takes it
    #[arg(long, value_name = "FILE", help_heading = "Kit", requires = "slice")]
    pub slicer_profile: Option<PathBuf>,
    /// Leave the copy of the model out of the kit; `verify` then needs --model to compare with it
    #[arg(long, help_heading = "Kit")]
    pub no_model: bool,
    /// Replay the run of this job.toml; MODEL, if given, replaces its model
    #[arg(long, value_name = "FILE", help_heading = "Kit", conflicts_with_all = DECIDED_BY_JOB)]
    pub job: Option<PathBuf>,
}

/// Number of plans that the command for plans writes.
pub const DEFAULT_PLANS: u8 = 3;

/// The order for `prepare`: the job, and the target of its kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The job, which decides the bytes of the kit.
    pub job: Job,
    /// The folder to write the kit to.
    pub out: PathBuf,
    /// True if an existing folder is replaced.
    pub force: bool,
    /// True if the kit is sliced, and solved for again with its toolpaths.
    pub slice: bool,
    /// The slicer's own profile for that.
    pub slicer_profile: Option<PathBuf>,
    /// The volume mesh to write beside the kit.
    pub tets: TetsArgs,
    /// The command line that was typed, with the answers to questions.
    pub typed: Vec<String>,
}

impl PrepareArgs {
    /// Returns the arguments that are missing and cannot be done without; `None` if there are none.
    ///
    /// # Errors
    /// The file equipoise.toml cannot be used.
    pub fn missing(&self) -> Result<Option<Missing>, ArgsError> {
        if self.job.is_some() {
            return Ok(None);
        }
        let near = self.model.clone().unwrap_or_default();
        let chosen = chosen_printer(self.printer.as_deref(), None, &near)?;
        let missing = Missing {
            model: self.model.clone(),
            goal: self.goal,
            printer: chosen.map(|printer| printer.id),
            is_size_open: self.scaling.is_open(),
        };
        Ok(Some(missing).filter(Missing::is_any))
    }

    /// Returns the job that was ordered, and the target of its kit.
    ///
    /// # Errors
    /// Arguments are missing or contradict each other, or a file they name cannot be used.
    pub fn request(self) -> Result<Request, ArgsError> {
        if let Some(missing) = self.missing()? {
            return Err(ArgsError::Missing(missing));
        }
        let (out, force, plans) = (self.out.clone(), self.force, self.plans);
        let (slice, slicer_profile) = (self.slice, self.slicer_profile.clone());
        let tets = self.tets.clone();
        let of_kits = [(slice, "--slice"), (tets.tets.is_some(), "--tets")];
        let unused = of_kits
            .iter()
            .find(|(is_ordered, _)| *is_ordered && plans.is_some());
        if let Some((_, flag)) = unused {
            return Err(ArgsError::OnlyOfKits(flag));
        }
        let typed = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
        let typed = typed.chain(self.answered.iter().cloned()).collect();
        let job = match &self.job {
            Some(path) => replay(path, self.model)?,
            None => self.new_job()?,
        };
        let out = out.unwrap_or_else(|| default_out(&job, plans));
        Ok(Request {
            job,
            out,
            force,
            slice,
            slicer_profile,
            tets,
            typed,
        })
    }

    fn new_job(self) -> Result<Job, ArgsError> {
        let path = self.model.clone().unwrap_or_default();
        let printer = chosen_printer(self.printer.as_deref(), self.material.clone(), &path)?;
        let (Some(kind), Some(printer)) = (self.goal, printer) else {
            // Asked for before.
            return Err(ArgsError::Missing(Missing::of_nothing()));
        };
        let model = ModelChoice {
            path,
            sha256: None,
            scaling: self.scaling.scaling(),
        };
        let default = Job::new(model, printer, self.goal(kind)?);
        let (cut, plan) = self
            .cutting
            .cut
            .map(CutArg::order)
            .transpose()?
            .unwrap_or((default.cut, None));
        let mut keep_clear = self.cutting.keep_clear;
        let of_plan = plan.iter().flat_map(|plan| plan.keep_clear.clone());
        keep_clear.extend(of_plan);
        let plan = plan.filter(|plan| !plan.is_only_clear());
        Ok(Job {
            wall: self.wall,
            pitch: self.pitch,
            cut,
            plan,
            drain: self.cutting.drain.unwrap_or_default(),
            plugs: self.cutting.plugs,
            interior: self.cutting.interior.unwrap_or(default.interior),
            cell_size: self.cutting.cell_size,
            density: self.cutting.density,
            infill: self.cutting.infill,
            levels: self.cutting.levels,
            keep: self.cutting.keep,
            field: self.cutting.field.map(FieldArg::order).transpose()?,
            seam: self.cutting.seam.unwrap_or(default.seam),
            keep_clear,
            least_part: self.cutting.least_part.unwrap_or(default.least_part),
            pins: self.cutting.pins.unwrap_or(default.pins),
            ids: self.cutting.ids.unwrap_or(default.ids),
            effort: self.cutting.effort.unwrap_or(default.effort),
            joint_price_ratio: self.cutting.joint_price,
            thicken: self.thicken,
            no_model: self.no_model,
            slicer: self.slicer.map(|command| SlicerChoice {
                command,
                version: None,
            }),
            format: self.format.unwrap_or(default.format),
            ballast: self.load.ballast.unwrap_or(default.ballast),
            fill: self.load.fill,
            repair: self.repair.unwrap_or_default(),
            like: self.like.like,
            ..default
        })
    }

    fn goal(&self, kind: GoalKind) -> Result<goal::Request, ArgsError> {
        let default = goal::Request::new(kind);
        let is_match = kind == GoalKind::Match;
        let request = goal::Request {
            up: self
                .up
                .unwrap_or(if is_match { default.up } else { Up::Natural }),
            contact: self.contact.or(default.contact),
            spin_point: self.spin_point.or(default.spin_point),
            objective: self.objective.unwrap_or(default.objective),
            rotor: self.rotor.or_default(default.rotor),
            water: self.water.or_default(default.water),
            target: self.like.target(),
            hardware: self.hardware.order(),
            tip: self.hardware.tip.unwrap_or(default.tip),
            least_lean_deg: self.promises.least_lean.unwrap_or(default.least_lean_deg),
            least_angle_deg: self.promises.least_angle.unwrap_or(default.least_angle_deg),
            ..default
        };
        Ok(request.validate()?)
    }
}

/// Returns the job in a file, with another path of its model if one is given. Else the model is
/// read from the kit of the job, or from the file's folder.
fn replay(file: &Path, model: Option<PathBuf>) -> Result<Job, ArgsError> {
    let job = Job::read(file)?;
    let copy = match &model {
        Some(_) => None,
        None => copy_beside(file, &job.model.path, job.model.sha256.as_deref()),
    };
    let path = model.unwrap_or(job.model.path);
    Ok(Job {
        model: ModelChoice { path, ..job.model },
        model_copy: copy,
        ..job
    })
}

/// Returns `<model>-<goal>` in the current folder, or `<model>-plans` for plans of cuts.
fn default_out(job: &Job, plans: Option<u8>) -> PathBuf {
    let stem = job.model.path.file_stem();
    let mut name = stem.map_or_else(|| OsString::from("model"), ToOwned::to_owned);
    name.push(plans.map_or_else(|| format!("-{}", job.goal.kind), |_| "-plans".to_owned()));
    PathBuf::from(name)
}
