//! The command line: what can be asked for, and the job it makes.

use std::{
    ffi::OsString,
    path::{Path, PathBuf},
    str::FromStr,
};

use clap::{
    Args, Parser, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
};

use super::ballast_args::BallastArgs;
use super::cut_arg::{CutArg, CutArgs};
use super::goal_args::{HardwareArgs, RotorArgs, WaterArgs};
use crate::{
    goal::{self, Contact, GoalKind, Objective, RequestError, SpinPoint, Up},
    job::{Job, JobError, ModelChoice, ModelUnit, PartFormat, PlanError, Scaling, Solver},
    printer::ShopError,
    units::Length,
    words::ChoiceError,
};

use super::{
    args_printers::{CouponArgs, PrintersArgs},
    shop::chosen_printer,
};

const EXIT_CODES: &str = "\
LENGTH takes a unit (100mm, 10cm, 0.1m, 4in); without one it is in mm.
Exit codes: 0 every promise kept; 1 finished, but a check failed or the goal is impossible; 2 could not run.";

/// Hollow a 3D model so that its printed, glued parts spin, stand or balance as asked.
#[derive(Debug, Parser)]
#[command(name = "equipoise", version, after_help = EXIT_CODES)]
pub struct Cli {
    /// What every command takes.
    #[command(flatten)]
    pub global: GlobalArgs,
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The most threads. Far more than there are cores, and the waiting ones take the time of those at work.
const MAX_THREADS: i64 = 256;

/// What every command takes.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Everywhere")]
pub struct GlobalArgs {
    /// Say nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more; twice, say everything
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Use so many threads, up to 256; the result does not depend on it [default: one for each core]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=MAX_THREADS))]
    pub threads: Option<u16>,
    /// Print the result as JSON on the standard output
    #[arg(long, global = true)]
    pub json: bool,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Turn a model into a kit of printable parts that does what the goal says
    Prepare(Box<PrepareArgs>),
    /// Tell what a model is: facts, defects, mass, and what it could become
    Inspect(InspectArgs),
    /// List the known printers, show one, or check a profile of your own
    Printers(PrintersArgs),
    /// Make coupons to print, weigh and try, so that a profile says what the machine does
    Coupon(CouponArgs),
    /// Read a kit's written files again and judge them, without the solver
    Verify(VerifyArgs),
}

/// The arguments of `prepare`.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct PrepareArgs {
    /// The model: an STL or OBJ file that bounds a solid
    #[arg(required_unless_present = "job")]
    pub model: Option<PathBuf>,

    /// A known printer's id (see `equipoise printers`), or a profile file [default: the shop's, from equipoise.toml]
    #[arg(long, value_name = "ID|FILE", help_heading = "Printer")]
    pub printer: Option<String>,
    /// A material the printer offers [default: the printer's]
    #[arg(long, value_name = "ID", help_heading = "Printer")]
    pub material: Option<String>,
    /// Keep at least this wall, rounded up to whole pixels or lines [default: the printer's least]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Printer")]
    pub wall: Option<Length>,

    /// What the object is to do
    #[arg(long, value_parser = words::<GoalKind>(GoalKind::WORDS), required_unless_present = "job", help_heading = "Goal")]
    pub goal: Option<GoalKind>,
    /// The spin axis or up: x, y, z, -x, -y, -z, any vector X,Y,Z, principal (the axis easiest to spin about) or
    /// auto (the best of all) [default: z]
    #[arg(long, value_name = "AXIS", allow_hyphen_values = true, help_heading = "Goal")]
    pub up: Option<Up>,
    /// Where a top touches the ground: lowest, center (below the centre of mass) or X,Y,Z in mm [default: lowest]
    #[arg(long, value_name = "POINT", allow_hyphen_values = true, help_heading = "Goal")]
    pub contact: Option<Contact>,
    /// A point of the axis a yo-yo spins or a rotor turns about: center (of mass) or X,Y,Z in mm [default: center]
    #[arg(long, value_name = "POINT", allow_hyphen_values = true, help_heading = "Goal")]
    pub spin_point: Option<SpinPoint>,
    /// What is made as good as it can be: top: critical-speed, spin-it; yoyo: spin-it, dominance; stand: toppling-angle,
    /// lowest-center; float: metacentric-height; balance: least-removed, least-unbalance [default: the first]. The weights
    /// of Spin-It's functional may follow it, that of a low centre first: spin-it:γc,γI [default: 1,1]
    #[arg(long, value_name = "OBJECTIVE", allow_hyphen_values = true, help_heading = "Goal")]
    pub objective: Option<Objective>,
    /// How a rotor runs.
    #[command(flatten)]
    pub rotor: RotorArgs,
    /// How it floats.
    #[command(flatten)]
    pub water: WaterArgs,
    /// What is put into it.
    #[command(flatten)]
    pub hardware: HardwareArgs,

    /// The model's size.
    #[command(flatten)]
    pub scaling: ScalingArgs,

    /// How the void is found [default: quadric]
    #[arg(long, value_parser = words::<Solver>(Solver::WORDS), help_heading = "Method")]
    pub solver: Option<Solver>,
    /// Solve with columns so far apart [default: the printer's pixel, at most a quarter of the wall]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Method")]
    pub pitch: Option<Length>,
    /// How it is cut and joined.
    #[command(flatten)]
    pub cutting: CutArgs,
    /// What is put into it.
    #[command(flatten)]
    pub load: BallastArgs,

    /// Write the kit to this folder [default: the model's name with -kit]
    #[arg(long, value_name = "DIR", help_heading = "Kit")]
    pub out: Option<PathBuf>,
    /// Replace the folder if it is there
    #[arg(long, help_heading = "Kit")]
    pub force: bool,
    /// The file format of the parts [default: stl]
    #[arg(long, value_parser = words::<PartFormat>(PartFormat::WORDS), help_heading = "Kit")]
    pub format: Option<PartFormat>,
    /// Replay the run that this job.toml describes; MODEL, if given, stands for its model
    #[arg(long, value_name = "FILE", help_heading = "Kit", conflicts_with_all = DECIDED_BY_JOB)]
    pub job: Option<PathBuf>,
}

