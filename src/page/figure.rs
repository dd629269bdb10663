//! A picture as a file of the kit and as a figure of the page.

use maud::{Markup, PreEscaped, html};

use crate::draw::{Drawn, PictureError, Shot, base64};

/// The place of a picture on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// Cover: the whole.
    Cover,
    /// Cover: the whole cut open.
    CutAway,
    /// Gluing: the parts drawn apart.
    Exploded,
    /// Table of parts: a part in its print pose.
    Part,
    /// Print: a plate from above.
    Plate,
    /// Table of parts: a part from below, with what support touches.
    Below,
    /// Clean: a drain hole, seen straight into it.
    Drain,
    /// Join: both faces of a joint, opened like a book.
    Joint,
    /// Join: the object in a jig.
    Jig,
    /// Certificate: a cut with its dimensions.
    Cut,
    /// Hardware: the halves of a yo-yo on their axle.
    Halves,
    /// Proof: mass properties before.
    Inertia,
    /// Proof: mass properties as made.
    Made,
    /// Test: the centre of mass and the axis.
    Test,
    /// Proof: plots of the search.
    Proof,
    /// Telescope: a state of its opening.
    State,
    /// Telescope: a pose.
    Pose,
    /// Telescope: one joint cut open.
    CutJoint,
    /// Screw on: the parts of a unit that pins join, drawn apart.
    Bench,
    /// Screw on: the ballast in a base that is open on one side.
    Ballast,
}

impl Role {
    /// Returns the CSS class of its pictures: side by side, or wider for drawings with small words.
    fn class(self) -> &'static str {
        match self {
            Self::Cut | Self::CutJoint | Self::Bench | Self::Ballast => "pictures wide",
            Self::Exploded | Self::Halves => "pictures wide whole",
            Self::Joint => "pictures joints",
            Self::Plate => "pictures plates",
            _ => "pictures",
        }
    }
}

/// A picture as a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Path in the kit.
    pub file: String,
    /// Place on the page.
    pub role: Role,
    /// Caption, a short sentence.
    pub caption: String,
    /// Description for those who cannot see it.
    pub alt: String,
    /// Image itself.
    pub drawn: Drawn,
}

impl Picture {
    /// Returns the bytes of its file.
    pub fn bytes(&self) -> Vec<u8> {
        match &self.drawn {
            Drawn::Png(png) => png.clone(),
            Drawn::Svg(drawing) => drawing.to_file(&self.alt).into_bytes(),
        }
    }

    /// Returns the image on the page, without a caption.
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
    /// Path in the kit.
    pub file: String,
    /// Place on the page.
    pub role: Role,
    /// Caption.
    pub caption: String,
    /// Description for those who cannot see it.
    pub alt: String,
    /// Scene.
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

/// Returns a picture with its caption.
pub(super) fn figure(picture: &Picture) -> Markup {
    html! { figure { (picture.image()) figcaption { (picture.caption) } } }
}

/// Returns the pictures of a role in a row; nothing if there are none.
pub(super) fn figures(pictures: &[Picture], role: Role) -> Markup {
    figures_of(pictures, &[role])
}

/// Returns the pictures of several roles in a row that looks like the first role's.
pub(super) fn figures_of(pictures: &[Picture], roles: &[Role]) -> Markup {
    let is_wanted = |picture: &&Picture| roles.contains(&picture.role);
    let mut of_role = pictures.iter().filter(is_wanted).peekable();
    let class = roles.first().map_or("pictures", |role| role.class());
    html! {
        @if of_role.peek().is_some() {
            div class=(class) { @for picture in of_role { (figure(picture)) } }
        }
    }
}
