//! The slicer that is asked what the plates take.

use serde::{Deserialize, Serialize};

/// The slicer that is asked what the plates take.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SlicerChoice {
    /// The command that starts it; in a kit without its folder.
    pub command: String,
    /// Its name and version, such as `PrusaSlicer 2.5.0`; `None` until it was asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub version: Option<String>,
}
