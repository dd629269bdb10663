//! The ways a command ends.

use std::process::ExitCode;

/// The way a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Exit {
    /// Every promise is kept.
    Kept,
    /// It ran to its end, but a check failed or the goal is impossible.
    NotKept,
    /// It could not run: a bad file, bad arguments, a target that cannot be written.
    CouldNotRun,
    /// Ctrl-C (SIGINT) stopped it before it wrote anything.
    Interrupted,
    /// A request to end (SIGTERM) stopped it before it wrote anything.
    Terminated,
}

impl Exit {
    /// Returns the exit code of the process: 0, 1 or 2, or 128 and the signal that stopped it.
    pub fn code(self) -> u8 {
        match self {
            Self::Kept => 0,
            Self::NotKept => 1,
            Self::CouldNotRun => 2,
            Self::Interrupted => 130,
            Self::Terminated => 143,
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}
