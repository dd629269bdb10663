//! The goals that need one programme or two each, the least ballast, and voids that are filled.

pub(crate) mod balance;
pub(crate) mod ballast;
pub(crate) mod fill;
pub(crate) mod float;
pub(crate) mod stand;
pub(crate) mod yoyo;
