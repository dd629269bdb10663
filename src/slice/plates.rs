//! Slices each plate of a kit, and weighs its toolpaths.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use super::error::SliceError;
use super::row::{PlateSlice, Slices};
use crate::base::digest::sha256_hex;
use crate::base::watch::Watch;
use crate::io::gcode::Toolpath;
use crate::job::Job;
use crate::kit::{Kit, SLICES_FILE};
use crate::printer::{Plate, Printer};
use crate::slicer::{PlateFile, SliceSettings, Slicer};
use crate::verify::{JOB_FILE, KitKind};

/// Largest profile of a slicer, bytes: real ones have some 20 000.
const MOST_PROFILE: u64 = 1_000_000;
/// Decimals of a stated mass, g.
const MASS_DECIMALS: f64 = 100.0;

/// The kit to slice, and the slicer with its profile.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SliceOrder {
    /// The folder of the kit.
    pub kit: PathBuf,
    /// The command of the slicer; `None` for the usual one.
    pub slicer: Option<String>,
    /// A profile of the slicer, whose settings hold where the printer's own profile says nothing.
    pub profile: Option<PathBuf>,
}

impl SliceOrder {
    /// Checks the slicer's profile before any work begins.
    ///
    /// # Errors
    /// The file cannot be read, or it is no profile.
    pub fn check_profile(&self) -> Result<(), SliceError> {
        self.profile
            .as_deref()
            .map_or(Ok(()), |path| read_profile(path).map(drop))
    }
}

/// The toolpaths of a kit.
#[derive(Debug, Clone, PartialEq)]
pub struct Sliced {
    /// The plates and their figures.
    pub slices: Slices,
    /// The toolpaths and `slices.json`, to be written as a folder.
    pub files: Kit,
}

/// Slices every plate of a kit with the settings of its printer's profile.
///
/// # Errors
/// The folder is no kit, its printer prints no filament, there is no such slicer, or a plate
/// cannot be sliced whole.
pub fn slice_kit(order: &SliceOrder, watch: &Watch) -> Result<Sliced, SliceError> {
    let job = read_job(&order.kit)?;
    let printer = Printer::find(&job.printer.id)?;
    let material = printer.material(job.printer.material.as_deref())?;
    let settings = SliceSettings::of(&printer, material).ok_or_else(|| SliceError::NoFilament {
        printer: printer.name.clone(),
    })?;
    let profile = order.profile.as_deref().map(read_profile).transpose()?;
    let profile_sha256 = profile.as_ref().map(|text| sha256_hex(&[text.as_bytes()]));
    let settings = settings.over(profile);
    let names = find_plates(&order.kit)?;
    let slicer = Slicer::find(order.slicer.as_deref())?;
    let mut files = Kit::default();
    let mut plates = Vec::new();
    let count = names.len();
    for name in names {
        watch.check()?;
        watch.advance(plates.len() as f64 / count as f64);
        let path = order.kit.join(&name);
        let bytes = fs::read(&path).map_err(|source| SliceError::Read { path, source })?;
        let plate = PlateFile {
            name: &name,
            bytes: &bytes,
        };
        let sliced = slicer.toolpaths(&plate, &settings, watch)?;
        let toolpaths = name.replace(".3mf", ".gcode");
        let [parts_g, support_g] = masses_g(&sliced.read, settings.density_g_cm3());
        plates.push(PlateSlice {
            toolpaths: toolpaths.clone(),
            minutes: PlateSlice::minutes_of(sliced.estimate.seconds),
            parts_g,
            support_g,
            filament_g: sliced.estimate.filament_g,
            layers: sliced.read.layers,
            plate: name,
        });
        files.add(&toolpaths, sliced.bytes);
    }
    let slices = Slices {
        schema: Slices::SCHEMA,
        job: job.name(),
        slicer: slicer.version().to_owned(),
        is_untried: !slicer.is_tried(),
        profile_sha256,
        plates,
    };
    let text = serde_json::to_string_pretty(&slices)? + "\n";
    files.add(SLICES_FILE, text.into_bytes());
    Ok(Sliced { slices, files })
}

pub(super) fn read_job(folder: &Path) -> Result<Job, SliceError> {
    let path = folder.join(JOB_FILE);
    if !path.is_file() {
        let path = folder.to_owned();
        return Err(SliceError::NoKit { path });
    }
    match KitKind::of(folder) {
        KitKind::Telescope => Err(SliceError::Telescope),
        KitKind::Core => Err(SliceError::Core),
        KitKind::Hollowed => Ok(Job::read(&path)?),
    }
}

