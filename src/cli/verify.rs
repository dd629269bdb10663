//! `equipoise verify`: judge the written files of a kit again.

use std::io::Write;
use std::path::Path;

use super::Exit;
use super::prepare::Voice;
use super::summary::{checks_table, summary};
use crate::verify::{VerifyError, verify_kit};

/// Why `verify` could not run.
#[derive(Debug, thiserror::Error)]
pub enum VerifyCommandError {
    /// The kit cannot be judged.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// Standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The checks cannot be put into JSON.
    #[error("the checks cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Judges the kit in `folder` from its files; says on `out` what was found.
pub fn verify(folder: &Path, voice: Voice, out: &mut dyn Write) -> Result<Exit, VerifyCommandError> {
    let judgement = verify_kit(folder)?;
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&judgement.checks)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", checks_table(&judgement.checks, voice.manner))?;
        writeln!(out, "{}", summary(&judgement.checks, voice.manner))?;
    }
    Ok(if judgement.passes() { Exit::Kept } else { Exit::NotKept })
}
