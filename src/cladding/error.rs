//! Errors in making the parts of a shell.

use crate::base::numbers::measured;
use crate::base::watch::Cancelled;
use crate::geom::{Plane, Point, Vector};
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
    #[error(
        "no order takes the object apart: the units over faces {} wait for each other. {}",
        list(.faces), barring(.parts)
    )]
    Cycle {
        /// The indices of their faces in the whole base.
        faces: Vec<usize>,
        /// The parts that bar each other, each with the next one in its way.
        parts: Vec<PartPlace>,
        /// A cut after which all come apart; `None` if no cut that was tried frees them.
        cut: Option<Box<FreeingCut>>,
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

/// A part of the shell, where a person finds it in the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PartPlace {
    /// The index of the face below it, in the whole base.
    pub face: usize,
    /// The middle of its box.
    pub middle: Point,
}

impl std::fmt::Display for PartPlace {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let face = self.face + 1;
        write!(
            f,
            "the part over face {face} about {} mm",
            place_words(&self.middle)
        )
    }
}

/// A cut by which units that bar each other come apart. It was tried.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeingCut {
    /// The part that is cut.
    pub part: PartPlace,
    /// The plane of the cut; its normal points to the piece that leaves first.
    pub plane: Plane,
    /// The direction in which it leaves, a unit vector.
    pub way: Vector,
    /// The middle of that piece's box.
    pub piece: Point,
    /// The volume of that piece, mm³.
    pub volume_mm3: f64,
    /// The area of the cut, mm².
    pub area_mm2: f64,
}

impl FreeingCut {
    /// Returns the place of the piece that leaves first, in words: the middle of its box, mm.
    pub fn piece_words(&self) -> String {
        place_words(&self.piece)
    }
}

/// Writes a place in the model in whole millimetres.
fn place_words(at: &Point) -> String {
    let [x, y, z] = [at.x, at.y, at.z].map(|mm| mm.round() + 0.0);
    format!("({x}, {y}, {z})")
}

/// Names parts that bar each other.
fn barring(parts: &[PartPlace]) -> String {
    let names: Vec<String> = parts.iter().map(PartPlace::to_string).collect();
    match names.as_slice() {
        [] => "None of them finds a way".to_owned(),
        names => format!("In each other's way are {}", names.join(", and ")),
    }
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
