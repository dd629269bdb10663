//! What a person sees on a terminal: progress, tables, errors with their remedies.

use std::{
    error::Error,
    io::{IsTerminal, Write},
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// How much is said, and whether in colour; decided once, at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Manner {
    /// Whether anything but errors is said.
    pub quiet: bool,
    /// 0: the result; 1: also each phase and its time; 2: everything.
    pub verbose: u8,
    /// Whether the standard error is a terminal.
    pub is_terminal: bool,
    /// Whether colours may be used.
    pub is_coloured: bool,
}

impl Manner {
    /// The manner for this process: bars on a terminal only; no colours where `NO_COLOR` is set to anything
    /// (no-color.org), where the terminal is dumb, or where there is none.
    pub fn of_process(quiet: bool, verbose: u8) -> Self {
        let is_set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty());
        let is_dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb");
        let is_terminal = std::io::stderr().is_terminal();
        let is_coloured = is_terminal && !is_set("NO_COLOR") && !is_dumb;
        Self { quiet, verbose, is_terminal, is_coloured }
    }

    fn shows_bars(self) -> bool {
        self.is_terminal && !self.quiet
    }

    fn lists_phases(self) -> bool {
        self.verbose > 0 && !self.quiet
    }
}

/// Steps of a bar; finer than any terminal is wide.
const BAR_STEPS: u64 = 1000;

/// How often a bar is drawn anew while nothing is reported. Slower looks stuck, faster costs time.
const TICK: Duration = Duration::from_millis(120);

/// The progress of a run: a bar on a terminal, or a line for each phase, or nothing.
///
/// ```
/// # use equipoise::{cli::show::{Bars, Manner}, progress::Progress};
/// let bars = Bars::new(Manner::of_process(true, 0));
/// let observer = bars.observer();
/// let progress = Progress::observed(&observer);
/// progress.report("solve", 0.5);
/// bars.finish();
/// ```
#[derive(Debug, Clone)]
pub struct Bars {
    manner: Manner,
    current: Arc<Mutex<Option<Phase>>>,
}

#[derive(Debug)]
struct Phase {
    name: String,
    since: Instant,
    bar: ProgressBar,
}

impl Bars {
    /// Nothing drawn yet.
    pub fn new(manner: Manner) -> Self {
        Self { manner, current: Arc::new(Mutex::new(None)) }
    }

    /// What a [`Progress`](crate::progress::Progress) is to call: it advances these bars.
    pub fn observer(&self) -> impl Fn(&str, f64) + Sync + 'static {
        let bars = self.clone();
        move |phase, done_ratio| bars.advance(phase, done_ratio)
    }

    /// Shows that the named phase is done so far, 0 to 1; a new name ends the phase before it.
    pub fn advance(&self, phase: &str, done_ratio: f64) {
        if !self.manner.shows_bars() && !self.manner.lists_phases() {
            return;
        }
        let mut current = self.current.lock().unwrap_or_else(PoisonError::into_inner);
        if current.as_ref().is_none_or(|shown| shown.name != phase) {
            self.end(current.take());
            *current = Some(Phase { name: phase.to_owned(), since: Instant::now(), bar: self.bar(phase) });
        }
        if let Some(shown) = &*current {
            shown.bar.set_position((done_ratio.clamp(0.0, 1.0) * BAR_STEPS as f64) as u64);
        }
    }

    /// Ends the last phase and clears its bar.
    pub fn finish(&self) {
        self.end(self.current.lock().unwrap_or_else(PoisonError::into_inner).take());
    }

    fn end(&self, phase: Option<Phase>) {
        let Some(Phase { name, since, bar }) = phase else {
            return;
        };
        bar.finish_and_clear();
        if self.manner.lists_phases() {
            say(&format!("{name}: {:.2} s", since.elapsed().as_secs_f64()));
        }
    }

    fn bar(&self, phase: &str) -> ProgressBar {
        if !self.manner.shows_bars() {
            return ProgressBar::hidden();
        }
        let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
        let template = if self.manner.is_coloured {
            "{msg:>16} {bar:40.green} {elapsed}"
        } else {
            "{msg:>16} {bar:40} {elapsed}"
        };
        bar.set_style(
            ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()),
        );
        bar.set_message(phase.to_owned());
        bar.enable_steady_tick(TICK);
        bar
    }
}

