//! `equipoise verify`: judges the written files of a kit again.

use std::io::Write;
use std::path::Path;

use super::args::VerifyArgs;
use super::exit::Exit;
use super::replay::replay;
use super::show::{GREEN, RED, paint, say};
use super::summary::{checks_table, summary};
use super::toolpaths::toolpaths_text;
use super::voice::{Manner, Voice};
use crate::base::watch::Watch;
use crate::error::Error;
use crate::press;
use crate::verify::{
    Check, CheckKind, CoreVerifyError, FileChange, PrintedError, TelescopeVerifyError, VerifyError,
    files_check, is_core, is_telescope, verify_core, verify_printed, verify_telescope,
};

/// Greatest number of files that are not on the list and are named.
const MAX_NAMED: usize = 10;

/// A reason why `verify` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VerifyCommandError {
    /// The kit cannot be judged.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// The kit of a telescope cannot be judged.
    #[error(transparent)]
    Telescope(#[from] TelescopeVerifyError),
    /// The kit of an object on a base cannot be judged.
    #[error(transparent)]
    Core(#[from] Box<CoreVerifyError>),
    /// An object on a base is compared with the kit's own model alone.
    #[error("this kit is compared with the model in it; remedy: verify it without another one")]
    OwnModel,
    /// The toolpaths of an object on a base are not judged.
    #[error(
        "this kit is that of an object on a base, whose toolpaths are not judged; remedy: verify it \
         without them"
    )]
    NoCoreToolpaths,
    /// An object on a base is not made again.
    #[error(
        "the kit of an object on a base is not made again; remedy: verify it without that order"
    )]
    NoCoreReplay,
    /// A telescope is made of no model.
    #[error("this kit is a telescope's, which is made of no model; remedy: verify it without one")]
    NoModel,
    /// The toolpaths cannot be judged.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The toolpaths of a telescope are not judged.
    #[error(
        "this kit is a telescope's, whose toolpaths are not judged; remedy: verify it without them"
    )]
    NoToolpaths,
    /// A telescope is not made again.
    #[error("a telescope's kit is not made again; remedy: verify it without that order")]
    NoReplay,
    /// The kit cannot be made again.
    #[error(transparent)]
    Replay(#[from] Box<Error>),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The checks cannot be put into JSON.
    #[error("the checks cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Judges a kit from its files, and by its model; prints the findings to `out`.
pub fn verify(
    args: &VerifyArgs,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<Exit, VerifyCommandError> {
    let (folder, model) = (args.kit.as_path(), args.model.as_deref());
    let is_telescope = is_telescope(folder);
    if args.replay && is_telescope {
        return Err(VerifyCommandError::NoReplay);
    }
    let is_core = is_core(folder);
    if args.replay && is_core {
        return Err(VerifyCommandError::NoCoreReplay);
    }
    if !args.gcode.is_empty() {
        return verify_toolpaths(args, voice, out);
    }
    let Judged {
        mut checks,
        changes,
        unlisted,
    } = if is_telescope {
        judge_telescope(folder, model)?
    } else if is_core {
        judge_core(folder, model)?
    } else {
        judge_kit(folder, model)?
    };
    if args.replay {
        let again = replay(folder, model, &Watch::silent()).map_err(Box::new)?;
        checks.push(again);
    }
    let is_kept = checks.iter().all(|check| check.pass);
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&checks)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&checks, &changes, voice.manner))?;
        write!(out, "{}", name_unlisted(&unlisted))?;
    } else if !is_kept {
        say(text(&checks, &changes, voice.manner).trim_end());
    }
    Ok(if is_kept { Exit::Kept } else { Exit::NotKept })
}

