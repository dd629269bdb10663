//! The region that may be emptied, discretised so that any choice of void has exact moments.

mod build;
mod columns;
mod depths;
mod integrate;
mod moments;
mod outside;
mod row;
mod without;

pub use build::BuildError;
pub use columns::Columns;
pub use depths::Depths;
pub use integrate::{Matrix10, moments_and_derivative, moments_where_positive};
