//! Samples shared by the tests of several rooms.

mod kit;

pub use kit::{sample, sample_pictures, steel_tip};
