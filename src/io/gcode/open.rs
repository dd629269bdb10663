//! Reads a file of G-code in any of its packings; the content decides which.

use std::fs::File;
use std::io::{BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use super::bgcode;
use super::error::{GcodeError, ReadGcodeError};
use super::parse::{Options, read_text};
use super::plates;
use super::toolpath::Plate;
use crate::base::watch::Watch;

/// Bytes that are read at once.
const CHUNK: usize = 1 << 16;

/// Reads the plates of a file: G-code as text or as Prusa's binary, or a sliced 3MF of Bambu's.
///
/// The content decides the packing, not the name. Memory does not grow with the file. A text or a
/// binary file has one plate, a 3MF one or more.
///
/// # Errors
/// Names the file, and the line or the part of the package at fault.
pub fn read_gcode(
    path: &Path,
    options: &Options,
    watch: &Watch,
) -> Result<Vec<Plate>, ReadGcodeError> {
    let file = File::open(path).map_err(|source| ReadGcodeError::Unopened {
        path: path.to_owned(),
        source,
    })?;
    let plates = read_plates(BufReader::with_capacity(CHUNK, file), options, watch);
    plates.map_err(|source| ReadGcodeError::Content {
        path: path.to_owned(),
        source,
    })
}

/// Reads the plates of a file that is open; see [`read_gcode`].
///
/// # Errors
/// Names the line or the part of the package at fault.
pub fn read_plates(
    mut input: impl BufRead + Seek,
    options: &Options,
    watch: &Watch,
) -> Result<Vec<Plate>, GcodeError> {
    let unreadable = |source| GcodeError::Unreadable { line: 0, source };
    let mut magic = Vec::new();
    let start = input.by_ref().take(4).read_to_end(&mut magic);
    start.map_err(unreadable)?;
    input.seek(SeekFrom::Start(0)).map_err(unreadable)?;
    let toolpath = match magic.as_slice() {
        plates::MAGIC => return plates::read(input, options, watch),
        bgcode::MAGIC => {
            let text = bgcode::Text::open(input)?;
            read_text(BufReader::with_capacity(CHUNK, text), options, watch)?
        }
        _ => read_text(input, options, watch)?,
    };
    Ok(vec![Plate {
        number: None,
        toolpath,
    }])
}
