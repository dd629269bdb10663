//! Curves in space, and the chains of helices that come near them. Lengths are in mm, angles in
//! radians, curvature and torsion in 1/mm.
//!
//! A rigid tube that touches its rigid sleeve everywhere can only move by one constant twist. So
//! the shells of a telescope are pieces of helices, and a curve must be met by a chain of them.
//! (Yu, Crane and Coros, "Computational Design of Telescoping Structures", ACM TOG 36(4), 2017.)
//!
//! * **What is asked:** [`Curve`], a checked polyline, or a spline through points; [`NamedCurve`],
//!   arcs and helices by their measures.
//! * **Differential quantities:** [`DiscreteFrames`] (bends and twists), [`flow_heat`].
//! * **What can be built:** [`Helix`], and a [`Chain`] of helices with turns between them.
//! * **From one to the other:** [`StepFit`] fits turns to the torsion, which is where [`fit`]
//!   begins; it fits positions. [`trade`] does it over the number of pieces.
//! * **How near it is:** [`Deviation`] at equal shares of the length, [`frechet_mm`] and
//!   [`hausdorff_mm`]; [`least_gap_mm`] between strands of the tube.

mod chain;
mod deviation;
mod embedding;
mod error;
mod fit;
mod frames;
mod heat;
mod helix;
mod named;
mod points;
mod spline;
mod steps;

#[cfg(test)]
mod samples;

pub use chain::Chain;
pub use deviation::{Deviation, frechet_mm, hausdorff_mm};
pub use embedding::least_gap_mm;
pub use error::{CurveError, NameError};
pub use fit::{
    Ends, Fit, FitError, FitRequest, Freedom, TradeRow, TurnBound, first_guess, fit, trade,
};
pub use frames::DiscreteFrames;
pub use heat::flow_heat;
pub use helix::{Helix, Twist, roll};
pub use named::NamedCurve;
pub use points::{Corner, Curve, MOST_POINTS};
pub use steps::{StepFit, TurnSample};
