//! The reasons why cells are not printed.

use crate::base::watch::Cancelled;
use crate::cells::BodyError;
use crate::mesh::ClipError;
use crate::voids::VoidError;

/// A reason why a model is not made of cells.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CombError {
    /// A length is not above zero.
    #[error("{name} is {value_mm} mm; remedy: give a length above zero")]
    NotPositive {
        /// The name of the length.
        name: &'static str,
        /// The value, mm.
        value_mm: f64,
    },
    /// The skin cannot be drawn.
    #[error(transparent)]
    Skin(#[from] VoidError),
    /// A void cannot be cut.
    #[error(transparent)]
    Void(#[from] BodyError),
    /// The voids cannot be taken out of the model.
    #[error("the voids cannot be taken out of the model")]
    Clip(#[from] ClipError),
    /// A stop was asked for.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl CombError {
    /// Returns true if a stop was asked for.
    pub fn is_stop(&self) -> bool {
        matches!(
            self,
            Self::Cancelled(_)
                | Self::Skin(VoidError::Cancelled(_))
                | Self::Void(BodyError::Cancelled(_))
        )
    }
}
