//! A picture as a file of the kit and as a figure of the page.

use maud::{Markup, PreEscaped, html};

use crate::draw::{Drawn, PictureError, Shot, base64};

/// Where on the page a picture belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// The whole, on the cover.
    Cover,
    /// What is inside, beside the cleaning of the voids and on the cover.
    CutAway,
    /// The parts drawn apart, beside the gluing.
    Exploded,
    /// A part in its print pose, in the table of parts.
    Part,
    /// A cut with its pins, beside the dry fit.
    Cut,
    /// The halves of a yo-yo on their axle, beside the hardware.
    Halves,
    /// Mass properties before and after.
    Inertia,
    /// How the proof came about.
    Proof,
}

impl Role {
    /// How its pictures are laid out: two beside each other, or one below the other, drawings with
    /// small words wider.
    fn class(self) -> &'static str {
        match self {
            Self::Cut => "pictures wide",
            Self::Exploded | Self::Halves => "pictures wide whole",
            _ => "pictures",
        }
    }
}

/// A picture as a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Its path in the kit.
    pub file: String,
    /// Where it belongs on the page.
    pub role: Role,
    /// What it is, in a short sentence.
    pub caption: String,
    /// What is to be seen on it, for those who cannot see it.
    pub alt: String,
    /// What is drawn.
    pub drawn: Drawn,
}

impl Picture {
    /// The bytes of its file.
    pub fn bytes(&self) -> Vec<u8> {
        match &self.drawn {
            Drawn::Png(png) => png.clone(),
            Drawn::Svg(drawing) => drawing.to_file(&self.alt).into_bytes(),
        }
    }

    /// The picture itself on the page, without a caption.
    pub(super) fn image(&self) -> Markup {
        match &self.drawn {
            Drawn::Png(png) => {
                html! { img src=(format!("data:image/png;base64,{}", base64(png))) alt=(self.alt); }
            }
            Drawn::Svg(drawing) => PreEscaped(drawing.inline(&self.alt)),
        }
    }
}

/// A picture before it is drawn.
pub(super) struct Draft<'a> {
    pub file: String,
    pub role: Role,
    pub caption: String,
    pub alt: String,
    pub shot: Shot<'a>,
}

impl Draft<'_> {
    /// Draws the picture.
    pub fn draw(&self) -> Result<Picture, PictureError> {
        let (file, caption, alt) = (self.file.clone(), self.caption.clone(), self.alt.clone());
        Ok(Picture {
            file,
            role: self.role,
            caption,
            alt,
            drawn: self.shot.draw()?,
        })
    }
}

/// One picture with its caption.
pub(super) fn figure(picture: &Picture) -> Markup {
    html! { figure { (picture.image()) figcaption { (picture.caption) } } }
}

/// Every picture of a role in a row, if there are any.
pub(super) fn figures(pictures: &[Picture], role: Role) -> Markup {
    html! {
        @if pictures.iter().any(|picture| picture.role == role) {
            div class=(role.class()) { @for picture in pictures.iter().filter(|p| p.role == role) { (figure(picture)) } }
        }
    }
}
