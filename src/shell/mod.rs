//! The wall that stays: the region nearer to the surface than the wall, and what else must stay
//! solid.

mod ball;
mod bins;
mod crossings;
mod cylinder;
#[cfg(test)]
pub(crate) mod fixtures;
mod footprint;
mod keep;
mod links;
mod normal_cone;
mod overlap;
mod piece;
mod pieces;
mod ruler;
mod slab;
mod wall;

pub(crate) use bins::Bins;
pub(crate) use crossings::{RowCrossings, inside_stretches};
pub use keep::Keep;
pub(crate) use piece::{OnRow, Piece, RowForm};
pub(crate) use ruler::Ruler;
pub use wall::{Shell, ShellError};