/// The arguments that a replayed job has already decided.
const DECIDED_BY_JOB: [&str; 29] = [
    "printer",
    "material",
    "wall",
    "goal",
    "up",
    "contact",
    "spin_point",
    "objective",
    "speed",
    "grade",
    "bore",
    "liquid",
    "waterline",
    "string_gap",
    "axle",
    "hardware_mass",
    "tip",
    "stem",
    "size",
    "scale",
    "unit",
    "solver",
    "pitch",
    "cut",
    "pins",
    "ids",
    "format",
    "ballast",
    "fill",
];

/// How large the model is; one of them at most.
#[derive(Debug, Clone, Args)]
#[group(multiple = false)]
#[command(next_help_heading = "Size")]
pub struct ScalingArgs {
    /// Make the longest side this long
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    pub size: Option<Length>,
    /// Multiply the file's numbers by this to get mm
    #[arg(long, value_name = "FACTOR", value_parser = factor, allow_hyphen_values = true)]
    pub scale: Option<f64>,
    /// The unit of the file's numbers [default: mm]
    #[arg(long, value_parser = words::<ModelUnit>(ModelUnit::WORDS))]
    pub unit: Option<ModelUnit>,
}

/// The arguments of `inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The model: an STL or OBJ file
    pub model: PathBuf,
    /// Tell what it could become on this printer: a known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE", help_heading = "Printer")]
    pub printer: Option<String>,
    /// Tell what it could become with this wall [default: the printer's least; a hundredth of the size without a printer]
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true, help_heading = "Printer")]
    pub wall: Option<Length>,
    /// The model's size.
    #[command(flatten)]
    pub scaling: ScalingArgs,
}

/// The arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// The folder of the kit
    pub kit: PathBuf,
}

/// What `prepare` is to do: the job, and where its kit goes.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// What decides the kit.
    pub job: Job,
    /// The folder it is written to.
    pub out: PathBuf,
    /// Whether a folder that is there is replaced.
    pub force: bool,
}

/// Arguments that do not go together.
#[derive(Debug, thiserror::Error)]
pub enum ArgsError {
    /// The goal's.
    #[error(transparent)]
    Goal(#[from] RequestError),
    /// The replayed job's.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The plan's.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// An argument that neither the command line nor a job gives; the parser lets none pass.
    #[error("{0} is missing; remedy: give it, or a job to replay with --job")]
    Missing(&'static str),
    /// Neither the command line nor the shop names a printer.
    #[error(
        "--printer is missing; remedy: give it, or write printer = \"ID\" into an equipoise.toml here, beside the model or in \
         your configuration folder"
    )]
    NoPrinter,
    /// The shop's defaults cannot be used.
    #[error(transparent)]
    Shop(#[from] ShopError),
}

impl PrepareArgs {
    /// The job that was asked for, and where its kit goes.
    pub fn request(self) -> Result<Request, ArgsError> {
        let (out, force) = (self.out.clone(), self.force);
        let job = match &self.job {
            Some(path) => replayed(Job::read(path)?, self.model),
            None => self.new_job()?,
        };
        let out = out.unwrap_or_else(|| default_out(&job.model.path));
        Ok(Request { job, out, force })
    }

