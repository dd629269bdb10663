//! A value together with where it is from and how sure it is.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How a number came to be known, the surest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Sure {
    /// Measured by the shop on a part it printed, such as a weighed coupon.
    Measured,
    /// Seen in the named source by whoever wrote the profile.
    Read,
    /// Stated in one of the scientific papers the method rests on.
    Paper,
    /// Computed from what the named source says.
    Computed,
    /// From a listing by somebody other than the maker.
    ThirdParty,
    /// Remembered from a source and not read again.
    Recalled,
    /// Chosen by whoever wrote the profile, for the reason given as its source.
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
    /// The value, in the unit its field's name says.
    pub value: T,
    /// Where it is from, or for an own choice the reason.
    pub source: String,
    /// How sure it is.
    pub sure: Sure,
    /// The process whose default this is; none where the printer's own profile says it.
    pub process_default_of: Option<String>,
}

impl<T> Sourced<T> {
    /// One line for people: `read, default of polyjet: Hubs poster`.
    pub fn provenance(&self) -> String {
        let inherited = self
            .process_default_of
            .as_ref()
            .map(|id| format!(", default of {id}"))
            .unwrap_or_default();
        format!("{}{inherited}: {}", self.sure, self.source)
    }
}
