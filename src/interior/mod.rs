//! The region that may be emptied, discretised so that any choice of void has exact moments.

//!
//! [`Columns`] are what the solver reads. [`Rays`], [`Voxels`] and [`Octree`] describe a void on
//! them by many numbers, as the papers do, behind one trait, [`Choice`]; [`Emptied`] is what any
//! method says is emptied.

mod build;
mod cells;
mod choice;
mod columns;
mod depths;
mod emptied;
mod grid;
mod integrate;
mod leaf;
mod moments;
mod octree;
mod octree_neighbours;
mod outside;
mod pack;
mod rays;
mod row;
mod section;
mod voxels;
mod without;

pub use build::BuildError;
pub use choice::Choice;
pub use columns::Columns;
pub use depths::Depths;
pub use emptied::{Emptied, Piece};
pub use integrate::{Matrix10, moments_and_derivative, moments_where_positive};
pub use octree::{Levels, Octree};
pub use rays::Rays;
pub use voxels::Voxels;

use moments::{BLOCK, block_sums};
use section::mean_on_column;
