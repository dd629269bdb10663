//! The density that is ordered on the command line: words, or a file.

use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

use crate::field::{FileError, Order, WordsError, is_file_name, read_file};

/// A density as it is typed.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldChoice {
    typed: String,
    source: Source,
}

#[derive(Debug, Clone, PartialEq)]
enum Source {
    Words(Order),
    File(PathBuf),
}

impl FieldChoice {
    /// Returns the density; a file is read now.
    ///
    /// # Errors
    /// The file is no field.
    pub fn order(&self) -> Result<Order, FileError> {
        match &self.source {
            Source::Words(order) => Ok(order.clone()),
            Source::File(path) => read_file(path),
        }
    }
}

impl FromStr for FieldChoice {
    type Err = WordsError;

    fn from_str(typed: &str) -> Result<Self, WordsError> {
        let source = if is_file_name(typed) {
            Source::File(typed.into())
        } else {
            Source::Words(typed.parse()?)
        };
        Ok(Self {
            typed: typed.to_owned(),
            source,
        })
    }
}

impl fmt::Display for FieldChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.typed)
    }
}
