//! The order for repairs: what a person asks for beyond the rungs that everyone gets.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::units::Length;
use crate::base::words::as_text;

/// The word for the rungs that everyone gets.
const AUTO: &str = "auto";
/// The word for a new surface.
const REMESH: &str = "remesh";

/// The repairs asked for. They are read and printed as `auto`, or as `cavities` or `fill`, `remesh`
/// or `remesh:TOLERANCE`. Two are joined by a comma.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct RepairOrder {
    /// The use of surfaces inside the model.
    pub inner: InnerSurfaces,
    /// The new surface; `None` keeps the old one.
    pub remesh: Option<Remesh>,
}

/// The use of surfaces inside the model.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum InnerSurfaces {
    /// They are refused: only their owner knows if they are meant.
    #[default]
    Refuse,
    /// They bound cavities, which stay empty.
    Cavities,
    /// They go: the model is filled.
    Fill,
}

/// The tolerance of a new surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Remesh {
    /// A share of the model's size.
    Usual,
    /// This length in the size that is printed.
    Within(Length),
}

impl RepairOrder {
    /// Returns true if nothing is asked for beyond the rungs that everyone gets.
    pub fn is_auto(&self) -> bool {
        *self == Self::default()
    }
}

/// A text that is not an order for repairs.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is not an order for repairs; remedy: give auto, cavities (surfaces inside stay empty), \
     fill (they are filled), remesh or remesh:TOLERANCE such as remesh:0.1mm (a new surface), or \
     two of them such as remesh,fill"
)]
pub struct RepairOrderError(String);

impl FromStr for RepairOrder {
    type Err = RepairOrderError;

    fn from_str(text: &str) -> Result<Self, RepairOrderError> {
        let refuse = || RepairOrderError(text.to_owned());
        if text == AUTO {
            return Ok(Self::default());
        }
        let mut order = Self::default();
        for word in text.split(',') {
            let is_new = match word
                .split_once(':')
                .map_or((word, None), |(w, t)| (w, Some(t)))
            {
                ("cavities", None) => order.set_inner(InnerSurfaces::Cavities),
                ("fill", None) => order.set_inner(InnerSurfaces::Fill),
                (REMESH, None) => order.remesh.replace(Remesh::Usual).is_none(),
                (REMESH, Some(length)) => {
                    let length = length.parse().map_err(|_| refuse())?;
                    order.remesh.replace(Remesh::Within(length)).is_none()
                }
                _ => false,
            };
            if !is_new {
                return Err(refuse());
            }
        }
        Ok(order)
    }
}

impl RepairOrder {
    /// Sets the use of inner surfaces; returns false if it was set before.
    fn set_inner(&mut self, inner: InnerSurfaces) -> bool {
        std::mem::replace(&mut self.inner, inner) == InnerSurfaces::Refuse
    }
}

impl fmt::Display for RepairOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let remesh = self.remesh.map(|remesh| match remesh {
            Remesh::Usual => REMESH.to_owned(),
            Remesh::Within(length) => format!("{REMESH}:{length}"),
        });
        let inner = match self.inner {
            InnerSurfaces::Refuse => None,
            InnerSurfaces::Cavities => Some("cavities".to_owned()),
            InnerSurfaces::Fill => Some("fill".to_owned()),
        };
        let words: Vec<String> = remesh.into_iter().chain(inner).collect();
        if words.is_empty() {
            f.write_str(AUTO)
        } else {
            f.write_str(&words.join(","))
        }
    }
}

as_text!(RepairOrder);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_order_prints_as_it_reads() {
        for text in [
            "auto",
            "cavities",
            "fill",
            "remesh",
            "remesh:0.1mm",
            "remesh:0.25mm,fill",
        ] {
            assert_eq!(text.parse::<RepairOrder>().unwrap().to_string(), text);
        }
        let turned: RepairOrder = "fill,remesh:1cm".parse().unwrap();
        assert_eq!(turned.to_string(), "remesh:10mm,fill");
        assert!(RepairOrder::default().is_auto());
    }

    #[test]
    fn other_words_and_contradictions_are_refused_with_the_words_to_type() {
        for text in [
            "",
            "none",
            "fill,cavities",
            "fill,fill",
            "auto,fill",
            "remesh:",
            "remesh:-1mm",
            "remesh:0mm",
            "remesh,remesh:1mm",
            "fill:1mm",
            "Remesh",
        ] {
            let error = text.parse::<RepairOrder>().unwrap_err().to_string();
            assert!(error.contains("remesh:0.1mm"), "{text}: {error}");
        }
    }
}
