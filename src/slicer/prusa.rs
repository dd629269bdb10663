//! PrusaSlicer and SuperSlicer: they read the plate's package and its orders by themselves.

use std::fs::{self, File};
use std::path::Path;

use super::error::SlicerError;
use super::reword::reword;
use super::run::Work;
use crate::base::dialect::Dialect;
use crate::base::watch::Watch;

/// What they say of a layer without lines, at exit code 0.
const EMPTY_LAYER: &str = "mpty layer";
/// What they say of a value that they do not know, at exit code 0.
const SUBSTITUTED: &str = "substituted = ";

/// Slices a plate and returns its toolpaths.
pub(super) fn slice(work: &Work, watch: &Watch) -> Result<File, SlicerError> {
    let [package, ini, base, toolpaths] =
        ["plate.3mf", "settings.ini", "base.ini", "plate.gcode"].map(|file| work.file(file));
    let own = reword(work, Dialect::Prusa)?;
    let bytes = own.as_deref().unwrap_or(work.plate.bytes);
    fs::write(&package, bytes).map_err(SlicerError::Folder)?;
    fs::write(&ini, work.settings.to_ini()).map_err(SlicerError::Folder)?;
    if let Some(profile) = work.settings.profile() {
        fs::write(&base, profile).map_err(SlicerError::Folder)?;
    }
    // Of two values of a key, the later one holds.
    let over: &[&Path] = match work.settings.profile() {
        Some(_) => &[Path::new("--load"), &base],
        None => &[],
    };
    let said = work.run(watch, |command| {
        command
            .args(["--export-gcode", "--dont-arrange", "--loglevel", "1"])
            .args(over)
            .args([Path::new("--load"), ini.as_path()])
            .args([Path::new("-o"), &toolpaths, &package]);
    })?;
    // The exit code says little: 0 may come without a file, and with empty layers.
    if let Some(fault) = fault_in(&said, work) {
        return Err(fault);
    }
    File::open(&toolpaths).map_err(|_| work.no_toolpaths(&said))
}

/// Returns the fault that the slicer names, whatever files it wrote; `None` if it names none.
fn fault_in(words: &str, work: &Work) -> Option<SlicerError> {
    let (version, plate) = work.names();
    let line_with = |part: &str| {
        let mut lines = words.lines();
        let line = lines.find(|line| line.contains(part));
        line.map(|line| line.trim().to_owned())
    };
    if let Some(said) = line_with(EMPTY_LAYER) {
        return Some(SlicerError::EmptyLayer {
            version,
            plate,
            said,
        });
    }
    line_with(SUBSTITUTED).map(|said| SlicerError::Substituted {
        version,
        plate,
        said,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::slicer::run::tests::work;

    #[test]
    fn empty_layers_and_changed_settings_are_faults() {
        let fault = |words: &str| work(|work| fault_in(words, work));
        assert!(fault("Slicing\nDone").is_none());
        let empty = fault("Slicing\n Empty layer at 2.3 mm\n");
        assert!(
            matches!(empty, Some(SlicerError::EmptyLayer { said, .. }) if said.starts_with("Empty"))
        );
        let line = "\tkey = \"fill_pattern\"\t loaded = \"wavy\tsubstituted = \"stars\"";
        let other = fault(line).unwrap().to_string();
        assert!(other.contains("fill_pattern"), "{other}");
    }
}
