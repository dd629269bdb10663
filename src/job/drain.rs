//! The order for drain holes in one uncut piece.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::base::units::{Length, LengthError};
use crate::base::words::as_text;

/// The word for holes where they are needed.
const AUTO: &str = "auto";
/// The word for no holes.
const NEVER: &str = "never";

/// The drain holes of an uncut piece. What is cut has none.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum DrainOrder {
    /// Holes of the least width that the process needs.
    #[default]
    Auto,
    /// No holes.
    Never,
    /// Holes of this free diameter.
    Diameter(Length),
}

impl DrainOrder {
    /// Returns whether the usual holes are made.
    pub fn is_auto(&self) -> bool {
        *self == Self::Auto
    }

    /// Returns the diameter that is asked for, mm; `None` for the least that does.
    pub fn asked_mm(self) -> Option<f64> {
        match self {
            Self::Diameter(length) => Some(length.mm()),
            Self::Auto | Self::Never => None,
        }
    }
}

as_text!(DrainOrder);

impl fmt::Display for DrainOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str(AUTO),
            Self::Never => f.write_str(NEVER),
            Self::Diameter(length) => length.fmt(f),
        }
    }
}

/// A text that orders no drain holes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}; or write {AUTO}, or {NEVER}")]
pub struct DrainOrderError(#[from] LengthError);

impl FromStr for DrainOrder {
    type Err = DrainOrderError;

    fn from_str(text: &str) -> Result<Self, DrainOrderError> {
        match text.trim() {
            AUTO => Ok(Self::Auto),
            NEVER => Ok(Self::Never),
            length => Ok(Self::Diameter(length.parse()?)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_reads_as_it_prints_and_other_text_is_refused() {
        for text in ["auto", "never", "3.5mm"] {
            assert_eq!(text.parse::<DrainOrder>().unwrap().to_string(), text);
        }
        let error = "some".parse::<DrainOrder>().unwrap_err().to_string();
        assert!(error.contains("or write auto, or never"), "{error}");
        assert!("-1mm".parse::<DrainOrder>().is_err());
    }
}
