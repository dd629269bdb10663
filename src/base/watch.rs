//! The watch over a long run: progress for the caller, a stop button, and a stopwatch in one.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// A phase of a run, in the order of a run without detours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Phase {
    /// Reads and checks the model, the profiles and the goal.
    Load,
    /// Searches the free waterline.
    Waterline,
    /// Puts the hardware into the model.
    Hardware,
    /// Measures the columns of what may be emptied.
    Columns,
    /// Solves for the best void.
    Solve,
    /// Searches places for ballast.
    Ballast,
    /// Tries what would make an impossible goal possible.
    Advise,
    /// Draws the surface of what may be emptied.
    Shell,
    /// Draws the voids.
    Voids,
    /// Plans the cuts and pins.
    Plan,
    /// Finds room for pins in bosses.
    Bosses,
    /// Cuts and writes the parts.
    Parts,
    /// Judges what is written.
    Verify,
    /// Makes the job sheet and its pictures.
    Report,
    /// Slices the plates and weighs their toolpaths.
    Slice,
}

impl Phase {
    /// All phases, in their order.
    pub const ALL: [Self; 15] = [
        Self::Load,
        Self::Waterline,
        Self::Hardware,
        Self::Columns,
        Self::Solve,
        Self::Ballast,
        Self::Advise,
        Self::Shell,
        Self::Voids,
        Self::Plan,
        Self::Bosses,
        Self::Parts,
        Self::Verify,
        Self::Report,
        Self::Slice,
    ];

    /// Returns the key under which the time of the phase is reported.
    pub fn key(self) -> &'static str {
        match self {
            Self::Load => "load",
            Self::Waterline => "waterline",
            Self::Hardware => "hardware",
            Self::Columns => "columns",
            Self::Solve => "solve",
            Self::Ballast => "ballast",
            Self::Advise => "advise",
            Self::Shell => "shell",
            Self::Voids => "voids",
            Self::Plan => "plan",
            Self::Bosses => "bosses",
            Self::Parts => "parts",
            Self::Verify => "verify",
            Self::Report => "report",
            Self::Slice => "slice",
        }
    }

    /// Returns the usual share of the phase in the time of a run; all shares sum to 1.
    ///
    /// They are the mean of `timing_s` in the rows `top-elephant` and `top-armadillo` of the
    /// acceptance table. Phases that these rows do not enter got a little.
    pub fn share(self) -> f64 {
        match self {
            Self::Load => 0.015,
            Self::Waterline | Self::Hardware | Self::Ballast | Self::Advise | Self::Slice => 0.005,
            Self::Columns | Self::Report => 0.035,
            Self::Solve => 0.03,
            Self::Shell => 0.385,
            Self::Voids | Self::Verify => 0.11,
            Self::Plan => 0.115,
            Self::Bosses => 0.01,
            Self::Parts => 0.13,
        }
    }
}

/// The progress of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Progress {
    /// The phase at work.
    pub phase: Phase,
    /// The done share of the phase, 0 to 1. A run may come back to a phase.
    pub phase_ratio: f64,
    /// The done share of the whole run, 0 to 1. It never falls.
    pub whole_ratio: f64,
}

/// Called with every report of progress, from any thread of the run.
pub type Observer = dyn Fn(Progress) + Send + Sync;

/// The caller has stopped the run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("stopped before the end")]
pub struct Cancelled;

/// Least time between two reports of checks, ms. Loops check at every turn, and a bar is drawn no
/// more often.
const CHECK_PERIOD_MS: u64 = 100;
/// Share of what is left of a phase by which a report of checks moves the progress. A phase that
/// does not know its own length takes some ten seconds.
const CHECK_STEP_RATIO: f64 = 0.01;
/// Share of what is left of a run that a round takes: most runs end with the second.
const ROUND_RATIO: f64 = 0.5;
/// Share of a round that slicing takes.
const SLICE_RATIO: f64 = 0.5;
/// Share of a phase left at which it takes longer than usual. From then on checks move the progress
/// towards the end of the run, as if as much time were left as it took so far.
const OVERDUE_RATIO: f64 = 0.05;

/// The watch over a run. Clones share one run: any of them reports, stops and measures it.
///
/// The library never prints: the command line draws a bar from these reports, tests pass
/// [`Watch::silent`].
///
/// ```
/// use equipoise::base::watch::{Phase, Watch};
/// let watch = Watch::observed(|progress| assert!(progress.whole_ratio <= 1.0));
/// watch.enter(Phase::Solve);
/// watch.advance(0.5);
/// assert!(watch.check().is_ok());
/// watch.cancel();
/// assert!(watch.check().is_err());
/// ```
#[derive(Clone)]
pub struct Watch {
    run: Arc<Run>,
    /// True if reported shares are those of a part of the phase: they count as checks only.
    is_muted: bool,
}

