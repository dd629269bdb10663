//! Ctrl-C and requests to end: the first stops the command, a second ends the process at once. A
//! time that is over stops it too.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;
use std::{io, process, thread};

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

use super::exit::Exit;
use super::show::say;

/// The line on the standard error when a command was stopped.
const STOPPED: &str = "stopped; nothing was written";
/// The line on the standard error when the time of a command was over.
const TIMED_OUT: &str =
    "error: the time that was given is over; nothing was written\n  remedy: give it more time";
/// The time between two looks at a stop button. A person takes less for at once.
const LOOK: Duration = Duration::from_millis(50);

/// A stop button for a command, pressed by the first SIGINT or SIGTERM, or once its time is over.
#[derive(Debug, Clone, Default)]
pub struct Stop {
    is_pressed: Arc<AtomicBool>,
    /// The number of the signal that pressed it; 0 before.
    signal: Arc<AtomicUsize>,
    /// True if it was pressed because the time was over.
    is_over: Arc<AtomicBool>,
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

    /// Returns a button that signals press from now on, and that is pressed after this time.
    pub fn within(timeout: Option<Duration>) -> Self {
        let stop = Self::on_signals();
        if let Some(timeout) = timeout {
            let timed = stop.clone();
            thread::spawn(move || {
                thread::sleep(timeout);
                timed.end_time();
            });
        }
        stop
    }

    /// Presses the button because the time is over, unless a signal did before.
    fn end_time(&self) {
        if !self.is_pressed.load(Ordering::SeqCst) {
            self.is_over.store(true, Ordering::SeqCst);
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
        if self.is_over.load(Ordering::SeqCst) {
            say(TIMED_OUT);
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
    fn a_time_that_is_over_presses_the_button_unless_a_signal_did() {
        let stop = Stop::default();
        stop.end_time();
        assert_eq!(stop.end(), Some(Exit::CouldNotRun));
        let stop = Stop::default();
        stop.flag().store(true, Ordering::SeqCst);
        stop.end_time();
        assert_eq!(stop.end(), Some(Exit::Interrupted));
    }
}
