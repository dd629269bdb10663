//! The faults of arguments.

use super::missing::Missing;
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
    /// A telescope without a printer.
    #[error(
        "a printer is missing; remedy: equipoise telescope {input} --printer prusa-mk4 (equipoise \
         printers lists them)"
    )]
    NoPrinter {
        /// The curve that was given.
        input: String,
    },
    /// Arguments are missing.
    #[error("{0}")]
    Missing(Missing),
    /// The file equipoise.toml cannot be used.
    #[error(transparent)]
    Shop(#[from] ShopError),
}
