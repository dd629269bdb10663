//! Sliced packages of Bambu Studio and OrcaSlicer: a 3MF with the G-code of its plates.

use std::collections::HashMap;
use std::io::{BufReader, Read, Seek};

use quick_xml::events::{BytesStart, Event};
use zip::ZipArchive;

use super::error::{GcodeError, Limit, package_fault, through_io};
use super::parse::{Options, read_text};
use super::toolpath::Plate;
use crate::base::watch::Watch;

/// The first bytes of an archive.
pub const MAGIC: &[u8] = b"PK\x03\x04";
/// The part with the names of objects and the slicer's estimates.
const SLICE_INFO: &str = "Metadata/slice_info.config";
/// Bytes of that part that are read.
const MOST_INFO: u64 = 1 << 24;
/// Unpacked size allowed for a file of any size, bytes.
const FREE_BYTES: u64 = 16 << 20;
/// Bytes that are read at once.
const CHUNK: usize = 1 << 16;

/// Reads every sliced plate of a package, in the order of their numbers.
pub fn read(
    mut input: impl Read + Seek,
    options: &Options,
    watch: &Watch,
) -> Result<Vec<Plate>, GcodeError> {
    let archive = |error| package_fault("the archive", error);
    let bytes = input.seek(std::io::SeekFrom::End(0));
    let bytes = bytes.map_err(|source| GcodeError::Unreadable { line: 0, source })?;
    let mut zip = ZipArchive::new(input).map_err(archive)?;
    let mut left = FREE_BYTES.saturating_add(bytes.saturating_mul(Limit::Unpacked.most()));
    let names = names(&mut zip);
    let names_of_parts = zip.file_names().filter_map(Result::ok);
    let mut parts: Vec<(u32, String)> = names_of_parts.filter_map(|n| plate_part(&n)).collect();
    parts.sort();
    if parts.len() as u64 > Limit::Plates.most() {
        let limit = Limit::Plates;
        return Err(GcodeError::TooMuch { line: 0, limit });
    }
    let mut plates = Vec::new();
    for (number, part) in parts {
        let file = zip
            .by_name(&part)
            .map_err(|error| package_fault(&part, error))?;
        let mut bounded = Bounded { file, left };
        let input = BufReader::with_capacity(CHUNK, &mut bounded);
        let mut toolpath = read_text(input, options, watch)?;
        left = bounded.left;
        for label in toolpath
            .objects
            .iter_mut()
            .filter_map(|object| object.label.as_mut())
        {
            let name = label.id.and_then(|id| names.get(&id));
            label.name = name.cloned().unwrap_or_else(|| label.name.clone());
        }
        let number = Some(number);
        plates.push(Plate { number, toolpath });
    }
    if plates.is_empty() {
        return Err(GcodeError::NoPlate);
    }
    Ok(plates)
}

/// Returns the number of the plate that a part holds; `None` for other parts.
fn plate_part(name: &str) -> Option<(u32, String)> {
    let number = name
        .strip_prefix("Metadata/plate_")?
        .strip_suffix(".gcode")?;
    Some((number.parse().ok()?, name.to_owned()))
}

/// Returns the names of objects by their numbers; empty if the package gives none.
fn names(zip: &mut ZipArchive<impl Read + Seek>) -> HashMap<i64, String> {
    let mut text = String::new();
    if let Ok(file) = zip.by_name(SLICE_INFO) {
        // Names are a comfort: without them objects keep their numbers.
        let _ = file.take(MOST_INFO).read_to_string(&mut text);
    }
    let mut reader = quick_xml::Reader::from_str(&text);
    let mut names = HashMap::new();
    while let Ok(event) = reader.read_event() {
        match event {
            Event::Start(tag) | Event::Empty(tag) => names.extend(named_object(&tag)),
            Event::Eof => break,
            _ => {}
        }
    }
    names
}

/// Returns the number and the name of an object; `None` for other tags.
fn named_object(tag: &BytesStart) -> Option<(i64, String)> {
    if tag.name().as_ref() != "object" {
        return None;
    }
    let value = |key: &str| {
        let attribute = tag.try_get_attribute(key).ok()??;
        Some(
            quick_xml::escape::unescape(&attribute.value)
                .ok()?
                .into_owned(),
        )
    };
    Some((value("identify_id")?.parse().ok()?, value("name")?))
}

/// A part that may unpack to a bounded size only.
struct Bounded<R> {
    file: R,
    left: u64,
}

impl<R: Read> Read for Bounded<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let read = self.file.read(buffer)?;
        self.left = self.left.checked_sub(read as u64).ok_or_else(|| {
            let limit = Limit::Unpacked;
            through_io(GcodeError::TooMuch { line: 0, limit })
        })?;
        Ok(read)
    }
}