/// Writes a line to the standard error; a closed one is not a reason to stop.
fn say(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Prints the error with its causes and remedies on the standard error.
pub fn print_error(error: &(dyn Error + 'static), manner: Manner) {
    say(&error_text(error, manner.is_coloured));
}

/// What begins the remedy in an error's message.
const REMEDY_MARK: &str = "; remedy: ";

/// The error, each of its causes and each remedy, a line each:
///
/// ```text
/// error: cannot read the job j.toml
///   caused by: No such file or directory
///   remedy: check the path
/// ```
///
/// A remedy is what follows "; remedy: " in a message; in a message of several lines each keeps its own. A cause whose words
/// its parent already said is left out.
pub fn error_text(error: &(dyn Error + 'static), is_coloured: bool) -> String {
    let (mut lines, mut remedies, mut said) = (Vec::new(), Vec::new(), String::new());
    for cause in chain(error) {
        let message = cause.to_string();
        if said.contains(&message) {
            continue;
        }
        let label = if said.is_empty() { paint("error", RED, is_coloured) } else { "  caused by".to_owned() };
        let is_list = message.contains('\n');
        for line in message.lines() {
            let split = if is_list { None } else { line.split_once(REMEDY_MARK) };
            let (statement, remedy) =
                split.map_or((line, None), |(statement, remedy)| (statement, Some(remedy)));
            lines.push(format!("{label}: {statement}"));
            remedies
                .extend(remedy.map(|remedy| format!("  {}: {remedy}", paint("remedy", GREEN, is_coloured))));
        }
        said.push_str(&message);
    }
    lines.append(&mut remedies);
    lines.join("\n")
}

/// The error and its causes, the outermost first.
fn chain<'a>(error: &'a (dyn Error + 'static)) -> impl Iterator<Item = &'a (dyn Error + 'static)> {
    std::iter::successors(Some(error), |cause| (*cause).source())
}

/// Terminal escape for bold red.
const RED: &str = "\x1b[1;31m";
/// Terminal escape for green.
const GREEN: &str = "\x1b[32m";
/// Terminal escape that ends a colour.
const PLAIN: &str = "\x1b[0m";

/// The text in a colour, if colours may be used.
fn paint(text: &str, colour: &str, is_coloured: bool) -> String {
    if is_coloured { format!("{colour}{text}{PLAIN}") } else { text.to_owned() }
}

/// "pass" in green or "FAIL" in red, for a table of promises.
pub fn verdict(passes: bool, is_coloured: bool) -> String {
    if passes { paint("pass", GREEN, is_coloured) } else { paint("FAIL", RED, is_coloured) }
}

/// Blanks between the columns of a table.
const COLUMN_GAP: usize = 2;

/// The rows with their columns under each other, a line each, no blanks at the ends. Escapes of colours take no room.
pub fn table<const COLUMNS: usize>(rows: &[[String; COLUMNS]]) -> String {
    let widths: [usize; COLUMNS] =
        std::array::from_fn(|column| rows.iter().map(|row| width(&row[column])).max().unwrap_or(0));
    rows.iter().map(|row| table_line(row, &widths) + "\n").collect()
}

fn table_line(row: &[String], widths: &[usize]) -> String {
    let cells = row.iter().zip(widths);
    let padded =
        cells.map(|(cell, &column)| format!("{cell}{}", " ".repeat(column + COLUMN_GAP - width(cell))));
    padded.collect::<String>().trim_end().to_owned()
}

/// How many characters of the text a terminal shows.
fn width(text: &str) -> usize {
    let plain = [RED, GREEN, PLAIN].iter().fold(text.to_owned(), |text, escape| text.replace(escape, ""));
    plain.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{job::JobError, printer::Printer, progress::Progress};

    const SILENT: Manner = Manner { quiet: true, verbose: 0, is_terminal: false, is_coloured: false };

    fn unreadable() -> JobError {
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "no such file");
        JobError::Unreadable { path: "j.toml".into(), source }
    }

    #[test]
    fn an_error_is_shown_with_its_cause_and_its_remedy_on_lines_of_their_own() {
        let text = error_text(&unreadable(), false);
        assert_eq!(
            text,
            "error: cannot read the job j.toml\n  caused by: no such file\n  remedy: check the path and its permissions"
        );
    }

    #[test]
    fn a_wrapped_error_is_not_said_twice() {
        let error = anyhow::Error::new(unreadable()).context("cannot replay");
        let text = error_text(error.as_ref(), false);
        assert_eq!(text.matches("cannot read the job").count(), 1, "{text}");
        assert!(text.starts_with("error: cannot replay\n  caused by: cannot read"), "{text}");
    }

    #[test]
    fn a_list_of_faults_keeps_each_remedy_in_its_line() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("bad.toml");
        let text = "id = \"bad\"\nname = \"\"\ninherits = \"fdmm\"\n";
        std::fs::write(&path, text).unwrap();
        let error = Printer::find(path.to_str().unwrap()).unwrap_err();
        let text = error_text(&error, false);
        assert_eq!(text.lines().count(), 2, "{text}");
        assert!(
            text.lines().all(|line| line.starts_with("error: ") && line.contains("; remedy: ")),
            "{text}"
        );
    }

    #[test]
    fn colours_are_used_only_where_they_may_be() {
        assert!(!error_text(&unreadable(), false).contains('\x1b'));
        assert!(error_text(&unreadable(), true).contains("\x1b[1;31merror\x1b[0m: "));
        assert_eq!(verdict(true, false), "pass");
        assert!(verdict(false, true).contains("FAIL"));
    }

    #[test]
    fn columns_stand_under_each_other_whatever_the_colours() {
        let rows = [
            ["axis tilt".to_owned(), verdict(true, true), "≤ 0.05°".to_owned()],
            ["µ".to_owned(), "no".to_owned(), "1".to_owned()],
        ];
        let text = table(&rows);
        let plain = [RED, GREEN, PLAIN].iter().fold(text, |text, escape| text.replace(escape, ""));
        assert_eq!(plain, "axis tilt  pass  ≤ 0.05°\nµ          no    1\n");
        assert_eq!(table::<2>(&[]), "");
    }

    #[test]
    fn bars_take_any_report_and_end_twice_without_harm() {
        let bars = Bars::new(Manner { quiet: false, is_terminal: true, ..SILENT });
        let observer = bars.observer();
        let progress = Progress::observed(&observer);
        for ratio in [0.0, 0.5, 2.0, f64::NAN, -1.0] {
            progress.report("solve", ratio);
        }
        progress.report("cut", 0.0);
        assert_eq!(bars.current.lock().unwrap().as_ref().unwrap().name, "cut");
        bars.finish();
        bars.finish();
        assert!(bars.current.lock().unwrap().is_none());
    }

    #[test]
    fn a_quiet_run_draws_nothing() {
        let bars = Bars::new(SILENT);
        bars.advance("solve", 0.5);
        assert!(bars.current.lock().unwrap().is_none());
    }
}
