//! `equipoise slice`: the toolpaths of a kit, and how they will balance.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::SliceArgs;
use super::exit::Exit;
use super::show::{say, table};
use super::signals::Stop;
use super::toolpaths::toolpaths_text;
use super::voice::{Manner, Voice};
use crate::base::numbers::quantity;
use crate::base::watch::Watch;
use crate::kit::{Existing, KitError};
use crate::slice::{SliceError, SliceOrder, Slices, slice_kit};
use crate::verify::{PrintedError, PrintedJudgement, verify_printed};

/// A reason why no toolpaths were written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SliceCommandError {
    /// The kit cannot be sliced.
    #[error(transparent)]
    Slice(#[from] SliceError),
    /// The folder cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// The toolpaths cannot be judged.
    #[error(transparent)]
    Printed(#[from] PrintedError),
    /// The result cannot be put into JSON.
    #[error("the result cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
}

/// The findings as they are printed as JSON.
#[derive(Serialize)]
struct Found<'a> {
    folder: &'a Path,
    slices: &'a Slices,
    judgement: &'a PrintedJudgement,
}

/// Slices a kit, writes its toolpaths and judges them; prints the findings to `out`.
pub fn slice(
    args: &SliceArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, SliceCommandError> {
    let target = args.out.clone().unwrap_or_else(|| folder_beside(&args.kit));
    let existing = if args.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&target)?;
    let watch = Watch::silent_until(stop.flag());
    let order = SliceOrder {
        kit: args.kit.clone(),
        slicer: args.slicer.clone(),
        profile: args.profile.clone(),
    };
    let written = slice_kit(&order, &watch)
        .map_err(SliceCommandError::from)
        .and_then(|sliced| {
            sliced.files.write_watched(&target, existing, &watch)?;
            Ok(sliced.slices)
        });
    if written.is_err()
        && let Some(exit) = stop.end()
    {
        return Ok(exit);
    }
    let slices = written?;
    let files = slices.plates.iter();
    let files: Vec<PathBuf> = files.map(|plate| target.join(&plate.toolpaths)).collect();
    let judgement = verify_printed(&args.kit, &files, &watch)?;
    if voice.json {
        let found = Found {
            folder: &target,
            slices: &slices,
            judgement: &judgement,
        };
        writeln!(out, "{}", serde_json::to_string_pretty(&found)?)?;
    } else if !voice.manner.quiet {
        write!(out, "{}", text(&slices, &judgement, &target, voice.manner))?;
    } else if !judgement.passes() {
        say(toolpaths_text(&judgement, voice.manner).trim_end());
    }
    Ok(if judgement.passes() {
        Exit::Kept
    } else {
        Exit::NotKept
    })
}

/// Returns the folder of the toolpaths beside a kit.
fn folder_beside(kit: &Path) -> PathBuf {
    let name = kit
        .file_name()
        .map(|name| name.to_string_lossy().into_owned());
    kit.with_file_name(format!(
        "{}-gcode",
        name.unwrap_or_else(|| "kit".to_owned())
    ))
}

fn text(slices: &Slices, judgement: &PrintedJudgement, folder: &Path, manner: Manner) -> String {
    let head = [
        "plate",
        "time",
        "parts",
        "support, brim, skirt",
        "toolpaths",
    ];
    let rows: Vec<[String; 5]> = std::iter::once(head.map(str::to_owned))
        .chain(slices.plates.iter().map(|plate| {
            [
                plate.plate.clone(),
                plate.time(),
                quantity(plate.parts_g, "g"),
                quantity(plate.support_g, "g"),
                folder.join(&plate.toolpaths).display().to_string(),
            ]
        }))
        .collect();
    let sum = format!(
        "all plates: {}, {} of parts, {} of support, brim and skirt; by {}\n",
        slices.time(),
        quantity(slices.parts_g(), "g"),
        quantity(slices.support_g(), "g"),
        slices.slicer
    );
    let sliced = table(&rows) + &sum;
    sliced.replace('\u{a0}', " ") + "\n" + &toolpaths_text(judgement, manner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_toolpaths_lie_beside_their_kit() {
        let beside = |kit: &str| folder_beside(Path::new(kit)).display().to_string();
        assert_eq!(beside("kits/elephant"), "kits/elephant-gcode");
        assert_eq!(beside("elephant/"), "elephant-gcode");
    }
}
