//! The faults of arguments.

use crate::goal::RequestError;
use crate::job::{JobError, PlanError};
use crate::printer::ShopError;

/// A reason why arguments make no job.
#[derive(Debug, thiserror::Error)]
pub enum ArgsError {
    /// The goal contradicts itself.
    #[error(transparent)]
    Goal(#[from] RequestError),
    /// The replayed job cannot be used.
    #[error(transparent)]
    Job(#[from] JobError),
    /// The plan of the cuts cannot be used.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// An argument is missing; the parser already refuses that.
    #[error("{0} is missing; remedy: give it, or replay a job with --job")]
    Missing(&'static str),
    /// Neither the command line nor equipoise.toml names a printer.
    #[error(
        "--printer is missing; remedy: give an id (`equipoise printers list` shows them), or write \
         printer = \"ID\" into an equipoise.toml here, beside the model or in your configuration \
         folder"
    )]
    NoPrinter,
    /// The file equipoise.toml cannot be used.
    #[error(transparent)]
    Shop(#[from] ShopError),
}
