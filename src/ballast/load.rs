//! The ballast that was decided on: parts at their places, and what they do to the body.

use super::{Fit, Part, Pocket};
use crate::geom::Frame;
use crate::interior::Columns;
use crate::mass::{Lump, Moments};

/// A stock part at its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The part.
    pub part: Part,
    /// Its mass, centre and axis, model frame.
    pub lump: Lump,
}

/// Parts in pockets, and how they change a body printed of some density.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Load {
    /// The parts, in the order they were placed.
    pub parts: Vec<Placed>,
    /// How they lie in their pockets.
    pub fit: Fit,
    /// The density of the print, g/mm³.
    pub density_g_mm3: f64,
}

impl Load {
    /// Whether there is no ballast.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// The mass of all parts, g.
    pub fn mass_g(&self) -> f64 {
        self.parts.iter().map(|placed| placed.lump.mass_g).sum()
    }

    /// With one more.
    pub fn with(&self, placed: Placed) -> Self {
        let mut more = self.clone();
        more.parts.push(placed);
        more
    }

    /// Without one of them.
    pub fn without(&self, index: usize) -> Self {
        let mut fewer = self.clone();
        fewer.parts.remove(index);
        fewer
    }

    /// The pockets, in the order of the parts.
    pub fn pockets(&self) -> impl Iterator<Item = Pocket> + '_ {
        self.parts
            .iter()
            .map(|placed| Pocket::of(&placed.lump, self.fit.clearance_mm))
    }

    /// The pockets with the material that must stay around them.
    pub fn jackets(&self) -> impl Iterator<Item = Pocket> + '_ {
        self.pockets().map(|pocket| pocket.grown(self.fit.web_mm))
    }

    /// What the parts alone add to a body of the print's density, model frame.
    pub fn moments(&self) -> Moments {
        let of_part = |placed: &Placed| placed.lump.moments(self.density_g_mm3);
        self.parts
            .iter()
            .map(of_part)
            .fold(Moments::default(), |sum, part| sum + part)
    }

    /// What the parts add less what their pockets take away, model frame.
    pub fn excess(&self) -> Moments {
        self.pockets()
            .fold(self.moments(), |sum, pocket| sum - pocket.moments())
    }

    /// The columns of a frame without the pockets and what must stay around them.
    pub fn carved(&self, columns: Columns, frame: &Frame) -> Columns {
        self.jackets().fold(columns, |columns, jacket| {
            columns.without(&jacket.mesh().in_frame(frame))
        })
    }
}
