//! The voids as solids: the region that may be emptied, once, and its part inside a quadric, for each quadric.

mod cavity;
mod extract;
mod field;
mod lattice;
mod march;
mod nodes;
mod octree;
mod roots;
mod table;
mod wall_field;

use crate::mesh::{ClipError, Csg, MeshError, Solid};
use crate::progress::Progress;
use crate::shell::Keep;

/// What must stay solid, and how closely the surface of the rest is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CavitySpec<'a> {
    /// The wall that stays under the model's surface, mm.
    pub wall_mm: f64,
    /// How far the voids' surface may stray from the true one on flat and smoothly curved places, mm.
    pub tolerance_mm: f64,
    /// What else stays solid.
    pub keeps: &'a [Keep],
}

/// Why no voids could be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum VoidError {
    /// A length that must be positive is not.
    #[error("{name} is {value_mm} mm; give a positive length")]
    NotPositive {
        /// Which length.
        name: &'static str,
        /// What it is.
        value_mm: f64,
    },
    /// The wall is too thin for the size of the model.
    #[error("a model of {size_mm} mm cannot be divided into cells of {finest_mm} mm; take a thicker wall")]
    TooFine {
        /// The model's longest side, mm.
        size_mm: f64,
        /// The cells that the wall asks for, mm.
        finest_mm: f64,
    },
    /// No surface was found that leaves the wall.
    #[error(
        "no surface leaves a wall of {wall_mm} mm everywhere; repair overlaps of the model or take a thicker wall"
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
    /// The caller asked to stop.
    #[error("stopped on request")]
    Cancelled,
}

/// The whole region that may be emptied.
#[derive(Clone)]
pub struct Cavity {
    body: Csg,
}

impl Cavity {
    /// The region of `solid` farther from its surface than the wall and outside the keeps.
    pub fn extract(solid: &Solid, spec: &CavitySpec, progress: &Progress) -> Result<Self, VoidError> {
        for (name, value_mm) in [("the wall", spec.wall_mm), ("the tolerance", spec.tolerance_mm)] {
            if !(value_mm > 0.0 && value_mm.is_finite()) {
                return Err(VoidError::NotPositive { name, value_mm });
            }
        }
        Ok(Self { body: cavity::extract(solid, spec, progress)? })
    }

    /// Its surface.
    pub fn body(&self) -> &Csg {
        &self.body
    }
}
