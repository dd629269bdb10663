//! Layer images: what a machine of pixels shows or jets, layer by layer.
//!
//! * [`read_layers`] weighs the images of a file: Prusa's SL1 and SL1S, or a stack of PNG files
//!   with its `layers.json`.
//! * [`encode_grey`] and [`encode_bits`] write an image; [`encode_sl1`] packs images for a machine.
//! * [`ImageFrame`] says where the pixels lie on the plate. `grey` holds one image, `sums` weighs
//!   it, `sl1` and `stack` find the images of a file.

mod error;
mod frame;
mod grey;
mod read;
mod sl1;
mod stack;
mod sums;
#[cfg(test)]
mod tests;

pub use error::{LayersError, ReadLayersError};
pub use frame::ImageFrame;
pub use grey::{GreyImage, encode_bits, encode_grey};
pub use read::{LayerPlate, holds_layers, read_layer_places, read_layers};
pub use sl1::{Sl1Settings, encode_sl1};
pub use stack::{STACK_FILE, StackPlate, StackRow, image_name};
pub use sums::PixelSum;
