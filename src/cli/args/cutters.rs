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
    /// Enter what was measured on coupons into a shop's own profiles
    Calibrate(CalibrateCutterArgs),
}

/// The arguments of `cutters calibrate`.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct CalibrateCutterArgs {
    /// The shop's own profile of the cutter, which gets the kerf
    pub file: PathBuf,
    /// The sheet that was cut: the shop's own profile gets the thickness and density; a known id
    /// stays as it is
    #[arg(long, value_name = "FILE|ID")]
    pub sheet: String,
    /// The length of all squares pushed together in a row, mm
    #[arg(long, value_name = "MM", allow_hyphen_values = true)]
    pub row: f64,
    /// A thickness of the sheet, mm; once for each place
    #[arg(long, value_name = "MM", required = true, allow_hyphen_values = true)]
    pub thickness: Vec<f64>,
    /// The mass of all squares together, g
    #[arg(long, value_name = "G", allow_hyphen_values = true)]
    pub weighed: Option<f64>,
    /// The lot of the sheet
    #[arg(long)]
    pub lot: String,
    /// The day, as 2026-11-21 [default: today]
    #[arg(long, value_name = "DAY")]
    pub date: Option<String>,
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
