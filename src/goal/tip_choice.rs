//! The choice of a top's tip: a stock pin that is chosen, none, or a given rod.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use super::hardware::Rod;
use crate::base::words::{ChoiceError, as_text};

/// The tip of a top, as a user orders it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum TipChoice {
    /// A stock pin, if the top does not spin on its contact without one.
    #[default]
    Auto,
    /// No tip; the promised lean is waived.
    None,
    /// This rod.
    Rod(Rod),
}

impl TipChoice {
    /// Returns the rod that was ordered; `None` if none was named.
    pub fn rod(self) -> Option<Rod> {
        match self {
            Self::Rod(rod) => Some(rod),
            Self::Auto | Self::None => None,
        }
    }

    /// Returns true if the choice is left to the run.
    pub fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

impl FromStr for TipChoice {
    type Err = ChoiceError;

    fn from_str(text: &str) -> Result<Self, ChoiceError> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            "none" => Ok(Self::None),
            rod => rod.parse().map(Self::Rod),
        }
    }
}

impl fmt::Display for TipChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::None => f.write_str("none"),
            Self::Rod(rod) => rod.fmt(f),
        }
    }
}

as_text!(TipChoice);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_choice_reads_and_prints_as_a_word_or_a_rod() {
        for text in ["auto", "none", "4mmx12mm", "4mmx30mmx12.5mm:2.7"] {
            assert_eq!(text.parse::<TipChoice>().unwrap().to_string(), text);
        }
        assert!("automatic".parse::<TipChoice>().is_err());
    }
}
