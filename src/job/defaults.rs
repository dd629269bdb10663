//! The values of keys that may be missing in a `job.toml`.

use super::choices::{IdStyle, Interior, PinStyle};
use super::effort::Effort;
use crate::cut::{LeastPart, SeamStyle};

/// Returns printed pins.
pub fn pins() -> PinStyle {
    PinStyle::Printed
}

/// Returns hidden seams.
pub fn seam() -> SeamStyle {
    SeamStyle::Hidden
}

/// Returns voids.
pub fn interior() -> Interior {
    Interior::Hollow
}

/// Returns the usual effort.
pub fn effort() -> Effort {
    Effort::Normal
}

/// Returns the usual limit.
pub fn least_part() -> LeastPart {
    LeastPart::USUAL
}

/// Returns engraved ids.
pub fn ids() -> IdStyle {
    IdStyle::Engraved
}
