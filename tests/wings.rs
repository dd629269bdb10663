//! What is more than one object: telescopes, objects on a base, cells.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod common;

mod cells;
#[path = "cladding/main.rs"]
mod cladding;
mod comb;
#[path = "core_kit/main.rs"]
mod core_kit;
mod cut_coupons;
mod figures;
#[path = "panels/main.rs"]
mod panels;
mod polyhedra;
mod skeletons;
mod telescopes;
