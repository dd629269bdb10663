//! Errors of the extraction of voids.

use crate::base::watch::Cancelled;
use crate::mesh::{ClipError, Defects, MeshError};

/// An error in making the cavity or the voids.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VoidError {
    /// A length is zero, negative or not finite.
    #[error("{name} is {value_mm} mm; give a positive length")]
    NotPositive {
        /// Name of the length.
        name: &'static str,
        /// The value given, mm.
        value_mm: f64,
    },
    /// The wall is too thin for the size of the model.
    #[error(
        "a model of {size_mm} mm cannot be divided into cells of {finest_mm} mm; \
         take a thicker wall"
    )]
    TooFine {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The cells that the wall asks for, mm.
        finest_mm: f64,
    },
    /// Every surface that was drawn violates the wall.
    #[error(
        "no surface leaves a wall of {wall_mm} mm everywhere; \
         repair overlaps of the model or take a thicker wall"
    )]
    WallNotKept {
        /// The wall, mm.
        wall_mm: f64,
    },
    /// The boolean engine failed.
    #[error("cutting the voids out failed")]
    Clip(#[from] ClipError),
    /// A surface did not make a mesh.
    #[error("a void's surface is not a mesh")]
    Mesh(#[from] MeshError),
    /// A void's surface does not bound a solid.
    #[error("a void is not a solid")]
    Defects(#[from] Defects),
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}
