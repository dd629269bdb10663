//! The region that may be emptied, discretised so that every void in it has exact moments.
//!
//! [`Columns`] are the solver's input. [`Emptied`] is the void itself, whatever the method, so that
//! results can be compared. With the feature `papers`, `Rays`, `Voxels` and `Octree` describe a
//! void on the columns by many numbers, as the papers do, behind one trait, `Choice`.

// The columns, and the ways to make and change them.
mod build;
mod columns;
mod depths;
mod outside;
mod row;
mod without;

// Integrals over the columns.
mod between;
mod integrate;
mod moments;
mod pack;
mod section;

// Voids on the columns.
#[cfg(any(test, feature = "papers"))]
mod choice;
mod emptied;

// Voids described by many numbers.
#[cfg(any(test, feature = "papers"))]
mod cells;
#[cfg(any(test, feature = "papers"))]
mod grid;
#[cfg(any(test, feature = "papers"))]
mod leaf;
#[cfg(any(test, feature = "papers"))]
mod octree;
#[cfg(any(test, feature = "papers"))]
mod octree_neighbours;
#[cfg(any(test, feature = "papers"))]
mod rays;
#[cfg(any(test, feature = "papers"))]
mod voxels;

pub use between::{Between, integrals_between};
pub use build::BuildError;
#[cfg(any(test, feature = "papers"))]
pub use choice::Choice;
pub use columns::Columns;
pub use depths::Depths;
pub use emptied::{Emptied, Piece};
pub use integrate::{
    Matrix10, moments_and_derivative, moments_and_own_derivative, moments_where_positive,
};
#[cfg(any(test, feature = "papers"))]
pub use octree::{Levels, Octree};
#[cfg(any(test, feature = "papers"))]
pub use rays::Rays;
#[cfg(any(test, feature = "papers"))]
pub use voxels::Voxels;
