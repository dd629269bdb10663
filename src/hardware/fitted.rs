//! A model with its hardware in place.

use crate::mass::{Moments, RoundBar};
use crate::mesh::Solid;

/// The kind of a piece of hardware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A yo-yo's axle.
    Axle,
    /// The fittings on a yo-yo's axle.
    Ring,
    /// The tip that a top spins on.
    Tip,
    /// The stem that a top is spun by.
    Stem,
}

impl Kind {
    /// Returns its word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Axle => "axle",
            Self::Ring => "ring",
            Self::Tip => "tip",
            Self::Stem => "stem",
        }
    }
}

/// A piece of hardware in its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// The kind.
    pub kind: Kind,
    /// Its shape and place, model frame with the halves moved apart.
    pub bar: RoundBar,
    /// The density, g/cm³.
    pub density_g_cm3: f64,
    /// The depth inside the object, mm; for an axle inside each half.
    pub depth_mm: f64,
    /// The diameter of its socket, mm; zero if it has none.
    pub bore_mm: f64,
}

/// A model with its hardware.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The model with its sockets, its halves moved apart.
    pub solid: Solid,
    /// The hardware.
    pub pieces: Vec<Piece>,
    /// The gap between the halves, mm; zero for one body.
    pub gap_mm: f64,
}

impl Fitted {
    /// Returns the moments of the hardware, model frame, mm, counted as volumes of a material of
    /// this density.
    pub fn moments(&self, density_g_cm3: f64) -> Moments {
        let of = |piece: &Piece| piece.bar.moments() * (piece.density_g_cm3 / density_g_cm3);
        self.pieces
            .iter()
            .map(of)
            .fold(Moments::default(), |sum, piece| sum + piece)
    }
}
