//! Equipoise hollows a 3D model so that its printed, glued parts spin, stand or balance as asked.

#![forbid(unsafe_code)]

pub mod cli;
pub mod cut;
pub mod digest;
pub mod error;
pub mod geom;
pub mod goal;
pub mod guide;
pub mod hollow;
pub mod interior;
pub mod io;
pub mod job;
pub mod mass;
pub mod mesh;
pub mod pipeline;
pub mod printer;
pub mod progress;
pub mod report;
pub mod shell;
pub mod toml_text;
pub mod units;
pub mod verify;
pub mod voids;
