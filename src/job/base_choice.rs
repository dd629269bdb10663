//! The base of an object that is larger than the printer: how many polyhedra, or a person's own.

use std::convert::Infallible;
use std::fmt;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};

/// The word for as many polyhedra as are worth it.
const AUTO: &str = "auto";
/// The largest file, bytes: a base of six polyhedra has some ten thousand.
const MOST_BYTES: u64 = 1 << 20;
/// The most polyhedra that may be asked for.
const MOST_POLYHEDRA: usize = 6;

/// The number of polyhedra of a base.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Polyhedra {
    /// As many as each raise the volume by 5 %.
    Auto,
    /// This many, or fewer if the model has no room for one more.
    Exactly(usize),
}

/// A text that is no number of polyhedra.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("`{0}` is no number of polyhedra; remedy: give {AUTO}, or 1 to {MOST_POLYHEDRA}")]
pub struct PolyhedraError(String);

impl Polyhedra {
    /// Returns true for one polyhedron.
    pub fn is_one(&self) -> bool {
        *self == Self::Exactly(1)
    }

    /// Returns the greatest number of polyhedra.
    pub fn most(&self) -> usize {
        match self {
            Self::Auto => MOST_POLYHEDRA,
            Self::Exactly(count) => *count,
        }
    }
}

impl FromStr for Polyhedra {
    type Err = PolyhedraError;

    fn from_str(text: &str) -> Result<Self, PolyhedraError> {
        if text == AUTO {
            return Ok(Self::Auto);
        }
        let count = text.parse().ok();
        let count = count.filter(|count| (1..=MOST_POLYHEDRA).contains(count));
        let refused = || PolyhedraError(text.to_owned());
        count.map(Self::Exactly).ok_or_else(refused)
    }
}

impl fmt::Display for Polyhedra {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str(AUTO),
            Self::Exactly(count) => count.fmt(f),
        }
    }
}

impl Serialize for Polyhedra {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Auto => serializer.serialize_str(AUTO),
            Self::Exactly(count) => count.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Polyhedra {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Written {
            Number(i64),
            Word(String),
        }
        let text = match Written::deserialize(deserializer)? {
            Written::Number(number) => number.to_string(),
            Written::Word(word) => word,
        };
        text.parse().map_err(D::Error::custom)
    }
}

/// The word for no rods.
const NONE: &str = "none";

/// The rods between polyhedra whose panels do not bear on each other.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub enum Dowel {
    /// The thickest on stock that have room.
    #[default]
    Auto,
    /// No rods: such polyhedra are not joined.
    None,
    /// Rods of this id, such as `dowel-8`.
    Id(String),
}

impl Dowel {
    /// Returns true if the thickest that have room are taken.
    pub fn is_auto(&self) -> bool {
        *self == Self::Auto
    }
}

impl FromStr for Dowel {
    type Err = Infallible;

    fn from_str(text: &str) -> Result<Self, Infallible> {
        Ok(match text {
            AUTO => Self::Auto,
            NONE => Self::None,
            id => Self::Id(id.to_owned()),
        })
    }
}

impl fmt::Display for Dowel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => AUTO,
            Self::None => NONE,
            Self::Id(id) => id,
        })
    }
}

impl Serialize for Dowel {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Dowel {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(D::Error::custom)
    }
}

/// The file of a base cannot be read.
#[derive(Debug, thiserror::Error)]
#[error("cannot read the base {path}; remedy: give the path of a base such as a kit's base.toml")]
pub struct BaseReadError {
    /// The file.
    pub path: PathBuf,
    /// The system's error.
    pub source: io::Error,
}

/// A base that a person gives, in place of one that is looked for.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BaseChoice {
    /// The name of its file, which messages use.
    pub file: String,
    /// The text of that file.
    pub toml: String,
}

impl BaseChoice {
    /// Reads the file at `path`; its text is not looked at.
    pub fn read(path: &Path) -> Result<Self, BaseReadError> {
        let refused = |source| BaseReadError {
            path: path.to_owned(),
            source,
        };
        let file = File::open(path).map_err(refused)?;
        let mut toml = String::new();
        let read = file.take(MOST_BYTES + 1).read_to_string(&mut toml);
        let read = read.map_err(refused)?;
        if read as u64 > MOST_BYTES {
            let fault = "it is far larger than a base";
            return Err(refused(io::Error::new(io::ErrorKind::FileTooLarge, fault)));
        }
        Ok(Self {
            file: path.to_string_lossy().into_owned(),
            toml,
        })
    }

    /// Returns the choice as a kit tells it: the name of the file, without its folder.
    pub fn without_folder(&self) -> Self {
        let name = Path::new(&self.file).file_name();
        Self {
            file: name.map_or_else(String::new, |name| name.to_string_lossy().into_owned()),
            toml: self.toml.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_choice_of_rods_reads_as_it_is_written() {
        for (text, expected) in [
            ("auto", Dowel::Auto),
            ("none", Dowel::None),
            ("dowel-8", Dowel::Id("dowel-8".to_owned())),
        ] {
            let Ok(read) = text.parse::<Dowel>();
            assert_eq!((read.to_string().as_str(), read), (text, expected));
        }
    }

    #[test]
    fn a_number_of_polyhedra_reads_as_it_is_written() {
        for (text, expected) in [
            ("auto", Polyhedra::Auto),
            ("1", Polyhedra::Exactly(1)),
            ("6", Polyhedra::Exactly(6)),
        ] {
            let read: Polyhedra = text.parse().unwrap();
            assert_eq!((read, read.to_string().as_str()), (expected, text));
        }
        for text in ["0", "7", "-1", "two", ""] {
            let error = text.parse::<Polyhedra>().unwrap_err();
            assert!(error.to_string().contains("give auto, or 1 to 6"));
        }
    }
}
