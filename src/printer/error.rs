//! Errors of profiles: each fault with its file, line, column and remedy.

use std::{fmt, path::PathBuf};

use crate::base::toml_text::{Place, TextFault};

/// An error that leaves no printer of that id or in that file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ProfileError {
    /// Neither a known id nor a file.
    #[error("there is no printer `{id}`; remedy: {remedy}")]
    Unknown {
        /// The id asked for.
        id: String,
        /// The nearest id, or the command that lists them.
        remedy: String,
    },
    /// The file cannot be read.
    #[error("cannot read the printer profile {path}; remedy: check the path and its permissions")]
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
    #[error("`{key}` has no source; remedy: add source = \"where the number is from\"")]
    NoSource {
        /// The number.
        key: String,
    },
    /// A number without its certainty.
    #[error(
        "`{key}` does not say how sure it is; remedy: add sure = \"measured\", \"read\", \
         \"paper\", \"computed\", \"third-party\", \"recalled\" or \"own-choice\""
    )]
    NotSure {
        /// The number.
        key: String,
    },
    /// Neither `value` nor `dpi`.
    #[error("`{key}` has no value; remedy: add value = …")]
    NoValue {
        /// The number.
        key: String,
    },
    /// Both `value` and `dpi`.
    #[error("`{key}` has both value and dpi; remedy: keep one of them")]
    TwoValues {
        /// The number.
        key: String,
    },
    /// Dots per inch for a number that is no step of the grid.
    #[error("`{key}` cannot be given in dpi; remedy: give its value")]
    DpiNotAStep {
        /// The number.
        key: String,
    },
    /// Not a number, infinite, zero or negative.
    #[error("`{key}` is {}, but must be positive and finite", show(*value))]
    NotPositive {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
    },
    /// A value so large or small that it must be in another unit.
    #[error(
        "`{key}` is {}, outside {least} to {most}; remedy: check the unit in its name",
        show(*value)
    )]
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
    #[error("`{key}` is not set, here or in a parent; remedy: add it, or inherits = \"…\"")]
    Missing {
        /// The key.
        key: String,
    },
    /// A text of blanks only.
    #[error("`{key}` is empty; remedy: write a text for people")]
    Empty {
        /// The key.
        key: String,
    },
    /// An id that is unfit for file names.
    #[error("the id `{id}` may only have lower-case letters, digits and hyphens")]
    BadId {
        /// The id.
        id: String,
    },
    /// A profile that inherits from itself, or from one that inherits from it.
    #[error(
        "`{id}` inherits from itself ({chain}); remedy: inherit from one of the processes {known}"
    )]
    Cycle {
        /// The profile.
        id: String,
        /// The chain of parents: `a → b → a`.
        chain: String,
        /// The known processes.
        known: String,
    },
    /// A parent file that cannot be read.
    #[error(
        "cannot read the parent {parent}; remedy: check its path, relative to this profile's folder"
    )]
    UnreadableParent {
        /// Its path.
        parent: String,
    },
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
    /// A measured density without its day or its lot.
    #[error("`{id}` has a measured density, but no {missing}; remedy: add {missing} = …")]
    NotDated {
        /// The material.
        id: String,
        /// `measured_on` or `lot`.
        missing: &'static str,
    },
    /// A value that is no day.
    #[error("`measured_on` is {value}, but must be a day such as 2026-11-21")]
    NotADay {
        /// The value as written.
        value: String,
    },
    /// A process with a parent.
    #[error(
        "the process `{id}` inherits from `{parent}`, but a process has no parent; \
         remedy: copy the values here"
    )]
    ProcessInherits {
        /// The process.
        id: String,
        /// Its parent.
        parent: String,
    },
    /// An unknown parent.
    #[error("there is no process or printer `{parent}`; remedy: {remedy}")]
    UnknownParent {
        /// The parent.
        parent: String,
        /// The nearest known id, or all of them.
        remedy: String,
    },
    /// An unknown material.
    #[error("there is no material `{id}`; remedy: {remedy}")]
    UnknownMaterial {
        /// The material.
        id: String,
        /// The nearest known material, or all of them.
        remedy: String,
    },
    /// An empty list of materials.
    #[error("the list of materials is empty; remedy: name at least one")]
    NoMaterials,
    /// A material that is listed or defined twice.
    #[error("the material `{id}` appears twice; remedy: remove one")]
    MaterialTwice {
        /// The material.
        id: String,
    },
    /// A default material that the list does not contain.
    #[error(
        "the default material `{id}` is not among the printer's materials {known}; \
         remedy: add it to `materials`"
    )]
    DefaultNotListed {
        /// The material.
        id: String,
        /// The printer's materials.
        known: String,
    },
}

/// Formats a number, with a power of ten if it would have many digits otherwise.
fn show(value: f64) -> String {
    let is_plain = value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs());
    if is_plain {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// Suggests the nearest known word, or all of them if none is near.
pub(super) fn suggest(word: &str, known: &[&str]) -> String {
    match crate::base::toml_text::nearest_name(word, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("use one of {}", known.join(", ")),
    }
}
