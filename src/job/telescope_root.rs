//! The root of a skeleton as a job orders it.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;

/// The root of a skeleton as it is ordered.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Root {
    /// The node of this number.
    Node(u32),
    /// The node nearest to this place, mm.
    Near([f64; 3]),
}

/// A text that names no root.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no root; remedy: give the number of a node, such as 12, or a place X,Y,Z in mm")]
pub struct RootError(String);

impl FromStr for Root {
    type Err = RootError;

    fn from_str(text: &str) -> Result<Self, RootError> {
        let fault = || RootError(text.to_owned());
        if let Ok(node) = text.trim().parse() {
            return Ok(Self::Node(node));
        }
        let numbers = text.split(',').map(|number| number.trim().parse().ok());
        let numbers: Option<Vec<f64>> = numbers.collect();
        let place = numbers.and_then(|numbers| <[f64; 3]>::try_from(numbers).ok());
        let is_finite = |place: &[f64; 3]| place.iter().all(|number| number.is_finite());
        place.filter(is_finite).map(Self::Near).ok_or_else(fault)
    }
}

impl fmt::Display for Root {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Node(id) => write!(f, "{id}"),
            Self::Near([x, y, z]) => write!(f, "{x},{y},{z}"),
        }
    }
}

as_text!(Root);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_root_is_a_number_or_a_place() {
        assert_eq!("12".parse(), Ok(Root::Node(12)));
        assert_eq!(Root::Near([-1.0, 2.5, 3.0]).to_string(), "-1,2.5,3");
        assert_eq!("-1, 2.5,3".parse(), Ok(Root::Near([-1.0, 2.5, 3.0])));
        for bad in ["", "-1", "1,2", "1,2,3,4", "nan,0,0", "tip", "1.5"] {
            assert!(bad.parse::<Root>().is_err(), "{bad}");
        }
    }
}
