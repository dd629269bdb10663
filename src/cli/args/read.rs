//! The reading of a command line, and the help that belongs to it.

use std::ffi::OsString;

use clap::{Arg, Command, CommandFactory, FromArgMatches};

use super::Cli;
use super::typed::{SplitUnit, find_split_unit, with_command};

/// The command of a line that names a model and no command.
const DEFAULT_COMMAND: &str = "prepare";
/// The options of `prepare` that its short help shows. The long one shows all.
const SHORT_HELP: [&str; 8] = [
    "model",
    "goal",
    "printer",
    "size",
    "up",
    "no_questions",
    "out",
    "help",
];

/// A reason why a command line is not run.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The parser refuses it, or shows a help instead.
    #[error(transparent)]
    Parser(#[from] clap::Error),
    /// A number and its unit are two words.
    #[error(transparent)]
    SplitUnit(#[from] SplitUnit),
}

impl Cli {
    /// Reads a command line, the program first. A model without a command is one to prepare.
    ///
    /// # Errors
    /// It cannot be understood, or it asks for help.
    pub fn read(words: Vec<OsString>) -> Result<Self, ReadError> {
        let command = Self::program();
        let names: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
        let known = [&names[..], &["help"]].concat();
        let words = with_command(words, &known, DEFAULT_COMMAND);
        if let Some(split) = find_split_unit(&words) {
            return Err(split.into());
        }
        let matches = command.try_get_matches_from(words)?;
        Ok(Self::from_arg_matches(&matches)?)
    }

    /// Returns the definition of the program, whose short helps fit on a screen.
    pub fn program() -> Command {
        let hide = |arg: Arg| {
            let is_short = SHORT_HELP.contains(&arg.get_id().as_str());
            arg.hide_short_help(!is_short)
        };
        Self::command()
            .mut_args(|global| global.hide_short_help(true))
            .mut_subcommand(DEFAULT_COMMAND, |prepare| prepare.mut_args(hide))
    }
}
