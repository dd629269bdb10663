//! Reasons why a telescope cannot be made.

use crate::mesh::{ClipError, Defects};

/// A reason why shells do not nest or turn. Shells are counted from 1, the root first.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TelescopeError {
    /// A measure that is not a number, or out of its range.
    #[error("the {measure} of {value_mm} mm must be {range}")]
    Size {
        /// Which measure.
        measure: &'static str,
        /// Its value, mm.
        value_mm: f64,
        /// The range, in words.
        range: &'static str,
    },
    /// A chain without pieces, or whose pieces and turns do not match.
    #[error(
        "a chain of {pieces} pieces and {turns} turns is no telescope; remedy: give a turn before each piece but the first"
    )]
    Chain {
        /// Number of pieces.
        pieces: usize,
        /// Number of turns.
        turns: usize,
    },
    /// A tube that is too thick for its curvature.
    #[error(
        "shell {shell} is a tube of radius {radius_mm:.1} mm that bends with a radius of \
         {bend_mm:.1} mm; remedy: bend less, use thinner walls, or fewer shells"
    )]
    TooThick {
        /// The shell.
        shell: usize,
        /// Its radius, mm.
        radius_mm: f64,
        /// The radius of its bend, mm.
        bend_mm: f64,
    },
    /// A shell that turns by more than half a circle.
    #[error(
        "shell {shell} bends by {bend_deg:.0}°, more than half a circle; remedy: use more shells"
    )]
    TurnsTooFar {
        /// The shell.
        shell: usize,
        /// The angle, degrees.
        bend_deg: f64,
    },
    /// A turn that parts the centre lines by more than the sliding clearance.
    #[error(
        "the turn of {turn_deg:.0}° before shell {shell} parts the tubes by {offset_mm:.2} mm, more \
         than the clearance of {clearance_mm:.2} mm; remedy: a shorter overlap, more clearance or \
         less curvature"
    )]
    TurnTooGreat {
        /// The shell.
        shell: usize,
        /// The turn, degrees.
        turn_deg: f64,
        /// The distance of the centre lines at the ends of the overlap, mm.
        offset_mm: f64,
        /// The clearance, mm.
        clearance_mm: f64,
    },
    /// A twist stop that leaves too little of the flange.
    #[error(
        "the twist stop before shell {shell} leaves {flange_deg:.0}° of its flange, less than 120°; \
         remedy: a turn nearer to zero"
    )]
    FlangeTooShort {
        /// The shell.
        shell: usize,
        /// The angle that is left, degrees.
        flange_deg: f64,
    },
    /// A shell shorter than its joints.
    #[error(
        "a stroke of {stroke_mm:.1} mm is used up by caps of {closed_mm:.1} mm; remedy: longer shells"
    )]
    NoStroke {
        /// The visible length, mm.
        stroke_mm: f64,
        /// What the caps take of it, mm.
        closed_mm: f64,
    },
    /// A root that is thicker than it may be.
    #[error("the root would be {root_mm:.1} mm in radius, more than {most_mm:.1} mm")]
    RootTooThick {
        /// Its radius, mm.
        root_mm: f64,
        /// The most that was allowed, mm.
        most_mm: f64,
    },
    /// A boolean failed.
    #[error("shell {shell} cannot be made: {error}")]
    Solid {
        /// The shell.
        shell: usize,
        /// The error.
        error: ClipError,
    },
    /// A sweep that is no solid.
    #[error("a sweep is no solid: {0}")]
    Sweep(#[from] Defects),
}
