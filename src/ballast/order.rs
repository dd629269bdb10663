//! The user's order: ballast if it is needed, parts of one kind, or none.

use std::{fmt, str::FromStr};

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;

/// The greatest number of parts. Each is a pocket that must be cut open, filled and glued; a dozen
/// is an afternoon's work.
pub const MOST_PARTS: u32 = 12;

/// The ballast asked for. It is read and printed as `none`, `auto`, `ID` or `IDxN`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Order {
    /// None.
    #[default]
    None,
    /// The fewest steel balls that make the goal possible; none if hollowing alone does.
    Auto,
    /// Parts of one kind.
    Parts {
        /// The part's id in the catalogue.
        id: String,
        /// The number of parts; the fewest that suffice, at least one, if `None`.
        count: Option<u32>,
    },
}

impl Order {
    /// Returns true if no ballast is asked for.
    pub fn is_none(&self) -> bool {
        *self == Self::None
    }
}

/// A text that is not an order for ballast.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not an order for ballast; remedy: give auto, none, the id of a stock part such as \
     ball-4, or the id and a number from 1 to \
     {MOST_PARTS} such as ball-4x3"
)]
pub struct OrderError(String);

impl FromStr for Order {
    type Err = OrderError;

    fn from_str(text: &str) -> Result<Self, OrderError> {
        match text {
            "none" => return Ok(Self::None),
            "auto" => return Ok(Self::Auto),
            _ => {}
        }
        let is_id = |id: &str| {
            !id.is_empty()
                && id
                    .chars()
                    .all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '.')
        };
        let number = |digits: &str| digits.parse::<u32>().ok();
        let (id, count) = match text
            .rsplit_once('x')
            .map(|(id, digits)| (id, number(digits)))
        {
            Some((id, Some(count))) => (id, Some(count)),
            _ => (text, None),
        };
        if !is_id(id) || count.is_some_and(|count| !(1..=MOST_PARTS).contains(&count)) {
            return Err(OrderError(text.to_owned()));
        }
        Ok(Self::Parts {
            id: id.to_owned(),
            count,
        })
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::Auto => f.write_str("auto"),
            Self::Parts { id, count: None } => f.write_str(id),
            Self::Parts {
                id,
                count: Some(count),
            } => write!(f, "{id}x{count}"),
        }
    }
}

as_text!(Order);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_prints_as_it_reads() {
        for text in [
            "none",
            "auto",
            "ball-4",
            "ball-4x3",
            "nut-m6x12",
            "coin-euro-1-cent",
            "ball-4.5x2",
        ] {
            assert_eq!(text.parse::<Order>().unwrap().to_string(), text);
        }
    }

    #[test]
    fn a_text_that_is_no_order_is_refused_with_an_example() {
        for text in ["", "ball 4", "ball-4x0", "ball-4x13", "x3"] {
            let error = text.parse::<Order>().unwrap_err().to_string();
            assert!(error.contains("such as ball-4x3"), "{error}");
        }
    }
}
