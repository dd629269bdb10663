//! `equipoise core`: run the job, write the kit, show what came of it.

use std::io::Write;

use super::args::{ArgsError, CoreArgs, CoreRequest};
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{flags, with_flags};
use super::show::say;
use super::signals::Stop;
use super::summary::{broken, checks_table, summary};
use super::voice::Voice;
use crate::base::numbers::{measured, measured_extent};
use crate::base::units::format_count;
use crate::base::watch::Watch;
use crate::core_kit::{CoreRunError, Impossible, Outcome, Prepared, prepare};
use crate::kit::{Existing, KitError};
use crate::sheet::core_kit::CoreSheet;

/// A reason why no kit was made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CoreCommandError {
    /// The arguments make no job.
    #[error(transparent)]
    Args(#[from] ArgsError),
    /// A stage failed.
    #[error(transparent)]
    Run(#[from] Box<CoreRunError>),
    /// The kit cannot be written.
    #[error(transparent)]
    Kit(#[from] KitError),
    /// The outcome cannot be put into JSON.
    #[error("the outcome cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
}

/// Prepares an object on a base and writes its kit, unless `stop` is pressed before; prints to
/// `out`.
pub fn core(
    args: CoreArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, CoreCommandError> {
    let request = args.request()?;
    let existing = if request.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&request.out)?;
    let bars = Bars::new(voice);
    let watch = Watch::observed_until(bars.observer(), stop.flag());
    let outcome = prepare(&request.job, &watch);
    bars.finish();
    if let Some(exit) = stop.end() {
        return Ok(exit);
    }
    match outcome.map_err(Box::new)? {
        Outcome::Prepared(prepared) => {
            prepared.kit.write_watched(&request.out, existing, &watch)?;
            print_prepared(&prepared, &request, voice, out)?;
            Ok(if prepared.passes() {
                Exit::Kept
            } else {
                Exit::NotKept
            })
        }
        Outcome::Impossible(impossible) => {
            print_impossible(&impossible, voice, out)?;
            Ok(Exit::NotKept)
        }
    }
}

fn print_prepared(
    prepared: &Prepared,
    request: &CoreRequest,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), CoreCommandError> {
    let sheet = &prepared.checklist;
    if voice.json {
        return Ok(writeln!(out, "{}", serde_json::to_string_pretty(sheet)?)?);
    }
    if voice.manner.quiet {
        if !prepared.passes() {
            say(broken(&sheet.checks, voice.manner).trim_end());
        }
        return Ok(());
    }
    write!(out, "{}", lines(sheet).replace('\u{a0}', " "))?;
    writeln!(out, "{}", summary(&sheet.checks, voice.manner))?;
    if voice.manner.verbose > 0 {
        write!(out, "{}", checks_table(&sheet.checks, voice.manner))?;
    } else {
        write!(out, "{}", broken(&sheet.checks, voice.manner))?;
    }
    for warning in &sheet.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    let page = request.out.join("job.html");
    writeln!(out, "the sheet is {}", page.display())?;
    Ok(())
}

/// Returns what came of it, some lines.
fn lines(sheet: &CoreSheet) -> String {
    let masses = &sheet.masses;
    let stands = sheet.toppling_deg.map_or_else(String::new, |toppling| {
        format!("stands     until leaned by {}\n", measured(toppling, "°"))
    });
    let brackets = sheet.parts.len() - sheet.part_rows.iter().filter(|row| is_shell(row)).count();
    format!(
        "size       {}, {}\n\
         base       {}, {} of the model, for {}\n\
         parts      {} and {} in {}, for {}\n\
         mass       printed {}, panels {}; solid it would be {}\n{stands}",
        measured_extent(&sheet.model.size_mm),
        measured(sheet.mass_g, "g"),
        format_count(sheet.base.panels, "panel"),
        measured(100.0 * sheet.base.volume_ratio, "%"),
        format_count(sheet.cut_sheets.len(), "sheet"),
        format_count(sheet.parts.len() - brackets, "part"),
        format_count(brackets, "bracket"),
        format_count(sheet.units.len(), "unit"),
        sheet.printer.name,
        measured(masses.shell_g, "g"),
        measured(masses.panels_g, "g"),
        measured(masses.if_solid_g, "g"),
    )
}

fn is_shell(row: &crate::sheet::core_kit::CorePartRow) -> bool {
    row.id.starts_with(|c: char| c.is_ascii_digit())
}

fn print_impossible(
    impossible: &Impossible,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), CoreCommandError> {
    if voice.json {
        let text = serde_json::to_string_pretty(impossible)?;
        return Ok(writeln!(out, "{text}")?);
    }
    let text = impossible_text(impossible);
    if voice.manner.quiet {
        say(text.trim_end());
        return Ok(());
    }
    Ok(write!(out, "{text}")?)
}

fn impossible_text(impossible: &Impossible) -> String {
    let remedies = impossible.remedies.iter();
    let remedies =
        remedies.map(|remedy| format!("  remedy: {}: {}\n", flags(&remedy.settings), remedy.words));
    let hints = impossible
        .hints
        .iter()
        .map(|hint| format!("  remedy: {hint}\n"));
    let kind = if impossible.is_proved {
        "impossible"
    } else {
        "not found"
    };
    let text = format!(
        "{kind}: {}\n{}",
        impossible.reason,
        remedies.chain(hints).collect::<String>()
    );
    with_flags(&text).replace('\u{a0}', " ")
}
