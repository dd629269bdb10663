//! Progress never stands still and never goes back, and a run that is stopped anywhere ends at once
//! and leaves nothing behind.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    reason = "a test whose input cannot be had has failed, and the table is shown with --nocapture"
)]

use crate::common;

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use clap::Parser;
use common::{ELLIPSOID, QUICK, words};
use equipoise::base::watch::{Phase, Progress, Watch};
use equipoise::cli::args::{Cli, Command, Request};
use equipoise::error::Error;
use equipoise::kit::Existing;
use equipoise::prepare::{Outcome, prepare};

/// The longest time for which progress may stand still.
const LONGEST_STILL: Duration = Duration::from_secs(2);
/// The longest time from a stop to the end of the run.
const LONGEST_STOP: Duration = Duration::from_secs(2);
/// Points of a run at which it is stopped, evenly spread over its progress, by default and in a
/// long run.
const FEW_STOPS: u32 = 5;
const STOPS: u32 = 12;
/// The acceptance table.
const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/.ci/models");

/// Returns the order that a command line of `prepare` makes.
fn order(model: &Path, out: &Path, options: &str) -> Request {
    let start = ["equipoise", "prepare", common::path(model)];
    let end = ["--force", "--out", common::path(out)];
    let cli = Cli::try_parse_from([&start[..], &words(options), &end].concat()).unwrap();
    let Command::Prepare(args) = cli.command else {
        unreachable!("the command is `prepare`");
    };
    args.request().unwrap()
}

/// Runs an order as the command line does: prepares the kit and writes it.
fn run(order: &Request, watch: &Watch) -> Result<Outcome, Error> {
    let outcome = prepare(&order.job, watch)?;
    if let Outcome::Prepared(prepared) = &outcome {
        let kit = &prepared.kit;
        kit.write_watched(&order.out, Existing::Replace, watch)?;
    }
    Ok(outcome)
}

/// The reports of a run.
#[derive(Default)]
struct Record {
    /// The reports, each with its time.
    reports: Vec<(Instant, Progress)>,
}

/// A stretch of a run in which progress stood still.
#[derive(Clone, Copy)]
struct Still {
    time: Duration,
    phase: Phase,
    whole_ratio: f64,
}

impl Record {
    /// Runs an order and records it; returns the record, and the time of the end.
    fn of(order: &Request) -> (Self, Instant) {
        let record: Arc<Mutex<Self>> = Arc::default();
        let reports = Arc::clone(&record);
        let watch = Watch::observed(move |progress| {
            let mut record = reports.lock().unwrap();
            record.reports.push((Instant::now(), progress));
        });
        run(order, &watch).unwrap();
        drop(watch);
        let record = Arc::into_inner(record).unwrap().into_inner().unwrap();
        (record, Instant::now())
    }

    /// Returns the shares of the whole run, in the order of the reports.
    fn whole_ratios(&self) -> Vec<f64> {
        let progress = self.reports.iter().map(|(_, progress)| progress);
        progress.map(|progress| progress.whole_ratio).collect()
    }

    /// Returns the longest stretch in which the share of the whole run did not rise.
    fn longest_still(&self, end: Instant) -> Still {
        let (mut since, mut last) = self.reports[0];
        let mut longest = Still {
            time: Duration::ZERO,
            phase: last.phase,
            whole_ratio: last.whole_ratio,
        };
        for (at, progress) in self.reports.iter().copied().chain([(end, last)]) {
            if progress.whole_ratio > last.whole_ratio || at == end {
                if at - since > longest.time {
                    longest = Still {
                        time: at - since,
                        phase: last.phase,
                        whole_ratio: last.whole_ratio,
                    };
                }
                since = at;
            }
            last = progress;
        }
        longest
    }
}

#[test]
fn progress_rises_to_the_end_and_never_stands_still() {
    let room = tempfile::tempdir().unwrap();
    let options = format!("{QUICK} --goal top --up z --wall 1.5mm");
    let order = order(Path::new(ELLIPSOID), &room.path().join("kit"), &options);
    let (record, end) = Record::of(&order);
    let whole = record.whole_ratios();
    assert!(whole.windows(2).all(|pair| pair[0] <= pair[1]));
    assert!(whole[0] < 0.01, "{}", whole[0]);
    assert!(*whole.last().unwrap() > 0.95, "{:?}", whole.last());
    let still = record.longest_still(end);
    assert!(still.time <= LONGEST_STILL, "{}", still.words());
}

#[test]
fn a_run_that_is_stopped_ends_at_once_and_writes_nothing() {
    assert_stopped(FEW_STOPS);
}

