//! The arguments of `cutters`.

use std::path::PathBuf;

use clap::{Args, Subcommand};

/// The arguments of `cutters`.
#[derive(Debug, Args)]
pub struct CuttersArgs {
    /// The action; `None` lists the profiles.
    #[command(subcommand)]
    pub action: Option<CuttersAction>,
}

/// An action on cutters, sheets and fasteners, and on their profiles.
#[derive(Debug, Clone, PartialEq, Subcommand)]
pub enum CuttersAction {
    /// List the known cutters, sheets and fasteners
    List,
    /// Show every number of a cutter, a sheet or a fastener with its source
    Show {
        /// A known id, or a profile file
        id: String,
    },
    /// Check a profile file and name everything that is wrong with it
    Check {
        /// The profile file
        file: PathBuf,
    },
    /// Write a shop's own profile, based on a known cutter or sheet
    New(NewCutterArgs),
}

/// The arguments of `cutters new`.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct NewCutterArgs {
    /// The id of a known cutter or sheet
    #[arg(long, value_name = "ID")]
    pub from: String,
    /// The new profile's id: lower-case letters, digits and hyphens [default: the file's name]
    #[arg(long)]
    pub id: Option<String>,
    /// The file to write
    #[arg(long, value_name = "FILE")]
    pub out: PathBuf,
    /// Replace the file if it exists
    #[arg(long)]
    pub force: bool,
}
