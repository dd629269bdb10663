//! The field of densities that a job orders: a family to fit, or a field with its numbers.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use crate::field::{
    FileError, Order, Ramp, Sine, SkinOrder, WordsError, is_file_name, read_text, text_of,
};

/// A field of densities in a graded print.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Written", into = "Written")]
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
    /// A field from a file.
    File {
        /// The file's name, without the folder in which it lay.
        name: String,
        /// The file's text.
        text: String,
        /// The field.
        field: GivenField,
    },
}

/// A field with its numbers that can be printed in nested regions.
#[derive(Debug, Clone, PartialEq)]
pub enum GivenField {
    /// The same everywhere.
    Uniform(f64),
    /// Linear between two planes.
    Ramp(Ramp),
    /// A wave of the distance to a point.
    Sine(Sine),
    /// A function of the depth below the surface.
    Skin(SkinOrder),
    /// Any other without jumps: its regions are drawn where it passes a density.
    Drawn(Order),
}

/// A field as it stands in a job: words, or a file with its name.
#[derive(Debug, Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    Words(String),
    File(WrittenFile),
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenFile {
    file: String,
    text: String,
}

/// The word for a ramp.
const RAMP: &str = "ramp";
/// The word for a wave.
const SINE: &str = "sine";

/// A reason why a text is no field to print.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FieldOrderError {
    /// It is no field.
    #[error(transparent)]
    Words(#[from] WordsError),
    /// A file is no field.
    #[error(transparent)]
    File(#[from] FileError),
    /// It jumps, so that no region can be drawn between two of its densities.
    #[error(
        "`{0}` has levels, and a field that jumps is not printed in regions; remedy: leave the \
         levels out, or write its toolpaths by scale-extrusion"
    )]
    Jumps(String),
    /// A job names a file in place of its text.
    #[error(
        "`{0}` is the name of a file, and a job holds the text of its field; remedy: write a table \
         with `file` and `text`, or order the file on the command line"
    )]
    FileName(String),
}

impl FieldOrder {
    /// Returns true for a wave, whose regions alternate.
    pub fn is_sine(&self) -> bool {
        *self == Self::FitSine || matches!(self.given(), Some(GivenField::Sine(_)))
    }

    /// Returns the field with its numbers; `None` if it is to be fitted.
    pub fn given(&self) -> Option<&GivenField> {
        match self {
            Self::Given { field, .. } | Self::File { field, .. } => Some(field),
            Self::FitRamp | Self::FitSine => None,
        }
    }

    /// Returns the text of the file that it is from; `None` for words.
    pub fn file_text(&self) -> Option<&str> {
        match self {
            Self::File { text, .. } => Some(text),
            _ => None,
        }
    }

    /// Reads a field from a file.
    ///
    /// # Errors
    /// It cannot be read, or is no field that can be printed.
    pub fn of_file(path: &Path) -> Result<Self, FieldOrderError> {
        let text = text_of(path)?;
        let order = read_text(&path.display().to_string(), &text)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        Ok(Self::File {
            field: GivenField::of(order, &name)?,
            name: name.into_owned(),
            text,
        })
    }
}

impl GivenField {
    /// Returns the field of an order with these words.
    fn of(order: Order, words: &str) -> Result<Self, FieldOrderError> {
        Ok(match order {
            Order::Uniform(uniform) => Self::Uniform(uniform.0),
            Order::Ramp(ramp) => Self::Ramp(ramp),
            Order::Sine(sine) => Self::Sine(sine),
            Order::Skin(skin) => Self::Skin(skin),
            order if order.jumps() => return Err(FieldOrderError::Jumps(words.to_owned())),
            order => Self::Drawn(order),
        })
    }

    /// Returns the least and the greatest density; `None` if they depend on the model.
    pub fn densities(&self) -> Option<[f64; 2]> {
        match self {
            Self::Uniform(density) => Some([*density; 2]),
            Self::Ramp(ramp) => Some(ramp.densities()),
            Self::Sine(sine) => Some(sine.densities()),
            Self::Skin(skin) => Some(skin.densities),
            Self::Drawn(_) => None,
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
        if is_file_name(text) {
            return Err(FieldOrderError::FileName(text.to_owned()));
        }
        Ok(Self::Given {
            typed: text.to_owned(),
            field: GivenField::of(text.parse::<Order>()?, text)?,
        })
    }
}

impl fmt::Display for FieldOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::FitRamp => RAMP,
            Self::FitSine => SINE,
            Self::Given { typed, .. } => typed,
            Self::File { name, .. } => name,
        })
    }
}

impl TryFrom<Written> for FieldOrder {
    type Error = FieldOrderError;

    fn try_from(written: Written) -> Result<Self, FieldOrderError> {
        match written {
            Written::Words(words) => words.parse(),
            Written::File(WrittenFile { file, text }) => Ok(Self::File {
                field: GivenField::of(read_text(&file, &text)?, &file)?,
                name: file,
                text,
            }),
        }
    }
}

impl From<FieldOrder> for Written {
    fn from(order: FieldOrder) -> Self {
        match order {
            FieldOrder::File { name, text, .. } => Self::File(WrittenFile { file: name, text }),
            words => Self::Words(words.to_string()),
        }
    }
}

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
            "skin:4mm:gauss:0.2..1",
        ] {
            let order: FieldOrder = text.parse().unwrap();
            assert_eq!(order.to_string(), text);
            assert_eq!(order.given().is_none(), !text.contains(':'));
            assert_eq!(order.is_sine(), text.starts_with("sine"));
        }
    }

    #[test]
    fn what_is_no_field_is_refused_with_what_to_type() {
        for text in ["field.toml", "wave", "uniform:15"] {
            let error = text.parse::<FieldOrder>().unwrap_err().to_string();
            assert!(error.contains("remedy: "), "{text}: {error}");
        }
    }

    #[test]
    fn a_field_with_levels_is_refused_wherever_they_stand_in_it() {
        let levels = "{ levels = { quadric = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], \
            cuts = [1.0], densities = [0.2, 0.4] } }";
        for text in [
            format!("field = {levels}"),
            format!("[field]\nsum = [\"uniform:10%\", {{ product = [{levels}] }}]"),
        ] {
            let written = Written::File(WrittenFile {
                file: "a.toml".into(),
                text,
            });
            let error = FieldOrder::try_from(written).unwrap_err().to_string();
            assert!(error.contains("leave the levels out"), "{error}");
        }
    }
}
