//! The questions on a terminal, asked and answered through a pseudo-terminal.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test whose terminal cannot be had has failed"
)]

use crate::common;

use std::fs;
use std::path::Path;
use std::process::Command;

use common::ELLIPSOID;
use rexpect::process::WaitStatus;
use rexpect::session::{PtySession, spawn_command};

/// The longest time for an answer of the program, ms; a kit takes a minute on a slow machine.
const LONGEST_MS: u64 = 300_000;
/// The keys of a terminal.
const ENTER: &str = "\r";

/// Starts the program in a folder, on a terminal of its own.
fn start(folder: &Path, line: &str) -> PtySession {
    let program = env!("CARGO_BIN_EXE_equipoise");
    let script = format!("stty cols 100 rows 40; exec {program} {line}");
    let mut command = Command::new("sh");
    let command_line = command.current_dir(folder).args(["-c", &script]);
    // A shop's own printer would not be asked for.
    command_line
        .env("TERM", "xterm")
        .env("NO_COLOR", "1")
        .env("HOME", folder)
        .env_remove("XDG_CONFIG_HOME");
    spawn_command(command, Some(LONGEST_MS)).unwrap()
}

/// Waits for a question and types the answer.
fn answer(terminal: &mut PtySession, question: &str, keys: &str) {
    terminal.exp_string(question).unwrap();
    // The prompt reads keys once it has drawn its help.
    terminal.exp_string("]").unwrap();
    terminal.send(keys).unwrap();
    terminal.send(ENTER).unwrap();
    terminal.flush().unwrap();
}

/// Returns the rest of what was printed, and the exit code.
fn end(terminal: &mut PtySession) -> (String, Option<i32>) {
    let rest = terminal.exp_eof().unwrap();
    let code = match terminal.process().wait().unwrap() {
        WaitStatus::Exited(_, code) => Some(code),
        _ => None,
    };
    (rest, code)
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let name = |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name();
    entries
        .map(|entry| name(entry).into_string().unwrap())
        .collect()
}

#[test]
fn a_model_alone_becomes_a_kit_by_four_answers_and_says_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let line = format!("{ELLIPSOID} --pitch 0.3mm");
    let mut terminal = start(folder.path(), &line);
    answer(&mut terminal, "What should it do?", "top");
    answer(&mut terminal, "Which printer?", "objet");
    answer(&mut terminal, "How large?", "60mm");
    answer(&mut terminal, "Which side is down?", "+z");
    terminal.exp_string("The same without questions:").unwrap();
    let command = "--pitch 0.3mm --goal=top --printer=objet-connex350 --size=60mm --up=-z";
    terminal.exp_string(command).unwrap();
    let (rest, code) = end(&mut terminal);
    assert_eq!(code, Some(0), "{rest}");
    assert_eq!(names(folder.path()), ["tilted-ellipsoid-top"]);
}

#[test]
fn a_size_that_is_none_is_asked_for_again() {
    let folder = tempfile::tempdir().unwrap();
    let mut terminal = start(folder.path(), &format!("prepare {ELLIPSOID} --goal stand"));
    answer(&mut terminal, "Which printer?", "mk4");
    answer(&mut terminal, "How large?", "tall");
    terminal.exp_string("is not a length").unwrap();
    // The field is empty again: the next answer is not appended to the wrong one.
    answer(&mut terminal, "How large?", "80mm");
    terminal.exp_string("Which side is down?").unwrap();
    terminal.exp_string("]").unwrap();
    terminal.send_control('c').unwrap();
    terminal.exp_string("stopped; nothing was written").unwrap();
    assert_eq!(end(&mut terminal).1, Some(130));
    assert_eq!(names(folder.path()), Vec::<String>::new());
}

#[test]
fn letters_that_no_printer_has_are_told_how_to_make_one() {
    let folder = tempfile::tempdir().unwrap();
    let mut terminal = start(folder.path(), &format!("prepare {ELLIPSOID} --goal stand"));
    terminal.exp_string("Which printer?").unwrap();
    terminal.exp_string("]").unwrap();
    terminal.send("qqqq").unwrap();
    terminal.flush().unwrap();
    terminal
        .exp_string("another: equipoise printers new")
        .unwrap();
    terminal.send_control('c').unwrap();
    assert_eq!(end(&mut terminal).1, Some(130));
}

#[test]
fn without_questions_a_terminal_is_told_what_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    let line = format!("prepare {ELLIPSOID} --no-questions");
    let mut terminal = start(folder.path(), &line);
    let (said, code) = end(&mut terminal);
    assert_eq!(code, Some(2), "{said}");
    assert!(
        said.contains("missing: ") && said.contains("--printer"),
        "{said}"
    );
}
