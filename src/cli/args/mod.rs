//! The command line: what can be asked for, and the job it makes.

mod ballast;
mod cut;
mod error;
mod goal;
mod prepare;
mod printers;
mod scaling;
#[cfg(test)]
mod tests;
mod values;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use clap_complete::Shell;

pub use error::ArgsError;
pub use prepare::{PrepareArgs, Request};
pub use printers::{CalibrateArgs, CouponArgs, ImportArgs, NewArgs, PrintersAction, PrintersArgs};
pub use scaling::ScalingArgs;
pub use values::FactorError;

use crate::base::units::Length;
use values::EXIT_CODES;

/// Hollow a 3D model so that its printed, glued parts spin, stand, float or run true as asked.
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

/// The most threads. Far more than there are cores, and the waiting ones take the time of those at
/// work.
const MAX_THREADS: i64 = 256;

/// What every command takes.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Everywhere")]
pub struct GlobalArgs {
    /// Say nothing but errors
    #[arg(short, long, global = true, conflicts_with = "verbose")]
    pub quiet: bool,
    /// Say more: every check, the certificate, the time of each stage and the solver's steps
    #[arg(short, long, global = true, action = clap::ArgAction::Count)]
    pub verbose: u8,
    /// Use so many threads, up to 256; the result does not depend on it [default: one for each
    /// core]
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
    /// Read a kit's written files again, tell what became of them, and judge them without the
    /// solver
    Verify(VerifyArgs),
    /// Print the completions of a shell
    ///
    /// For bash: equipoise completions bash > ~/.local/share/bash-completion/completions/equipoise
    Completions(CompletionsArgs),
    /// Print the manual's page of the program, or of one of its commands
    ///
    /// To read one: equipoise man prepare | man -l -
    Man(ManArgs),
}

/// The arguments of `inspect`.
#[derive(Debug, Args)]
pub struct InspectArgs {
    /// The model: an STL, OBJ, PLY or 3MF file
    pub model: PathBuf,
    /// Tell what it could become on this printer: a known printer's id, or a profile file
    #[arg(long, value_name = "ID|FILE", help_heading = "Printer")]
    pub printer: Option<String>,
    /// Tell what it could become with this wall [default: the printer's least; a hundredth of the
    /// size without a printer]
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        help_heading = "Printer"
    )]
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

/// The arguments of `completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    pub shell: Shell,
}

/// The arguments of `man`.
#[derive(Debug, Args)]
pub struct ManArgs {
    /// The command, such as prepare [default: the program itself]
    pub command: Option<String>,
}
