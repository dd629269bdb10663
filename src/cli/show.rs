//! Text for a terminal: colours, tables, and errors with their remedies.

use std::error::Error;
use std::io::Write;

use super::flags::with_flags;
use super::voice::Manner;

/// Writes a line to the standard error; a closed one is not a reason to stop.
pub(super) fn say(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Prints the error with its causes and remedies on the standard error.
pub fn print_error(error: &(dyn Error + 'static), manner: Manner) {
    say(&error_text(error, manner.is_coloured));
}

/// The words before the remedy in an error's message.
const REMEDY_MARK: &str = "; remedy: ";

/// Returns the error, each of its causes and each remedy, a line each:
///
/// ```text
/// error: cannot read the job j.toml
///   caused by: No such file or directory
///   remedy: check the path
/// ```
///
/// Every remedy follows "; remedy: " in a message. In a message of several lines each line keeps
/// its own. A cause whose words stand in an error above it is left out.
pub fn error_text(error: &(dyn Error + 'static), is_coloured: bool) -> String {
    let (mut lines, mut remedies, mut said) = (Vec::new(), Vec::new(), String::new());
    for cause in chain(error) {
        let message = with_flags(&cause.to_string());
        if said.contains(&message) {
            continue;
        }
        let label = if said.is_empty() {
            paint("error", RED, is_coloured)
        } else {
            "  caused by".to_owned()
        };
        let is_list = message.contains('\n');
        // The head of a list repeats the error above it.
        let is_head = |line: &&str| is_list && !said.is_empty() && line.ends_with(':');
        for line in message
            .lines()
            .filter(|line| !is_head(line))
            .map(str::trim_start)
        {
            let mark = if is_list { "\n" } else { REMEDY_MARK };
            let mut pieces = line.split(mark);
            let statement = pieces.next().unwrap_or_default();
            lines.push(format!("{label}: {statement}"));
            let label = paint("remedy", GREEN, is_coloured);
            remedies.extend(pieces.map(|remedy| format!("  {label}: {remedy}")));
        }
        said.push_str(&message);
    }
    lines.append(&mut remedies);
    lines.join("\n")
}

/// Returns the error and its causes, the outermost first.
fn chain<'a>(error: &'a (dyn Error + 'static)) -> impl Iterator<Item = &'a (dyn Error + 'static)> {
    std::iter::successors(Some(error), |cause| (*cause).source())
}

/// Terminal escape for bold red.
pub(super) const RED: &str = "\x1b[1;31m";
/// Terminal escape for green.
pub(super) const GREEN: &str = "\x1b[32m";
/// Terminal escape that ends a colour.
const PLAIN: &str = "\x1b[0m";

/// Returns the text in a colour, if colours may be used.
pub(super) fn paint(text: &str, colour: &str, is_coloured: bool) -> String {
    if is_coloured {
        format!("{colour}{text}{PLAIN}")
    } else {
        text.to_owned()
    }
}

/// Returns "pass" in green or "FAIL" in red, for a table of promises.
pub fn verdict(passes: bool, is_coloured: bool) -> String {
    if passes {
        paint("pass", GREEN, is_coloured)
    } else {
        paint("FAIL", RED, is_coloured)
    }
}

/// Number of blanks between the columns of a table.
const COLUMN_GAP: usize = 2;

/// Returns the rows as aligned columns, a line each, without blanks at the ends. Escapes of colours
/// take no room.
pub fn table<Row: AsRef<[String]>>(rows: &[Row]) -> String {
    let columns = rows.iter().map(|row| row.as_ref().len()).max().unwrap_or(0);
    let widest = |column: usize| {
        rows.iter()
            .filter_map(|row| row.as_ref().get(column))
            .map(|cell| width(cell))
            .max()
    };
    let widths: Vec<usize> = (0..columns)
        .map(|column| widest(column).unwrap_or(0))
        .collect();
    rows.iter()
        .map(|row| table_line(row.as_ref(), &widths) + "\n")
        .collect()
}

fn table_line(row: &[String], widths: &[usize]) -> String {
    let cells = row.iter().zip(widths);
    let padded = cells
        .map(|(cell, &column)| format!("{cell}{}", " ".repeat(column + COLUMN_GAP - width(cell))));
    padded.collect::<String>().trim_end().to_owned()
}

/// Returns the number of characters that a terminal shows.
pub(super) fn width(text: &str) -> usize {
    let plain = [RED, GREEN, PLAIN]
        .iter()
        .fold(text.to_owned(), |text, escape| text.replace(escape, ""));
    plain.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{job::JobError, printer::Printer};

    fn unreadable() -> JobError {
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "no such file");
        JobError::Unreadable {
            path: "j.toml".into(),
            source,
        }
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
        assert!(
            text.starts_with("error: cannot replay\n  caused by: cannot read"),
            "{text}"
        );
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
            text.lines()
                .all(|line| line.starts_with("error: ") && line.contains("; remedy: ")),
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
            [
                "axis tilt".to_owned(),
                verdict(true, true),
                "≤ 0.05°".to_owned(),
            ],
            ["µ".to_owned(), "no".to_owned(), "1".to_owned()],
        ];
        let text = table(&rows);
        let plain = [RED, GREEN, PLAIN]
            .iter()
            .fold(text, |text, escape| text.replace(escape, ""));
        assert_eq!(plain, "axis tilt  pass  ≤ 0.05°\nµ          no    1\n");
        assert_eq!(table::<[String; 2]>(&[]), "");
    }
}
