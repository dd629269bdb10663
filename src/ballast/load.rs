//! The chosen ballast: parts at their places, and their effect on the body.

use super::pocket::{Fit, Pocket};
use super::stock::Part;
use crate::geom::Frame;
use crate::interior::Columns;
use crate::mass::{Lump, Moments};

/// A stock part at its place.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacedPart {
    /// The part.
    pub part: Part,
    /// Its mass, centre and axis, model frame.
    pub lump: Lump,
}

/// Parts in pockets, within a body printed of some density.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Load {
    /// The parts, in the order they were placed.
    pub parts: Vec<PlacedPart>,
    /// The clearance and the web of their pockets.
    pub fit: Fit,
    /// The density of the print, g/mm³.
    pub density_g_mm3: f64,
}

impl Load {
    /// Returns true if there is no ballast.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Returns the mass of all parts, g.
    pub fn mass_g(&self) -> f64 {
        self.parts.iter().map(|placed| placed.lump.mass_g).sum()
    }

    /// Returns the load with one more part.
    pub fn with(&self, placed: PlacedPart) -> Self {
        let mut more = self.clone();
        more.parts.push(placed);
        more
    }

    /// Returns the load without one part.
    pub fn without(&self, index: usize) -> Self {
        let mut fewer = self.clone();
        fewer.parts.remove(index);
        fewer
    }

    /// Returns the pockets, in the order of the parts.
    pub fn pockets(&self) -> impl Iterator<Item = Pocket> + '_ {
        self.parts
            .iter()
            .map(|placed| Pocket::of(&placed.lump, self.fit.clearance_mm))
    }

    /// Returns the pockets with the material that must stay around them.
    pub fn jackets(&self) -> impl Iterator<Item = Pocket> + '_ {
        self.pockets().map(|pocket| pocket.grown(self.fit.web_mm))
    }

    /// Returns the moments that the parts alone add to a body of the print's density, model frame.
    pub fn moments(&self) -> Moments {
        let of_part = |placed: &PlacedPart| placed.lump.moments(self.density_g_mm3);
        self.parts
            .iter()
            .map(of_part)
            .fold(Moments::default(), |sum, part| sum + part)
    }

    /// Returns the moments of the parts less those of their pockets, model frame.
    pub fn excess(&self) -> Moments {
        self.pockets()
            .fold(self.moments(), |sum, pocket| sum - pocket.moments())
    }

    /// Removes the pockets, with the material that must stay around them, from the columns of a
    /// frame.
    pub fn carve(&self, columns: Columns, frame: &Frame) -> Columns {
        self.jackets().fold(columns, |columns, jacket| {
            columns.without(&jacket.mesh().in_frame(frame))
        })
    }
}
