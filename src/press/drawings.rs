//! Drawing the pictures of a kit, and printing its pages.

use super::faces::faces;
use super::layout::Layout;
use crate::base::watch::Watch;
use crate::cut::CutError;
use crate::draw::PictureError;
use crate::error::Error;
use crate::page::{self, PageInputs, Picture, View};
use crate::sheet::Checklist;
use crate::verify::{CERTIFICATE_FILE, SHEET_FILE};

/// The pictures of a kit, and the view that can be turned.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawings {
    /// The pictures, in the order in which they were drawn.
    pub pictures: Vec<Picture>,
    /// The view.
    pub view: View,
}

/// A reason why the pictures of a kit are not drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PressError {
    /// A section cannot be made.
    #[error(transparent)]
    Section(#[from] CutError),
    /// A picture cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

impl From<PressError> for Error {
    fn from(error: PressError) -> Self {
        match error {
            PressError::Section(error) => error.into(),
            PressError::Picture(error) => error.into(),
        }
    }
}

impl Layout<'_> {
    /// Draws the pictures that show the parts alone, and the view. The same on any number of
    /// threads.
    ///
    /// # Errors
    /// A picture cannot be encoded, or the watch was stopped.
    pub fn draw_parts(&self, watch: &Watch) -> Result<Drawings, PictureError> {
        let subject = self.subject();
        let (pictures, view) = rayon::join(
            || page::render_pictures(&subject, watch),
            || View::of(&subject, watch),
        );
        Ok(Drawings {
            pictures: pictures?,
            view: view?,
        })
    }

    /// Adds the pictures that show numbers of the sheet.
    ///
    /// # Errors
    /// A section or a picture cannot be made, or the watch was stopped.
    pub fn draw_figures(
        &self,
        sheet: &Checklist,
        drawings: &mut Drawings,
        watch: &Watch,
    ) -> Result<(), PressError> {
        let faces = faces(self, watch)?;
        let figures = page::draw_figures(sheet, &self.subject(), &faces, watch)?;
        drawings.pictures.extend(figures);
        Ok(())
    }
}

impl Drawings {
    /// Prints the pages for people, with their names: the job sheet and the certificate.
    ///
    /// `sha256` is the hash of `checklist.json`.
    pub fn print(&self, sheet: &Checklist, sha256: &str) -> [(&'static str, String); 2] {
        let inputs = PageInputs {
            sheet,
            sha256,
            pictures: &self.pictures,
            view: Some(&self.view),
        };
        [
            (SHEET_FILE, page::job(&inputs)),
            (CERTIFICATE_FILE, page::certificate(&inputs)),
        ]
    }
}
