//! The edge: arguments in, text and exit codes out. Everything that is printed is printed here.

pub mod args;
pub mod args_printers;
mod ballast_args;
pub mod bars;
pub mod coupon;
mod cut_arg;
mod flags;
mod goal_args;
pub mod inspect;
pub mod manual;
pub mod prepare;
pub mod printers;
pub mod printers_markdown;
pub mod profiles;
pub mod shop;
pub mod show;
mod summary;
pub mod verify;

use std::error::Error;
use std::process::ExitCode;

use args::{Cli, Command};
use prepare::Voice;
use show::Manner;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Every promise is kept.
    Kept,
    /// It ran to its end, but a check failed or the goal is impossible.
    NotKept,
    /// It could not run: a bad file, bad arguments, a target that cannot be written.
    CouldNotRun,
}

impl Exit {
    /// The code the process ends with: 0, 1 or 2.
    pub fn code(self) -> u8 {
        match self {
            Self::Kept => 0,
            Self::NotKept => 1,
            Self::CouldNotRun => 2,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// Runs the command on as many threads as it asks for, and prints what came of it on the standard
/// output.
pub fn run(cli: Cli, manner: Manner) -> Result<Exit, Box<dyn Error + Send + Sync>> {
    let threads = cli.global.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()?;
    pool.install(|| dispatch(cli, manner))
}

fn dispatch(cli: Cli, manner: Manner) -> Result<Exit, Box<dyn Error + Send + Sync>> {
    let voice = Voice {
        manner,
        json: cli.global.json,
    };
    let out = &mut std::io::stdout();
    match cli.command {
        Command::Prepare(args) => Ok(prepare::prepare(*args, voice, out)?),
        Command::Inspect(args) => Ok(inspect::inspect(&args, voice, out)?),
        Command::Printers(args) => {
            printers::run(args.action, voice.json, out)?;
            Ok(Exit::Kept)
        }
        Command::Coupon(args) => {
            coupon::coupon(&args, voice, out)?;
            Ok(Exit::Kept)
        }
        Command::Verify(args) => Ok(verify::verify(&args.kit, voice, out)?),
        Command::Completions(args) => {
            manual::completions(args.shell, out)?;
            Ok(Exit::Kept)
        }
        Command::Man(args) => {
            manual::page(args.command.as_deref(), out)?;
            Ok(Exit::Kept)
        }
    }
}
