//! `equipoise prepare`: run the job, write the kit, show the table.

use std::io::Write;

use super::Exit;
use super::args::{ArgsError, PrepareArgs, Request};
use super::show::{Bars, Manner, table, verdict};
use crate::advice::Remedy;
use crate::error::Error;
use crate::pipeline::{Impossible, Outcome, Prepared, run};
use crate::progress::Progress;
use crate::report::{Checklist, Existing};
use crate::units::counted;
use crate::verify::Check;

/// Why `prepare` could not run.
#[derive(Debug, thiserror::Error)]
pub enum PrepareError {
    /// The arguments do not go together.
    #[error(transparent)]
    Args(#[from] ArgsError),
    /// A stage failed.
    #[error(transparent)]
    Run(#[from] Error),
    /// Standard output is closed.
    #[error("cannot write to the standard output")]
    Output(#[from] std::io::Error),
    /// The outcome cannot be put into JSON.
    #[error("the outcome cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// What is said on the standard output.
#[derive(Debug, Clone, Copy)]
pub struct Voice {
    /// How the terminal is used.
    pub manner: Manner,
    /// Whether to print JSON in place of text.
    pub json: bool,
}

/// Prepares the kit and writes it; says what came of it on `out`.
pub fn prepare(args: PrepareArgs, voice: Voice, out: &mut dyn Write) -> Result<Exit, PrepareError> {
    let request = args.request()?;
    let existing = if request.force { Existing::Replace } else { Existing::Keep };
    existing.allows(&request.out).map_err(Error::from)?;
    let bars = Bars::new(voice.manner);
    let observer = bars.observer();
    let outcome = run(&request.job, &Progress::observed(&observer));
    bars.finish();
    match outcome? {
        Outcome::Prepared(prepared) => {
            prepared.kit.write(&request.out, existing).map_err(Error::from)?;
            tell_prepared(&prepared, &request, voice, out)?;
            Ok(if prepared.passes() { Exit::Kept } else { Exit::NotKept })
        }
        Outcome::Impossible(impossible) => {
            tell_impossible(&impossible, voice, out)?;
            Ok(Exit::NotKept)
        }
    }
}

fn tell_prepared(
    prepared: &Prepared,
    request: &Request,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), PrepareError> {
    let checklist = &prepared.checklist;
    if voice.json {
        return Ok(writeln!(out, "{}", serde_json::to_string_pretty(checklist)?)?);
    }
    if voice.manner.quiet {
        return Ok(());
    }
    if let Some(choice) = &checklist.goal.choice {
        writeln!(out, "{choice}")?;
    }
    write!(out, "{}", checks_table(&checklist.checks, voice.manner))?;
    for warning in &checklist.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    if voice.manner.verbose > 0 {
        write!(out, "{}", details(checklist))?;
    }
    write!(out, "{}", last_lines(checklist, request))?;
    Ok(())
}

/// Promise, measured, limit, verdict: one line each.
pub fn checks_table(checks: &[Check], manner: Manner) -> String {
    let head = ["promise", "measured", "limit", "verdict"].map(str::to_owned);
    let row = |check: &Check| {
        let measured = check.value.map_or("none".to_owned(), |value| quantity(value, &check.unit));
        [
            check.promise.clone(),
            measured,
            format!("{} {}", check.comparison.sign(), quantity(check.limit, &check.unit)),
            verdict(check.pass, manner.is_coloured)
                + &check
                    .detail
                    .as_ref()
                    .filter(|_| !check.pass)
                    .map_or(String::new(), |at| format!(" ({at})")),
        ]
    };
    let rows: Vec<[String; 4]> = std::iter::once(head).chain(checks.iter().map(row)).collect();
    table(&rows)
}

/// Four significant digits, or as many as an integer has.
fn quantity(value: f64, unit: &str) -> String {
    let number = match value.abs() {
        magnitude if magnitude == 0.0 || (value.fract() == 0.0 && magnitude < 1e6) => format!("{value}"),
        magnitude if magnitude >= 100.0 => format!("{value:.1}"),
        magnitude if magnitude >= 0.01 => format!("{value:.4}"),
        _ => format!("{value:.2e}"),
    };
    match unit {
        "" | "°" => number + unit,
        _ => format!("{number} {unit}"),
    }
}

/// Certificate, timings and the solver's rows.
fn details(checklist: &Checklist) -> String {
    let certificate = &checklist.certificate;
    let mut text = format!(
        "certificate: value {:.6}, bound {:.6}, gap {:.1e}\n",
        certificate.value, certificate.bound, certificate.gap_ratio
    );
    for (stage, seconds) in checklist.timing_s.iter().flat_map(|timing| &timing.0) {
        text += &format!("{stage}: {seconds:.3} s\n");
    }
    for note in &checklist.notes {
        text += &format!("note: {note}\n");
    }
    for row in &checklist.log {
        let figures: Vec<String> =
            row.figures.iter().map(|(name, value)| format!("{name} {value:.6e}")).collect();
        text += &format!("  {}: {}\n", row.phase, figures.join(", "));
    }
    text
}

/// What was written where, how long it took, and what to do next.
fn last_lines(checklist: &Checklist, request: &Request) -> String {
    let seconds = checklist.timing_s.as_ref().map_or(0.0, |timing| timing.total_s());
    let counts = [
        counted(checklist.parts.len(), "part"),
        counted(checklist.cuts.len(), "cut"),
        counted(checklist.voids.len(), "void"),
    ];
    let sheet = request.out.join("checklist.html");
    format!(
        "{} ({seconds:.1} s)\n{}; the job sheet is {}\n",
        counts.join(", "),
        summary(&checklist.checks),
        sheet.display()
    )
}

/// Whether every promise is kept, in words.
pub fn summary(checks: &[Check]) -> String {
    match checks.iter().filter(|check| !check.pass).count() {
        0 => "all promises kept".to_owned(),
        broken => format!("{} BROKEN", counted(broken, "promise")),
    }
}

fn tell_impossible(impossible: &Impossible, voice: Voice, out: &mut dyn Write) -> Result<(), PrepareError> {
    if voice.json {
        return Ok(writeln!(out, "{}", serde_json::to_string_pretty(impossible)?)?);
    }
    writeln!(out, "{}", impossible.reason)?;
    if !voice.manner.quiet {
        write!(out, "{}", advice(impossible))?;
    }
    if voice.manner.verbose > 0 {
        writeln!(out, "  proof: the quadric {:?} (goal frame, mm)", impossible.proof_quadric)?;
    }
    Ok(())
}

/// What was chosen and warned of, what helps, with what to type, and what does not.
fn advice(impossible: &Impossible) -> String {
    let choice = impossible.choice.iter().map(|choice| format!("{choice}\n"));
    let warnings = impossible.warnings.iter().map(|warning| format!("warning: {warning}\n"));
    let (helpful, useless): (Vec<&Remedy>, Vec<&Remedy>) =
        impossible.remedies.iter().partition(|remedy| remedy.helps());
    let typed = |remedy: &Remedy| {
        if remedy.flags.is_empty() { String::new() } else { format!("{}: ", remedy.flags) }
    };
    let helpful = helpful.into_iter().map(|remedy| format!("  remedy: {}{}\n", typed(remedy), remedy.words));
    let hints = impossible.hints.iter().map(|hint| format!("  perhaps: {hint}\n"));
    let useless = useless.into_iter().map(|remedy| format!("  no remedy: {}\n", remedy.words));
    choice.chain(warnings).chain(helpful).chain(hints).chain(useless).collect()
}
