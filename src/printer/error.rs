//! What can be wrong with a profile: each fault with its file, line, column and remedy.

use std::{fmt, path::PathBuf};

use crate::base::toml_text::{Place, TextFault};

/// Why there is no printer of that name or in that file.
#[derive(Debug, thiserror::Error)]
pub enum ProfileError {
    /// Neither a known id nor a file.
    #[error("there is no printer `{id}`; the known ones are {known}; remedy: {remedy}")]
    Unknown {
        /// What was asked for.
        id: String,
        /// The ids of the built-in set.
        known: String,
        /// The nearest id, or how to give a file.
        remedy: String,
    },
    /// The file cannot be read.
    #[error("cannot read the printer profile {path}; remedy: check the path and its permissions")]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
    /// Not TOML, or not a profile's keys.
    #[error(transparent)]
    Text(#[from] TextFault),
    /// A profile by its keys, but with values that cannot be.
    #[error(transparent)]
    Broken(#[from] Faults),
}

/// Everything that was found wrong with a profile, at least one fault.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub struct Faults(pub Vec<Fault>);

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lines: Vec<String> = self.0.iter().map(ToString::to_string).collect();
        f.write_str(&lines.join("\n"))
    }
}

/// One thing that is wrong, and where.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{place}: {problem}")]
pub struct Fault {
    /// Where it stands.
    pub place: Place,
    /// What it is.
    pub problem: Problem,
}

/// What can be wrong with a value of a profile.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Problem {
    /// A number that no source vouches for.
    #[error("`{key}` has no source; remedy: add source = \"where the number is from\"")]
    NoSource {
        /// The number.
        key: String,
    },
    /// A number whose certainty is not said.
    #[error(
        "`{key}` does not say how sure it is; remedy: add sure = \"measured\", \"read\", \"paper\", \"computed\", \"third-party\", \"recalled\" or \"own-choice\""
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
    /// Dots per inch for what is not a step of the grid.
    #[error("`{key}` cannot be given in dpi; remedy: give its value")]
    DpiNotAStep {
        /// The number.
        key: String,
    },
    /// Not a number, infinite, zero or negative.
    #[error("`{key}` is {}, but must be positive and finite", shown(*value))]
    NotPositive {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
    },
    /// So large or small that another unit was meant.
    #[error("`{key}` is {}, outside {least} to {most}; remedy: check the unit in its name", shown(*value))]
    Implausible {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
        /// The least that can be meant.
        least: f64,
        /// The most that can be meant.
        most: f64,
    },
    /// A key that every printer needs.
    #[error(
        "`{key}` is not set, here or in the process it inherits from; remedy: add it, or inherits = \"…\""
    )]
    Missing {
        /// The key.
        key: String,
    },
    /// A text of blanks.
    #[error("`{key}` is empty; remedy: write something a person can use")]
    Empty {
        /// The key.
        key: String,
    },
    /// An id that would not do in file names.
    #[error("the id `{id}` may only have lower-case letters, digits and hyphens")]
    BadId {
        /// The id.
        id: String,
    },
    /// A profile that inherits from itself, or from one that inherits from it.
    #[error(
        "`{id}` inherits from itself ({way}); remedy: inherit from one of the processes {known}"
    )]
    Cycle {
        /// The profile.
        id: String,
        /// The way round: `a → b → a`.
        way: String,
        /// The processes there are.
        known: String,
    },
    /// A parent's file that cannot be read.
    #[error(
        "cannot read the parent {parent}; remedy: check its path, taken from this profile's folder"
    )]
    UnreadableParent {
        /// Its path.
        parent: String,
    },
    /// Numbers of one profile that cannot both be right.
    #[error("`{key}` is {value}, but {against}; remedy: correct the one or the other")]
    Contradiction {
        /// The number.
        key: String,
        /// Its value.
        value: f64,
        /// What speaks against it.
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
    /// Something that is not a day.
    #[error("`measured_on` is {value}, but must be a day such as 2026-11-21")]
    NotADay {
        /// What it says.
        value: String,
    },
    /// A process that has a parent itself.
    #[error(
        "the process `{id}` inherits from `{parent}`, but a process has no parent; remedy: copy the values here"
    )]
    ProcessInherits {
        /// The process.
        id: String,
        /// Its parent.
        parent: String,
    },
    /// A parent that does not exist.
    #[error("there is no process or printer `{parent}`; remedy: {remedy}")]
    UnknownParent {
        /// The parent.
        parent: String,
        /// The nearest process, or all.
        remedy: String,
    },
    /// A material that does not exist.
    #[error("there is no material `{id}`; remedy: {remedy}")]
    UnknownMaterial {
        /// The material.
        id: String,
        /// The nearest material, or all.
        remedy: String,
    },
    /// A list of no materials.
    #[error("the list of materials is empty; remedy: name at least one")]
    NoMaterials,
    /// A material twice in the list, or defined twice.
    #[error("the material `{id}` appears twice; remedy: remove one")]
    MaterialTwice {
        /// The material.
        id: String,
    },
    /// A default that is not in the list.
    #[error(
        "the default material `{id}` is not among the printer's materials {known}; remedy: add it to `materials`"
    )]
    DefaultNotListed {
        /// The material.
        id: String,
        /// The printer's materials.
        known: String,
    },
}

/// A number for people: with a power of ten where it would have many digits.
fn shown(value: f64) -> String {
    let is_plain = value == 0.0 || !value.is_finite() || (1e-4..1e6).contains(&value.abs());
    if is_plain {
        value.to_string()
    } else {
        format!("{value:e}")
    }
}

/// "did you mean `x`?", or the whole list when nothing is near.
pub(super) fn suggestion(word: &str, known: &[&str]) -> String {
    match crate::base::toml_text::nearest(word, known.iter().copied()) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("use one of {}", known.join(", ")),
    }
}
