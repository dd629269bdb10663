//! A run of a slicer in a folder of its own, with limits of time and memory.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use super::error::SlicerError;
use super::program::{MOST_GIB, Slicer, limited};
use super::settings::SliceSettings;
use crate::base::watch::Watch;

/// The most time for one plate. A plate of 100 mm figures takes some ten seconds. One of 200 mm
/// with six densities, beside other work, takes more than five minutes.
const LIMIT: Duration = Duration::from_secs(1800);
/// Time between two looks at a run.
const LOOK: Duration = Duration::from_millis(20);
/// The word that a slicer says if it gets no more memory.
const NO_MEMORY: &str = "bad_alloc";

/// The file of a plate: a 3MF package whose parts lie in their places.
#[derive(Debug, Clone, Copy)]
pub struct PlateFile<'a> {
    /// Its name in the kit, for messages.
    pub name: &'a str,
    /// Its bytes.
    pub bytes: &'a [u8],
}

/// A plate to be sliced, in a folder of its own.
pub(super) struct Work<'a> {
    /// The slicer.
    pub slicer: &'a Slicer,
    /// The plate.
    pub plate: &'a PlateFile<'a>,
    /// What the slicer must know besides.
    pub settings: &'a SliceSettings,
    /// The folder.
    pub folder: &'a Path,
}

impl Work<'_> {
    /// Returns the path of a file in its folder.
    pub fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Returns the names of the slicer and of the plate, for messages.
    pub fn names(&self) -> (String, String) {
        (self.slicer.version().to_owned(), self.plate.name.to_owned())
    }

    /// Makes the fault that no toolpaths were written, with the last line that was said.
    pub fn no_toolpaths(&self, words: &str) -> SlicerError {
        let (version, plate) = self.names();
        SlicerError::NoToolpaths {
            version,
            plate,
            said: last_line(words),
        }
    }

    /// Runs the slicer in its folder, with limits of time and memory. Returns what it said.
    pub fn run(
        &self,
        watch: &Watch,
        add_arguments: impl FnOnce(&mut Command),
    ) -> Result<String, SlicerError> {
        let log = self.file("said.txt");
        let said = File::create(&log).map_err(SlicerError::Folder)?;
        let also = said.try_clone().map_err(SlicerError::Folder)?;
        let mut command = limited(self.slicer.command().as_ref());
        add_arguments(&mut command);
        let started = command
            .env("HOME", self.folder)
            .current_dir(self.folder)
            .stdout(Stdio::from(said))
            .stderr(Stdio::from(also))
            .spawn();
        let child = started.map_err(|source| SlicerError::Absent {
            command: self.slicer.command().to_owned(),
            source,
        })?;
        let (version, plate) = self.names();
        if !Running(child).wait(watch)? {
            let limit_s = LIMIT.as_secs();
            return Err(SlicerError::Slow {
                version,
                plate,
                limit_s,
            });
        }
        let words = fs::read(&log).map_err(SlicerError::Folder)?;
        let words = String::from_utf8_lossy(&words).into_owned();
        if words.contains(NO_MEMORY) {
            return Err(SlicerError::Large {
                version,
                plate,
                limit_gib: MOST_GIB,
            });
        }
        Ok(words)
    }
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
pub(super) mod tests {
    use super::*;
    use crate::printer::Printer;

    /// Calls back with a plate to be sliced by a program that says what it was called with.
    pub fn work<T>(then: impl FnOnce(&Work) -> T) -> T {
        let printer = Printer::find("prusa-mk4").unwrap();
        let settings = SliceSettings::of(&printer, &printer.materials[0]).unwrap();
        let folder = Scratch::new().unwrap();
        then(&Work {
            slicer: &Slicer::test("echo"),
            plate: &PlateFile {
                name: "plate.3mf",
                bytes: &[],
            },
            settings: &settings,
            folder: folder.path(),
        })
    }

    #[test]
    fn the_folder_of_a_run_is_gone_after_it() {
        let folder = Scratch::new().unwrap();
        let path = folder.0.clone();
        fs::write(path.join("file"), "x").unwrap();
        drop(folder);
        assert!(!path.exists());
    }

    #[test]
    fn a_lack_of_memory_is_a_fault() {
        let run = |said: &str| {
            let said = said.to_owned();
            work(|work| {
                work.run(&Watch::silent(), |command| {
                    command.arg(said);
                })
            })
        };
        assert_eq!(run("Slicing").unwrap().trim(), "Slicing");
        let large = run("terminate called after throwing 'std::bad_alloc'").unwrap_err();
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
