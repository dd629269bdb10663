//! The command line: what can be asked for, and the job it makes.

mod prepare;
#[cfg(test)]
mod tests;

use std::{path::PathBuf, str::FromStr};

use clap::{
    Args, Parser, Subcommand,
    builder::{PossibleValuesParser, TypedValueParser},
};
use clap_complete::Shell;

pub use prepare::{ArgsError, PrepareArgs, Request, ScalingArgs};

use super::args_printers::{CouponArgs, PrintersArgs};
use crate::base::units::Length;
use crate::base::words::ChoiceError;

const EXIT_CODES: &str = "\
LENGTH takes a unit (100mm, 10cm, 0.1m, 4in, 42um); without one it is in mm.
Exit codes: 0 every promise kept; 1 finished, but a promise is broken (a file of a kit that is missing or damaged breaks one) or \
the goal is impossible; 2 could not run: bad arguments, a model that is not one solid body, no kit.";

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
