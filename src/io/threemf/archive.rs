//! The archive of a package: its parts unpacked, no further than their size justifies.

use std::io::{Cursor, Read};

use zip::{ZipArchive, result::ZipError};

use super::{Limit, MODEL_PART, MODEL_TYPE, ThreeMfError, xml::Scanner};

/// What may be unpacked whatever the size of the file, bytes: small files are packed best, and hurt
/// nobody.
const FREE_BYTES: u64 = 16 << 20;

/// An open package.
pub struct Archive<'a> {
    zip: ZipArchive<Cursor<&'a [u8]>>,
    /// How many more bytes may be unpacked.
    left: u64,
}

impl<'a> Archive<'a> {
    /// Opens the archive in these bytes.
    pub fn open(bytes: &'a [u8]) -> Result<Self, ThreeMfError> {
        let zip = ZipArchive::new(Cursor::new(bytes)).map_err(damaged("the archive"))?;
        Ok(Self {
            zip,
            left: FREE_BYTES + bytes.len() as u64 * Limit::Unpacked.most(),
        })
    }

    /// The name of the part that holds the model: where the package's relationships lead, else
    /// where it usually is.
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

    /// The text of a part.
    pub fn text(&mut self, part: &str) -> Result<String, ThreeMfError> {
        let mut file = match self.zip.by_name(part) {
            Err(ZipError::FileNotFound) => {
                return Err(ThreeMfError::NoModel {
                    part: part.to_owned(),
                });
            }
            file => file.map_err(damaged(part))?,
        };
        let mut bytes = Vec::new();
        let unpacked = file.by_ref().take(self.left + 1).read_to_end(&mut bytes);
        let unpacked = unpacked.map_err(|error| damaged(part)(error.into()))? as u64;
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

/// The name in the archive of a part that is told by its path.
pub fn part_name(path: &str) -> String {
    path.trim_start_matches('/').to_owned()
}

/// A fault of a part's text.
pub fn xml_fault(part: &str, line: usize, reason: &str) -> ThreeMfError {
    ThreeMfError::Xml {
        part: part.to_owned(),
        line,
        reason: reason.to_owned(),
    }
}

fn damaged(part: &str) -> impl Fn(ZipError) -> ThreeMfError {
    move |error| ThreeMfError::Archive {
        part: part.to_owned(),
        reason: error.to_string(),
    }
}
