//! The promise of where parts and jigs lie on the plates.

use serde::{Deserialize, Serialize};

/// A plate of a kit, and what lies where on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedPlate {
    /// Its file, relative to the kit.
    pub file: String,
    /// The width and depth of the machine's plate, mm; `None` if they are not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size_mm: Option<[f64; 2]>,
    /// The parts and jigs on it.
    pub holds: Vec<PlateSpot>,
}

/// The place of a part or a jig on its plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlateSpot {
    /// Its name, such as `P01` or `jig-J1`.
    pub id: String,
    /// The front left corner of its box, mm from that of the plate.
    pub low_mm: [f64; 2],
    /// The width and depth of its box as it lies there, mm.
    pub size_mm: [f64; 2],
    /// Whether it is turned by a right angle from the pose in its own file.
    pub is_turned: bool,
}
