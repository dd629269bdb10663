//! The edge: arguments in, text and exit codes out. Everything that is printed is printed here.

pub mod args;
pub mod printers;
pub mod show;

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exit {
    /// Every promise is kept.
    Kept,
    /// It ran to its end, but a check failed or the goal is impossible.
    NotKept,
    /// It could not run: a bad file, bad arguments, a target that cannot be written.
    CouldNotRun,
}

impl Exit {
    /// The code the process ends with: 0, 1 or 2.
    pub fn code(self) -> u8 {
        match self {
            Self::Kept => 0,
            Self::NotKept => 1,
            Self::CouldNotRun => 2,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
