//! Layer images: what a machine of pixels hardens, layer by layer.
//!
//! * [`Pixels`] and [`Layers`] say where the pixels and layers of a machine lie.
//! * [`Stack::image`] covers the pixels of a layer by the section of a mesh. The share of each
//!   pixel is the exact area of the section in it.
//! * [`LayerImage`] holds the shares as runs, paints them in grey, and has their moments.
//! * [`Diffusion`] gives each pixel of a body one of two materials, by error diffusion.
//!
//! Lengths are in mm, on the plate: z is up, and the platform is at zero.

mod coverage;
mod dither;
mod grid;
mod image;
mod sections;
mod stack;

pub use dither::{Cell, Diffusion, Grid, mark_body};
pub use grid::{Layers, Pixels};
pub use image::{LayerImage, Run};
pub use stack::Stack;