    fn new_job(self) -> Result<Job, ArgsError> {
        let goal = self.goal()?;
        let path = self.model.ok_or(ArgsError::Missing("MODEL"))?;
        let model = ModelChoice { path, sha256: None, scaling: self.scaling.scaling() };
        let printer = chosen_printer(self.printer, self.material, &model.path)?;
        let default = Job::new(model, printer, goal);
        let (cut, plan) = self.cutting.cut.map(CutArg::order).transpose()?.unwrap_or((default.cut, None));
        Ok(Job {
            wall: self.wall,
            pitch: self.pitch,
            solver: self.solver.unwrap_or(default.solver),
            cut,
            plan,
            pins: self.cutting.pins.unwrap_or(default.pins),
            ids: self.cutting.ids.unwrap_or(default.ids),
            format: self.format.unwrap_or(default.format),
            ballast: self.load.ballast.unwrap_or(default.ballast),
            fill: self.load.fill,
            ..default
        })
    }

    fn goal(&self) -> Result<goal::Request, ArgsError> {
        let default = goal::Request::new(self.goal.ok_or(ArgsError::Missing("--goal"))?);
        let asked = goal::Request {
            up: self.up.unwrap_or(default.up),
            contact: self.contact.or(default.contact),
            spin_point: self.spin_point.or(default.spin_point),
            objective: self.objective.unwrap_or(default.objective),
            rotor: self.rotor.over(default.rotor),
            water: self.water.over(default.water),
            hardware: self.hardware.asked(),
            ..default
        };
        Ok(asked.checked()?)
    }
}

impl ScalingArgs {
    /// What was asked for; mm where nothing was.
    pub fn scaling(&self) -> Scaling {
        match (self.size, self.scale) {
            (Some(size), _) => Scaling::Size(size),
            (None, Some(factor)) => Scaling::Factor(factor),
            (None, None) => Scaling::Unit(self.unit.unwrap_or(ModelUnit::Mm)),
        }
    }
}

fn replayed(job: Job, model: Option<PathBuf>) -> Job {
    let path = model.unwrap_or(job.model.path);
    Job { model: ModelChoice { path, ..job.model }, ..job }
}

/// `<model>-kit` in the current folder.
fn default_out(model: &Path) -> PathBuf {
    let mut name = model.file_stem().map_or_else(|| OsString::from("model"), ToOwned::to_owned);
    name.push("-kit");
    PathBuf::from(name)
}

/// Reads one of the words, which the help lists.
fn words<T>(words: &'static [&'static str]) -> impl TypedValueParser<Value = T>
where
    T: FromStr<Err = ChoiceError> + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(words).try_map(|word| word.parse::<T>())
}

/// A factor that is not positive and finite.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is not a positive, finite factor; remedy: give a number above zero")]
pub struct FactorError(String);

