//! The goals with one or two programmes each, the least ballast, filled voids, two
//! densities, levels near a wished one, printed fields, and the match.

mod asked;
pub(crate) mod balance;
pub(crate) mod ballast;
mod cone;
pub(crate) mod drawn_field;
pub(crate) mod fill;
pub(crate) mod float;
mod found;
pub(crate) mod kept;
pub(crate) mod matching;
pub(crate) mod near;
pub(crate) mod printed_field;
pub(crate) mod stand;
pub(crate) mod trade;
pub(crate) mod two;
pub(crate) mod yoyo;
