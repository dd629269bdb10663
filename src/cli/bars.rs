//! The progress of a run: one bar with the time left, or a line for each stage.

use std::collections::BTreeSet;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use terminal_size::{Width, terminal_size_of};

use super::show::say;
use super::voice::{Manner, Voice};
use crate::base::watch::{Phase, Progress};

/// Steps of a bar; finer than any terminal is wide.
const BAR_STEPS: u64 = 1000;
/// Time between two drawings of a bar. A slower one looks stuck, a faster one costs time.
const TICK: Duration = Duration::from_millis(120);
/// The columns of a terminal below which the bar is left out.
const MIN_BAR_COLUMNS: u16 = 70;

/// The time without a line after which a long stage says that it goes on.
const MOST_SILENT: Duration = Duration::from_secs(30);
/// The share of a run below which no time left is shown: it would be wrong by whole factors.
const MIN_TIMED_SHARE: f64 = 0.2;
/// The time left that is called a few seconds, and the longest time for which that is said, s.
const FEW_S: f64 = 10.0;
/// Time in which a new estimate of the end takes over from the old ones, s.
const CALM_S: f64 = 6.0;

/// Returns the words for a phase, short enough to stand beside a bar.
pub fn words(phase: Phase) -> &'static str {
    match phase {
        Phase::Load => "reading the model",
        Phase::Waterline => "finding the waterline",
        Phase::Hardware => "fitting the hardware",
        Phase::Columns => "measuring the inside",
        Phase::Solve => "finding the best void",
        Phase::Ballast => "placing the ballast",
        Phase::Advise => "trying remedies",
        Phase::Shell => "drawing the wall",
        Phase::Voids => "drawing the voids",
        Phase::Plan => "planning the cuts",
        Phase::Bosses => "placing the pins",
        Phase::Parts => "cutting the parts",
        Phase::Verify => "checking the files",
        Phase::Report => "writing the sheet",
        Phase::Slice => "slicing the plates",
    }
}

/// The progress of a run: one bar on a terminal, else a line for each stage.
///
/// ```
/// # use equipoise::base::watch::{Phase, Watch};
/// # use equipoise::cli::{bars::Bars, voice::{Manner, Voice}};
/// let bars = Bars::new(Voice { manner: Manner::of_process(true, 0), json: false });
/// let watch = Watch::observed(bars.observer());
/// watch.enter(Phase::Solve);
/// bars.finish();
/// ```
#[derive(Debug, Clone)]
pub struct Bars {
    bar: ProgressBar,
    course: Arc<Mutex<Course>>,
    /// True if each new stage is a line on the standard error.
    says_stages: bool,
}

/// The last report of a run, and its times.
#[derive(Debug, Clone)]
struct Course {
    /// The start of the run.
    since: Instant,
    /// The last report; `None` before the first.
    progress: Option<Progress>,
    /// The time of the last report.
    at: Instant,
    /// The estimated time of the whole run, s; `None` if too little is done for one.
    whole_s: Option<f64>,
    /// The time since when a few seconds are left; `None` if more are left, or nothing is known.
    few_since: Option<Instant>,
    /// The stages that were said.
    said: BTreeSet<Phase>,
    /// The time of the last line.
    said_at: Instant,
}

impl Course {
    fn start() -> Self {
        let now = Instant::now();
        Self {
            since: now,
            progress: None,
            at: now,
            whole_s: None,
            few_since: None,
            said: BTreeSet::new(),
            said_at: now,
        }
    }

    /// Returns the line that a report is worth without a terminal: each new stage, and from time to
    /// time one that takes long. `None` for all other reports.
    fn line(&mut self, phase: Phase, is_new: bool, now: Instant) -> Option<String> {
        let is_long = now - self.said_at >= MOST_SILENT;
        if !is_new && !is_long {
            return None;
        }
        self.said_at = now;
        let elapsed_s = (now - self.since).as_secs_f64();
        let stage = words(phase);
        Some(if is_new {
            format!("{elapsed_s:6.1} s  {stage}")
        } else {
            let percent = 100.0 * self.share();
            format!("{elapsed_s:6.1} s  still {stage}; about {percent:.0} % of the whole is done")
        })
    }

