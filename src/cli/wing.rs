//! The commands of kits of their own kind: run the job, write the kit, show what came of it.

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::args::ArgsError;
use super::bars::Bars;
use super::exit::Exit;
use super::flags::{flags, with_flags};
use super::show::say;
use super::signals::Stop;
use super::summary::{broken, checks_table, summary};
use super::voice::Voice;
use crate::base::watch::Watch;
use crate::kit::{Existing, KitError};
use crate::sheet::KindSheet;
use crate::wing::{Impossible, Outcome, Prepared};

/// The order for a kit: the job, and the target of its kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Order<J> {
    /// The job, which decides the bytes of the kit.
    pub job: J,
    /// The folder to write the kit to.
    pub out: PathBuf,
    /// True if an existing folder is replaced.
    pub force: bool,
}

/// A kind of kit: the line that makes it, and the words about it.
pub trait Wing {
    /// The job.
    type Job;
    /// The checklist.
    type Sheet: KindSheet + Serialize;
    /// More that its answer tells, besides the reason.
    type More: Serialize;
    /// A reason why a run reaches no answer.
    type Error: std::error::Error;

    /// Prepares the kit.
    ///
    /// # Errors
    /// No answer was reached.
    fn prepare(
        job: &Self::Job,
        watch: &Watch,
    ) -> Result<Outcome<Self::Sheet, Self::More>, Self::Error>;

    /// Returns the job of the kit in a folder. It reads the copy of its input there.
    ///
    /// # Errors
    /// The job cannot be read.
    fn job_in(folder: &Path) -> Result<Self::Job, Self::Error>;

    /// Returns what came of it, some lines.
    fn lines(sheet: &Self::Sheet) -> String;
}

/// A reason why no kit was made. `E` is that of its line.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WingError<E: std::error::Error + 'static> {
    /// The arguments make no job.
    #[error(transparent)]
    Args(ArgsError),
    /// A stage failed.
    #[error(transparent)]
    Run(Box<E>),
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

/// The places to which a command speaks.
pub struct Ends<'a> {
    /// The manner of speaking.
    pub voice: Voice,
    /// The end that a signal asks for.
    pub stop: &'a Stop,
    /// The standard output.
    pub out: &'a mut dyn Write,
}

/// Prepares a kit and writes it, unless a signal stops it before; prints what came of it.
pub fn run<W: Wing>(
    order: Result<Order<W::Job>, ArgsError>,
    ends: Ends,
) -> Result<Exit, WingError<W::Error>> {
    let Ends { voice, stop, out } = ends;
    let order = order.map_err(WingError::Args)?;
    let existing = if order.force {
        Existing::Replace
    } else {
        Existing::Keep
    };
    existing.allows(&order.out)?;
    let bars = Bars::new(voice);
    let watch = Watch::observed_until(bars.observer(), stop.flag());
    let outcome = W::prepare(&order.job, &watch);
    bars.finish();
    if let Some(exit) = stop.end() {
        return Ok(exit);
    }
    match outcome.map_err(|error| WingError::Run(Box::new(error)))? {
        Outcome::Prepared(prepared) => {
            prepared.kit.write_watched(&order.out, existing, &watch)?;
            print_prepared::<W>(&prepared, &order, voice, out)?;
            Ok(if prepared.passes() {
                Exit::Kept
            } else {
                Exit::NotKept
            })
        }
        Outcome::Impossible(impossible) => {
            print_impossible::<W>(&impossible, voice, out)?;
            Ok(Exit::NotKept)
        }
    }
}

fn print_prepared<W: Wing>(
    prepared: &Prepared<W::Sheet>,
    order: &Order<W::Job>,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), WingError<W::Error>> {
    let sheet = &prepared.checklist;
    if voice.json {
        return Ok(writeln!(out, "{}", serde_json::to_string_pretty(sheet)?)?);
    }
    if voice.manner.quiet {
        if !prepared.passes() {
            say(broken(sheet.checks(), voice.manner).trim_end());
        }
        return Ok(());
    }
    write!(out, "{}", W::lines(sheet).replace('\u{a0}', " "))?;
    writeln!(out, "{}", summary(sheet.checks(), voice.manner))?;
    if voice.manner.verbose > 0 {
        write!(out, "{}", checks_table(sheet.checks(), voice.manner))?;
    } else {
        write!(out, "{}", broken(sheet.checks(), voice.manner))?;
    }
    for warning in sheet.warnings() {
        writeln!(out, "warning: {warning}")?;
    }
    let page = order.out.join("job.html");
    writeln!(out, "the sheet is {}", page.display())?;
    Ok(())
}

fn print_impossible<W: Wing>(
    impossible: &Impossible<W::More>,
    voice: Voice,
    out: &mut dyn Write,
) -> Result<(), WingError<W::Error>> {
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

/// Returns the answer that there is no such kit, in lines.
fn impossible_text<M>(impossible: &Impossible<M>) -> String {
    let remedies = impossible.remedies.iter();
    let remedies =
        remedies.map(|remedy| format!("  remedy: {}: {}\n", flags(&remedy.settings), remedy.words));
    let hints = impossible.hints.iter();
    let hints = hints.map(|hint| format!("  remedy: {hint}\n"));
    let tried = impossible.tried.join("; ");
    let tried = if tried.is_empty() {
        String::new()
    } else {
        format!("  also tried, without success: {tried}\n")
    };
    let kind = if impossible.is_proved {
        "impossible"
    } else {
        "not found"
    };
    let helps: String = remedies.chain(hints).collect();
    let text = format!("{kind}: {}\n{helps}{tried}", impossible.reason);
    with_flags(&text).replace('\u{a0}', " ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::setting::{Key, Setting};
    use crate::wing::{NoMore, Remedy};

    #[test]
    fn an_answer_names_its_reason_then_remedies_with_flags_then_what_was_tried_in_vain() {
        let mut answer: Impossible<NoMore> = Impossible::new("it falls".to_owned());
        answer.remedies.push(Remedy {
            settings: vec![Setting::new(Key::Size, "700mm")],
            words: "it stands".to_owned(),
        });
        answer.hints.push("turn it over".to_owned());
        answer.tried.push("a thicker wall".to_owned());
        let text = impossible_text(&answer);
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines,
            [
                "not found: it falls",
                "  remedy: --size=700mm: it stands",
                "  remedy: turn it over",
                "  also tried, without success: a thicker wall",
            ]
        );
        answer.is_proved = true;
        assert!(impossible_text(&answer).starts_with("impossible: it falls"));
    }

    #[test]
    fn an_answer_in_json_has_the_same_keys_for_every_kind() {
        let answer: Impossible<NoMore> = Impossible::new("it falls".to_owned());
        let json = serde_json::to_value(&answer).unwrap();
        let keys: Vec<&String> = json.as_object().unwrap().keys().collect();
        for key in [
            "verdict",
            "is_proved",
            "reason",
            "remedies",
            "hints",
            "tried",
        ] {
            assert!(keys.iter().any(|known| *known == key), "{key}");
        }
    }
}
