//! Drawings of meshes and numbers: shaded pictures, line drawings, plots and codes. Knows nothing of
//! jobs, kits and sheets.

mod base64;
mod hatch;
mod palette;
mod plot;
mod projection;
mod qr;
mod render;
mod scene;
mod section;
mod seen;
mod shot;
mod svg;

pub(crate) use base64::base64;
pub use hatch::{Hatch, Runs};
pub(crate) use hatch::{Key, draw_peg, legend};
pub(crate) use palette::{BALLAST, BODY, HARDWARE, INK, PAPER, PLATE, VOID};
pub use palette::{Color, hex, part_color};
pub(crate) use plot::{Curve, LINES, Plot};
pub use projection::Projection;
pub(crate) use qr::code_path;
pub use render::{Image, PictureError, render};
pub use scene::{Camera, Item, Scene};
pub(crate) use scene::{LABEL_RATIO, camera, labelled_camera, still, turned};
pub(crate) use section::convex_section;
pub use shot::Drawn;
pub(crate) use shot::{Label, Shot, TEXT_PX};
pub use svg::{Anchor, Drawing, Spot, Stroke};
pub(crate) use svg::{Mark, short};
