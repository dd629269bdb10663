//! The region that may be emptied, discretised so that every void in it has exact moments.
//!
//! [`Columns`] are the solver's input. [`Rays`], [`Voxels`] and [`Octree`] describe a void on the
//! columns by many numbers, as the papers do, behind one trait, [`Choice`]. [`Emptied`] is the void
//! itself, whatever the method, so that results can be compared.

// The columns, and the ways to make and change them.
mod build;
mod columns;
mod depths;
mod outside;
mod row;
mod without;

// Integrals over the columns.
mod integrate;
mod moments;
mod pack;
mod section;

// Voids on the columns.
mod choice;
mod emptied;

// Voids described by many numbers.
mod cells;
mod grid;
mod leaf;
mod octree;
mod octree_neighbours;
mod rays;
mod voxels;

pub use build::BuildError;
pub use choice::Choice;
pub use columns::Columns;
pub use depths::Depths;
pub use emptied::{Emptied, Piece};
pub use integrate::{Matrix10, moments_and_derivative, moments_where_positive};
pub use octree::{Levels, Octree};
pub use rays::Rays;
pub use voxels::Voxels;
