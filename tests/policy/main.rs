//! The corpus of the search's policy: for each ratio and limit the model that set it, or the reason
//! why no model does.
//!
//! `corpus.toml` holds both. Runs take minutes, so they are ignored by default:
//!
//! ```text
//! EQUIPOISE_SOAK_MODELS=FOLDER cargo test --test command policy[::ROW] -- --ignored --nocapture
//! ```

#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a test whose input cannot be had has failed"
)]
#![allow(clippy::print_stderr, reason = "a long run reports its figures")]

mod corpus;
mod runs;
