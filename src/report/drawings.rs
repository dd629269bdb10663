//! The pictures that need the numbers of the sheet: cuts with their lengths, mass properties, and
//! the plots of the proof.

use super::cut_drawing::{self, CutFace};
use super::figure::Picture;
use super::picture::PictureError;
use super::{Checklist, Sitting, inertia, plot};

/// Draws them; the same bytes on any number of threads.
pub fn drawings(
    sheet: &Checklist,
    sitting: &Sitting,
    faces: &[CutFace],
) -> Result<Vec<Picture>, PictureError> {
    let mut drawings = cut_drawing::drawings(sheet, faces);
    drawings.extend(inertia::pictures(sheet, sitting)?);
    drawings.extend(plot::plots(sheet));
    Ok(drawings)
}
