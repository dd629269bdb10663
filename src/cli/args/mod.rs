//! The arguments of the command line, and the job they make.

mod again;
mod ballast;
mod beside;
mod cells;
mod core_kit;
mod cut;
mod cutters;
mod decided;
mod error;
mod field;
mod goal;
mod missing;
mod prepare;
mod printers;
mod quote;
mod read;
mod scale;
mod scaling;
mod skeleton;
mod slice;
mod telescope;
#[cfg(test)]
mod tests;
mod tets;
mod typed;
mod values;
mod weighed;

use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

pub use again::again;
pub use cells::CellsArgs;
pub use core_kit::CoreArgs;
pub use cutters::{CalibrateCutterArgs, CuttersAction, CuttersArgs, NewCutterArgs};
pub use error::ArgsError;
pub use field::FieldChoice;
pub use missing::Missing;
pub use prepare::{DEFAULT_PLANS, PrepareArgs, Request};
pub use printers::{CalibrateArgs, CouponArgs, ImportArgs, NewArgs, PrintersAction, PrintersArgs};
pub use quote::quoted;
pub use read::ReadError;
pub use scale::ScaleArgs;
pub use scaling::ScalingArgs;
pub use skeleton::SkeletonArgs;
pub use slice::SliceArgs;
pub use telescope::TelescopeArgs;
pub use tets::TetsArgs;
pub use typed::SplitUnit;
pub use values::NumberError;

use crate::base::units::Length;
use crate::io::DataChoice;
use crate::repair::RepairOrder;
use values::{ALSO, EXAMPLES, EXIT_CODES, memory, time};

/// Make kits of printed parts that spin, stand, float, run true or slide open
#[derive(Debug, Parser)]
#[command(
    name = "equipoise",
    version,
    after_help = EXAMPLES,
    after_long_help = [EXAMPLES, ALSO, EXIT_CODES].join("\n\n"),
    override_usage = USAGE
)]
pub struct Cli {
    /// The options of every command.
    #[command(flatten)]
    pub global: GlobalArgs,
    /// The command to run.
    #[command(subcommand)]
    pub command: Command,
}

/// The usage: a model alone is prepared.
const USAGE: &str = "equipoise <MODEL|COMMAND> [OPTIONS]";

/// The usage of `cuts`, which takes the arguments of `prepare`.
const CUTS_USAGE: &str = "equipoise cuts <MODEL> --goal <GOAL> --printer <ID|FILE> [OPTIONS]";

/// The most threads. With far more threads than cores, the waiting ones slow the others down.
const MAX_THREADS: i64 = 256;

/// The options of every command.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Everywhere")]
pub struct GlobalArgs {
    /// Print errors only
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Print more: every check, the proof, the time of each stage and the solver's steps
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Number of threads, up to 256 [default: one per core]
    #[arg(
        long,
        global = true,
        value_name = "N",
        value_parser = clap::value_parser!(u16).range(1..=MAX_THREADS)
    )]
    pub threads: Option<u16>,
    /// Stop after this time, such as 90s, 10min or 2h, and write nothing [default: never]
    #[arg(long, global = true, value_name = "TIME", value_parser = time)]
    pub timeout: Option<Duration>,
    /// Stop before more memory than this is taken, such as 800MB or 4GB [default: 90 % of what the
    /// machine has]
    #[arg(long, global = true, value_name = "SIZE", value_parser = memory)]
    pub max_memory: Option<u64>,
    /// Print the result as JSON on the standard output
    #[arg(long, global = true)]
    pub json: bool,
}

