//! `equipoise prepare`: run the job, write the kit, show the table.

use std::io::Write;

use super::args::{ArgsError, PrepareArgs, Request};
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{flags, with_flags};
use super::show::say;
use super::signals::Stop;
use super::summary::{broken, details, ten_lines};
use super::voice::Voice;
use crate::advice::Remedy;
use crate::base::watch::Watch;
use crate::error::Error;
use crate::kit::Existing;
use crate::prepare::{self, Failure, Impossible, Outcome, Prepared};

/// A reason why `prepare` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The arguments make no job.
    #[error(transparent)]
    Args(#[from] ArgsError),
    /// A stage failed.
    #[error(transparent)]
    Run(#[from] Error),
    /// The standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The outcome cannot be put into JSON.
    #[error("the outcome cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Prepares the kit and writes it, unless `stop` is pressed before; prints the result to `out`.
pub fn prepare(
    args: PrepareArgs,
    voice: Voice,
    stop: &Stop,
    out: &mut dyn Write,
) -> Result<Exit, PrepareError> {
    let request = args.request()?;
    let bars = Bars::new(voice.manner);
    let watch = Watch::observed_until(bars.observer(), stop.flag());
    let outcome = run(&request, &watch);
    bars.finish();
    // A kit that was written before the stop button was pressed stays, and so does its answer.
    let is_written = matches!(outcome, Ok(Outcome::Prepared(_)));
    if !is_written && let Some(exit) = stop.end() {
        return Ok(exit);
    }
    match outcome? {
        Outcome::Prepared(prepared) => {
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

/// Runs the job, and writes its kit if it has one.
fn run(request: &Request, watch: &Watch) -> Result<Outcome, Error> {
    let existing = if request.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&request.out)?;
    let outcome = prepare::prepare(&request.job, watch)?;
    if let Outcome::Prepared(prepared) = &outcome {
        let kit = &prepared.kit;
        kit.write_watched(&request.out, existing, watch)?;
    }
    Ok(outcome)
}

fn print_prepared(
    prepared: &Prepared,
    request: &Request,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), PrepareError> {
    let checklist = &prepared.checklist;
    if voice.json {
        return Ok(writeln!(
            out,
            "{}",
            serde_json::to_string_pretty(checklist)?
        )?);
    }
    if voice.manner.quiet {
        if let Some(failure) = &prepared.failure {
            let broken = broken(&checklist.checks, voice.manner);
            say(&format!("{broken}{}", failure_text(failure))
                .trim_end()
                .replace('\u{a0}', " "));
        }
        return Ok(());
    }
    if let Some(choice) = &checklist.goal.choice {
        writeln!(out, "{}", with_flags(choice))?;
    }
    write!(out, "{}", ten_lines(checklist, &request.out, voice.manner))?;
    if let Some(failure) = &prepared.failure {
        write!(out, "{}", failure_text(failure).replace('\u{a0}', " "))?;
    }
    for warning in &checklist.warnings {
        writeln!(out, "warning: {}", with_flags(warning))?;
    }
    if voice.manner.verbose > 0 {
        write!(out, "{}", details(checklist, voice.manner))?;
    }
    Ok(())
}

/// Prints why a goal cannot be met, and what helps.
pub(super) fn print_impossible(
    impossible: &Impossible,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), PrepareError> {
    if voice.json {
        return Ok(writeln!(
            out,
            "{}",
            serde_json::to_string_pretty(impossible)?
        )?);
    }
    if voice.manner.quiet {
        // A goal that cannot be met is reported even then.
        say(format!("{}\n{}", impossible.reason, advice(impossible)).trim_end());
        return Ok(());
    }
    writeln!(out, "{}", impossible.reason)?;
    write!(out, "{}", advice(impossible))?;
    if voice.manner.verbose > 0 {
        writeln!(
            out,
            "  proof: the quadric {:?} (goal frame, mm)",
            impossible.proof_quadric
        )?;
    }
    Ok(())
}

/// Returns the choice, the warnings and the remedies, with flags for their settings.
fn advice(impossible: &Impossible) -> String {
    let choice = impossible.choice.iter().map(|choice| format!("{choice}\n"));
    let warnings = impossible
        .warnings
        .iter()
        .map(|warning| format!("warning: {warning}\n"));
    let remedies = remedies_text(&impossible.remedies, &impossible.hints);
    let text: String = choice.chain(warnings).chain([remedies]).collect();
    with_flags(&text)
}

/// Returns the reason why a kit fails, and the remedies, with flags for their settings.
fn failure_text(failure: &Failure) -> String {
    let remedies = remedies_text(&failure.remedies, &failure.hints);
    with_flags(&format!("{}\n{remedies}", failure.reason))
}

/// Returns the remedies that help, with what to type, then hints, then remedies that do not help.
fn remedies_text(remedies: &[Remedy], hints: &[String]) -> String {
    let (helpful, useless): (Vec<&Remedy>, Vec<&Remedy>) =
        remedies.iter().partition(|remedy| remedy.helps());
    let typed = |remedy: &Remedy| {
        if remedy.settings.is_empty() {
            String::new()
        } else {
            format!("{}: ", flags(&remedy.settings))
        }
    };
    let helpful = helpful
        .into_iter()
        .map(|remedy| format!("  remedy: {}{}\n", typed(remedy), remedy.words));
    let hints = hints.iter().map(|hint| format!("  perhaps: {hint}\n"));
    let useless = useless
        .into_iter()
        .map(|remedy| format!("  no remedy: {}\n", remedy.words));
    helpful.chain(hints).chain(useless).collect()
}
