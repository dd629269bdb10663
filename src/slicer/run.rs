//! A run of a slicer in a folder of its own, with limits of time and memory.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::error::SlicerError;
use super::program::{MOST_GIB, Slicer, limited};
use super::settings::SliceSettings;
use crate::base::watch::Watch;

/// The most time for one plate. A plate of 100 mm figures takes some ten seconds.
const LIMIT: Duration = Duration::from_secs(300);
/// Time between two looks at a run.
const LOOK: Duration = Duration::from_millis(20);
/// The word that the slicer says if it gets no more memory.
const NO_MEMORY: &str = "bad_alloc";
/// What the slicer says of a layer without lines, at exit code 0.
const EMPTY_LAYER: &str = "mpty layer";

/// What the slicer says of a value that it does not know, at exit code 0.
const SUBSTITUTED: &str = "substituted = ";

/// The file of a plate: a 3MF package whose parts lie in their places.
#[derive(Debug, Clone, Copy)]
pub struct PlateFile<'a> {
    /// Its name in the kit, for messages.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
}

impl Slicer {
    /// Slices a plate and returns its toolpaths.
    pub(super) fn slice(
        &self,
        plate: &PlateFile,
        settings: &SliceSettings,
        watch: &Watch,
    ) -> Result<File, SlicerError> {
        let folder = Scratch::new().map_err(SlicerError::Folder)?;
        let [package, ini, log, toolpaths] =
            ["plate.3mf", "settings.ini", "said.txt", "plate.gcode"]
                .map(|file| folder.0.join(file));
        fs::write(&package, plate.bytes).map_err(SlicerError::Folder)?;
        fs::write(&ini, settings.to_ini()).map_err(SlicerError::Folder)?;
        let base = folder.0.join("base.ini");
        if let Some(profile) = settings.profile() {
            fs::write(&base, profile).map_err(SlicerError::Folder)?;
        }
        // Of two values of a key, the later one holds.
        let over: &[&Path] = match settings.profile() {
            Some(_) => &[Path::new("--load"), &base],
            None => &[],
        };
        let said = File::create(&log).map_err(SlicerError::Folder)?;
        let also = said.try_clone().map_err(SlicerError::Folder)?;
        let started = limited(self.command().as_ref())
            .args(["--export-gcode", "--dont-arrange", "--loglevel", "1"])
            .args(over)
            .args([Path::new("--load"), ini.as_path()])
            .args([Path::new("-o"), &toolpaths, &package])
            .env("HOME", &folder.0)
            .current_dir(&folder.0)
            .stdout(Stdio::from(said))
            .stderr(Stdio::from(also))
            .spawn();
        let child = started.map_err(|source| SlicerError::Absent {
            command: self.command().to_owned(),
            source,
        })?;
        let (version, plate) = (self.version().to_owned(), plate.name.to_owned());
        if !Running(child).wait(watch)? {
            let limit_s = LIMIT.as_secs();
            return Err(SlicerError::Slow {
                version,
                plate,
                limit_s,
            });
        }
        // The exit code says little: 0 may come without a file, and with empty layers.
        let words = fs::read_to_string(&log).unwrap_or_default();
        if let Some(fault) = fault_in(&words, &version, &plate) {
            return Err(fault);
        }
        File::open(&toolpaths).map_err(|_| SlicerError::NoToolpaths {
            version,
            plate,
            said: last_line(&words),
        })
    }
}

/// Returns the fault that a slicer names, whatever files it wrote; `None` if it names none.
fn fault_in(words: &str, version: &str, plate: &str) -> Option<SlicerError> {
    let (version, plate) = (version.to_owned(), plate.to_owned());
    if let Some(line) = words.lines().find(|line| line.contains(EMPTY_LAYER)) {
        let said = line.trim().to_owned();
        return Some(SlicerError::EmptyLayer {
            version,
            plate,
            said,
        });
    }
    if let Some(line) = words.lines().find(|line| line.contains(SUBSTITUTED)) {
        let said = line.trim().to_owned();
        return Some(SlicerError::Substituted {
            version,
            plate,
            said,
        });
    }
    words.contains(NO_MEMORY).then_some(SlicerError::Large {
        version,
        plate,
        limit_gib: MOST_GIB,
    })
}

/// Returns the last line that a program said.
fn last_line(words: &str) -> String {
    let mut lines = words.lines().map(str::trim).rev();
    let line = lines.find(|line| !line.is_empty());
    line.unwrap_or("it said nothing").to_owned()
}

/// A program that is killed if nobody waits for it to end.
struct Running(Child);

impl Running {
    /// Waits for its end. Returns false if it was killed after the limit.
    fn wait(mut self, watch: &Watch) -> Result<bool, SlicerError> {
        let since = Instant::now();
        loop {
            watch.check()?;
            if self.0.try_wait().map_err(SlicerError::Folder)?.is_some() {
                return Ok(true);
            }
            if since.elapsed() > LIMIT {
                return Ok(false);
            }
            std::thread::sleep(LOOK);
        }
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        // Neither fails for a program that has ended.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A folder for one run, removed at its end.
#[derive(Debug)]
pub struct Scratch(PathBuf);

impl Scratch {
    /// Makes the folder.
    ///
    /// # Errors
    /// The system's folder for such files cannot be written.
    pub fn new() -> io::Result<Self> {
        static COUNT: AtomicU64 = AtomicU64::new(0);
        let count = COUNT.fetch_add(1, Ordering::Relaxed);
        let name = format!("equipoise-slice-{}-{count}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        // An old folder of a killed run with the same number is of no use to anyone.
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir(&folder)?;
        Ok(Self(folder))
    }

    /// Returns its path.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_folder_of_a_run_is_gone_after_it() {
        let folder = Scratch::new().unwrap();
        let path = folder.0.clone();
        fs::write(path.join("file"), "x").unwrap();
        drop(folder);
        assert!(!path.exists());
    }

    #[test]
    fn empty_layers_and_a_lack_of_memory_are_faults() {
        let fault = |words: &str| fault_in(words, "PrusaSlicer 2.5.0", "plate.3mf");
        assert!(fault("Slicing\nDone").is_none());
        let empty = fault("Slicing\n Empty layer at 2.3 mm\n");
        assert!(
            matches!(empty, Some(SlicerError::EmptyLayer { said, .. }) if said.starts_with("Empty"))
        );
        let line = "\tkey = \"fill_pattern\"\t loaded = \"wavy\tsubstituted = \"stars\"";
        let other = fault(line).unwrap().to_string();
        assert!(other.contains("fill_pattern"), "{other}");
        let large = fault("terminate called after throwing 'std::bad_alloc'").unwrap();
        assert!(large.to_string().contains("more than 8 GiB"), "{large}");
    }

    #[test]
    fn what_a_slicer_said_last_is_told() {
        assert_eq!(last_line("one\n two \n\n"), "two");
        assert_eq!(last_line("\n"), "it said nothing");
    }

    #[test]
    fn a_stopped_watch_ends_a_program_at_once() {
        let child = limited("sleep".as_ref()).arg("60").spawn().unwrap();
        let watch = Watch::silent();
        watch.cancel();
        let since = Instant::now();
        assert!(Running(child).wait(&watch).is_err());
        assert!(since.elapsed() < Duration::from_secs(30));
    }
}
