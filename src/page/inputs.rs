//! What the page is made of.

use super::figure::Picture;
use super::view::View;
use crate::sheet::Checklist;

/// Everything the page shows.
#[derive(Debug, Clone, Copy)]
pub struct PageInputs<'a> {
    /// The job sheet.
    pub sheet: &'a Checklist,
    /// The SHA-256 of the job sheet as it is written for machines, hexadecimal.
    pub sha256: &'a str,
    /// The pictures.
    pub pictures: &'a [Picture],
    /// What can be turned and taken apart on a screen; none where there are pictures only.
    pub view: Option<&'a View>,
}
