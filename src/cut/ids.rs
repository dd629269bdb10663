//! The ids of cuts, pins, parts, joints and voids.
//!
//! Parts, joints and voids are counted, and their ids are copied like numbers. Cuts and pins carry
//! names, because a user may name them freely in a file of cuts. The planner counts its own cuts
//! and pins.

use std::{convert::Infallible, fmt, str::FromStr};

use serde::{Deserialize, Serialize};

/// The error for a text that is no id of the expected kind.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{text} is no id such as {example}")]
pub struct IdError {
    /// The text.
    pub text: String,
    /// An example of that kind.
    pub example: String,
}

/// Defines a counted id: a letter, and a number from 1 with at least the given number of digits.
macro_rules! counted_id {
    ($(#[$doc:meta])* $name:ident, $letter:literal, $digits:literal) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
        #[serde(into = "String", try_from = "String")]
        pub struct $name(usize);

        impl $name {
            /// Returns the id of the item with this index, from 0.
            pub const fn of(index: usize) -> Self {
                Self(index)
            }

            /// Returns the index, from 0.
            pub const fn index(self) -> usize {
                self.0
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}{:0digits$}", $letter, self.0 + 1, digits = $digits)
            }
        }

        impl FromStr for $name {
            type Err = IdError;

            fn from_str(text: &str) -> Result<Self, IdError> {
                let number = text.strip_prefix($letter).and_then(|number| number.parse().ok());
                let id = number.and_then(|number: usize| number.checked_sub(1)).map(Self);
                // Accept only the text that the id is written as: not "P1" for "P01".
                id.filter(|id| id.to_string() == text).ok_or_else(|| IdError {
                    text: text.to_owned(),
                    example: Self(0).to_string(),
                })
            }
        }

        impl TryFrom<String> for $name {
            type Error = IdError;

            fn try_from(text: String) -> Result<Self, IdError> {
                text.parse()
            }
        }

        impl From<$name> for String {
            fn from(id: $name) -> Self {
                id.to_string()
            }
        }
    };
}

/// Defines an id that a user may choose freely. The planner's own ids are a letter and a number
/// from 1.
macro_rules! named_id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(
            Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize,
        )]
        #[serde(transparent)]
        pub struct $name(String);

        impl $name {
            /// Returns the planner's id of the item with this index, from 0.
            pub fn of(index: usize) -> Self {
                Self(format!("{}{}", $letter, index + 1))
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(&self.0)
            }
        }

        impl FromStr for $name {
            type Err = Infallible;

            fn from_str(text: &str) -> Result<Self, Infallible> {
                Ok(Self(text.to_owned()))
            }
        }

        impl From<&str> for $name {
            fn from(text: &str) -> Self {
                Self(text.to_owned())
            }
        }
    };
}

counted_id! {
    /// The id of a drain hole: D1, D2, …
    DrainId, 'D', 1
}

counted_id! {
    /// The id of a void, by its place among those of the hollowed body: V1, V2, …
    VoidId, 'V', 1
}
counted_id! {
    /// The id of a part, by its place in the order of pieces: P01, P02, …
    PartId, 'P', 2
}
counted_id! {
    /// The id of a joint, by its place in a plan: J1, J2, …
    JointId, 'J', 1
}
named_id! {
    /// The name of a cut: C1, C2, … for those of the planner.
    CutId, 'C'
}
named_id! {
    /// The name of a pin: N1, N2, … for those of the planner; empty before the plan numbers it.
    PinId, 'N'
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_are_read_as_they_are_written() {
        assert_eq!(PartId::of(0).to_string(), "P01");
        assert_eq!(PartId::of(99).to_string(), "P100");
        assert_eq!("P12".parse(), Ok(PartId::of(11)));
        assert_eq!("V3".parse(), Ok(VoidId::of(2)));
        assert_eq!("J10".parse(), Ok(JointId::of(9)));
        assert_eq!(CutId::of(1), "C2".into());
        assert_eq!("waist".parse(), Ok(CutId::from("waist")));
    }

    #[test]
    fn texts_that_are_no_ids_are_refused() {
        for text in [
            "", "P", "P0", "P00", "P1", "p01", "V01", "C1", "P-1", "P+01",
        ] {
            assert!(text.parse::<PartId>().is_err(), "{text}");
        }
        let error = "W1".parse::<VoidId>().unwrap_err();
        assert_eq!(error.to_string(), "W1 is no id such as V1");
    }
}
