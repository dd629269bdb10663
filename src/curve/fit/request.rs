//! What is asked of a fit, checked.

use crate::curve::error::CurveError;

/// The most pieces of a chain: nested shells are some dozen at most.
const MOST_PIECES: usize = 200;

/// Samples of each piece during the descent. Between them a piece turns by little.
pub(super) const FIT_SAMPLES: usize = 8;

/// How many values a quantity of the pieces takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Freedom {
    /// Zero for all pieces.
    Zero,
    /// One value for all pieces.
    One,
    /// A value for each piece.
    Each,
}

/// The ends of the chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// They come as near to those of the curve as the rest.
    Free,
    /// They lie on those of the curve, to 1e-3 of the misfit they would have.
    Pinned,
}

/// How far a turn may part neighbours that slide in each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TurnBound {
    /// What stays inside of a piece that is all out, mm. It turns about the middle of this.
    pub overlap_mm: f64,
    /// The greatest distance of their centre lines at the ends of the overlap, mm.
    pub offset_mm: f64,
}

impl TurnBound {
    /// Returns the offset over κ and the sine of half of the turn, mm²: (o/2)².
    pub(super) fn lever_mm2(&self) -> f64 {
        0.25 * self.overlap_mm * self.overlap_mm
    }
}

/// What a chain must be like, and what it pays for.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRequest {
    /// Number of pieces.
    pub pieces: usize,
    /// The values that curvature takes.
    pub curvature: Freedom,
    /// The values that torsion takes.
    pub torsion: Freedom,
    /// The greatest curvature of a piece, 1/mm. A tube of radius b needs κ b < 1.
    pub max_curvature: f64,
    /// The greatest torsion of a piece either way, 1/mm.
    pub max_torsion: f64,
    /// The price β of the misfit of neighbours that nest. The sum of its squares over all joints
    /// counts β² as much as the mean square of the distances.
    pub nesting_price: f64,
    /// The price of a turn between pieces, mm²/rad. Without one all turns are taken.
    pub impulse_price: f64,
    /// The bound of e = κ (o/2)² sin(|θ|/2) at every turn; `None` if turns part nothing.
    pub turn_bound: Option<TurnBound>,
    /// The ends of the chain.
    pub ends: Ends,
    /// The radius of the tube of each piece, mm; empty for a line without a body.
    pub body_mm: Vec<f64>,
}

/// A reason why no chain can be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FitError {
    /// The curve has a corner.
    #[error(transparent)]
    Curve(#[from] CurveError),
    /// Another number of pieces than can be.
    #[error("a chain of {pieces} pieces cannot be fitted; remedy: ask for 1 to {most}")]
    Pieces {
        /// Number of pieces.
        pieces: usize,
        /// The most there may be.
        most: usize,
    },
    /// A bound or price that is negative or no number.
    #[error("the {quantity} must be a number of at least zero; it is {value}")]
    Quantity {
        /// Which bound or price.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Another number of radii than pieces.
    #[error("{radii} radii are given for {pieces} pieces; remedy: give one for each, or none")]
    Radii {
        /// Number of radii.
        radii: usize,
        /// Number of pieces.
        pieces: usize,
    },
}

impl FitRequest {
    /// Asks for pieces with their own curvature and torsion, free turns and free ends.
    pub fn new(pieces: usize, max_curvature: f64, max_torsion: f64) -> Self {
        Self {
            pieces,
            curvature: Freedom::Each,
            torsion: Freedom::Each,
            max_curvature,
            max_torsion,
            nesting_price: 0.3,
            impulse_price: 0.0,
            turn_bound: None,
            ends: Ends::Free,
            body_mm: Vec::new(),
        }
    }

    /// Refuses what cannot be fitted.
    pub(super) fn check(&self) -> Result<(), FitError> {
        if !(1..=MOST_PIECES).contains(&self.pieces) {
            return Err(FitError::Pieces {
                pieces: self.pieces,
                most: MOST_PIECES,
            });
        }
        let numbers = [
            ("greatest curvature", self.max_curvature),
            ("greatest torsion", self.max_torsion),
            ("price of nesting", self.nesting_price),
            ("price of turns", self.impulse_price),
        ];
        let of_turns = self.turn_bound.iter().flat_map(|bound| {
            [
                ("overlap", bound.overlap_mm),
                ("offset of turns", bound.offset_mm),
            ]
        });
        let numbers = numbers.into_iter().chain(of_turns);
        let radii = self.body_mm.iter().map(|radius| ("radius", *radius));
        let is_bad = |value: f64| !(value.is_finite() && value >= 0.0);
        let mut all = numbers.chain(radii);
        if let Some((quantity, value)) = all.find(|(_, value)| is_bad(*value)) {
            return Err(FitError::Quantity { quantity, value });
        }
        match self.body_mm.len() {
            0 => Ok(()),
            radii if radii == self.pieces => Ok(()),
            radii => Err(FitError::Radii {
                radii,
                pieces: self.pieces,
            }),
        }
    }

    /// Asks for half as many pieces, whose answer is then split; `None` for odd or few pieces.
    pub(super) fn halved(&self) -> Option<Self> {
        let is_even = self.pieces.is_multiple_of(2) && self.pieces > 2;
        is_even.then(|| Self {
            pieces: self.pieces / 2,
            body_mm: self.body_mm.iter().step_by(2).copied().collect(),
            ..self.clone()
        })
    }
}
