//! Space that is filled twice.
//!
//! The tetrahedra all have positive volume, so the winding number of their surface counts how many
//! of them hold a point. It changes only across the surface. A surface that passes through itself
//! has a region with 2 beside the crossing. A surface that does not leaves one region inside each
//! shell, and one point in each of them decides.

use super::boundary::Boundary;
use super::error::TetsError;
use super::faces::middle;
use crate::geom::Point;
use crate::mesh::edges::EdgeTable;
use crate::mesh::shells::Shells;
use crate::mesh::{Crossings, WindingNumbers};

/// Winding number above which a point is filled twice: it is a whole number, right to 0.015.
const TWICE: f64 = 1.5;

/// Checks that no space is filled twice.
///
/// # Errors
/// A place where it is.
pub(super) fn check(
    boundary: &Boundary,
    corners: impl Fn(u32) -> [Point; 4],
) -> Result<(), TetsError> {
    let mesh = boundary.mesh();
    if let Crossings {
        pairs,
        first: Some(at),
    } = Crossings::of(mesh)
    {
        return Err(TetsError::Crossing { pairs, at });
    }
    let shells = Shells::of(mesh, &EdgeTable::of(mesh));
    // One shell encloses what is inside it once.
    if shells.count() == 1 {
        return Ok(());
    }
    let filled = WindingNumbers::new(mesh.iter_corners());
    for triangles in shells.members() {
        let Some(&triangle) = triangles.first() else {
            continue;
        };
        let cell = boundary.cell(triangle as usize);
        let at = middle(corners(cell));
        if filled.at(&at) > TWICE {
            let cell = cell as usize;
            return Err(TetsError::FilledTwice { cell, at });
        }
    }
    Ok(())
}