struct Run {
    observer: Option<Box<Observer>>,
    stop: Arc<AtomicBool>,
    start: Instant,
    /// Time from the start before which checks are not reported, ms.
    due_ms: AtomicU64,
    course: Mutex<Course>,
}

/// The phase at work, and the time that each took so far.
struct Course {
    progress: Progress,
    /// The done share of the round at work, 0 to 1; that of the whole run without rounds.
    round_ratio: f64,
    /// The shares of the whole run at which the round begins and ends; `None` without rounds.
    round: Option<[f64; 2]>,
    since: Instant,
    laps: Vec<(Phase, f64)>,
}

impl Watch {
    /// Returns a watch that reports to nobody.
    pub fn silent() -> Self {
        Self::new(None, Arc::default())
    }

    /// Returns a watch that reports to nobody, with `stop` as its stop button: the run ends once
    /// it is true.
    pub fn silent_until(stop: Arc<AtomicBool>) -> Self {
        Self::new(None, stop)
    }

    /// Returns a watch that calls `observer` with every report.
    pub fn observed(observer: impl Fn(Progress) + Send + Sync + 'static) -> Self {
        Self::new(Some(Box::new(observer)), Arc::default())
    }

    /// Returns a watch that calls `observer` with every report, with `stop` as its stop button.
    pub fn observed_until(
        observer: impl Fn(Progress) + Send + Sync + 'static,
        stop: Arc<AtomicBool>,
    ) -> Self {
        Self::new(Some(Box::new(observer)), stop)
    }

    fn new(observer: Option<Box<Observer>>, stop: Arc<AtomicBool>) -> Self {
        let progress = Progress {
            phase: Phase::Load,
            phase_ratio: 0.0,
            whole_ratio: 0.0,
        };
        let start = Instant::now();
        let course = Mutex::new(Course {
            progress,
            round_ratio: 0.0,
            round: None,
            since: start,
            laps: Vec::new(),
        });
        Self {
            run: Arc::new(Run {
                observer,
                stop,
                start,
                due_ms: AtomicU64::new(0),
                course,
            }),
            is_muted: false,
        }
    }

    /// Returns a watch over a part of the phase: its reports move the progress a little, its stop
    /// button is the same.
    #[must_use]
    pub fn muted(&self) -> Self {
        Self {
            run: Arc::clone(&self.run),
            is_muted: true,
        }
    }

    /// Begins a round of a run that makes and slices its kit until that is good enough. Nobody
    /// knows how many rounds there are: each takes half of what is left of the progress.
    pub fn begin_round(&self) {
        let mut course = self.course();
        let begin = course.round.map_or(0.0, |[_, end]| end);
        course.round = Some([begin, begin + ROUND_RATIO * (1.0 - begin)]);
        self.report(course, 0.0);
    }

    /// Begins a phase, or goes on with it; the time since the last call counts for the phase
    /// before.
    pub fn enter(&self, phase: Phase) {
        let mut course = self.course();
        course.lap();
        course.progress.phase = phase;
        course.progress.phase_ratio = 0.0;
        let round_ratio = course.round_ratio.max(course.share_before(phase));
        self.report(course, round_ratio);
    }

    /// Reports that the phase at work is done so far, 0 to 1. A smaller share than before counts
    /// as a check, and so does one that the whole run has passed.
    pub fn advance(&self, done_ratio: f64) {
        let mut course = self.course();
        let Progress {
            phase, phase_ratio, ..
        } = course.progress;
        let is_news = !self.is_muted && done_ratio > phase_ratio;
        if is_news {
            course.progress.phase_ratio = done_ratio.min(1.0);
        }
        let done = course.share(phase) * course.progress.phase_ratio;
        let reached = course.share_before(phase) + done;
        if is_news && reached > course.round_ratio {
            self.report(course, reached);
        } else if self.is_due() {
            self.creep(course);
        }
    }

