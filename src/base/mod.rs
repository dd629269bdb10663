//! The ground floor, on which every room stands.
//!
//! * [`units`]: lengths with units, and quantities as text for people.
//! * [`numbers`]: rounded numbers and coordinates as text.
//! * [`words`]: values that are written as single words.
//! * [`toml_text`]: TOML with faults that name line, column and the nearest known name.
//! * [`digest`]: SHA-256 of files.
//! * [`dialect`]: the families of slicers that a package gives orders to.
//! * `random`: random numbers from a seed, for searches.
//! * [`verdict`]: an answer that may be no, with the reason.
//! * [`sourced`]: values with their sources and their certainty.
//! * [`walls`]: the lines and layers that slicers lay solid around what they fill.
//! * [`watch`]: progress and cancellation of a run.

pub mod dialect;
pub mod digest;
pub mod numbers;
pub(crate) mod random;
pub mod setting;
pub mod sourced;
pub mod toml_text;
pub mod units;
pub mod verdict;
pub mod walls;
pub mod watch;
pub mod words;
