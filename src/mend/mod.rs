//! Mending: the model as its owner ordered it, by the ladder of repairs and by a new surface.
//!
//! [`mend`] is what every command does to a file that it has read. The ladder is in
//! [`crate::repair`], the new surface in [`Soup`](crate::voids::Soup).
//!
//! * `error`: the reasons why a model cannot be mended
//!
//! * `redraw`: the new surface, drawn until it is as near to the old one as it must be

mod error;
mod redraw;

use crate::base::watch::Watch;
use crate::mesh::TriMesh;
use crate::repair::{RepairOrder, Repairs, repair_with, settle_inner};
use redraw::redraw;

pub use error::MendError;

/// A model that was mended.
#[derive(Debug, Clone)]
pub struct Mended {
    /// The mesh, in the numbers of its file. Nobody has proved it yet.
    pub mesh: TriMesh,
    /// The factor from these numbers to mm.
    pub scale_ratio: f64,
    /// The report of what was changed.
    pub repairs: Repairs,
}

/// Mends a mesh as ordered; returns it with the report of what was changed.
///
/// `factor` gives the factor to mm for a longest side in the file's numbers. Tolerances count in
/// the size that is printed. See [`Solid::new`](crate::mesh::Solid::new) and
/// [`one_body`](crate::repair::one_body) for the proof of the result.
///
/// # Errors
/// The new surface cannot be drawn, or the watch was stopped.
pub fn mend(
    mesh: TriMesh,
    order: RepairOrder,
    factor: impl Fn(f64) -> f64,
    watch: &Watch,
) -> Result<Mended, MendError> {
    let (mesh, mut repairs) = repair_with(mesh, order.inner, watch)?;
    let mesh = match order.remesh {
        None => mesh,
        Some(how) => {
            let (mesh, redrawn) = redraw(&mesh, how, &factor, watch)?;
            repairs.redrawn = Some(redrawn);
            settle_inner(mesh, order.inner, &mut repairs, watch)?
        }
    };
    Ok(Mended {
        scale_ratio: factor(mesh.longest_side_mm()),
        mesh,
        repairs,
    })
}

#[cfg(test)]
mod tests;
