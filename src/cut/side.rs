//! The sides of cuts.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::cut::ids::CutId;

/// A side of a cut to which another cut is limited.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CutSide {
    /// The cut's id.
    pub cut: CutId,
    /// The side of it.
    pub side: Side,
}

impl fmt::Display for CutSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.side.word(), self.cut)
    }
}

/// A side of a cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Side {
    /// The side to which its normal points.
    Above,
    /// The side from which its normal points away.
    Below,
}

impl Side {
    pub(crate) fn of(is_above: bool) -> Self {
        if is_above { Self::Above } else { Self::Below }
    }

    /// Returns `above` or `below`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Above => "above",
            Self::Below => "below",
        }
    }
}
