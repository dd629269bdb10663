//! The goals with one or two programmes each, the least ballast, filled voids and two densities.

pub(crate) mod balance;
pub(crate) mod ballast;
pub(crate) mod fill;
pub(crate) mod float;
pub(crate) mod stand;
pub(crate) mod two;
pub(crate) mod yoyo;
