//! Errors in making the parts of a shell.

use crate::base::numbers::measured;
use crate::base::watch::Cancelled;
use crate::mesh::{ClipError, Defects};
use crate::voids::VoidError;

/// The reason that a base gets no shell.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CladdingError {
    /// A length is negative, or not finite.
    #[error("{name} is {value_mm} mm; give a positive length")]
    NotPositive {
        /// Name of the length.
        name: &'static str,
        /// The value given, mm.
        value_mm: f64,
    },
    /// The gap over the panels reaches the surface of the model.
    #[error(
        "the gap of {gap_mm} mm over the panels leaves no shell: the surface is only \
         {distance_mm} mm away"
    )]
    Gap {
        /// The gap, mm.
        gap_mm: f64,
        /// The distance of the base from the surface, mm.
        distance_mm: f64,
    },
    /// The printer's room is too small for any part.
    #[error("the printer's room of {room_mm:.0} mm is narrower than {least_mm:.0} mm, four walls")]
    Room {
        /// The shortest side of the room, mm.
        room_mm: f64,
        /// The least side, mm.
        least_mm: f64,
    },
    /// No cut makes a part fit.
    #[error("no cut makes the part over face {} fit the printer's room", .face + 1)]
    NoCut {
        /// The index of the face.
        face: usize,
    },
    /// Units that bar each other's ways.
    #[error("no order takes the object apart: the units over faces {} bar each other", list(.faces))]
    Cycle {
        /// The indices of their faces in the whole base.
        faces: Vec<usize>,
    },
    /// A polyhedron among several that no side opens.
    #[error(
        "polyhedron {} cannot be closed last: on its way out, every panel meets units of others, \
         those over faces {}", .polyhedron + 1, list(.faces)
    )]
    Enclosed {
        /// The index of the polyhedron.
        polyhedron: usize,
        /// The indices of the faces, in the whole base, whose units bar it.
        faces: Vec<usize>,
    },
    /// Panels of two polyhedra without room for their bolts.
    #[error(
        "the panels between polyhedra {} and {} have room for {found} bolts, and two are needed",
        .polyhedra[0] + 1, .polyhedra[1] + 1
    )]
    NoBolts {
        /// The indices of the polyhedra.
        polyhedra: [usize; 2],
        /// The number of bolts that find a place.
        found: usize,
    },
    /// Panels of two polyhedra without room for the rods between them.
    #[error(
        "two rods {rod} do not join polyhedra {} and {}: {lack}",
        .polyhedra[0] + 1, .polyhedra[1] + 1
    )]
    NoRods {
        /// The indices of the polyhedra.
        polyhedra: [usize; 2],
        /// The id of the thinnest rod that was tried.
        rod: String,
        /// The reason.
        lack: RodLack,
    },
    /// The boolean engine failed.
    #[error("cutting the shell failed")]
    Clip(#[from] ClipError),
    /// A part bounds no solid.
    #[error("a part of the shell is not a solid")]
    Defects(#[from] Defects),
    /// Hollowing failed.
    #[error("hollowing a part of the shell failed")]
    Void(#[from] VoidError),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// A reason why two rods of a kind find no place.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RodLack {
    /// Their faces have no panels.
    #[error("one of the faces between them has no panel")]
    Panels,
    /// Their panels are too small.
    #[error("their panels have no room for both clear of the joints")]
    Joints,
    /// The model is too thin between the panels.
    #[error("the model has no room for both bores with a wall about them")]
    Wall,
    /// The panels are too far apart.
    #[error(
        "they must be {} long, and are sold by {}",
        measured(*.needed_mm, "mm"), measured(*.sold_mm, "mm")
    )]
    Length {
        /// The length that is needed, mm.
        needed_mm: f64,
        /// The length in which they are sold, mm.
        sold_mm: f64,
    },
}

/// Lists indices as numbers from 1.
fn list(indices: &[usize]) -> String {
    let numbers: Vec<String> = indices.iter().map(|at| (at + 1).to_string()).collect();
    numbers.join(", ")
}