#[test]
#[ignore = "long: a minute; run with -- --ignored"]
fn a_run_stopped_anywhere_ends_at_once_and_writes_nothing() {
    assert_stopped(STOPS);
}

fn assert_stopped(stops: u32) {
    let options = format!("{QUICK} --goal top --up z --wall 1.5mm");
    for stop in 0..stops {
        let room = tempfile::tempdir().unwrap();
        let order = order(Path::new(ELLIPSOID), &room.path().join("kit"), &options);
        let at_ratio = 0.96 * f64::from(stop) / f64::from(stops - 1);
        let (outcome, took) = run_until(&order, at_ratio);
        let is_cancelled = matches!(outcome, Err(Error::Cancelled));
        assert!(is_cancelled, "stopped at {at_ratio:.2}");
        assert!(took <= LONGEST_STOP, "stopped at {at_ratio:.2}: {took:?}");
        assert_eq!(room.path().read_dir().unwrap().count(), 0);
    }
}

/// Runs an order and stops it at a share of the whole run; returns the outcome, and the time from
/// the stop to the end.
fn run_until(order: &Request, at_ratio: f64) -> (Result<Outcome, Error>, Duration) {
    let stop = Arc::new(AtomicBool::new(false));
    let stopped: Arc<Mutex<Option<Instant>>> = Arc::default();
    let (button, since) = (Arc::clone(&stop), Arc::clone(&stopped));
    let observer = move |progress: Progress| {
        if progress.whole_ratio >= at_ratio && !button.swap(true, Ordering::Relaxed) {
            *since.lock().unwrap() = Some(Instant::now());
        }
    };
    let outcome = run(order, &Watch::observed_until(observer, stop));
    let since = stopped.lock().unwrap();
    (
        outcome,
        since.map_or(Duration::MAX, |since| since.elapsed()),
    )
}

/// A row of the acceptance table.
struct Row {
    name: String,
    model: PathBuf,
    options: String,
}

/// Returns the rows of the acceptance table that end with a kit or a proof.
fn rows() -> Vec<Row> {
    let table = std::fs::read_to_string(TABLE).unwrap();
    let usual = table.lines().find_map(|line| line.strip_prefix("usual="));
    let usual = usual.unwrap().trim_matches('"').to_owned();
    let folder = common::shared_folder();
    let row = |line: &str| {
        let line = line.strip_prefix("case_ ")?.replace("$usual", &usual);
        let [name, code, model, options @ ..] = &words(&line)[..] else {
            return None;
        };
        (*code != "2").then(|| Row {
            name: (*name).to_owned(),
            model: folder.join(model),
            options: format!("--printer objet-connex350 {}", options.join(" ")),
        })
    };
    table.lines().filter_map(row).collect()
}

impl Still {
    fn words(&self) -> String {
        let (seconds, phase) = (self.time.as_secs_f64(), self.phase.key());
        format!("{seconds:.2} s in {phase} at {:.3}", self.whole_ratio)
    }
}

/// Run it on an otherwise idle machine, with --nocapture. `EQUIPOISE_SHARED_MODELS` names the
/// folder of models, and `EQUIPOISE_ROWS` the rows by parts of their names, between commas.
#[test]
#[ignore = "takes half an hour, and needs models that are not part of the project"]
fn progress_never_stands_still_on_the_acceptance_table() {
    let asked = std::env::var("EQUIPOISE_ROWS").unwrap_or_default();
    let is_asked = |row: &Row| asked.split(',').any(|part| row.name.contains(part));
    let mut failed = Vec::new();
    for row in rows().into_iter().filter(is_asked) {
        if !row.model.is_file() {
            println!("SKIPPED {}: {} is not there", row.name, row.model.display());
            continue;
        }
        let room = tempfile::tempdir().unwrap();
        let order = order(&row.model, &room.path().join("kit"), &row.options);
        let start = Instant::now();
        let (record, end) = Record::of(&order);
        let whole = record.whole_ratios();
        let still = record.longest_still(end);
        println!(
            "{:24} {:6.1} s, {:5} reports, to {:.3}, longest still {}",
            row.name,
            (end - start).as_secs_f64(),
            whole.len(),
            whole.last().unwrap(),
            still.words()
        );
        let rises = whole.windows(2).all(|pair| pair[0] <= pair[1]);
        if !rises || still.time > LONGEST_STILL {
            failed.push(row.name);
        }
    }
    assert!(failed.is_empty(), "stood still or went back: {failed:?}");
}
