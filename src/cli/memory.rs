//! The memory that this process uses, by `sysinfo`, and the most that it may.

use sysinfo::{MemoryRefreshKind, Pid, ProcessRefreshKind, ProcessesToUpdate, System};

/// The part of the machine's memory that a command may take if nothing else is said. With more the
/// system ends some process, or all become slow.
const MACHINE_RATIO: f64 = 0.9;

/// A look at the memory of this process.
#[derive(Debug)]
pub struct Gauge {
    system: System,
    process: Pid,
    /// The most that may be used, bytes.
    pub limit_bytes: u64,
}

impl Gauge {
    /// Returns a gauge with this limit in bytes, or with nearly all that the machine has.
    ///
    /// It is `None` where the system does not tell what a process uses.
    pub fn new(limit_bytes: Option<u64>) -> Option<Self> {
        let mut system = System::new().ok()?;
        system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
        // A container may have less than its machine.
        let group = system.cgroup_limits().map(|group| group.total_memory);
        let machine = group.unwrap_or(u64::MAX).min(system.total_memory());
        let mut gauge = Self {
            system,
            process: sysinfo::get_current_pid().ok()?,
            limit_bytes: limit_bytes.unwrap_or((MACHINE_RATIO * machine as f64) as u64),
        };
        let is_told = gauge.limit_bytes > 0 && gauge.used_bytes() > 0;
        is_told.then_some(gauge)
    }

    /// Returns the memory that this process uses, bytes; 0 if the system does not tell.
    pub fn used_bytes(&mut self) -> u64 {
        self.system.refresh_processes_specifics(
            ProcessesToUpdate::Some(&[self.process]),
            false,
            ProcessRefreshKind::nothing().with_memory().without_tasks(),
        );
        let process = self.system.process(self.process);
        process.map_or(0, sysinfo::Process::memory)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gauge_sees_what_is_taken() {
        let mut gauge = Gauge::new(None).unwrap();
        let machine = gauge.limit_bytes;
        let before = gauge.used_bytes();
        let held = vec![1_u8; 200_000_000];
        let after = gauge.used_bytes();
        // Other tests of this process take and give back memory meanwhile.
        assert!(after > before + 100_000_000, "{before} {after}");
        assert!(machine > after, "{machine} {after}");
        assert_eq!(held.len(), 200_000_000);
        assert_eq!(Gauge::new(Some(123)).unwrap().limit_bytes, 123);
    }
}
