//! A kit in memory as it is filled: files first, then the papers that tell their hashes.

use serde::Serialize;

use super::{Prepared, Unwritable, json};
use crate::base::digest::sha256_hex;
use crate::kit::Kit;
use crate::sheet::KindSheet;
use crate::verify::{CHECKLIST_FILE, SUMS_FILE, sums};

/// A kit whose files are complete but for the pages.
pub struct Papers<S> {
    kit: Kit,
    /// The checklist, with the hashes of the files.
    pub sheet: S,
    /// The hash of the checklist's text.
    pub sha256: String,
}

impl<S: KindSheet + Serialize> Papers<S> {
    /// Lists the files of a kit in its checklist, and adds that.
    ///
    /// # Errors
    /// The checklist cannot be put into JSON.
    pub fn listed(mut kit: Kit, mut sheet: S) -> Result<Self, Unwritable> {
        let hashed = |(file, bytes): (&str, &[u8])| (file.to_owned(), sha256_hex(&[bytes]));
        sheet.list_files(kit.files().map(hashed).collect());
        let text = json(CHECKLIST_FILE, &sheet)?;
        let sha256 = sha256_hex(&[text.as_bytes()]);
        kit.add(CHECKLIST_FILE, text.into_bytes());
        Ok(Self { kit, sheet, sha256 })
    }

    /// Returns the kit with its pages and the hashes of all files.
    pub fn sealed(self, pages: impl IntoIterator<Item = (&'static str, String)>) -> Prepared<S> {
        let mut kit = self.kit;
        for (file, page) in pages {
            kit.add(file, page.into_bytes());
        }
        let list = sums(kit.files());
        kit.add(SUMS_FILE, list.into_bytes());
        Prepared {
            kit,
            checklist: self.sheet,
        }
    }
}
