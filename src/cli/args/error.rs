//! The faults of arguments.

use super::missing::Missing;
use crate::goal::RequestError;
use crate::job::base_choice::BaseReadError;
use crate::job::telescope::PoseReadError;
use crate::job::{FieldOrderError, JobError, PlanError};
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
    /// The pose file cannot be read.
    #[error(transparent)]
    Pose(#[from] PoseReadError),
    /// The base cannot be read.
    #[error(transparent)]
    Base(#[from] BaseReadError),
    /// The plan of the cuts cannot be used.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The field of densities cannot be used.
    #[error(transparent)]
    Field(#[from] FieldOrderError),
    /// A telescope without a printer.
    #[error(
        "a printer is missing; remedy: equipoise telescope {input} --printer prusa-mk4 (equipoise \
         printers lists them)"
    )]
    NoPrinter {
        /// The curve that was given.
        input: String,
    },
    /// An object on a base without its machines.
    #[error(
        "a printer, a cutter and a sheet are needed; remedy: equipoise core {model} --size 600mm \
         --printer prusa-mk4 --cutter makerspace-900x600 --sheet birch-5 (equipoise printers and \
         equipoise cutters list them)"
    )]
    NoMachines {
        /// The model that was given.
        model: String,
    },
    /// Plans were ordered with what only a kit has.
    #[error(
        "plans of cuts are no kit, and {0} is for a kit; remedy: leave it out, choose a plan, and \
         order it with prepare"
    )]
    OnlyOfKits(&'static str),
    /// Arguments are missing.
    #[error("{0}")]
    Missing(Missing),
    /// The file equipoise.toml cannot be used.
    #[error(transparent)]
    Shop(#[from] ShopError),
}