    /// Takes a report. Returns true if it is the first of its stage.
    fn take(&mut self, progress: Progress, now: Instant) -> bool {
        let since_last_s = (now - self.at).as_secs_f64();
        self.progress = Some(progress);
        self.at = now;
        let share = self.share();
        if share >= MIN_TIMED_SHARE {
            let whole_s = (now - self.since).as_secs_f64() / share;
            let known_s = self.whole_s.unwrap_or(whole_s);
            let weight = (since_last_s / CALM_S).min(1.0);
            self.whole_s = Some(known_s + weight * (whole_s - known_s));
        }
        self.note_few(now);
        self.said.insert(progress.phase)
    }

    /// Notes since when a few seconds are left.
    fn note_few(&mut self, now: Instant) {
        let is_few = self.remaining_s(now).is_some_and(|left_s| left_s < FEW_S);
        self.few_since = is_few.then(|| self.few_since.unwrap_or(now));
    }

    /// Returns the done share of the whole run, 0 to 1.
    fn share(&self) -> f64 {
        self.progress.map_or(0.0, |progress| progress.whole_ratio)
    }

    /// Returns an estimate of the time left, s; `None` if too little is done for one.
    fn remaining_s(&self, now: Instant) -> Option<f64> {
        let elapsed_s = (now - self.since).as_secs_f64();
        self.whole_s.map(|whole_s| (whole_s - elapsed_s).max(0.0))
    }

    /// Returns the words for the phase.
    fn words(&self) -> String {
        let phase = self.progress.map_or(Phase::Load, |progress| progress.phase);
        format!("{:<21}", words(phase))
    }

    /// Returns the words for the time left. Empty if too little is done for an estimate, or if a
    /// few seconds were left for longer than that.
    fn remaining_words(&mut self, now: Instant) -> String {
        self.note_few(now);
        let is_over = |since: Instant| (now - since).as_secs_f64() > FEW_S;
        let left_s = self
            .remaining_s(now)
            .filter(|_| !self.few_since.is_some_and(is_over));
        left_s.map_or(String::new(), left_words)
    }
}

/// Returns a time left, no more exactly than it is known.
fn left_words(left_s: f64) -> String {
    match left_s {
        left_s if left_s < FEW_S => "a few seconds left".to_owned(),
        left_s if left_s < 90.0 => format!("about {:.0} s left", 5.0 * (left_s / 5.0).ceil()),
        left_s => format!("about {:.0} min left", (left_s / 60.0).ceil()),
    }
}

impl Bars {
    /// Returns a bar that begins now.
    pub fn new(voice: Voice) -> Self {
        let course = Arc::new(Mutex::new(Course::start()));
        let bar = if voice.manner.shows_bars() {
            draw(&course, voice.manner)
        } else {
            ProgressBar::hidden()
        };
        let Manner {
            quiet, is_terminal, ..
        } = voice.manner;
        Self {
            bar,
            course,
            says_stages: !quiet && !is_terminal && !voice.json,
        }
    }

    /// Returns the observer for a [`Watch`](crate::base::watch::Watch), which advances the bar.
    pub fn observer(&self) -> impl Fn(Progress) + Send + Sync + 'static {
        let bars = self.clone();
        move |progress| bars.advance(progress)
    }

    /// Shows a report of progress.
    pub fn advance(&self, progress: Progress) {
        let mut course = self.course.lock().unwrap_or_else(PoisonError::into_inner);
        let now = Instant::now();
        let is_new = course.take(progress, now);
        let position = (course.share() * BAR_STEPS as f64) as u64;
        let line = course.line(progress.phase, is_new, now);
        drop(course);
        self.bar.set_position(position);
        if let Some(line) = line.filter(|_| self.says_stages) {
            say(&line);
        }
    }

    /// Clears the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// Returns a bar on the standard error that shows the course whenever it is drawn.
