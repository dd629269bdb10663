//! The region that may be emptied, discretised so that any choice of void has exact moments.

mod columns;
mod integrate;

pub use columns::Columns;
pub use integrate::{Matrix10, moments_and_derivative, moments_where_positive};
