//! A run that a signal stops says so, ends with the signal's code and leaves nothing behind.

#![cfg(unix)]
#![allow(
    clippy::unwrap_used,
    reason = "a test whose process cannot be started has failed"
)]

use crate::common;

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use common::ELLIPSOID;

/// Returns a `prepare` that takes some seconds.
fn slow(out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_equipoise"));
    command
        .args(["prepare", ELLIPSOID, "--printer", "objet-connex350"])
        .args([
            "--goal", "top", "--up", "z", "--size", "100mm", "--force", "--out",
        ])
        .arg(out);
    command
}

/// Starts a `prepare` that takes some seconds, and sends it a signal after a time.
fn stopped(signal: &str, after: Duration, out: &Path) -> Output {
    let child = slow(out)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    thread::sleep(after);
    let kill = format!("kill -{signal} {}", child.id());
    let sent = Command::new("sh").args(["-c", &kill]).status().unwrap();
    assert!(sent.success(), "the run ended before the signal");
    child.wait_with_output().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect()
}

#[test]
fn a_stopped_run_says_so_and_leaves_nothing_behind() {
    for (signal, code, after_ms) in [("INT", 130, 300), ("TERM", 143, 1000)] {
        let room = tempfile::tempdir().unwrap();
        let out = room.path().join("deep/er/kit");
        let output = stopped(signal, Duration::from_millis(after_ms), &out);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(code), "{said}");
        assert!(said.ends_with("stopped; nothing was written\n"), "{said}");
        assert!(output.stdout.is_empty());
        assert_eq!(names(room.path()), Vec::<String>::new());
    }
}

#[test]
fn a_kit_that_was_to_be_replaced_is_still_there() {
    let room = tempfile::tempdir().unwrap();
    let kit = room.path().join("kit");
    fs::create_dir(&kit).unwrap();
    fs::write(kit.join("checklist.json"), "old").unwrap();
    let output = stopped("INT", Duration::from_millis(500), &kit);
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(names(room.path()), ["kit"]);
    assert_eq!(names(&kit), ["checklist.json"]);
}

#[test]
fn a_run_whose_time_is_over_says_so_and_leaves_nothing_behind() {
    let room = tempfile::tempdir().unwrap();
    let start = Instant::now();
    let output = slow(&room.path().join("kit"))
        .args(["--timeout", "0.3s"])
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(
        said.contains("time that was given is over; nothing was written"),
        "{said}"
    );
    assert!(said.contains("remedy: give it more time"), "{said}");
    assert!(
        start.elapsed() < Duration::from_secs(20),
        "{:?}",
        start.elapsed()
    );
    assert_eq!(names(room.path()), Vec::<String>::new());
    for wrong in ["0s", "nan", "soon", "10 parsecs"] {
        let output = slow(&room.path().join("kit"))
            .args(["--timeout", wrong])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{wrong}: {said}");
        assert!(said.contains("90s, 10min or 2h"), "{wrong}: {said}");
    }
}

#[test]
fn a_run_that_takes_more_memory_than_it_may_says_so_and_leaves_nothing_behind() {
    let room = tempfile::tempdir().unwrap();
    let kit = room.path().join("kit");
    let output = slow(&kit).args(["--max-memory", "30MB"]).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2), "{said}");
    let told = "more memory than 30 MB; nothing was written";
    assert!(said.contains(told), "{said}");
    assert!(said.contains("remedy: allow more (--max-memory)"), "{said}");
    assert_eq!(names(room.path()), Vec::<String>::new());
    for wrong in ["4", "0GB", "nan", "much"] {
        let output = slow(&kit).args(["--max-memory", wrong]).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{wrong}: {said}");
        assert!(said.contains("800MB or 4GB"), "{wrong}: {said}");
    }
}
