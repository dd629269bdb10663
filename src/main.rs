//! The `equipoise` command: parse, run, print, exit.

use std::process::ExitCode;

use clap::Parser;
use equipoise::cli::args::Cli;
use equipoise::cli::voice::Manner;
use equipoise::cli::{Exit, run, show};

fn main() -> ExitCode {
    let cli = Cli::parse();
    let manner = Manner::of_process(cli.global.quiet, cli.global.verbose);
    let exit = run(cli, manner).unwrap_or_else(|error| {
        show::print_error(error.as_ref(), manner);
        Exit::CouldNotRun
    });
    exit.into()
}