/// A command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Turn a model into a kit of printable parts
    Prepare(Box<PrepareArgs>),
    /// Show plans of cuts side by side, to choose one for prepare
    ///
    /// It takes the arguments of prepare, and writes plan1.toml and so on with pictures of each.
    #[command(override_usage = CUTS_USAGE)]
    Cuts(Box<PrepareArgs>),
    /// Turn a curve into a kit of nested shells that slide open into it
    Telescope(Box<TelescopeArgs>),
    /// Put a model larger than the printer on a laser-cut base
    #[command(hide = true)]
    Core(Box<CoreArgs>),
    /// Show a model's facts, and which of the five goals it can reach
    Inspect(InspectArgs),
    /// Find the limbs inside a model and their radii, for telescopes
    ///
    /// It writes a file to edit and a picture. Given such a file, it checks it.
    Skeleton(SkeletonArgs),
    /// Divide a model into cells: near cubes, or round ones
    ///
    /// It writes sites, cells (OBJ, VTK), the steps of the relaxation with a plot, and pictures.
    #[command(hide = true)]
    Cells(Box<CellsArgs>),
    /// List the known printers, show one, or check a profile of your own
    Printers(PrintersArgs),
    /// List laser cutters, sheets and fasteners, or check a profile
    #[command(hide = true)]
    Cutters(CuttersArgs),
    /// Make coupons to measure and try, to fit a profile to the machine
    Coupon(CouponArgs),
    /// Slice a kit's plates, and tell how the toolpaths will balance
    Slice(SliceArgs),
    /// Scale the infill of a kit's toolpaths, so that its density follows a field (experimental)
    ///
    /// Walls, surfaces, bridges and support stay as they are. What the lines weigh is told before
    /// and after; how a printer follows them is not measured.
    #[command(hide = true)]
    ScaleExtrusion(ScaleArgs),
    /// Check a kit's files, and name those that changed
    Verify(VerifyArgs),
    /// Print the completion script of a shell
    ///
    /// For bash: equipoise completions bash > ~/.local/share/bash-completion/completions/equipoise
    #[command(hide = true)]
    Completions(CompletionsArgs),
    /// Print the manual page of the program or of a command
    ///
    /// To read one: equipoise man prepare | man -l -
    #[command(hide = true)]
    Man(ManArgs),
}

/// The arguments of `inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The model: an STL, OBJ, PLY or 3MF file, or a volume mesh: .msh, .vtk, .node with .ele
    pub model: PathBuf,
    /// Show what it could become on this printer: a known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE", help_heading = "Printer")]
    pub printer: Option<String>,
    /// Show what it could become with this wall [default: the printer's minimum; without a printer
    /// a hundredth of the size]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Printer"
    )]
    pub wall: Option<Length>,
    /// Show the mass properties with this density, in words or as a field.toml
    ///
    /// The same everywhere is uniform:40%. A ramp is ramp:0,0,1@20mm..60mm:0.2..1. A wave about a
    /// point is sine:X,Y,Z@40mm:0.1..1. Dense at the surface is skin:4mm:gauss:0.2..1, or linear.
    /// Lengths are those of the model as scaled, in the axes of its file.
    #[arg(long, value_name = "FIELD", allow_hyphen_values = true)]
    pub field: Option<FieldChoice>,
    /// The data of a volume mesh that is its density, or none [default: density, or the only one]
    #[arg(long, value_name = "NAME", value_parser = |name: &str| name.parse::<DataChoice>())]
    pub data: Option<DataChoice>,
    /// The volume mesh to write.
    #[command(flatten)]
    pub tets: TetsArgs,
    /// Repair the model as `prepare --repair` does: cavities, fill, remesh or remesh:TOLERANCE
    /// [default: auto]
    #[arg(long, value_name = "HOW")]
    pub repair: Option<RepairOrder>,
    /// Draw the model with the places of its defects into this SVG file
    #[arg(long, value_name = "FILE")]
    pub picture: Option<PathBuf>,
    /// The size of the model.
    #[command(flatten, next_help_heading = "Size")]
    pub scaling: ScalingArgs,
}

impl InspectArgs {
    /// Returns an option that was given and says nothing of a volume mesh, as it is typed.
    pub fn only_for_surfaces(&self) -> Option<&'static str> {
        let given = [
            ("--wall", self.wall.is_some()),
            ("--repair", self.repair.is_some()),
            ("--picture", self.picture.is_some()),
            ("--tets", self.tets.tets.is_some()),
        ];
        given
            .into_iter()
            .find_map(|(name, is_given)| is_given.then_some(name))
    }

    /// Returns an option that was given and says nothing of a surface, as it is typed.
    pub fn only_for_volumes(&self) -> Option<&'static str> {
        self.data.as_ref().map(|_| "--data")
    }
}

/// The arguments of `verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// The folder of the kit
    pub kit: PathBuf,
    /// Compare its outside with this model, in place of the kit's own copy
    #[arg(long, value_name = "FILE")]
    pub model: Option<PathBuf>,
    /// Also make the kit again from its job.toml, and compare every file; takes as long as prepare
    #[arg(long)]
    pub replay: bool,
    /// Tell how these slices will balance, of every plate: .gcode, .bgcode, .gcode.3mf, .sl1, .sl1s
    /// or layers.json
    #[arg(
        long,
        value_name = "FILE",
        num_args = 1..,
        conflicts_with_all = ["model", "replay"]
    )]
    pub gcode: Vec<PathBuf>,
}

/// The arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

/// The arguments of `man`.
#[derive(Debug, Args)]
pub struct ManArgs {
    /// The command, such as prepare [default: the program]
    pub command: Option<String>,
}
