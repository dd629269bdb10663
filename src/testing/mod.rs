//! What the tests of several rooms share.

mod kit;

pub use kit::{sample, sample_pictures};
