//! The effort of the search for cuts and pins.

use crate::base::words::choice;

choice! {
    /// The effort of the search for cuts and pins.
    Effort, "effort" {
        /// Takes the first plan that works.
        Quick = "quick",
        /// Compares plans for as long as a customer waits.
        Normal = "normal",
        /// Compares every plan that it knows of.
        Thorough = "thorough",
    }
}

/// Units of work of a quick search, each about a microsecond on one core.
const QUICK_UNITS: u64 = 1;
/// Units of work of a normal search. The rows of the acceptance table take at most half of it.
const NORMAL_UNITS: u64 = 60_000_000;

impl Effort {
    /// Returns whether it is the usual effort.
    pub fn is_normal(&self) -> bool {
        *self == Self::Normal
    }

    /// Returns the units of work after which nothing is tried that a kit does not need.
    pub fn most_units(self) -> u64 {
        match self {
            Self::Quick => QUICK_UNITS,
            Self::Normal => NORMAL_UNITS,
            Self::Thorough => u64::MAX,
        }
    }

    /// Returns the next greater effort; `None` for the greatest.
    pub fn next(self) -> Option<Self> {
        match self {
            Self::Quick => Some(Self::Normal),
            Self::Normal => Some(Self::Thorough),
            Self::Thorough => None,
        }
    }
}
