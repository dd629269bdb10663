//! The solver's figures as Markdown, in one run on one machine: the papers' tables beside the
//! quadric, every goal, and Spin-It's teapot. Every goal is solved at 100 columns a side and at the
//! printers' finest pitch.
//!
//! ```text
//! cargo run --release --features papers --example solver_table
//! ```
//!
//! `EQUIPOISE_SHARED_MODELS` names a folder with the larger models; those that are not there are
//! left out.

#![allow(
    clippy::print_stdout,
    reason = "an example talks to the person who runs it"
)]

#[path = "../make_models/models.rs"]
mod models;

mod goals;
mod papers;
mod scene;
mod teapot;

fn main() -> anyhow::Result<()> {
    papers::print_tables()?;
    goals::print_table()?;
    teapot::print_table()
}
