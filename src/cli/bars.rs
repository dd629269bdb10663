//! The progress of a run on a terminal: the stage at work, how far the whole has come, how fast,
//! and how long it will take.

use std::{
    sync::{Arc, Mutex, PoisonError},
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};

use super::show::Manner;

/// Steps of a bar; finer than any terminal is wide.
const BAR_STEPS: u64 = 1000;
/// How often a bar is drawn anew while nothing is reported. Slower looks stuck, faster costs time.
const TICK: Duration = Duration::from_millis(120);

/// The phases of a run, what they do in a word or two, and about what share of its time each takes:
/// measured on the elephant and the armadillo. Phases that are not listed take the place of the one
/// before them.
const STAGES: [(&str, &str, f64); 8] = [
    ("load", "reading the model", 0.02),
    ("columns", "measuring columns", 0.03),
    ("solve", "solving", 0.03),
    ("shell", "drawing the wall", 0.02),
    ("cavity", "drawing the wall", 0.45),
    ("parts", "cutting parts", 0.22),
    ("verify", "judging the files", 0.19),
    ("report", "writing the sheet", 0.04),
];
/// No time is told before so much of a run is done: it would be wrong by whole factors.
const TELLING_SHARE: f64 = 0.2;

/// The progress of a run: one bar on a terminal, else nothing.
///
/// ```
/// # use equipoise::{cli::{bars::Bars, show::Manner}, progress::Watch};
/// let bars = Bars::new(Manner::of_process(true, 0));
/// let observer = bars.observer();
/// let progress = Watch::observed(&observer);
/// progress.report("solve", 0.5);
/// bars.finish();
/// ```
#[derive(Debug, Clone)]
pub struct Bars {
    bar: ProgressBar,
    course: Arc<Mutex<Course>>,
}

/// How far a run has come.
#[derive(Debug, Clone, Copy)]
struct Course {
    since: Instant,
    /// The index of the stage at work.
    stage: usize,
    /// What of it is done, 0 to 1.
    done_ratio: f64,
    /// When the stage began.
    stage_since: Instant,
}

impl Course {
    fn start() -> Self {
        let now = Instant::now();
        Self {
            since: now,
            stage: 0,
            done_ratio: 0.0,
            stage_since: now,
        }
    }

    /// Goes on to that stage, or on in it. A run may come back to an earlier one; the bar does not.
    fn advance(&mut self, phase: &str, done_ratio: f64) {
        let stage = STAGES
            .iter()
            .position(|(name, ..)| *name == phase)
            .unwrap_or(self.stage);
        let done_ratio = if done_ratio.is_nan() {
            0.0
        } else {
            done_ratio.clamp(0.0, 1.0)
        };
        if stage > self.stage {
            *self = Self {
                stage,
                done_ratio,
                stage_since: Instant::now(),
                ..*self
            };
        } else if stage == self.stage {
            self.done_ratio = self.done_ratio.max(done_ratio);
        }
    }

    /// What of the whole run is done, 0 to 1.
    fn share(&self) -> f64 {
        self.share_before() + STAGES[self.stage].2 * self.done_ratio
    }

    fn share_before(&self) -> f64 {
        STAGES[..self.stage].iter().map(|(.., share)| share).sum()
    }

    /// About how long the rest will take, s: the time so far over the share that is done, less what
    /// has gone by since; none while too little is done to tell.
    fn left_s(&self, now: Instant) -> Option<f64> {
        let share = self.share();
        let known_s = if self.done_ratio > 0.0 {
            now - self.since
        } else {
            self.stage_since - self.since
        };
        let whole_s = known_s.as_secs_f64() / share;
        (share >= TELLING_SHARE).then(|| (whole_s - (now - self.since).as_secs_f64()).max(0.0))
    }

    /// What of the stage is done in a second, 0 to 1; none where it does not say.
    fn rate_per_s(&self, now: Instant) -> Option<f64> {
        let seconds = (now - self.stage_since).as_secs_f64();
        (self.done_ratio > 0.0 && seconds > 0.0).then(|| self.done_ratio / seconds)
    }

