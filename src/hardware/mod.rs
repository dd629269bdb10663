//! Hardware put in its place: sockets bored, a yo-yo's halves moved apart, and what the rods weigh.
//!
//! A run with hardware solves for the solid that this room makes of the model. A socket's wall is
//! then outside like any other, and keeps the wall about it; what is not printed adds constant
//! moments ([`Fitted::moments`]).
//!
//! # A yo-yo's halves
//! The model is cut across the axis through the spin point, and the halves are moved by half the
//! string gap each. Seen from the spin point, a grain of the upper half at (x, y, z) then counts as
//! (x, y, z + gap/2). What the extreme interior along g empties (`hollow`) is therefore
//!
//! ```text
//! { q(x, y, z + gap/2) > 0 } of the upper half,    { q(x, y, z − gap/2) > 0 } of the lower,    q = g·m
//! ```
//!
//! one quadric of the ten coefficients g where the halves are, and two quadrics of the same
//! multipliers in the model: q with its z shifted. Nothing of the programmes or their proofs
//! changes but the set of moments that can be reached, so the halves are moved first and everything
//! after works where they will be. Each half is closed towards the gap by a wall of its own, so
//! that the string runs between two faces.
//!
//! Moving halves of mass m/2 apart by a gap g adds m (c g + g²/4) to both moments across the axis,
//! c the distance of a half's centre from the cut, and nothing to the one about it: a gap costs
//! dominance.

mod bore;
mod halves;
#[cfg(test)]
mod tests;
mod top;
mod yoyo;

use crate::goal::{Goal, Hardware, Rod};
use crate::mass::{Moments, RoundBar};
use crate::mesh::{ClipError, Defects, Solid};

pub use bore::SeatError;

/// Room in and around a socket.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowances {
    /// From a rod to its socket, on each side, mm.
    pub clearance_mm: f64,
    /// The least wall about a socket, mm.
    pub wall_mm: f64,
}

/// What a piece of hardware is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A yo-yo's axle.
    Axle,
    /// What sits on the axle besides it.
    Ring,
    /// What a top spins on.
    Tip,
    /// What a top is spun by.
    Stem,
}

impl Kind {
    /// A word for it.
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
    /// What it is.
    pub kind: Kind,
    /// Its shape and place, model frame with the halves where they will be.
    pub bar: RoundBar,
    /// g/cm³.
    pub density_g_cm3: f64,
    /// How far it goes into the object, into each half for an axle, mm.
    pub depth_mm: f64,
    /// The diameter of its socket, mm; zero where it has none.
    pub bore_mm: f64,
}

/// A model with its hardware.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// The model with the sockets in it, its halves moved apart.
    pub solid: Solid,
    /// What is put into it.
    pub pieces: Vec<Piece>,
    /// How far the halves are apart, mm; zero where there is one body.
    pub gap_mm: f64,
}

impl Fitted {
    /// The moments of the hardware, as so much of a material of this density, model frame, mm.
    pub fn moments(&self, density_g_cm3: f64) -> Moments {
        let of = |piece: &Piece| piece.bar.moments() * (piece.density_g_cm3 / density_g_cm3);
        self.pieces
            .iter()
            .map(of)
            .fold(Moments::default(), |sum, piece| sum + piece)
    }
}

/// Why hardware cannot be put in.
#[derive(Debug, thiserror::Error)]
pub enum FitError {
    /// A socket is not in the model.
    #[error(transparent)]
    Seat(#[from] SeatError),
    /// The axis does not leave the model anywhere.
    #[error(
        "the spin axis passes through no part of the model, so that nothing can hold a {0}; give another point"
    )]
    NoAxis(&'static str),
    /// Apart from the halves on the axle, loose pieces would be left.
    #[error(
        "cut across the axis through the spin point, the model falls into {pieces} pieces that cannot stay with either half; \
         remedy: give another --spin-point or --up"
    )]
    Loose {
        /// How many pieces, the halves on the axle among them.
        pieces: usize,
    },
    /// A boolean failed.
    #[error(transparent)]
    Clip(#[from] ClipError),
    /// The result is no solid.
    #[error("the model with its sockets is not a solid: {0}")]
    NotSolid(#[from] Defects),
}

/// The model with its sockets bored, its halves apart, and its hardware in place; none where there
/// is no hardware.
///
/// The rods lie along the goal's axis. Some booleans: about a second for 100 000 triangles.
pub fn fitted(
    solid: &Solid,
    goal: &Goal,
    hardware: &Hardware,
    allowances: &Allowances,
) -> Result<Option<Fitted>, FitError> {
    let workshop = Workshop {
        solid,
        goal,
        allowances,
    };
    match (hardware.axle, hardware.string_gap) {
        (Some(axle), Some(gap)) => {
            yoyo::fitted(&workshop, axle, gap.mm(), hardware.mass_g.unwrap_or(0.0)).map(Some)
        }
        _ if hardware.is_empty() => Ok(None),
        _ => top::fitted(&workshop, hardware.tip, hardware.stem).map(Some),
    }
}

/// What every socket is made in.
struct Workshop<'a> {
    solid: &'a Solid,
    goal: &'a Goal,
    allowances: &'a Allowances,
}

impl Workshop<'_> {
    /// The radius of the socket for a rod, mm.
    fn bore_radius_mm(&self, rod: &Rod) -> f64 {
        rod.radius_mm() + self.allowances.clearance_mm
    }
}
