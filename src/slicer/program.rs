//! Finding a slicer, and asking for its version.

use std::ffi::OsStr;
use std::process::{Command, Stdio};

use super::error::SlicerError;

/// The command by which the slicer is known if none is asked for.
const USUAL: &str = "prusa-slicer";
/// The names of the slicers whose options are known.
const KNOWN: [&str; 2] = ["PrusaSlicer", "SuperSlicer"];

/// A slicer that is installed here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slicer {
    /// The command that starts it.
    command: String,
    /// Its name and version, such as `PrusaSlicer 2.5.0`.
    version: String,
}

impl Slicer {
    /// Finds the slicer of a command, or the usual one, and asks for its version.
    ///
    /// # Errors
    /// It cannot be started, or does not name itself as a known one.
    pub fn find(command: Option<&str>) -> Result<Self, SlicerError> {
        let command = command.unwrap_or(USUAL).to_owned();
        let output = quiet(command.as_ref()).arg("--help").output();
        let output = output.map_err(|source| SlicerError::Absent {
            command: command.clone(),
            source,
        })?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let version = said.lines().find_map(version_of);
        match version {
            Some(version) => Ok(Self { command, version }),
            None => Err(SlicerError::Unknown { command }),
        }
    }

    /// Returns its name and version, such as `PrusaSlicer 2.5.0`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Returns the command that starts it.
    pub fn command(&self) -> &str {
        &self.command
    }
}

/// Returns a command without input, without windows and with no more of the environment than it
/// needs to start.
pub(super) fn quiet(program: &OsStr) -> Command {
    let mut command = Command::new(program);
    let path = std::env::var_os("PATH").unwrap_or_default();
    command
        .env_clear()
        .env("PATH", path)
        .env("LC_ALL", "C")
        .stdin(Stdio::null());
    command
}

/// Most memory that a slicer may ask for, GiB. The plate of an elephant of 128 mm takes less than
/// one.
pub(super) const MOST_GIB: u64 = 8;

/// Returns a command as [`quiet`] does, with a limit of memory where the system has a shell that
/// sets one.
pub(super) fn limited(program: &OsStr) -> Command {
    if !cfg!(unix) {
        return quiet(program);
    }
    const KIB_PER_GIB: u64 = 1 << 20;
    let limit_kib = MOST_GIB * KIB_PER_GIB;
    let mut command = quiet("sh".as_ref());
    // The shell becomes the slicer, so that it can be stopped as one. A lower limit of the user's
    // own stays.
    command
        .args([
            "-c",
            &format!("ulimit -v {limit_kib} 2>/dev/null; exec \"$@\""),
            "sh",
        ])
        .arg(program)
        // Else every thread of a large machine reserves memory that it does not use.
        .env("MALLOC_ARENA_MAX", "2");
    command
}

/// Returns the name and version in a line such as `PrusaSlicer-2.5.0+dfsg based on Slic3r`.
fn version_of(line: &str) -> Option<String> {
    let first = line.split_whitespace().next()?;
    let (name, version) = first.split_once('-')?;
    let is_number = |c: char| c.is_ascii_digit() || c == '.';
    let number: String = version.chars().take_while(|c| is_number(*c)).collect();
    (KNOWN.contains(&name) && !number.is_empty()).then(|| format!("{name} {number}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slicer_is_known_by_the_first_line_of_its_help() {
        let line = "PrusaSlicer-2.5.0+UNKNOWN based on Slic3r (with GUI support)";
        assert_eq!(version_of(line).as_deref(), Some("PrusaSlicer 2.5.0"));
        let line = "SuperSlicer-2.4.58 based on Slic3r";
        assert_eq!(version_of(line).as_deref(), Some("SuperSlicer 2.4.58"));
        for line in [
            "",
            "Cura-4.13",
            "PrusaSlicer",
            "PrusaSlicer-beta",
            "usage: x",
        ] {
            assert_eq!(version_of(line), None, "{line}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_slicer_runs_with_a_limit_of_memory_and_with_its_own_arguments() {
        let output = limited("sh".as_ref())
            .args(["-c", "ulimit -v; echo \"$0\"", "two words"])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        let lines: Vec<&str> = said.lines().collect();
        let [limit, argument] = lines[..] else {
            panic!("{said}")
        };
        assert!(limit.parse::<u64>().unwrap() <= MOST_GIB << 20, "{limit}");
        assert_eq!(argument, "two words");
    }

    #[test]
    fn a_program_that_is_no_slicer_is_named() {
        let absent = Slicer::find(Some("no-such-slicer-anywhere"));
        let Err(SlicerError::Absent { command, .. }) = absent else {
            panic!("{absent:?}")
        };
        assert_eq!(command, "no-such-slicer-anywhere");
        assert!(matches!(
            Slicer::find(Some("echo")),
            Err(SlicerError::Unknown { .. })
        ));
    }
}