fn draw(course: &Arc<Mutex<Course>>, manner: Manner) -> ProgressBar {
    let columns = terminal_size_of(std::io::stderr()).map(|(Width(columns), _)| columns);
    let is_wide = columns.is_none_or(|columns| columns >= MIN_BAR_COLUMNS);
    let bar = ProgressBar::with_draw_target(Some(BAR_STEPS), ProgressDrawTarget::stderr());
    let template = match (is_wide, manner.is_coloured) {
        (true, true) => "{stage} {bar:24.green} {left}",
        (true, false) => "{stage} {bar:24} {left}",
        (false, _) => "{stage} {left}",
    };
    let shown = |words: fn(&mut Course, Instant) -> String| {
        let course = Arc::clone(course);
        move |_: &ProgressState, line: &mut dyn std::fmt::Write| {
            let mut course = course.lock().unwrap_or_else(PoisonError::into_inner);
            let words = words(&mut course, Instant::now());
            drop(course);
            // A line that cannot be drawn is not a reason to stop.
            let _ = line.write_str(&words);
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
        may_ask: false,
        is_coloured: false,
        is_output_coloured: false,
        output_columns: None,
    };

    fn at_share(whole_ratio: f64) -> Progress {
        Progress {
            phase: Phase::Parts,
            phase_ratio: 0.5,
            whole_ratio,
        }
    }

    #[test]
    fn bars_take_any_report_and_end_twice_without_harm() {
        let manner = Manner {
            quiet: false,
            is_terminal: true,
            ..SILENT
        };
        let bars = Bars::new(Voice {
            manner,
            json: false,
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
        let mut course = Course::start();
        let after = |s: u64| course.since + Duration::from_secs(s);
        let [early, late] = [after(3), after(33)];
        course.take(at_share(0.01), early);
        assert_eq!(course.remaining_words(early), "");
        // After 33 s two thirds are done: 16.5 s are left of 49.5.
        course.take(at_share(2.0 / 3.0), late);
        assert!((course.remaining_s(late).unwrap() - 16.5).abs() < 1e-6);
        assert_eq!(course.remaining_words(late), "about 20 s left");
    }

    #[test]
    fn one_slow_stage_does_not_throw_the_time_left_about() {
        let mut course = Course::start();
        let after = |tenths: u64| course.since + Duration::from_millis(100 * tenths);
        let [half, stuck] = [after(100), after(110)];
        course.take(at_share(0.5), half);
        // A second without progress would lead to 12 s left in place of 9.
        course.take(at_share(0.5), stuck);
        let left_s = course.remaining_s(stuck).unwrap();
        assert!((9.0..10.0).contains(&left_s), "{left_s}");
    }

    #[test]
    fn a_few_seconds_are_not_promised_for_half_a_minute() {
        let mut course = Course::start();
        let after = |tenths: u64| course.since + Duration::from_millis(100 * tenths);
        let [early, soon, stuck] = [after(81), after(120), after(190)];
        let [late, end] = [after(250), after(345)];
        course.take(at_share(0.57), early);
        assert_eq!(course.remaining_words(early), "a few seconds left");
        assert_eq!(course.remaining_words(soon), "a few seconds left");
        // Ten seconds after the first words they are no longer believed.
        assert_eq!(course.remaining_words(stuck), "");
        course.take(at_share(0.71), late);
        assert_eq!(course.remaining_words(late), "about 15 s left");
        assert_eq!(course.remaining_words(end), "a few seconds left");
    }

    #[test]
    fn each_stage_is_new_only_once() {
        let mut course = Course::start();
        let now = course.since;
        assert!(course.take(at_share(0.1), now));
        assert!(!course.take(at_share(0.2), now));
    }

    #[test]
    fn a_stage_that_takes_long_says_every_half_minute_that_it_goes_on() {
        let mut course = Course::start();
        let after = |s: u64| course.since + Duration::from_secs(s);
        let [first, soon, late, later] = [after(1), after(20), after(32), after(40)];
        let mut said = |now: Instant| {
            let is_new = course.take(at_share(0.25), now);
            course.line(Phase::Parts, is_new, now)
        };
        assert_eq!(said(first).as_deref(), Some("   1.0 s  cutting the parts"));
        assert_eq!(said(soon), None);
        assert_eq!(
            said(late).as_deref(),
            Some("  32.0 s  still cutting the parts; about 25 % of the whole is done")
        );
        assert_eq!(said(later), None);
    }

    #[test]
    fn a_time_left_is_said_in_steps_that_it_can_keep() {
        assert_eq!(left_words(3.2), "a few seconds left");
        assert_eq!(left_words(41.0), "about 45 s left");
        assert_eq!(left_words(130.0), "about 3 min left");
    }
}
