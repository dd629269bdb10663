//! The field of densities that a job orders: a family to fit, or a field with its numbers.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::base::words::as_text;
use crate::field::{Order, Ramp, Sine, WordsError};

/// A field of densities in a graded print.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum FieldOrder {
    /// A ramp that is fitted to the goal.
    FitRamp,
    /// A wave of the distance to a point that is fitted to the goal.
    FitSine,
    /// A field with its numbers.
    Given {
        /// The text as it was typed.
        typed: String,
        /// The field.
        field: GivenField,
    },
}

/// A field with its numbers that can be printed in nested regions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GivenField {
    /// The same everywhere.
    Uniform(f64),
    /// Linear between two planes.
    Ramp(Ramp),
    /// A wave of the distance to a point.
    Sine(Sine),
}

/// The word for a ramp.
const RAMP: &str = "ramp";
/// The word for a wave.
const SINE: &str = "sine";

/// A reason why a text is no field to print.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldOrderError {
    /// It is no field.
    #[error(transparent)]
    Words(#[from] WordsError),
    /// It has level sets that no region is drawn of.
    #[error(
        "`{0}` has no planes or balls for regions of infill; remedy: give a uniform, ramp or sine \
         field, or write its toolpaths by scale-extrusion"
    )]
    NoRegions(String),
}

impl FieldOrder {
    /// Returns true for a wave, whose regions alternate.
    pub fn is_sine(&self) -> bool {
        let given = Self::given;
        *self == Self::FitSine || matches!(given(self), Some(GivenField::Sine(_)))
    }

    /// Returns the field with its numbers; `None` if it is to be fitted.
    pub fn given(&self) -> Option<GivenField> {
        match self {
            Self::Given { field, .. } => Some(*field),
            Self::FitRamp | Self::FitSine => None,
        }
    }
}

impl GivenField {
    /// Returns the least and the greatest density.
    pub fn densities(&self) -> [f64; 2] {
        match self {
            Self::Uniform(density) => [*density; 2],
            Self::Ramp(ramp) => ramp.densities(),
            Self::Sine(sine) => sine.densities(),
        }
    }
}

impl FromStr for FieldOrder {
    type Err = FieldOrderError;

    fn from_str(text: &str) -> Result<Self, FieldOrderError> {
        match text.trim() {
            RAMP => return Ok(Self::FitRamp),
            SINE => return Ok(Self::FitSine),
            _ => {}
        }
        let no_regions = || FieldOrderError::NoRegions(text.to_owned());
        if text.to_lowercase().ends_with(".toml") {
            return Err(no_regions());
        }
        let field = match text.parse::<Order>()? {
            Order::Uniform(uniform) => GivenField::Uniform(uniform.0),
            Order::Ramp(ramp) => GivenField::Ramp(ramp),
            Order::Sine(sine) => GivenField::Sine(sine),
            _ => return Err(no_regions()),
        };
        Ok(Self::Given {
            typed: text.to_owned(),
            field,
        })
    }
}

impl fmt::Display for FieldOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FitRamp => RAMP,
            Self::FitSine => SINE,
            Self::Given { typed, .. } => typed,
        })
    }
}

as_text!(FieldOrder);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_family_is_a_bare_word_and_a_field_has_its_numbers() {
        for text in [
            "ramp",
            "sine",
            "uniform:40%",
            "ramp:0,0,1@20mm..60mm:0.2..1",
            "sine:10,0,25@40mm:0.2..0.9",
        ] {
            let order: FieldOrder = text.parse().unwrap();
            assert_eq!(order.to_string(), text);
            assert_eq!(order.given().is_none(), !text.contains(':'));
            assert_eq!(order.is_sine(), text.starts_with("sine"));
        }
    }

    #[test]
    fn fields_without_planes_or_balls_are_refused_with_what_to_type() {
        for text in ["skin:4mm:gauss:0.2..1", "field.toml", "wave", "uniform:15"] {
            let error = text.parse::<FieldOrder>().unwrap_err().to_string();
            assert!(error.contains("remedy: "), "{text}: {error}");
        }
    }
}
