//! The progress bar of a run: its phase, the done share, the time so far and the time left.

use std::{
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::voice::Manner;
use crate::base::watch::{Phase, Progress};

/// Steps of a bar; finer than any terminal is wide.
const BAR_STEPS: u64 = 1000;
/// Time between two drawings of a bar. A slower one looks stuck, a faster one costs time.
const TICK: Duration = Duration::from_millis(120);

/// The share of a run below which no time left is shown: it would be wrong by whole factors.
const MIN_TIMED_SHARE: f64 = 0.2;

/// Returns the words for a phase, short enough to stand beside a bar.
fn words(phase: Phase) -> &'static str {
    match phase {
        Phase::Load => "reading the model",
        Phase::Waterline => "waterline",
        Phase::Hardware => "hardware",
        Phase::Columns => "measuring columns",
        Phase::Solve => "solving",
        Phase::Ballast => "placing ballast",
        Phase::Advise => "trying remedies",
        Phase::Shell => "drawing the wall",
        Phase::Voids => "drawing voids",
        Phase::Plan => "planning cuts",
        Phase::Bosses => "placing pins",
        Phase::Parts => "cutting parts",
        Phase::Verify => "judging the files",
        Phase::Report => "writing the sheet",
    }
}

/// The progress of a run: one bar on a terminal, else nothing.
///
/// ```
/// # use equipoise::{base::watch::{Phase, Watch}, cli::{bars::Bars, voice::Manner}};
/// let bars = Bars::new(Manner::of_process(true, 0));
/// let watch = Watch::observed(bars.observer());
/// watch.enter(Phase::Solve);
/// bars.finish();
/// ```
#[derive(Debug, Clone)]
pub struct Bars {
    bar: ProgressBar,
    course: Arc<Mutex<Course>>,
}

/// The last report of a run, and its times.
#[derive(Debug, Clone, Copy)]
struct Course {
    /// The start of the run.
    since: Instant,
    /// The last report; `None` before the first.
    progress: Option<Progress>,
    /// The time of the last report.
    at: Instant,
}

impl Course {
    fn start() -> Self {
        let now = Instant::now();
        Self {
            since: now,
            progress: None,
            at: now,
        }
    }

    /// Returns the done share of the whole run, 0 to 1.
    fn share(&self) -> f64 {
        self.progress.map_or(0.0, |progress| progress.whole_ratio)
    }

    /// Returns an estimate of the time left, s; `None` if too little is done for one.
    fn remaining_s(&self, now: Instant) -> Option<f64> {
        let share = self.share();
        let whole_s = (self.at - self.since).as_secs_f64() / share;
        let elapsed_s = (now - self.since).as_secs_f64();
        (share >= MIN_TIMED_SHARE).then(|| (whole_s - elapsed_s).max(0.0))
    }

    /// Returns the words for the phase, with its number among all phases.
    fn words(&self) -> String {
        let phase = self.progress.map_or(Phase::Load, |progress| progress.phase);
        let number = Phase::ALL.iter().filter(|other| **other <= phase).count();
        format!("{number}/{} {:<17}", Phase::ALL.len(), words(phase))
    }

    fn remaining_words(&self, now: Instant) -> String {
        let words = |remaining_s: f64| format!("about {:.0} s left", remaining_s.ceil());
        self.remaining_s(now)
            .map_or("time left unknown".to_owned(), words)
    }
}

impl Bars {
    /// Returns a bar that begins now.
    pub fn new(manner: Manner) -> Self {
        let course = Arc::new(Mutex::new(Course::start()));
        let bar = if manner.shows_bars() {
            draw(&course, manner)
        } else {
            ProgressBar::hidden()
        };
        Self { bar, course }
    }

    /// Returns the observer for a [`Watch`](crate::base::watch::Watch), which advances the bar.
    pub fn observer(&self) -> impl Fn(Progress) + Send + Sync + 'static {
        let bars = self.clone();
        move |progress| bars.advance(progress)
    }

    /// Shows a report of progress.
    pub fn advance(&self, progress: Progress) {
        let mut course = self.course.lock().unwrap_or_else(PoisonError::into_inner);
        course.progress = Some(progress);
        course.at = Instant::now();
        let position = (course.share() * BAR_STEPS as f64) as u64;
        drop(course);
        self.bar.set_position(position);
    }

    /// Clears the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Returns a bar on the standard error that shows the course whenever it is drawn.
fn draw(course: &Arc<Mutex<Course>>, manner: Manner) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    let template = if manner.is_coloured {
        "{stage} {bar:24.green} {percent:>3} % {elapsed} {left}"
    } else {
        "{stage} {bar:24} {percent:>3} % {elapsed} {left}"
    };
    let shown = |words: fn(&Course, Instant) -> String| {
        let course = Arc::clone(course);
        move |_: &ProgressState, line: &mut dyn std::fmt::Write| {
            let course = *course.lock().unwrap_or_else(PoisonError::into_inner);
            // A line that cannot be drawn is not a reason to stop.
            let _ = line.write_str(&words(&course, Instant::now()));
        }
    };
    let style =
        ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    bar.set_style(
        style
            .with_key("stage", shown(|course, _| course.words()))
            .with_key("left", shown(Course::remaining_words)),
    );
    bar.enable_steady_tick(TICK);
    bar
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::base::watch::Watch;

    const SILENT: Manner = Manner {
        quiet: true,
        verbose: 0,
        is_terminal: false,
        is_coloured: false,
        is_output_coloured: false,
    };

    fn course(phase: Phase, whole_ratio: f64, elapsed_s: u64) -> Course {
        let start = Course::start();
        let progress = Progress {
            phase,
            phase_ratio: 0.5,
            whole_ratio,
        };
        Course {
            progress: Some(progress),
            at: start.since + Duration::from_secs(elapsed_s),
            ..start
        }
    }

    #[test]
    fn bars_take_any_report_and_end_twice_without_harm() {
        let bars = Bars::new(Manner {
            quiet: false,
            is_terminal: true,
            ..SILENT
        });
        let watch = Watch::observed(bars.observer());
        watch.enter(Phase::Solve);
        for ratio in [0.0, 0.5, 2.0, f64::NAN, -1.0] {
            watch.advance(ratio);
        }
        let share = bars.course.lock().unwrap().share();
        assert!((0.0..=1.0).contains(&share));
        bars.finish();
        bars.finish();
    }

    #[test]
    fn the_time_left_follows_from_the_done_share_and_is_not_shown_too_early() {
        // After 33 s two thirds are done: 16.5 s are left of 49.5.
        let late = course(Phase::Parts, 2.0 / 3.0, 33);
        assert!((late.remaining_s(late.at).unwrap() - 16.5).abs() < 1e-6);
        assert!(late.remaining_words(late.at).contains("about 17 s left"));
        let early = course(Phase::Load, 0.01, 33);
        assert_eq!(early.remaining_s(early.at), None);
    }

    #[test]
    fn the_phase_is_shown_with_its_number() {
        let words = course(Phase::Columns, 0.03, 5).words();
        assert!(words.contains("4/14 measuring columns"), "{words}");
    }
}
