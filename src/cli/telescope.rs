//! `equipoise telescope`: run the job, write the kit, show what came of it.

use std::io::Write;

use super::args::{ArgsError, TelescopeArgs, TelescopeRequest};
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{flags, with_flags};
use super::show::say;
use super::signals::Stop;
use super::summary::{broken, checks_table, summary};
use super::voice::Voice;
use crate::base::numbers::{measured, measured_extent};
use crate::base::watch::Watch;
use crate::kit::{Existing, KitError};
use crate::sheet::telescope::TelescopeSheet;
use crate::telescope::{Impossible, Outcome, Prepared, TelescopeRunError, prepare};

/// A reason why no telescope was made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TelescopeCommandError {
    /// The arguments make no job.
    #[error(transparent)]
    Args(#[from] ArgsError),
    /// A stage failed.
    #[error(transparent)]
    Run(#[from] TelescopeRunError),
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

/// Prepares a telescope and writes its kit, unless `stop` is pressed before; prints to `out`.
pub fn telescope(
    args: TelescopeArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, TelescopeCommandError> {
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
    match outcome? {
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
    request: &TelescopeRequest,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), TelescopeCommandError> {
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
    writeln!(
        out,
        "the sheet is {}",
        request.out.join("job.html").display()
    )?;
    Ok(())
}

/// Returns what came of it, some lines.
fn lines(sheet: &TelescopeSheet) -> String {
    let stands = sheet.least_angle_deg.map_or_else(String::new, |_| {
        let foot = sheet.foot.as_ref().map_or(0.0, |foot| foot.radius_mm);
        format!(
            "stands     on a foot of {} in radius, until leaned by {}\n",
            measured(foot, "mm"),
            measured(sheet.worst_toppling_deg, "°")
        )
    });
    format!(
        "shells     {}, {} in all, for {}\n\
         all in     {}\n\
         all out    {}, {} along the curve\n\
         deviation  {} at most, {} rms\n\
         opens      {}, proved free of collisions\n{stands}\
         tip        plays by {}\n",
        sheet.shells.len(),
        measured(sheet.mass_g, "g"),
        sheet.printer.name,
        measured_extent(&sheet.collapsed_mm),
        measured_extent(&sheet.extended_mm),
        measured(sheet.curve.length_mm, "mm"),
        measured(sheet.deviation.max_mm, "mm"),
        measured(sheet.deviation.rms_mm, "mm"),
        sheet.order_words,
        measured(sheet.tip_play_mm, "mm"),
    )
}

fn print_impossible(
    impossible: &Impossible,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), TelescopeCommandError> {
    if voice.json {
        return Ok(writeln!(
            out,
            "{}",
            serde_json::to_string_pretty(impossible)?
        )?);
    }
    let text = impossible_text(impossible);
    if voice.manner.quiet {
        say(text.trim_end());
        return Ok(());
    }
    Ok(write!(out, "{text}")?)
}

fn impossible_text(impossible: &Impossible) -> String {
    let kind = if impossible.is_proved {
        "impossible"
    } else {
        "not found"
    };
    let remedies = impossible.remedies.iter();
    let remedies =
        remedies.map(|remedy| format!("  remedy: {}: {}\n", flags(&remedy.settings), remedy.words));
    let tried = impossible.tried.join("; ");
    let tried = if tried.is_empty() {
        String::new()
    } else {
        format!("  also tried, without success: {tried}\n")
    };
    let text = format!(
        "{kind}: {}\n{}{tried}",
        impossible.reason,
        remedies.collect::<String>()
    );
    with_flags(&text)
}