    /// The stage, what of it is done, and how fast it goes.
    fn words(&self, now: Instant) -> String {
        let (_, words, _) = STAGES[self.stage];
        let done = match self.rate_per_s(now) {
            Some(rate) => format!("{:.0} %, {:.0} %/s", self.done_ratio * 100.0, rate * 100.0),
            None => String::new(),
        };
        format!("{}/{} {words:<17} {done:<12}", self.stage + 1, STAGES.len())
    }

    fn left_words(&self, now: Instant) -> String {
        self.left_s(now)
            .map_or("time left unknown".to_owned(), |left_s| {
                format!("about {:.0} s left", left_s.ceil())
            })
    }
}

impl Bars {
    /// A bar that begins now.
    pub fn new(manner: Manner) -> Self {
        let course = Arc::new(Mutex::new(Course::start()));
        let bar = if manner.shows_bars() {
            drawn(&course, manner)
        } else {
            ProgressBar::hidden()
        };
        Self { bar, course }
    }

    /// What a [`Watch`](crate::base::watch::Watch) is to call: it advances the bar.
    pub fn observer(&self) -> impl Fn(&str, f64) + Sync + 'static {
        let bars = self.clone();
        move |phase, done_ratio| bars.advance(phase, done_ratio)
    }

    /// Shows that the named phase is done so far, 0 to 1.
    pub fn advance(&self, phase: &str, done_ratio: f64) {
        let mut course = self.course.lock().unwrap_or_else(PoisonError::into_inner);
        course.advance(phase, done_ratio);
        let position = (course.share() * BAR_STEPS as f64) as u64;
        drop(course);
        self.bar.set_position(position);
    }

    /// Clears the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar on the standard error that shows the course whenever it is drawn.
fn drawn(course: &Arc<Mutex<Course>>, manner: Manner) -> ProgressBar {
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
            .with_key("stage", shown(Course::words))
            .with_key("left", shown(Course::left_words)),
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

    fn course(phase: &str, done_ratio: f64, gone_s: u64) -> (Course, Instant) {
        let mut course = Course::start();
        course.advance(phase, done_ratio);
        (course, course.since + Duration::from_secs(gone_s))
    }

    #[test]
    fn the_shares_of_the_stages_make_a_whole() {
        let whole: f64 = STAGES.iter().map(|(.., share)| share).sum();
        assert!((whole - 1.0).abs() < 1e-12);
    }

    #[test]
    fn bars_take_any_report_and_end_twice_without_harm() {
        let bars = Bars::new(Manner {
            quiet: false,
            is_terminal: true,
            ..SILENT
        });
        let observer = bars.observer();
        let progress = Watch::observed(&observer);
        for ratio in [0.0, 0.5, 2.0, f64::NAN, -1.0] {
            progress.report("solve", ratio);
        }
        progress.report("something else", 0.25);
        assert_eq!(bars.course.lock().unwrap().stage, 2);
        bars.finish();
        bars.finish();
    }

    #[test]
    fn a_stage_that_comes_back_does_not_take_the_bar_back() {
        let (mut course, _) = course("parts", 0.5, 0);
        let share = course.share();
        course.advance("columns", 0.1);
        course.advance("parts", 0.2);
        assert_eq!((course.share(), STAGES[course.stage].0), (share, "parts"));
    }

    #[test]
    fn the_time_left_is_the_time_gone_by_over_what_is_done_and_nothing_is_told_too_early() {
        // Halfway through cutting parts 0.55 + 0.11 of the run is done: after 33 s, 17 s are left
        // of 50.
        let (halfway, now) = course("parts", 0.5, 33);
        assert!((halfway.left_s(now).unwrap() - 17.0).abs() < 1e-6);
        assert!(halfway.left_words(now).contains("about 17 s left"));
        let (early, now) = course("load", 0.5, 33);
        assert_eq!(early.left_s(now), None);
    }

    #[test]
    fn the_rate_of_a_stage_is_told_where_it_says_how_far_it_is() {
        let (columns, now) = course("columns", 0.5, 5);
        let words = columns.words(now);
        assert!(
            words.contains("2/8 measuring columns") && words.contains("50 %, 10 %/s"),
            "{words}"
        );
        let (silent, now) = course("verify", 0.0, 5);
        assert!(!silent.words(now).contains('%'));
    }
}
