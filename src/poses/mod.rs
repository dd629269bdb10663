//! Poses of parts in a printer: the support that a pose needs, the cups that it makes, and the
//! choice among many poses.
//!
//! | file | holds |
//! |---|---|
//! | `shape` | a part's surface, as far as it decides the pose |
//! | `columns` | the gaps and the material along the vertical lines of a grid |
//! | `support` | the support under overhangs: its volume, its mass and what it touches |
//! | `cups` | the places where a part, the platform and the film enclose resin |
//! | `directions` | the directions that may point up |
//! | `choice` | the price of a pose, and the cheapest of all directions |

mod choice;
mod columns;
mod cups;
mod directions;
mod shape;
mod support;
#[cfg(test)]
mod tests;

pub use choice::{PoseRules, Want, rank_poses};
pub use columns::Columns;
pub use cups::{Cup, LEAST_CUP_MM3, cup_volume_mm3, find_cups};
pub(crate) use directions::{of_cube, spread};
pub use shape::{Peg, Shape, Side};
pub use support::{Support, SupportRule, find_overhangs};
