//! The region that may be emptied, discretised so that any choice of void has exact moments.

mod build;
mod columns;
mod moments;
mod row;

pub use build::BuildError;
pub use columns::Columns;
