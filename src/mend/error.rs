//! The reasons why a model cannot be mended.

use crate::base::setting::{Key, Setting};
use crate::base::watch::Cancelled;
use crate::geom::Point;
use crate::voids::VoidError;

/// A reason why a model could not be mended as ordered.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MendError {
    /// The new surface cannot be drawn.
    #[error("the new surface cannot be drawn: {0}")]
    Remesh(VoidError),
    /// The tolerance is too fine for the size of the model.
    #[error(
        "a new surface within {within_mm} mm is too fine for a model of this size; remedy: allow \
         more (`{}`)",
        Setting::new(Key::Repair, allowing(*least_mm))
    )]
    TooFine {
        /// The tolerance of the order, mm.
        within_mm: f64,
        /// The least tolerance that can be drawn, mm.
        least_mm: f64,
    },
    /// The triangles wind around nothing.
    #[error(
        "the triangles enclose nothing, so that a new surface would be empty; remedy: give the \
         surface a thickness in a modelling program, then export again"
    )]
    Nothing,
    /// The new surface strays too far, however finely it is drawn.
    #[error(
        "the new surface strays by {strays_mm:.3} mm at ({:.2}, {:.2}, {:.2}) in the file's own \
         coordinates, where {within_mm:.3} mm are allowed: the model is thinner there than can be \
         drawn; remedy: allow more (`{}`), or thicken the model there in a modelling program",
        at.x, at.y, at.z, Setting::new(Key::Repair, allowing(*strays_mm))
    )]
    Strays {
        /// The tolerance of the order, mm.
        within_mm: f64,
        /// The distance between the surfaces, mm.
        strays_mm: f64,
        /// The place, in the file's numbers.
        at: Point,
    },
    /// The caller stopped the run.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl From<VoidError> for MendError {
    fn from(error: VoidError) -> Self {
        match error {
            VoidError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            other => Self::Remesh(other),
        }
    }
}

/// Returns the order for a new surface that may stray so far, rounded up to a hundredth of a mm.
fn allowing(strays_mm: f64) -> String {
    format!("remesh:{:.2}mm", (100.0 * strays_mm).ceil() / 100.0)
}
