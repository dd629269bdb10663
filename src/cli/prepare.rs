//! `equipoise prepare`: run the job, write the kit, show the table.

use std::io::Write;

use super::args::{ArgsError, PrepareArgs, Request};
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{flags, with_flags};
use super::print_time::print_time;
use super::questions::{AskError, Unanswered, ask};
use super::show::say;
use super::signals::Stop;
use super::summary::{broken, details, ten_lines};
use super::tets_file::{TetsFileError, check_graded, write_graded, written_text};
use super::usual::size_hint;
use super::values::show_box;
use super::voice::Voice;
use super::wrap::wrapped;
use crate::advice::Remedy;
use crate::base::numbers::measured;
use crate::base::units::{Length, show_mm};
use crate::base::watch::Watch;
use crate::error::{Error, GradedError};
use crate::goal::GoalKind;
use crate::io::read_model;
use crate::job::{Interior, Job, Scaling};
use crate::kit::Existing;
use crate::prepare::{self, Failure, Impossible, Outcome, Prepared};
use crate::printer::Printer;

/// A reason why `prepare` could not run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The arguments make no job.
    #[error(transparent)]
    Args(#[from] ArgsError),
    /// The questions made no order.
    #[error(transparent)]
    Ask(#[from] AskError),
    /// A stage failed.
    #[error(transparent)]
    Run(#[from] Error),
    /// The volume mesh cannot be written.
    #[error(transparent)]
    Tets(#[from] TetsFileError),
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
    let request = match complete(args, voice) {
        Err(PrepareError::Ask(AskError::Unanswered(Unanswered::Stopped))) => {
            return Ok(stop.interrupt());
        }
        args => args?.request()?,
    };
    if let Some(path) = &request.tets.tets {
        check_graded(path, &request.job, request.force)?;
    }
    if !voice.manner.quiet && !voice.json {
        beyond_plate(&request.job).iter().for_each(|note| say(note));
    }
    let bars = Bars::new(voice);
    let watch = Watch::observed_until(bars.observer(), stop.flag());
    let outcome = run(&request, &watch);
    bars.finish();
    // A kit that was written before the stop button was pressed stays, and so does its answer.
    let is_written = matches!(&outcome, Ok(ran) if matches!(ran.outcome, Outcome::Prepared(_)));
    if !is_written && let Some(exit) = stop.end() {
        return Ok(exit);
    }
    if outcome.is_err() {
        unit_hint(&request.job).iter().for_each(|hint| say(hint));
    }
    let Ran { outcome, rounds } = outcome?;
    if !voice.manner.quiet {
        rounds.iter().for_each(|rounds| say(&rounds.words()));
    }
    match outcome {
        Outcome::Prepared(prepared) => {
            let ending = Ending {
                request: &request,
                voice,
                stop,
            };
            ending.print(&prepared, out)?;
            let written = write_graded(&request.tets, &request.job, &prepared)?;
            let shown = written.filter(|_| !voice.manner.quiet);
            shown.iter().for_each(|it| say(written_text(it).trim_end()));
            let is_broken = rounds.is_some_and(|rounds| !rounds.broken.is_empty());
            Ok(if prepared.passes() && !is_broken {
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

/// Asks for the arguments that are missing, if a person can be asked.
fn complete(args: PrepareArgs, voice: Voice) -> Result<PrepareArgs, PrepareError> {
    let may_ask = voice.manner.may_ask && !voice.manner.quiet && !voice.json && !args.no_questions;
    match args.missing()? {
        Some(missing) if may_ask => Ok(ask(args, missing.printer)?),
        _ => Ok(args),
    }
}

/// Runs the job, and writes its kit if it has one.
///
/// What the arguments alone decide is checked before the folder, and that before the model is read.
fn run(request: &Request, watch: &Watch) -> Result<Ran, Error> {
    check_arguments(&request.job)?;
    refuse_unsliced(request)?;
    let existing = if request.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&request.out)?;
    let ran = if request.slice {
        let sliced =
            prepare::prepare_sliced(&request.job, request.slicer_profile.as_deref(), watch)?;
        let rounds = Rounds {
            misses_mm: sliced.misses_mm,
            infill_ratio: sliced.infill_ratio,
            broken: sliced.broken,
        };
        Ran {
            outcome: sliced.outcome,
            rounds: Some(rounds).filter(|rounds| !rounds.misses_mm.is_empty()),
        }
    } else {
        Ran {
            outcome: prepare::prepare(&request.job, watch)?,
            rounds: None,
        }
    };
    if let Outcome::Prepared(prepared) = &ran.outcome {
        let kit = &prepared.kit;
        kit.write_watched(&request.out, existing, watch)?;
    }
    Ok(ran)
}

/// The end of a run.
struct Ran {
    outcome: Outcome,
    /// The rounds in which its kits were sliced, if they were.
    rounds: Option<Rounds>,
}

/// The rounds of a run whose kits were sliced.
struct Rounds {
    /// The distance between the centre of the toolpaths and the promised one in every round, mm.
    misses_mm: Vec<f64>,
    /// The infill that the slicer lays, over what the printer's profile says; `None` for as much.
    infill_ratio: Option<f64>,
    /// The promises that the toolpaths of the best kit break.
    broken: Vec<String>,
}

impl Rounds {
    /// Words how far the toolpaths were off, and what they break.
    fn words(&self) -> String {
        let misses = self.misses_mm.iter().map(|miss_mm| format!("{miss_mm:.4}"));
        let misses = misses.collect::<Vec<String>>().join(", ");
        let mut sliced = format!(
            "sliced {} times: the centre of mass was {misses} mm from the promised one",
            self.misses_mm.len()
        );
        if let Some(ratio) = self.infill_ratio {
            let infill = measured(100.0 * ratio, "%");
            sliced += &format!(
                "\nthe slicer lays {infill} of the infill that the printer's profile says; the kit \
                 counts with it"
            );
        }
        if self.broken.is_empty() {
            return sliced;
        }
        let broken = self.broken.join(", ");
        format!("{sliced}\nwarning: the toolpaths of this kit break {broken}: do not print it")
    }
}

/// Refuses a print that floats if nothing tells what it weighs.
fn refuse_unsliced(request: &Request) -> Result<(), GradedError> {
    let job = &request.job;
    let is_unsliced = !request.slice && job.sliced.is_empty();
    let floats = job.goal.kind == GoalKind::Float && job.interior == Interior::Graded;
    // A wished infill is refused for what floats, sliced or not, and that is said later.
    if floats && is_unsliced && job.infill.is_none() {
        return Err(GradedError::FloatUnsliced);
    }
    Ok(())
}

/// Checks what the arguments alone decide: the printer, its material, the size and the wall.
fn check_arguments(job: &Job) -> Result<(), Error> {
    let printer = Printer::find(&job.printer.id)?;
    printer.material(job.printer.material.as_deref())?;
    if let Scaling::Size(size) = job.model.scaling {
        printer.check_length(size.mm())?;
        printer.quantise_wall(job.wall.map(Length::mm), size.mm())?;
    }
    Ok(())
}

/// Returns a remark if the model is longer than the printer's build volume; `None` if it is not, or
/// if that cannot be known.
fn beyond_plate(job: &Job) -> Option<String> {
    let volume_mm = Printer::find(&job.printer.id).ok()?.build_volume_mm?.value;
    let longest_mm = volume_mm.into_iter().fold(0.0, f64::max);
    let size_mm = match job.model.scaling {
        Scaling::Size(size) => size.mm(),
        scaling => {
            let drawn_mm = read_model(job.model_file()).ok()?.longest_side_mm();
            scaling.factor(drawn_mm) * drawn_mm
        }
    };
    (size_mm > longest_mm).then(|| {
        format!(
            "note: {} is longer than the printer ({}); its parts are cut to fit, or refused",
            show_mm(size_mm),
            show_box(volume_mm)
        )
    })
}

/// Returns a warning if the model has a size that nobody prints, as `inspect` does; `None` if its
/// size is plausible.
fn unit_hint(job: &Job) -> Option<String> {
    let mesh = read_model(job.model_file()).ok()?;
    let longest = mesh.longest_side_mm();
    let hint = size_hint(job.model.scaling.factor(longest) * longest)?;
    Some(format!("warning: {}", with_flags(&hint)))
}

/// The end of a run whose kit is written.
struct Ending<'a> {
    request: &'a Request,
    voice: Voice,
    stop: &'a Stop,
}

impl Ending<'_> {
    /// Prints the result: a few lines, all of it, or JSON.
    fn print(&self, prepared: &Prepared, out: &mut dyn Write) -> Result<(), PrepareError> {
        let checklist = &prepared.checklist;
        if self.voice.json {
            let text = serde_json::to_string_pretty(checklist)?;
            return Ok(writeln!(out, "{text}")?);
        }
        if self.voice.manner.quiet {
            if let Some(failure) = &prepared.failure {
                let broken = broken(&checklist.checks, self.voice.manner);
                say(&format!("{broken}{}", failure_text(failure))
                    .trim_end()
                    .replace('\u{a0}', " "));
            }
            return Ok(());
        }
        self.print_lines(prepared, out)
    }

    fn print_lines(&self, prepared: &Prepared, out: &mut dyn Write) -> Result<(), PrepareError> {
        let (checklist, manner) = (&prepared.checklist, self.voice.manner);
        let fitted = |text: &str| wrapped(text, manner.output_columns);
        if let Some(choice) = &checklist.goal.choice {
            let choice = format!("{}\n", with_flags(choice));
            write!(out, "{}", fitted(&choice))?;
        }
        let lines = ten_lines(checklist, self.request, manner);
        write!(out, "{}", fitted(&lines))?;
        // The slicer takes its time: what is known is shown before.
        out.flush()?;
        if let Some(line) = print_time(prepared, self.request, self.voice, self.stop) {
            write!(out, "{}", fitted(&line))?;
        }
        if let Some(failure) = &prepared.failure {
            let failure = failure_text(failure).replace('\u{a0}', " ");
            write!(out, "{}", fitted(&failure))?;
        }
        for warning in &checklist.warnings {
            let warning = format!("warning: {}\n", with_flags(warning));
            write!(out, "{}", fitted(&warning))?;
        }
        if manner.verbose > 0 {
            write!(out, "{}", details(checklist, manner))?;
        }
        Ok(())
    }
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
    let said = format!("{}\n{}", impossible.reason, advice(impossible));
    write!(out, "{}", wrapped(&said, voice.manner.output_columns))?;
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

/// Returns the remedies that help, with what to type, then hints, then what was tried in vain.
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
    let tried: Vec<&str> = useless.iter().map(|remedy| remedy.words.as_str()).collect();
    let tried = if tried.is_empty() {
        String::new()
    } else {
        format!("  also tried, without success: {}\n", tried.join("; "))
    };
    helpful.chain(hints).chain([tried]).collect()
}
