//! The wall: the region nearer to the surface than the wall's thickness, and the regions to keep
//! solid.
//!
//! [`Shell`] holds the wall as convex pieces. A vertical line meets each piece in one stretch, in
//! closed form; [`crate::interior`] subtracts these stretches from its columns.

// The wall and the keep-solid regions.
mod keep;
mod wall;

// The pieces of which the wall is made.
mod links;
mod normal_cone;
mod pieces;

// One convex piece: its footprint, its shape and its cut by a row.
mod ball;
mod cylinder;
mod footprint;
mod on_row;
mod piece;
mod slab;

// Rows and columns.
mod bins;
mod crossings;
mod overlap;
mod ruler;

#[cfg(test)]
pub(crate) mod fixtures;

pub(crate) use bins::Bins;
pub(crate) use crossings::{RowCrossings, inside_stretches};
pub use keep::Keep;
pub(crate) use on_row::OnRow;
pub(crate) use piece::{Piece, RowForm};
pub(crate) use ruler::Ruler;
pub use wall::{Shell, ShellError};
