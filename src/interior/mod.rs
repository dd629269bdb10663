//! The region that may be emptied, discretised so that any choice of void has exact moments.

mod columns;

pub use columns::Columns;
