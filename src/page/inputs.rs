//! The inputs of the page.

use super::figure::Picture;
use super::view::View;
use crate::sheet::Checklist;

/// Everything the page shows.
#[derive(Debug, Clone, Copy)]
pub struct PageInputs<'a> {
    /// Job sheet.
    pub sheet: &'a Checklist,
    /// SHA-256 of `checklist.json`, hexadecimal.
    pub sha256: &'a str,
    /// Pictures.
    pub pictures: &'a [Picture],
    /// 3D view for a screen; `None` for a page with pictures only.
    pub view: Option<&'a View>,
}
