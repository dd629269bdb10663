//! Finding a slicer, and asking for its version.

use std::ffi::OsStr;
use std::process::{Command, Stdio};

use super::error::SlicerError;

/// The command by which the slicer is known if none is asked for.
const USUAL: &str = "prusa-slicer";
/// The names by which a slicer may be asked for, beside its own command.
const NICKNAMES: [(&str, &str); 2] = [("cura", "CuraEngine"), ("curaengine", "CuraEngine")];
/// The words by which programs tell what they are. CuraEngine has no option for it.
const QUESTIONS: [&str; 2] = ["--help", "help"];

/// A family of slicers that are run alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// PrusaSlicer and SuperSlicer.
    Prusa,
    /// OrcaSlicer and Bambu Studio.
    Orca,
    /// Cura's engine.
    Cura,
}

/// The names by which slicers call themselves, before their version, with the names that people
/// know.
const KNOWN: [(&str, &str, Family); 5] = [
    ("PrusaSlicer-", "PrusaSlicer", Family::Prusa),
    ("SuperSlicer-", "SuperSlicer", Family::Prusa),
    ("OrcaSlicer-", "OrcaSlicer", Family::Orca),
    ("BambuStudio-", "Bambu Studio", Family::Orca),
    ("Cura_SteamEngine version ", "CuraEngine", Family::Cura),
];

/// A slicer that is installed here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Slicer {
    /// The command that starts it.
    command: String,
    /// Its name and version, such as `PrusaSlicer 2.5.0`.
    version: String,
    family: Family,
}

impl Slicer {
    /// Finds the slicer of a command or a name, or the usual one, and asks for its version.
    ///
    /// # Errors
    /// It cannot be started, or does not name itself as a known one.
    pub fn find(command: Option<&str>) -> Result<Self, SlicerError> {
        let asked = command.unwrap_or(USUAL);
        let nickname = NICKNAMES
            .iter()
            .find(|(name, _)| name.eq_ignore_ascii_case(asked));
        let command = nickname.map_or(asked, |(_, command)| command).to_owned();
        for question in QUESTIONS {
            let output = quiet(command.as_ref()).arg(question).output();
            let output = output.map_err(|source| SlicerError::Absent {
                command: command.clone(),
                source,
            })?;
            // Some say it as an error.
            let said = [output.stdout, output.stderr].concat();
            let said = String::from_utf8_lossy(&said).into_owned();
            if let Some((version, family)) = said.lines().find_map(version_of) {
                return Ok(Self {
                    command,
                    version,
                    family,
                });
            }
        }
        Err(SlicerError::Unknown { command })
    }

    /// Returns its name and version, such as `PrusaSlicer 2.5.0`.
    pub fn version(&self) -> &str {
        &self.version
    }

    /// Returns the command that starts it.
    pub fn command(&self) -> &str {
        &self.command
    }

    /// Makes one of a command that nobody asks.
    #[cfg(test)]
    pub(super) fn test(command: &str) -> Self {
        Self {
            command: command.to_owned(),
            version: "PrusaSlicer 2.5.0".to_owned(),
            family: Family::Prusa,
        }
    }

    /// Returns whether this program was tried with a slicer of its family.
    pub fn is_tried(&self) -> bool {
        self.family != Family::Orca
    }

    /// Returns its family.
    pub(super) fn family(&self) -> Family {
        self.family
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

/// Returns the name and version in a line such as `PrusaSlicer-2.5.0+dfsg based on Slic3r`, with
/// the family.
fn version_of(line: &str) -> Option<(String, Family)> {
    let line = line.trim();
    let known = KNOWN.iter();
    let mut known = known.filter_map(|(own, name, family)| {
        let version = line.strip_prefix(own)?;
        Some((version, name, *family))
    });
    let (version, name, family) = known.next()?;
    let is_number = |c: &char| c.is_ascii_digit() || *c == '.';
    let number: String = version.chars().take_while(is_number).collect();
    (!number.is_empty()).then(|| (format!("{name} {number}"), family))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slicer_is_known_by_a_line_of_its_help() {
        for (line, version, family) in [
            (
                "PrusaSlicer-2.5.0+UNKNOWN based on Slic3r (with GUI support)",
                "PrusaSlicer 2.5.0",
                Family::Prusa,
            ),
            (
                "SuperSlicer-2.4.58 based on Slic3r",
                "SuperSlicer 2.4.58",
                Family::Prusa,
            ),
            ("OrcaSlicer-2.3.2:", "OrcaSlicer 2.3.2", Family::Orca),
            (
                "Cura_SteamEngine version 4.13.0",
                "CuraEngine 4.13.0",
                Family::Cura,
            ),
        ] {
            assert_eq!(version_of(line), Some((version.to_owned(), family)));
        }
        for line in [
            "",
            "Cura-4.13",
            "Cura_SteamEngine version master",
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