/// Judges the toolpaths of a kit; prints the findings to `out`.
fn verify_toolpaths(
    args: &VerifyArgs,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<Exit, VerifyCommandError> {
    if is_telescope(&args.kit) {
        return Err(VerifyCommandError::NoToolpaths);
    }
    if is_core(&args.kit) {
        return Err(VerifyCommandError::NoCoreToolpaths);
    }
    let found = verify_printed(&args.kit, &args.gcode, &Watch::silent())?;
    if voice.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", toolpaths_text(&found, voice.manner))?;
    } else if !found.passes() {
        say(toolpaths_text(&found, voice.manner).trim_end());
    }
    Ok(if found.passes() {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// What was found in a kit.
struct Judged {
    checks: Vec<Check>,
    changes: Vec<FileChange>,
    unlisted: Vec<String>,
}

fn judge_kit(folder: &Path, model: Option<&Path>) -> Result<Judged, VerifyError> {
    match press::verify(folder, model, &Watch::silent()) {
        Ok(judgement) => Ok(Judged {
            checks: judgement.checks,
            changes: judgement.changes,
            unlisted: judgement.unlisted,
        }),
        Err(error) => match error.changes(folder) {
            changes if changes.is_empty() => Err(error),
            changes => Ok(Judged {
                checks: vec![files_check(&changes)],
                changes,
                unlisted: Vec::new(),
            }),
        },
    }
}

fn judge_telescope(folder: &Path, model: Option<&Path>) -> Result<Judged, VerifyCommandError> {
    if model.is_some() {
        return Err(VerifyCommandError::NoModel);
    }
    let judgement = verify_telescope(folder, &Watch::silent())?;
    Ok(Judged {
        checks: judgement.checks,
        changes: judgement.changes,
        unlisted: judgement.unlisted,
    })
}

fn judge_core(folder: &Path, model: Option<&Path>) -> Result<Judged, VerifyCommandError> {
    if model.is_some() {
        return Err(VerifyCommandError::OwnModel);
    }
    let judgement = verify_core(folder, &Watch::silent()).map_err(Box::new)?;
    Ok(Judged {
        checks: judgement.checks,
        changes: judgement.changes,
        unlisted: judgement.unlisted,
    })
}

/// Returns a line about the files that are not on the kit's list; empty without any.
fn name_unlisted(unlisted: &[String]) -> String {
    let named = unlisted[..unlisted.len().min(MAX_NAMED)].join(", ");
    match unlisted.len() {
        0 => String::new(),
        count if count > MAX_NAMED => {
            let more = count - MAX_NAMED;
            format!("not on the kit's list, and not judged: {named} and {more} more\n")
        }
        _ => format!("not on the kit's list, and not judged: {named}\n"),
    }
}

/// Returns the changed files first, then the broken promises or all checks, then the sum.
///
/// If a file has another shape, the promises that break with it are only named, as they follow from
/// it. With `-v` they are shown in full.
fn text(checks: &[Check], changes: &[FileChange], manner: Manner) -> String {
    let causes = changes.iter().map(|change| {
        let label = paint("FAIL", RED, manner.is_output_coloured);
        format!(
            "{label} {change}\n  {}: {}\n",
            paint("remedy", GREEN, manner.is_output_coloured),
            change.remedy()
        )
    });
    let mut text: String = causes.collect();
    let is_shown = |check: &&Check| {
        !check.pass && (check.kind != CheckKind::ChangedFiles || changes.is_empty())
    };
    let broken: Vec<Check> = checks.iter().filter(is_shown).cloned().collect();
    let follows = changes.iter().any(FileChange::is_of_shape) && manner.verbose == 0;
    if follows && !broken.is_empty() {
        let names: Vec<String> = broken.iter().map(|check| check.kind.to_string()).collect();
        text += &format!(
            "  with it {} broken: {} (-v shows each)\n",
            if names.len() == 1 {
                "one promise is".to_owned()
            } else {
                format!("{} promises are", names.len())
            },
            names.join(", ")
        );
    } else if manner.verbose > 0 || changes.is_empty() {
        text += &checks_table(checks, manner);
    } else if !broken.is_empty() {
        text += &checks_table(&broken, manner);
    }
    // A kit whose files cannot be read has no promise that could be kept.
    let is_unjudged = !changes.is_empty() && checks.iter().all(is_of_files);
    let sum = if is_unjudged {
        paint("could not be judged", RED, manner.is_output_coloured)
    } else {
        summary(checks, manner)
    };
    text + &sum + "\n"
}

/// Returns true for the check that the files are those that were made.
fn is_of_files(check: &Check) -> bool {
    check.kind == CheckKind::ChangedFiles
}
