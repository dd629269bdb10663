//! A value with its source and its certainty.

use std::fmt;

use serde::{Deserialize, Serialize};

/// The certainty of a number, by how it came to be known; the surest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sure {
    /// Measured by the shop on a part it printed, such as a weighed coupon.
    Measured,
    /// Read in the named source by the author of the profile.
    Read,
    /// Stated in a scientific paper on which the method rests.
    Paper,
    /// Computed from values of the named source.
    Computed,
    /// Listed by a third party, not by the maker.
    ThirdParty,
    /// Recalled from a source and not read again.
    Recalled,
    /// Chosen by the author of the profile, for the reason given as the source.
    OwnChoice,
}

impl fmt::Display for Sure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Measured => "measured",
            Self::Read => "read",
            Self::Paper => "paper",
            Self::Computed => "computed",
            Self::ThirdParty => "third party",
            Self::Recalled => "recalled",
            Self::OwnChoice => "own choice",
        })
    }
}

/// A value with its provenance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Sourced<T> {
    /// The value, in the unit that the name of the field states.
    pub value: T,
    /// Its source, or the reason for an own choice.
    pub source: String,
    /// Its certainty.
    pub sure: Sure,
    /// The process whose default this is; `None` if a printer's own profile states the value.
    pub process_default_of: Option<String>,
}

impl<T> Sourced<T> {
    /// Describes certainty and source in one line: `read, default of polyjet: Hubs poster`.
    pub fn provenance(&self) -> String {
        let inherited = self
            .process_default_of
            .as_ref()
            .map(|id| format!(", default of {id}"))
            .unwrap_or_default();
        format!("{}{inherited}: {}", self.sure, self.source)
    }
}
