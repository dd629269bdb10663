//! Where to cut: a word, or a file with the plan.

use std::convert::Infallible;
use std::path::PathBuf;
use std::str::FromStr;

use clap::Args;

use crate::cut::CutOrder;
use crate::job::{CutMode, IdStyle, PinStyle, PlanError};

/// How the object is cut and its parts joined.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Method")]
pub struct CutArgs {
    /// Cut the object where a void would stay closed (auto), not at all (never), or as the plan in
    /// FILE says: the kit's cuts.toml, edited [default: auto]
    #[arg(long, value_name = "auto|never|FILE")]
    pub cut: Option<CutArg>,
    /// Align the parts by pins that are printed with them (printed), or by dowels cut from stock
    /// rods (dowel) [default: printed]
    #[arg(long, value_name = "printed|dowel")]
    pub pins: Option<PinStyle>,
    /// Sink the parts' ids into their cut faces where there is room (engraved), or not (none)
    /// [default: engraved]
    #[arg(long, value_name = "engraved|none")]
    pub ids: Option<IdStyle>,
}

/// What `--cut` was given.
#[derive(Debug, Clone, PartialEq)]
pub enum CutArg {
    /// A word.
    Mode(CutMode),
    /// A file that holds the cuts and, maybe, the pins.
    Plan(PathBuf),
}

impl FromStr for CutArg {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(text
            .parse()
            .map_or_else(|_| Self::Plan(text.into()), Self::Mode))
    }
}

impl CutArg {
    /// Whether to cut, and the plan that the file holds.
    pub fn order(self) -> Result<(CutMode, Option<CutOrder>), PlanError> {
        match self {
            Self::Mode(mode) => Ok((mode, None)),
            Self::Plan(path) => Ok((CutMode::Auto, Some(crate::job::read_plan(&path)?))),
        }
    }
}
