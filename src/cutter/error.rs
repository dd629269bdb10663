//! Errors of profiles: each fault with its file, line, column and remedy.

use std::{fmt, path::PathBuf};

use crate::base::toml_text::{Place, TextFault, nearest_name};

/// An error that leaves no profile of that id or in that file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// Neither a known id nor a file.
    #[error("there is no {kind} `{id}`; remedy: {remedy}")]
    Unknown {
        /// The kind of profile.
        kind: &'static str,
        /// The id asked for.
        id: String,
        /// The nearest id, or all of them.
        remedy: String,
    },
    /// The file cannot be read.
    #[error("cannot read the profile {path}; remedy: check the path and its permissions")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The operating system's error.
        source: std::io::Error,
    },
    /// Not TOML, or not a profile's keys.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// Known keys, but impossible or missing values.
    #[error(transparent)]
    Broken(#[from] Faults),
}

/// All faults of a profile, at least one.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct Faults(pub Vec<Fault>);

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

/// One fault and its place.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct Fault {
    /// Its place in the file.
    pub place: Place,
    /// The problem.
    pub problem: Problem,
}

/// A problem with a value of a profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// A number without a source.
    #[error("`{0}` has no source; remedy: add source = \"where the number is from\"")]
    NoSource(String),
    /// A number without its certainty.
    #[error(
        "`{0}` does not say how sure it is; remedy: add sure = \"measured\", \"read\", \
         \"paper\", \"computed\", \"third-party\", \"recalled\" or \"own-choice\""
    )]
    NotSure(String),
    /// Not a number, infinite, zero or negative.
    #[error("`{key}` is {value}, but must be positive and finite")]
    NotPositive {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
    },
    /// A value so large or small that it must be in another unit.
    #[error("`{key}` is {value}, outside {least} to {most}; remedy: check the unit in its name")]
    Implausible {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
        /// The smallest plausible value.
        least: f64,
        /// The largest plausible value.
        most: f64,
    },
    /// A required key that is not set.
    #[error("`{0}` is not set, here or in a parent; remedy: add it, or inherits = \"…\"")]
    Missing(&'static str),
    /// A text of blanks only.
    #[error("`{0}` is empty; remedy: write a text for people")]
    Empty(&'static str),
    /// An id that is unfit for file names.
    #[error("the id `{0}` may only have lower-case letters, digits and hyphens")]
    BadId(String),
    /// Two values that contradict each other.
    #[error("`{key}` is {value}, but {against}; remedy: correct one of them")]
    Contradiction {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
        /// The value that contradicts it, as a clause.
        against: String,
    },
    /// The same thing listed twice.
    #[error("{0} appears twice; remedy: remove one")]
    Twice(String),
    /// A profile that inherits from itself, or from one that inherits from it.
    #[error("`{id}` inherits from itself ({chain}); remedy: inherit from one of {known}")]
    Cycle {
        /// The profile.
        id: String,
        /// The chain of parents: `a → b → a`.
        chain: String,
        /// The known parents.
        known: String,
    },
    /// An unknown parent.
    #[error("there is no profile `{parent}` to inherit from; remedy: {remedy}")]
    UnknownParent {
        /// The parent.
        parent: String,
        /// The nearest known id, or all of them.
        remedy: String,
    },
    /// A parent file that cannot be read.
    #[error("cannot read the parent {0}; remedy: check its path, relative to this file's folder")]
    UnreadableParent(String),
    /// A material that nobody knows.
    #[error("there is no sheet material `{material}`; remedy: {remedy}")]
    UnknownMaterial {
        /// The material.
        material: String,
        /// The nearest known material, or all of them.
        remedy: String,
    },
    /// A material that must not be cut by a laser.
    #[error(
        "`{0}` must never be cut by a laser: it gives off chlorine, which harms lungs and \
         machines; remedy: use plywood, MDF or acrylic"
    )]
    Chlorine(String),
    /// A density that no such fastener has.
    #[error(
        "`{id}` would have a density of {density:.1} g/cm³; remedy: check its sizes and its mass"
    )]
    Density {
        /// The fastener.
        id: String,
        /// Its mass over the volume of its shape, g/cm³.
        density: f64,
    },
}

/// Suggests the nearest known word, or all of them if none is near.
pub(super) fn suggest(word: &str, known: &[&str]) -> String {
    match nearest_name(word, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("use one of {}", known.join(", ")),
    }
}
