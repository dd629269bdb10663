//! Unpacks the parts of a package from its archive, up to a bound on the unpacked size.

use std::io::{Cursor, Read};

use zip::{ZipArchive, result::ZipError};

use super::error::{Limit, ThreeMfError, xml_fault};
use super::names::{MODEL_PART, MODEL_TYPE};
use super::xml::Scanner;

/// Unpacked size allowed for a file of any size, bytes. Small files compress best and do no harm.
const FREE_BYTES: u64 = 16 << 20;

/// An open package.
pub struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// Number of bytes that may still be unpacked.
    left: u64,
}

impl<'a> Archive<'a> {
    /// Opens the archive in these bytes.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ThreeMfError> {
        let zip = ZipArchive::new(Cursor::new(bytes)).map_err(archive_fault("the archive"))?;
        Ok(Self {
            zip,
            left: FREE_BYTES + bytes.len() as u64 * Limit::Unpacked.most(),
        })
    }

    /// Returns the name of the part that holds the model, as the package's relationships say.
    /// Returns the usual name if they do not.
    pub fn root_part(&mut self) -> Result<String, ThreeMfError> {
        let relationships = match self.text("_rels/.rels") {
            Err(ThreeMfError::NoModel { .. }) => return Ok(MODEL_PART.to_owned()),
            text => text?,
        };
        let mut scanner = Scanner::new("_rels/.rels", &relationships);
        while let Some(tag) = scanner.next_tag()? {
            if tag.name() == "Relationship" && tag.get("Type")?.as_deref() == Some(MODEL_TYPE) {
                return Ok(part_name(&tag.get("Target")?.unwrap_or_default()));
            }
        }
        Ok(MODEL_PART.to_owned())
    }

    /// Unpacks a part and returns its text.
    pub fn text(&mut self, part: &str) -> Result<String, ThreeMfError> {
        let mut file = match self.zip.by_name(part) {
            Err(ZipError::FileNotFound) => {
                return Err(ThreeMfError::NoModel {
                    part: part.to_owned(),
                });
            }
            file => file.map_err(archive_fault(part))?,
        };
        let mut bytes = Vec::new();
        let unpacked = file.by_ref().take(self.left + 1).read_to_end(&mut bytes);
        let unpacked = unpacked.map_err(|error| archive_fault(part)(error.into()))? as u64;
        self.left = self
            .left
            .checked_sub(unpacked)
            .ok_or(ThreeMfError::TooMuch {
                limit: Limit::Unpacked,
            })?;
        let text = String::from_utf8(bytes);
        text.map_err(|_| xml_fault(part, 1, "its text is not UTF-8"))
    }
}

/// Returns the name in the archive of the part at this path.
pub fn part_name(path: &str) -> String {
    path.trim_start_matches('/').to_owned()
}

fn archive_fault(part: &str) -> impl Fn(ZipError) -> ThreeMfError {
    move |error| ThreeMfError::Archive {
        part: part.to_owned(),
        reason: error.to_string(),
    }
}
