//! Prusa's archive of layer images: SL1 and SL1S.

use std::collections::BTreeMap;
use std::io::{Cursor, Read, Seek, Write};

use zip::{CompressionMethod, ZipArchive, ZipWriter, write::SimpleFileOptions};

use super::error::{LayersError, package_fault, setting_fault};
use super::frame::ImageFrame;

/// The part with the print's own settings.
pub(super) const CONFIG: &str = "config.ini";
/// The part with all settings of the slicer.
pub(super) const SLICER_CONFIG: &str = "prusaslicer.ini";
/// Bytes of a part with settings that are read.
const MOST_CONFIG: u64 = 1 << 22;
/// Longest length of a display or a layer, mm.
pub(super) const MOST_MM: f64 = 10_000.0;

/// The settings of an archive, as `key = value` lines.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sl1Settings(pub BTreeMap<String, String>);

impl Sl1Settings {
    /// Reads lines of `key = value`; others are skipped.
    pub fn of_text(text: &str) -> Self {
        let pairs = text.lines().filter_map(|line| line.split_once('='));
        let trimmed = pairs.map(|(key, value)| (key.trim().to_owned(), value.trim().to_owned()));
        Self(trimmed.collect())
    }

    /// Returns a length, mm, if it is one above zero and sane.
    pub fn length(&self, key: &str) -> Option<f64> {
        let value: f64 = self.0.get(key)?.parse().ok()?;
        (value > 0.0 && value < MOST_MM).then_some(value)
    }

    fn count(&self, key: &str) -> Option<u32> {
        self.0.get(key)?.parse().ok().filter(|count| *count > 0)
    }

    /// Returns the names of the layers among those of an archive, from the first on.
    ///
    /// They are numbered without gaps behind the name of the job. Another image beside them is no
    /// layer.
    pub(super) fn layer_names(&self, all: &[String]) -> Result<Vec<String>, LayersError> {
        let job = self.0.get("jobDir");
        let number = |name: &String| {
            let stem = name
                .strip_suffix(".png")
                .filter(|stem| !stem.contains('/'))?;
            let digits = stem.len() - stem.trim_end_matches(|c: char| c.is_ascii_digit()).len();
            let (prefix, number) = stem.split_at(stem.len() - digits.min(5));
            let is_of_job = job.is_none_or(|job| job == prefix);
            Some((
                number.parse::<usize>().ok().filter(|_| is_of_job)?,
                name.clone(),
            ))
        };
        let mut layers: Vec<(usize, String)> = all.iter().filter_map(number).collect();
        layers.sort();
        let first = layers.first().map_or(0, |(number, _)| *number);
        let stated = ["numFast", "numSlow"].map(|key| self.0.get(key));
        let stated = stated.map(|text| text.and_then(|text| text.parse::<usize>().ok()));
        let count = match stated {
            [None, None] => layers.len(),
            counts => counts.into_iter().flatten().fold(0, usize::saturating_add),
        };
        let is_right = |at: usize| {
            layers
                .get(at)
                .is_some_and(|(number, _)| *number == first + at)
        };
        if let Some(layer) = (0..count.max(layers.len())).find(|at| !is_right(*at)) {
            return Err(LayersError::MissingLayer {
                layer: first + layer,
            });
        }
        Ok(layers.into_iter().map(|(_, name)| name).collect())
    }

    fn is_set(&self, key: &str) -> bool {
        self.0.get(key).is_some_and(|value| value == "1")
    }

    /// Returns the place of the display's pixels on the plate, whose corner is at zero; `None` with
    /// the key that is missing or wrong.
    ///
    /// PrusaSlicer lays columns along x and rows against y. On a display that stands upright both
    /// are exchanged, which is a mirror image that its mirror setting takes back.
    pub fn frame(&self) -> Result<ImageFrame, &'static str> {
        let number = |key: &'static str| self.length(key).ok_or(key);
        let mut size_mm = [number("display_width")?, number("display_height")?];
        let whole = |key: &'static str| self.count(key).ok_or(key);
        let mut count = [whole("display_pixels_x")?, whole("display_pixels_y")?];
        let stands = self
            .0
            .get("display_orientation")
            .is_some_and(|way| way == "portrait");
        let mirrors = ["display_mirror_x", "display_mirror_y"].map(|key| self.is_set(key));
        let is_forward = [mirrors[0] == stands, mirrors[1]];
        if stands {
            size_mm.swap(0, 1);
            count.swap(0, 1);
        }
        let frame = ImageFrame {
            column_axis: usize::from(stands),
            signs: is_forward.map(|forward| if forward { 1.0 } else { -1.0 }),
            origin_mm: [0, 1].map(|way| if is_forward[way] { 0.0 } else { size_mm[way] }),
            pitch_mm: [0, 1].map(|way| size_mm[way] / f64::from(count[way])),
            count,
        };
        frame
            .is_display()
            .then_some(frame)
            .ok_or("display_pixels_x")
    }
}

/// Reads the two parts with settings as one; those of the print come first.
pub(super) fn read_settings<R: Read + Seek>(
    zip: &mut ZipArchive<R>,
) -> Result<Sl1Settings, LayersError> {
    let mut all = Sl1Settings::default();
    for part in [SLICER_CONFIG, CONFIG] {
        let Ok(file) = zip.by_name(part) else {
            return Err(package_fault(part, "it is missing"));
        };
        let mut text = String::new();
        file.take(MOST_CONFIG)
            .read_to_string(&mut text)
            .map_err(|error| package_fault(part, error))?;
        all.0.extend(Sl1Settings::of_text(&text).0);
    }
    Ok(all)
}

/// Returns the heights of the first layer and of the others, mm.
pub(super) fn layer_heights(settings: &Sl1Settings) -> Result<[f64; 2], LayersError> {
    let usual_mm = settings
        .length("layerHeight")
        .ok_or_else(|| setting_fault(CONFIG, "layerHeight"))?;
    let first_mm = settings.length("initial_layer_height").unwrap_or(usual_mm);
    Ok([first_mm, usual_mm])
}

/// Packs images as an archive for a machine: its settings, then the layers from the first on.
///
/// # Errors
/// The archive grows beyond what its format holds.
pub fn encode_sl1(
    name: &str,
    parts: &[(&str, String)],
    images: &[Vec<u8>],
) -> Result<Vec<u8>, zip::result::ZipError> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let packed = SimpleFileOptions::default()
        .last_modified_time(zip::DateTime::DEFAULT)
        .compression_method(CompressionMethod::Deflated);
    // Images are packed already.
    let stored = packed.compression_method(CompressionMethod::Stored);
    for (part, text) in parts {
        zip.start_file(*part, packed)?;
        zip.write_all(text.as_bytes())?;
    }
    for (layer, image) in images.iter().enumerate() {
        zip.start_file(format!("{name}{layer:05}.png"), stored)?;
        zip.write_all(image)?;
    }
    Ok(zip.finish()?.into_inner())
}