    /// Returns an error if the caller has stopped the run. Now and then it moves the progress a
    /// little, so that it does not stand still.
    ///
    /// Every loop that may take more than some hundredths of a second calls it once a turn. A call
    /// costs less than a tenth of a microsecond.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() {
            return Err(Cancelled);
        }
        if self.run.observer.is_some() && self.is_due() {
            self.creep(self.course());
        }
        Ok(())
    }

    /// Asks the run to stop at its next check.
    pub fn cancel(&self) {
        self.run.stop.store(true, Ordering::Relaxed);
    }

    /// Returns whether the caller has asked the run to stop.
    pub fn is_cancelled(&self) -> bool {
        self.run.stop.load(Ordering::Relaxed)
    }

    /// Returns the seconds that each phase took until now, in the order in which they began.
    pub fn laps(&self) -> Vec<(Phase, f64)> {
        let mut course = self.course();
        course.lap();
        course.laps.clone()
    }

    fn course(&self) -> MutexGuard<'_, Course> {
        let course = self.run.course.lock();
        course.unwrap_or_else(PoisonError::into_inner)
    }

    /// Returns whether a report of checks is due; the next one is then due a period later.
    fn is_due(&self) -> bool {
        let now_ms = self.elapsed_ms();
        let next = |due_ms: u64| (now_ms >= due_ms).then_some(now_ms + CHECK_PERIOD_MS);
        let due_ms = &self.run.due_ms;
        let claimed = due_ms.fetch_update(Ordering::Relaxed, Ordering::Relaxed, next);
        claimed.is_ok()
    }

    fn elapsed_ms(&self) -> u64 {
        let elapsed_ms = self.run.start.elapsed().as_millis();
        u64::try_from(elapsed_ms).unwrap_or(u64::MAX)
    }

    /// Moves on by a share of what is left of the phase, or of the run if the phase came back or is
    /// overdue.
    fn creep(&self, mut course: MutexGuard<'_, Course>) {
        let progress = &mut course.progress;
        progress.phase_ratio += CHECK_STEP_RATIO * (1.0 - progress.phase_ratio);
        let (phase, round_ratio) = (progress.phase, course.round_ratio);
        let share = course.share(phase);
        let left_ratio = course.share_before(phase) + share - round_ratio;
        let step_ratio = if left_ratio > OVERDUE_RATIO * share {
            CHECK_STEP_RATIO * left_ratio
        } else {
            let elapsed_ms = self.elapsed_ms().max(1) as f64;
            let slow_ratio = CHECK_PERIOD_MS as f64 / elapsed_ms;
            CHECK_STEP_RATIO.min(slow_ratio) * (1.0 - round_ratio)
        };
        self.report(course, round_ratio + step_ratio);
    }

    fn report(&self, mut course: MutexGuard<'_, Course>, round_ratio: f64) {
        course.round_ratio = round_ratio.min(1.0);
        let [begin, end] = course.round.unwrap_or([0.0, 1.0]);
        let whole_ratio = begin + (end - begin) * course.round_ratio;
        course.progress.whole_ratio = whole_ratio.max(course.progress.whole_ratio);
        if let Some(observer) = &self.run.observer {
            // Called under the lock, so that reports of two threads arrive in their order.
            observer(course.progress);
        }
    }
}

impl fmt::Debug for Watch {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut words = formatter.debug_struct("Watch");
        words.field("is_cancelled", &self.is_cancelled());
        words.finish_non_exhaustive()
    }
}

impl Course {
    /// Returns the usual share of a phase in the time of a round.
    fn share(&self, phase: Phase) -> f64 {
        let rest = (1.0 - SLICE_RATIO) / (1.0 - Phase::Slice.share());
        match (self.round, phase) {
            (None, _) => phase.share(),
            (Some(_), Phase::Slice) => SLICE_RATIO,
            (Some(_), _) => rest * phase.share(),
        }
    }

    /// Returns the share of a round that usually lies before a phase.
    fn share_before(&self, phase: Phase) -> f64 {
        let earlier = Phase::ALL.into_iter().filter(|other| *other < phase);
        earlier.map(|phase| self.share(phase)).sum()
    }

