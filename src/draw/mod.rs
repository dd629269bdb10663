//! Drawings of meshes and numbers: shaded pictures, line drawings, plots and QR codes.
//!
//! The room knows nothing of jobs, kits and job sheets.

mod base64;
mod callouts;
mod dimension;
mod error;
mod hatch;
mod inside;
mod legend;
mod letters;
mod palette;
mod plot;
mod projection;
mod qr;
mod render;
mod scene;
mod section;
mod shot;
mod svg;
mod visibility;

pub(crate) use base64::base64;
pub(crate) use callouts::Mark;
pub use error::PictureError;
pub use hatch::{Hatch, Stripes};
pub use inside::{InnerBall, InnerLine, draw_inside};
pub(crate) use legend::{Key, draw_legend, draw_peg};
pub(crate) use palette::{BALLAST, BODY, CURVES, HARDWARE, INK, PAPER, PIN, PLATE, VOID};
pub use palette::{Color, hex, part_color};
pub(crate) use plot::{Curve, Plot};
pub use projection::Projection;
pub(crate) use qr::code_path;
pub use render::{Image, render};
pub(crate) use scene::view_direction;
pub use scene::{Camera, Item, Scene};
pub(crate) use section::convex_section;
pub use shot::Drawn;
pub(crate) use shot::{Label, Shot, TEXT_PX};
pub(crate) use svg::short;
pub use svg::{Anchor, Drawing, Paint, Spot, Stroke};
