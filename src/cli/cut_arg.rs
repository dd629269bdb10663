//! Where to cut: a word, or a file with the plan.

use std::{convert::Infallible, path::PathBuf, str::FromStr};

use crate::{
    cut::CutOrder,
    job::{CutMode, PlanError},
};

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
        Ok(text.parse().map_or_else(|_| Self::Plan(text.into()), Self::Mode))
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
