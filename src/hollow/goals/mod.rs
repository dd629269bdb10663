//! The goals with one or two programmes each, the least ballast, filled voids, two
//! densities and levels near a wished one.

pub(crate) mod balance;
pub(crate) mod ballast;
pub(crate) mod fill;
pub(crate) mod float;
pub(crate) mod kept;
pub(crate) mod near;
pub(crate) mod stand;
pub(crate) mod two;
pub(crate) mod yoyo;