pub(super) fn factor(text: &str) -> Result<f64, FactorError> {
    match text.trim().parse::<f64>() {
        Ok(factor) if factor.is_finite() && factor > 0.0 => Ok(factor),
        _ => Err(FactorError(text.to_owned())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::CutMode;
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<Cli, clap::Error> {
        Cli::try_parse_from(line.split_whitespace())
    }

    fn request(line: &str) -> Request {
        match parse(line).unwrap().command {
            Command::Prepare(args) => args.request().unwrap(),
            other => panic!("{other:?}"),
        }
    }

    const PREPARE: &str = "equipoise prepare models/elephant.obj --printer objet-connex350 --goal top";

    #[test]
    fn the_definition_of_the_arguments_is_consistent() {
        Cli::command().debug_assert();
    }

    #[test]
    fn hardware_and_the_weights_of_the_functional_reach_the_job() {
        let top =
            request(&format!("{PREPARE} --tip 4mmx12mmx5mm --stem 5x30 --objective spin-it:0.5,2")).job.goal;
        assert_eq!(top.objective, Objective::SpinIt { gamma_c: 0.5, gamma_i: 2.0 });
        let hardware = top.hardware.unwrap();
        assert_eq!((hardware.tip.unwrap().to_string(), hardware.axle), ("4mmx12mmx5mm".to_owned(), None));
        assert_eq!(request(PREPARE).job.goal.hardware, None);
    }

    #[test]
    fn the_readme_command_makes_the_job_it_says() {
        let request = request(&format!("{PREPARE} --up z --contact center --size 100mm --wall 1mm"));
        let job = &request.job;
        assert_eq!(job.model.path, Path::new("models/elephant.obj"));
        assert_eq!(job.model.scaling, Scaling::Size("100mm".parse().unwrap()));
        assert_eq!((job.goal.kind, job.goal.up), (GoalKind::Top, Up::Z));
        assert_eq!(job.goal.contact, Some(Contact::Center));
        assert_eq!(job.goal.objective, Objective::CriticalSpeed);
        assert_eq!(job.wall.unwrap().mm(), 1.0);
        assert_eq!((request.out.as_path(), request.force), (Path::new("elephant-kit"), false));
    }

    #[test]
    fn what_is_not_said_gets_the_documented_default() {
        let job = request(PREPARE).job;
        assert_eq!(job.model.scaling, Scaling::Unit(ModelUnit::Mm));
        assert_eq!(
            (job.goal.up, job.goal.contact, job.goal.spin_point),
            (Up::Z, Some(Contact::Lowest), None)
        );
        assert_eq!((job.wall, job.pitch, job.printer.material), (None, None, None));
        assert_eq!((job.solver, job.cut, job.format), (Solver::Quadric, CutMode::Auto, PartFormat::Stl));
    }

    #[test]
    fn directions_may_begin_with_a_minus_sign() {
        let up = |up: &str| request(&format!("{PREPARE} {up}")).job.goal.up;
        assert_eq!(up("--up=-0.1,-0.19,0.98"), Up::Along([-0.1, -0.19, 0.98]));
        assert_eq!(up("--up -0.1,-0.19,0.98"), Up::Along([-0.1, -0.19, 0.98]));
        assert_eq!(up("--up -y"), Up::NegY);
        assert_eq!(up("--up=-y"), Up::NegY);
        assert_eq!(up("--up principal"), Up::Principal);
    }

    #[test]
    fn everything_that_can_be_said_arrives_in_the_job() {
        let line = "equipoise prepare m.stl --printer my.toml --material pla --goal yoyo --up x --spin-point -1,2,3 \
                    --objective dominance --scale 2.5 --wall 0.1cm --pitch 0.2 --solver quadric --cut never --out k --force --format stl";
        let request = request(line);
        let job = &request.job;
        assert_eq!((job.printer.id.as_str(), job.printer.material.as_deref()), ("my.toml", Some("pla")));
        assert_eq!(job.goal.spin_point, Some(SpinPoint::At([-1.0, 2.0, 3.0])));
        assert_eq!(job.goal.objective, Objective::Dominance);
        assert_eq!(job.model.scaling, Scaling::Factor(2.5));
        assert_eq!((job.wall.unwrap().mm(), job.pitch.unwrap().mm()), (1.0, 0.2));
        assert_eq!((job.cut, request.force), (CutMode::Never, true));
        assert_eq!(request.out, Path::new("k"));
    }

    #[test]
    fn bad_arguments_are_refused_with_exit_code_2_and_clear_words() {
        let cases = [
            ("--size 100mm --scale 2", "cannot be used with"),
            ("--unit in --scale 2", "cannot be used with"),
            ("--wall -1mm", "`-1mm` is not a positive, finite length"),
            ("--wall 0", "`0` is not a positive, finite length"),
            ("--wall nan", "`nan` is not a positive, finite length"),
            ("--wall 1furlong", "`furlong` in `1furlong` is not a unit"),
            ("--size inf", "positive, finite"),
            ("--scale 0", "`0` is not a positive, finite factor"),
            ("--scale -2", "`-2` is not a positive, finite factor"),
            ("--scale NaN", "`NaN` is not a positive, finite factor"),
            ("--up 0,0,0", "has no direction"),
            ("--up nan,0,1", "not finite"),
            ("--up", "a value is required"),
            ("--up --contact", "`--contact` is not a direction"),
            ("--contact highest", "is not a contact point"),
            ("--unit ft", "possible values: mm, cm, m, in"),
            ("--solver octree", "possible values: quadric"),
            ("--objective fastest", "invalid value 'fastest'"),
            ("--threads 0", "invalid value '0'"),
            ("--threads 100000", "invalid value '100000'"),
            ("--wal 1", "a similar argument exists: '--wall'"),
            ("-q -v", "cannot be used with"),
            ("--job job.toml", "cannot be used with"),
            ("second.stl", "unexpected argument 'second.stl'"),
        ];
        for (arguments, says) in cases {
            let error = parse(&format!("{PREPARE} {arguments}")).expect_err(arguments);
            assert_eq!(error.exit_code(), 2, "{arguments}");
            assert!(error.to_string().contains(says), "{arguments}: {error}");
        }
    }

    #[test]
    fn what_must_be_said_is_asked_for() {
        for (line, says) in [
            ("equipoise prepare m.stl --printer prusa-mk4", "--goal"),
            ("equipoise prepare --printer prusa-mk4 --goal top", "<MODEL>"),
            (
                "equipoise prepare m.stl --printer prusa-mk4 --goal swim",
                "possible values: top, yoyo, stand, float, balance",
            ),
            ("equipoise frobnicate", "unrecognized subcommand"),
        ] {
            let error = parse(line).expect_err(line);
            assert_eq!(error.exit_code(), 2, "{line}");
            assert!(error.to_string().contains(says), "{line}: {error}");
        }
    }

    #[test]
    fn parts_of_a_goal_that_do_not_go_together_are_refused() {
        for (arguments, says) in [
            ("--goal stand --objective spin-it", "use toppling-angle or lowest-center"),
            ("--goal yoyo --contact lowest", "a contact point goes with the goal top, not with yoyo"),
            ("--goal stand --spin-point center", "a spin point goes with the goal yoyo or balance"),
            ("--goal stand --waterline 30mm", "a liquid or waterline goes with the goal float"),
            ("--goal top --speed 3000", "a speed, grade or bore goes with the goal balance"),
        ] {
            let line = format!("equipoise prepare m.stl --printer prusa-mk4 {arguments}");
            let Command::Prepare(args) = parse(&line).unwrap().command else { panic!("{line}") };
            let error = args.request().unwrap_err().to_string();
            assert!(error.contains(says), "{arguments}: {error}");
        }
    }

    #[test]
    fn without_a_printer_the_shops_own_is_taken_and_where_there_is_none_it_is_asked_for() {
        let folder = tempfile::tempdir().unwrap();
        let model = folder.path().join("m.stl");
        let line = format!("equipoise prepare {} --goal top", model.display());
        let Command::Prepare(args) = parse(&line).unwrap().command else { panic!("{line}") };
        // A user who runs the tests may have defaults of his own.
        match args.request() {
            Err(error) => assert!(error.to_string().contains("equipoise.toml"), "{error}"),
            Ok(request) => assert!(!request.job.printer.id.is_empty()),
        }
        std::fs::write(folder.path().join("equipoise.toml"), "printer = \"prusa-mk4\"\nmaterial = \"asa\"\n")
            .unwrap();
        let printer = request(&line).job.printer;
        assert_eq!((printer.id.as_str(), printer.material.as_deref()), ("prusa-mk4", Some("asa")));
        let printer = request(&format!("{line} --printer objet-connex350")).job.printer;
        assert_eq!((printer.id.as_str(), printer.material), ("objet-connex350", None));
    }

    #[test]
    fn a_job_is_replayed_and_its_model_may_lie_elsewhere() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("job.toml");
        let original = request(&format!("{PREPARE} --size 4in --wall 1.2")).job;
        std::fs::write(&path, original.to_toml().unwrap()).unwrap();
        let path = path.to_str().unwrap();
        let again = request(&format!("equipoise prepare --job {path} --out again"));
        assert_eq!((again.job, again.out.as_path()), (original.clone(), Path::new("again")));
        let moved = request(&format!("equipoise prepare other/b.obj --job {path}"));
        assert_eq!(moved.job.model.path, Path::new("other/b.obj"));
        assert_eq!((moved.job.wall, moved.out.as_path()), (original.wall, Path::new("b-kit")));
    }

    #[test]
    fn global_flags_stand_before_or_after_the_command() {
        for line in ["equipoise -q --threads 2 --json printers", "equipoise printers --json --threads 2 -q"] {
            let global = parse(line).unwrap().global;
            assert!(global.quiet && global.json, "{line}");
            assert_eq!(global.threads, Some(2));
        }
        assert_eq!(parse("equipoise inspect a.stl -vv").unwrap().global.verbose, 2);
    }
}
