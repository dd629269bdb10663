//! Fields of density, infill and toolpaths.

#![allow(
    clippy::unwrap_used,
    reason = "a test whose input cannot be had has failed"
)]

mod common;
#[path = "common/scene.rs"]
mod scene;

mod density;
mod density_best;
mod density_bodies;
mod density_coupon;
mod density_fields;
mod dithered;
mod drawn_fields;
mod fields;
mod gcode;
mod graded;
mod graded_levels;
mod matching;
mod scale_extrusion;
mod slice;
mod volumes;
