//! The processor time of this process, by `sysinfo`.

use anyhow::{Context, Result, anyhow};
use sysinfo::{Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// Tells the processor time of this process.
struct Clock {
    system: System,
    process: Pid,
}

impl Clock {
    fn new() -> Result<Self> {
        Ok(Self {
            system: System::new().map_err(|why| anyhow!("{why:?}"))?,
            process: sysinfo::get_current_pid().map_err(|why| anyhow!("{why}"))?,
        })
    }

    /// Returns the processor time of all threads since the process began, s.
    fn seconds(&mut self) -> Result<f64> {
        self.system.refresh_processes_specifics(
            ProcessesToUpdate::Some(&[self.process]),
            false,
            ProcessRefreshKind::nothing().with_cpu().without_tasks(),
        );
        let process = self.system.process(self.process);
        let process = process.context("the system does not tell the processor time")?;
        Ok(process.accumulated_cpu_time() as f64 / 1e3)
    }
}

/// Returns what a search yields, and the processor time that it took on all threads, s.
pub fn timed<T>(search: impl FnOnce() -> Result<T>) -> Result<(T, f64)> {
    let mut clock = Clock::new()?;
    let start_s = clock.seconds()?;
    let found = search()?;
    Ok((found, clock.seconds()? - start_s))
}
