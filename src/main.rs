//! The `equipoise` command: parse, run, print, exit.

use std::process::ExitCode;

use equipoise::cli::args::{Cli, ReadError};
use equipoise::cli::voice::Manner;
use equipoise::cli::{Exit, run, show};

fn main() -> ExitCode {
    let cli = match Cli::read(std::env::args_os().collect()) {
        Ok(cli) => cli,
        Err(ReadError::Parser(error)) => error.exit(),
        Err(error) => {
            show::print_error(&error, Manner::of_process(false, 0));
            return Exit::CouldNotRun.into();
        }
    };
    let manner = Manner::of_process(cli.global.quiet, cli.global.verbose);
    let exit = run(cli, manner).unwrap_or_else(|error| {
        show::print_error(error.as_ref(), manner);
        Exit::CouldNotRun
    });
    exit.into()
}
