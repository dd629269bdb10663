//! Ctrl-C and requests to end: the first stops the command, a second ends the process at once. A
//! time that is over and memory that is used up stop it too.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};
use std::time::Duration;
use std::{io, process, thread};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::exit::Exit;
use super::flags;
use super::memory::Gauge;
use super::show::say;
use crate::base::units::show_bytes;

/// The line on the standard error when a command was stopped.
const STOPPED: &str = "stopped; nothing was written";
/// The line on the standard error when the time of a command was over.
const TIMED_OUT: &str =
    "error: the time that was given is over; nothing was written\n  remedy: give it more time";
/// The time between two looks at a stop button. A person takes less for at once.
const LOOK: Duration = Duration::from_millis(50);

/// The time between two looks at the memory that is used. A thread fills some 20 MB in it.
const MEMORY_LOOK: Duration = Duration::from_millis(10);
/// Memory, as a part of the limit, at which the process ends at once: what works then does not look
/// at the button.
const HARD_RATIO: f64 = 1.08;

/// The limits of a command.
#[derive(Debug, Clone, Copy, Default)]
pub struct Limits {
    /// The time after which it stops; `None` for never.
    pub time: Option<Duration>,
    /// The memory beyond which it stops, bytes; `None` for nearly all that the machine has.
    pub memory_bytes: Option<u64>,
}

/// A reason beside signals why a command stops.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Cause {
    /// Its time is over.
    Time,
    /// More than so many bytes of memory are used.
    Memory(u64),
}

/// A stop button for a command, pressed by the first SIGINT or SIGTERM, or once a limit is reached.
#[derive(Debug, Clone, Default)]
pub struct Stop {
    is_pressed: Arc<AtomicBool>,
    /// The number of the signal that pressed it; 0 before.
    signal: Arc<AtomicUsize>,
    /// The limit that pressed it; empty if a signal did, and before.
    limit: Arc<OnceLock<Cause>>,
}

impl Stop {
    /// Returns a button that signals press from now on.
    ///
    /// A second signal has its default effect again. If the system refuses to hand signals over,
    /// the first has it too.
    pub fn on_signals() -> Self {
        let stop = Self::default();
        for signal in [SIGINT, SIGTERM] {
            // A process whose signals cannot be caught ends by them, as most processes do.
            let _ = stop.listen(signal);
        }
        stop
    }

    /// Returns a button that signals press from now on, and that is pressed at these limits.
    pub fn within(limits: Limits) -> Self {
        let stop = Self::on_signals();
        if let Some(time) = limits.time {
            let timed = stop.clone();
            thread::spawn(move || {
                thread::sleep(time);
                timed.press(Cause::Time);
            });
        }
        if let Some(gauge) = Gauge::new(limits.memory_bytes) {
            let watched = stop.clone();
            thread::spawn(move || watched.guard_memory(gauge));
        }
        stop
    }

    /// Looks at the used memory from time to time, and presses the button at the limit.
    fn guard_memory(&self, mut gauge: Gauge) {
        let limit = gauge.limit_bytes;
        loop {
            let used = gauge.used_bytes();
            if used > limit {
                self.press(Cause::Memory(limit));
            }
            if used as f64 > HARD_RATIO * limit as f64
                && let Some(exit) = self.end()
            {
                process::exit(exit.code().into());
            }
            thread::sleep(MEMORY_LOOK);
        }
    }

    /// Presses the button because of a limit, unless something did before.
    fn press(&self, cause: Cause) {
        if !self.is_pressed.load(Ordering::SeqCst) {
            // Only the first limit counts.
            let _ = self.limit.set(cause);
            self.is_pressed.store(true, Ordering::SeqCst);
        }
    }

    fn listen(&self, signal: i32) -> io::Result<()> {
        let number = usize::try_from(signal).unwrap_or_default();
        // They act in this order: the first signal finds the button not yet pressed.
        flag::register_conditional_default(signal, Arc::clone(&self.is_pressed))?;
        flag::register_usize(signal, Arc::clone(&self.signal), number)?;
        flag::register(signal, Arc::clone(&self.is_pressed))?;
        Ok(())
    }

    /// Returns the flag that is to stop a [`Watch`](crate::base::watch::Watch).
    pub fn flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.is_pressed)
    }

    /// Presses the button for a Ctrl-C that came as a key, and returns how the command ends.
    pub fn interrupt(&self) -> Exit {
        self.is_pressed.store(true, Ordering::SeqCst);
        self.end().unwrap_or(Exit::Interrupted)
    }

    /// Returns how the command ends if the button is pressed, and says that nothing was written;
    /// else `None`.
    pub fn end(&self) -> Option<Exit> {
        if !self.is_pressed.load(Ordering::SeqCst) {
            return None;
        }
        if let Some(cause) = self.limit.get() {
            match cause {
                Cause::Time => say(TIMED_OUT),
                Cause::Memory(bytes) => say(&out_of_memory(*bytes)),
            }
            return Some(Exit::CouldNotRun);
        }
        say(STOPPED);
        let is_request = self.signal.load(Ordering::SeqCst) == SIGTERM as usize;
        Some(if is_request {
            Exit::Terminated
        } else {
            Exit::Interrupted
        })
    }

    /// Lets the button end the process once it is pressed, with the usual words and code.
    ///
    /// It is for commands that write no files and cannot be stopped in between.
    pub fn end_process(self) {
        thread::spawn(move || {
            loop {
                thread::sleep(LOOK);
                if let Some(exit) = self.end() {
                    process::exit(exit.code().into());
                }
            }
        });
    }
}

/// Words that a command would take more memory than so many bytes.
fn out_of_memory(bytes: u64) -> String {
    format!(
        "error: this takes more memory than {}; nothing was written\n  remedy: allow more ({}), or \
         give a larger pitch, a smaller size or a model of fewer triangles",
        show_bytes(bytes),
        flags::MAX_MEMORY
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_button_tells_which_signal_pressed_it() {
        let stop = Stop::default();
        assert_eq!(stop.end(), None);
        stop.flag().store(true, Ordering::SeqCst);
        for (signal, exit, code) in [
            (SIGINT, Exit::Interrupted, 130),
            (SIGTERM, Exit::Terminated, 143),
        ] {
            stop.signal.store(signal as usize, Ordering::SeqCst);
            assert_eq!(stop.end(), Some(exit));
            assert_eq!(exit.code(), code);
        }
    }

    #[test]
    fn a_limit_presses_the_button_unless_a_signal_did() {
        for cause in [Cause::Time, Cause::Memory(4_000_000_000)] {
            let stop = Stop::default();
            stop.press(cause);
            assert_eq!(stop.end(), Some(Exit::CouldNotRun));
            let stop = Stop::default();
            stop.flag().store(true, Ordering::SeqCst);
            stop.press(cause);
            assert_eq!(stop.end(), Some(Exit::Interrupted));
        }
    }
}