/// Reads a profile of a slicer: lines of `key = value`.
pub(super) fn read_profile(path: &Path) -> Result<String, SliceError> {
    let fault = |reason: &str| SliceError::NoProfile {
        path: path.to_owned(),
        reason: reason.to_owned(),
    };
    let read_error = |source: io::Error| SliceError::Read {
        path: path.to_owned(),
        source,
    };
    if fs::metadata(path).map_err(read_error)?.len() > MOST_PROFILE {
        return Err(fault("it is too long"));
    }
    let bytes = fs::read(path).map_err(read_error)?;
    let text = String::from_utf8(bytes).map_err(|_| fault("it is no text"))?;
    let mut lines = text.lines().map(str::trim);
    let is_said = |line: &&str| !(line.is_empty() || line.starts_with(['#', ';']));
    let wrong = lines
        .by_ref()
        .filter(is_said)
        .find(|line| !line.contains('=') || line.starts_with('['));
    match wrong {
        Some(line) if line.starts_with('[') => Err(fault(
            "it is a bundle of several profiles, of which one must be chosen",
        )),
        Some(line) => {
            let start: String = line.chars().take(40).collect();
            Err(fault(&format!("a line is no setting: {start}")))
        }
        None => Ok(text),
    }
}

/// Returns the names of the plates of a kit, in the order of their numbers.
pub(super) fn find_plates(folder: &Path) -> Result<Vec<String>, SliceError> {
    let read_error = |source: io::Error| SliceError::Read {
        path: folder.to_owned(),
        source,
    };
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(read_error)? {
        let name = entry.map_err(read_error)?.file_name();
        let name = name.to_string_lossy().into_owned();
        if Plate::is_file_name(&name) {
            names.push(name);
        }
    }
    if names.is_empty() {
        let path = folder.to_owned();
        return Err(SliceError::NoPlates { path });
    }
    names.sort_by_key(|name| (name.len(), name.clone()));
    Ok(names)
}

/// Returns the masses of the parts, and of all that is taken off them, g.
fn masses_g(read: &Toolpath, density_g_cm3: f64) -> [f64; 2] {
    let tallies = || {
        read.objects
            .iter()
            .flat_map(|object| &object.deposits.tallies)
    };
    let sum_g = |is_part: bool| {
        let those = tallies().filter(|tally| tally.feature.is_part() == is_part);
        let volume_mm3: f64 = those.map(|tally| tally.moments.volume()).sum();
        (volume_mm3 * density_g_cm3 * 1e-3 * MASS_DECIMALS).round() / MASS_DECIMALS
    };
    [sum_g(true), sum_g(false)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a folder of its own for a test, emptied.
    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("equipoise-slice-test-{name}"));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_folder_without_a_job_is_no_kit() {
        let order = SliceOrder {
            kit: folder("no-kit"),
            ..SliceOrder::default()
        };
        let found = slice_kit(&order, &Watch::silent());
        assert!(matches!(found, Err(SliceError::NoKit { .. })), "{found:?}");
    }

    #[test]
    fn plates_are_sliced_in_the_order_of_their_numbers() {
        let folder = folder("plates");
        for name in [
            "plate_10.3mf",
            "plate_2.3mf",
            "plate_1.3mf",
            "plates.3mf",
            "assembly.3mf",
        ] {
            fs::write(folder.join(name), "").unwrap();
        }
        let found = find_plates(&folder).unwrap();
        assert_eq!(found, ["plate_1.3mf", "plate_2.3mf", "plate_10.3mf"]);
    }

    #[test]
    fn profiles_that_are_none_are_named_with_their_fault() {
        let folder = folder("profiles");
        let refused = |name: &str, bytes: &[u8]| {
            let path = folder.join(name);
            fs::write(&path, bytes).unwrap();
            read_profile(&path).unwrap_err().to_string()
        };
        assert!(refused("bundle.ini", b"# x\n[printer:MK4]\na = 1\n").contains("a bundle of"));
        assert!(refused("prose.ini", b"a = 1\nhello\n").contains("no setting: hello"));
        assert!(refused("junk.ini", &[0xff, 0xfe]).contains("no text"));
        let path = folder.join("right.ini");
        fs::write(&path, "# a\n\nperimeters = 3\n").unwrap();
        assert!(read_profile(&path).unwrap().contains("perimeters = 3"));
        assert!(matches!(
            read_profile(&folder.join("absent.ini")),
            Err(SliceError::Read { .. })
        ));
    }
}
