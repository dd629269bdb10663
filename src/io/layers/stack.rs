//! A stack of images as a folder of PNG files, with the list that says where they lie.

use serde::{Deserialize, Serialize};

use super::frame::ImageFrame;

/// The list of a stack, beside the folders of its images.
pub const STACK_FILE: &str = "layers.json";

/// The list of stacks, one a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StackRow {
    /// The version of this file.
    pub schema: u32,
    /// The job of the kit.
    pub job: String,
    /// The stacks.
    pub plates: Vec<StackPlate>,
}

/// The images of a plate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StackPlate {
    /// The plate's file in the kit.
    pub plate: String,
    /// The folder of its images, beside the list.
    pub folder: String,
    /// The edges of a pixel in x and y, mm.
    pub pixel_mm: [f64; 2],
    /// The place of the image's left and upper edge on the plate: its least x and its greatest y,
    /// mm.
    pub corner_mm: [f64; 2],
    /// The number of columns and rows.
    pub pixels: [u32; 2],
    /// The height of a layer, mm.
    pub layer_mm: f64,
    /// The number of layers.
    pub layers: u32,
    /// The volume of all images, mm³.
    pub volume_mm3: f64,
}

impl StackRow {
    /// The version of `layers.json` that this program writes.
    pub const SCHEMA: u32 = 1;
}

impl StackPlate {
    /// Returns the place of the images on the plate: seen from above, y upwards.
    pub fn frame(&self) -> ImageFrame {
        ImageFrame {
            column_axis: 0,
            signs: [1.0, -1.0],
            origin_mm: self.corner_mm,
            pitch_mm: self.pixel_mm,
            count: self.pixels,
        }
    }
}

/// Returns the name of a layer's image in its folder, counted from 0.
pub fn image_name(layer: u32) -> String {
    format!("{layer:05}.png")
}
