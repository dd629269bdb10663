//! A model of cells, printed: walls between voids, a way out of every void, and a skin around all.
//!
//! * `rooms`: the void of each cell, drawn in from its walls and from the skin.
//! * `doors`: an opening through every wall between two voids that can hold one.
//! * `escapes`: holes from voids to the outside.
//! * `pockets`: which voids would enclose resin in a vat, and stay solid, too.
//! * `flow`: which voids drain, and on which way. The others stay solid.
//! * [`build`]: all of it, as one solid.
//! * [`InnerCells`]: cells of a region inside of a solid, whose ways out are made by others.
//!
//! The voids are exact: a cell is a convex polytope, and every face toward another cell moves
//! inward by half a wall. So a ball of half a wall about any point of a void lies in its cell, and
//! two voids are a wall apart. Lengths are in mm.

mod build;
mod doors;
mod error;
mod escapes;
mod flow;
mod for_printer;
mod inner;
mod pockets;
mod prism;
mod rooms;

pub use build::{Comb, CombCell, CombOrder, build};
pub use doors::Door;
pub use error::CombError;
pub use escapes::Escape;
pub use inner::{CellVoid, InnerCells, InnerSizes, InnerVoids};