    /// Gives the time since the last lap to the phase at work.
    fn lap(&mut self) {
        let now = Instant::now();
        let seconds = (now - self.since).as_secs_f64();
        self.since = now;
        let at_work = self.progress.phase;
        match self.laps.iter_mut().find(|(phase, _)| *phase == at_work) {
            Some((_, total)) => *total += seconds,
            None => self.laps.push((at_work, seconds)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::thread;
    use std::time::Duration;

    use super::*;

    fn recorded() -> (Watch, Arc<Mutex<Vec<Progress>>>) {
        let seen: Arc<Mutex<Vec<Progress>>> = Arc::default();
        let record = Arc::clone(&seen);
        let watch = Watch::observed(move |progress| record.lock().unwrap().push(progress));
        (watch, seen)
    }

    #[test]
    fn the_shares_of_the_phases_make_a_whole() {
        let whole: f64 = Phase::ALL.into_iter().map(Phase::share).sum();
        assert!((whole - 1.0).abs() < 1e-12, "{whole}");
        assert!(Phase::ALL.windows(2).all(|pair| pair[0] < pair[1]));
    }

    fn whole_ratios(seen: &Mutex<Vec<Progress>>) -> Vec<f64> {
        let seen = seen.lock().unwrap();
        seen.iter().map(|progress| progress.whole_ratio).collect()
    }

    #[test]
    fn progress_never_falls_even_when_a_phase_comes_back() {
        let (watch, seen) = recorded();
        for phase in [Phase::Shell, Phase::Plan, Phase::Parts, Phase::Plan] {
            watch.enter(phase);
            for ratio in [0.0, 0.5, f64::NAN, 2.0, -1.0] {
                watch.advance(ratio);
                watch.check().unwrap();
            }
        }
        let whole = whole_ratios(&seen);
        assert!(whole.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(whole.iter().all(|ratio| (0.0..=1.0).contains(ratio)));
        assert!(whole.last() >= Some(&end(Phase::Parts)));
    }

    /// Returns the share of a run that is usually done after a phase.
    fn end(phase: Phase) -> f64 {
        let until = Phase::ALL.into_iter().filter(|other| *other <= phase);
        until.map(Phase::share).sum()
    }

    #[test]
    fn each_round_takes_half_of_what_is_left_and_slicing_half_of_a_round() {
        let (watch, seen) = recorded();
        for begin in [0.0, 0.5, 0.75] {
            watch.begin_round();
            for (phase, end) in [(Phase::Report, 0.5), (Phase::Slice, 1.0)] {
                watch.enter(phase);
                watch.advance(1.0);
                let whole = whole_ratios(&seen).last().copied().unwrap();
                let expected = begin + 0.5 * (1.0 - begin) * end;
                assert!(
                    (whole - expected).abs() < 1e-12,
                    "{begin} {phase:?}: {whole}"
                );
            }
        }
        let whole = whole_ratios(&seen);
        assert!(whole.windows(2).all(|pair| pair[0] <= pair[1]));
    }

    #[test]
    fn checks_move_the_progress_in_a_phase_that_comes_back() {
        let (watch, seen) = recorded();
        watch.enter(Phase::Parts);
        watch.enter(Phase::Plan);
        assert_checks_move(&watch, &seen);
    }

    #[test]
    fn checks_move_the_progress_in_a_phase_that_takes_longer_than_it_said() {
        let (watch, seen) = recorded();
        watch.enter(Phase::Plan);
        watch.advance(1.0);
        assert_checks_move(&watch, &seen);
        assert!(whole_ratios(&seen).last() > Some(&end(Phase::Plan)));
    }

    fn assert_checks_move(watch: &Watch, seen: &Mutex<Vec<Progress>>) {
        for _ in 0..2 {
            let before = whole_ratios(seen).last().copied();
            thread::sleep(Duration::from_millis(2 * CHECK_PERIOD_MS));
            watch.check().unwrap();
            assert!(whole_ratios(seen).last().copied() > before);
        }
    }

    #[test]
    fn a_million_checks_make_few_reports() {
        let (watch, seen) = recorded();
        watch.enter(Phase::Plan);
        let start = Instant::now();
        for _ in 0..1_000_000 {
            watch.check().unwrap();
        }
        let periods = start.elapsed().as_millis() as usize / CHECK_PERIOD_MS as usize;
        assert!(whole_ratios(&seen).len() <= 3 + periods);
    }

    #[test]
    fn a_muted_watch_stops_the_run_and_does_not_say_how_far_the_phase_is() {
        let (watch, seen) = recorded();
        watch.enter(Phase::Solve);
        watch.muted().advance(1.0);
        assert!(seen.lock().unwrap().last().unwrap().phase_ratio < 0.1);
        watch.muted().cancel();
        assert_eq!(watch.check(), Err(Cancelled));
    }

    #[test]
    fn a_flag_of_the_caller_stops_the_run() {
        let flag = Arc::new(AtomicBool::new(false));
        let watch = Watch::silent_until(Arc::clone(&flag));
        let (part, other) = (watch.muted(), watch.clone());
        assert!(watch.check().is_ok());
        flag.store(true, Ordering::Relaxed);
        assert!([watch, part, other].iter().all(Watch::is_cancelled));
    }

    #[test]
    fn each_phase_gets_its_own_time_and_what_comes_back_is_added() {
        let watch = Watch::silent();
        for phase in [Phase::Plan, Phase::Parts, Phase::Plan] {
            watch.enter(phase);
        }
        let phases: Vec<Phase> = watch.laps().into_iter().map(|(phase, _)| phase).collect();
        assert_eq!(phases, [Phase::Load, Phase::Plan, Phase::Parts]);
    }
}
