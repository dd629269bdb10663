//! The faults of arguments.

use crate::goal::RequestError;
use crate::job::{JobError, PlanError};
use crate::printer::ShopError;

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
        "--printer is missing; remedy: give it (`equipoise printers list` shows the ids), or write printer = \"ID\" into an equipoise.toml here, beside the model or in \
         your configuration folder"
    )]
    NoPrinter,
    /// The shop's defaults cannot be used.
    #[error(transparent)]
    Shop(#[from] ShopError),
}
