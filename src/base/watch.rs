//! The watch over a long run: progress for the caller, a stop button, and a stopwatch in one.

use std::sync::atomic::{AtomicBool, Ordering};
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
}

impl Phase {
    /// All phases, in their order.
    pub const ALL: [Self; 14] = [
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
    ];

    /// Returns the key under which the time of the phase is told.
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
        }
    }

    /// Returns the usual share of the phase in the time of a run; all shares sum to 1.
    ///
    /// They are the mean of `timing_s` in the rows `top-elephant` and `top-armadillo` of the
    /// acceptance table. Phases that these rows do not enter got a little.
    pub fn share(self) -> f64 {
        match self {
            Self::Load => 0.015,
            Self::Waterline | Self::Hardware | Self::Ballast | Self::Advise => 0.005,
            Self::Columns | Self::Report => 0.035,
            Self::Solve => 0.03,
            Self::Shell => 0.39,
            Self::Voids | Self::Verify => 0.11,
            Self::Plan => 0.115,
            Self::Bosses => 0.01,
            Self::Parts => 0.13,
        }
    }

    /// Returns the share of a run that usually lies before the phase.
    fn share_before(self) -> f64 {
        let earlier = Self::ALL.into_iter().filter(|phase| *phase < self);
        earlier.map(Self::share).sum()
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

/// Share of what is left of a phase by which a check moves the progress. A phase that does not
/// know its own length makes about a hundred checks.
const CHECK_STEP_RATIO: f64 = 0.02;

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
    course: Mutex<Course>,
}

/// The phase at work, and the time that each took so far.
struct Course {
    progress: Progress,
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
        let course = Mutex::new(Course {
            progress,
            since: Instant::now(),
            laps: Vec::new(),
        });
        Self {
            run: Arc::new(Run {
                observer,
                stop,
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

    /// Begins a phase, or goes on with it; the time since the last call counts for the phase
    /// before.
    pub fn enter(&self, phase: Phase) {
        let mut course = self.course();
        course.lap();
        course.progress.phase = phase;
        course.progress.phase_ratio = 0.0;
        let whole_ratio = course.progress.whole_ratio.max(phase.share_before());
        self.report(course, whole_ratio);
    }

    /// Reports that the phase at work is done so far, 0 to 1. A smaller share than before counts
    /// as a check.
    pub fn advance(&self, done_ratio: f64) {
        let course = self.course();
        let Progress {
            phase,
            phase_ratio,
            whole_ratio,
        } = course.progress;
        if self.is_muted || done_ratio.is_nan() || done_ratio <= phase_ratio {
            return self.creep(course);
        }
        let done_ratio = done_ratio.min(1.0);
        let mut course = course;
        course.progress.phase_ratio = done_ratio;
        let reached = phase.share_before() + phase.share() * done_ratio;
        self.report(course, whole_ratio.max(reached));
    }

    /// Returns an error if the caller has stopped the run; else moves the progress a little.
    ///
    /// Loops of unknown length call it once a turn.
    pub fn check(&self) -> Result<(), Cancelled> {
        if self.is_cancelled() {
            return Err(Cancelled);
        }
        if self.run.observer.is_some() {
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

    /// Moves on by a share of what is left of the phase, or of the run if the phase came back.
    fn creep(&self, mut course: MutexGuard<'_, Course>) {
        let progress = &mut course.progress;
        progress.phase_ratio += CHECK_STEP_RATIO * (1.0 - progress.phase_ratio);
        let end = progress.phase.share_before() + progress.phase.share();
        let end = if progress.whole_ratio < end { end } else { 1.0 };
        let whole_ratio = progress.whole_ratio + CHECK_STEP_RATIO * (end - progress.whole_ratio);
        self.report(course, whole_ratio);
    }

    fn report(&self, mut course: MutexGuard<'_, Course>, whole_ratio: f64) {
        course.progress.whole_ratio = whole_ratio.min(1.0);
        if let Some(observer) = &self.run.observer {
            // Called under the lock, so that reports of two threads arrive in their order.
            observer(course.progress);
        }
    }
}

impl Course {
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

    #[test]
    fn progress_rises_with_every_report_even_when_a_phase_comes_back() {
        let (watch, seen) = recorded();
        for phase in [Phase::Shell, Phase::Plan, Phase::Parts, Phase::Plan] {
            watch.enter(phase);
            for ratio in [0.0, 0.5, f64::NAN, 2.0, -1.0] {
                watch.advance(ratio);
                watch.check().unwrap();
            }
        }
        let whole: Vec<f64> = seen.lock().unwrap().iter().map(|p| p.whole_ratio).collect();
        assert!(whole.windows(2).all(|pair| pair[0] <= pair[1]));
        assert!(whole.iter().all(|ratio| (0.0..=1.0).contains(ratio)));
        let moved = whole.windows(2).filter(|pair| pair[0] < pair[1]).count();
        assert!(moved >= whole.len() - 5, "{moved} of {}", whole.len());
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
