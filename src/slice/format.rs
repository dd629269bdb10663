//! The formats of a sliced kit.

use crate::base::words::choice;

choice! {
    /// The format in which a plate is sliced.
    SliceFormat, "format of slices" {
        /// Toolpaths of a filament printer, by a slicer.
        Gcode = "gcode",
        /// Images of layers, a PNG file each.
        Stack = "png-stack",
        /// Images of layers in Prusa's archive.
        Sl1 = "sl1",
    }
}
