//! What every room stands on: quantities with units, digests, words, TOML and the watch of a run.

pub mod digest;
pub mod numbers;
pub mod setting;
pub mod toml_text;
pub mod units;
pub mod verdict;
pub mod watch;
pub mod words;
