//! `equipoise verify`: judges the written files of a kit again.

use std::io::Write;
use std::path::Path;

use super::args::VerifyArgs;
use super::core_kit::CoreWing;
use super::exit::Exit;
use super::replay::{replay, replay_wing};
use super::show::{GREEN, RED, paint, say};
use super::summary::{checks_table, summary};
use super::telescope::TelescopeWing;
use super::toolpaths::toolpaths_text;
use super::voice::{Manner, Voice};
use crate::base::watch::Watch;
use crate::core_kit::CoreRunError;
use crate::error::Error;
use crate::press;
use crate::telescope::TelescopeRunError;
use crate::verify::{
    Check, CheckKind, CoreVerifyError, FileChange, KindJudgement, KitKind, PrintedError,
    TelescopeVerifyError, VerifyError, files_check, verify_core, verify_printed, verify_telescope,
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
    /// The toolpaths cannot be judged.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The kit is judged by itself.
    #[error("{kit} is judged without another model; remedy: verify it without one")]
    OwnModel {
        /// The kind of kit.
        kit: &'static str,
    },
    /// The toolpaths of the kit are not judged.
    #[error("the toolpaths of {kit} are not judged; remedy: verify it without them")]
    NoToolpaths {
        /// The kind of kit.
        kit: &'static str,
    },
    /// The telescope cannot be made again.
    #[error(transparent)]
    ReplayTelescope(#[from] Box<TelescopeRunError>),
    /// The object on a base cannot be made again.
    #[error(transparent)]
    ReplayCore(#[from] Box<CoreRunError>),
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
    let kind = KitKind::of(folder);
    if let Some(kit) = own_kind(kind) {
        refuse(args, kit)?;
    }
    if !args.gcode.is_empty() {
        return verify_toolpaths(args, voice, out);
    }
    let Judged {
        mut checks,
        changes,
        unlisted,
    } = match kind {
        KitKind::Hollowed => judge_kit(folder, model)?,
        KitKind::Telescope => verify_telescope(folder, &Watch::silent())?.into(),
        KitKind::Core => verify_core(folder, &Watch::silent())
            .map_err(Box::new)?
            .into(),
    };
    if args.replay {
        checks.push(made_again(kind, folder, model)?);
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

/// Makes a kit again from its job, and compares it.
fn made_again(
    kind: KitKind,
    folder: &Path,
    model: Option<&Path>,
) -> Result<Check, VerifyCommandError> {
    let watch = &Watch::silent();
    Ok(match kind {
        KitKind::Hollowed => replay(folder, model, watch).map_err(Box::new)?,
        KitKind::Telescope => replay_wing::<TelescopeWing>(folder, watch).map_err(Box::new)?,
        KitKind::Core => replay_wing::<CoreWing>(folder, watch).map_err(Box::new)?,
    })
}

/// Returns the name of a kind of kit that has its own line; `None` for hollowed models.
fn own_kind(kind: KitKind) -> Option<&'static str> {
    match kind {
        KitKind::Hollowed => None,
        KitKind::Telescope => Some("the kit of a telescope"),
        KitKind::Core => Some("the kit of an object on a base"),
    }
}

/// Refuses what is ordered and cannot be done with kits of their own kind.
fn refuse(args: &VerifyArgs, kit: &'static str) -> Result<(), VerifyCommandError> {
    if !args.gcode.is_empty() {
        return Err(VerifyCommandError::NoToolpaths { kit });
    }
    if args.model.is_some() {
        return Err(VerifyCommandError::OwnModel { kit });
    }
    Ok(())
}

/// Judges the toolpaths of a kit; prints the findings to `out`.
fn verify_toolpaths(
    args: &VerifyArgs,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<Exit, VerifyCommandError> {
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

impl From<KindJudgement> for Judged {
    fn from(judgement: KindJudgement) -> Self {
        Self {
            checks: judgement.checks,
            changes: judgement.changes,
            unlisted: judgement.unlisted,
        }
    }
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
