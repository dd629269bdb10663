//! The choices of a job besides its goal. Each is read and printed as its word in `job.toml`.

use crate::base::words::choice;

choice! {
    /// The unit the numbers of a model file are in.
    ModelUnit, "unit" {
        /// Millimetres.
        Mm = "mm",
        /// Centimetres.
        Cm = "cm",
        /// Metres.
        M = "m",
        /// Inches.
        In = "in",
    }
}

impl ModelUnit {
    /// Returns the unit in mm.
    pub fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::M => 1000.0,
            Self::In => crate::base::units::MM_PER_INCH,
        }
    }
}

choice! {
    /// The choice to cut the object so that its voids can be cleaned.
    CutMode, "cut mode" {
        /// Cut wherever a void would stay closed.
        Auto = "auto",
        /// Not at all.
        Never = "never",
    }
}

choice! {
    /// The inside of the print.
    Interior, "interior" {
        /// Solid but for voids, which cuts open.
        Hollow = "hollow",
        /// One piece without cuts: solid but for regions of sparse infill.
        Graded = "graded",
        /// One piece without cuts: solid but for cells between thin walls, which drain.
        Cells = "cells",
    }
}

impl Interior {
    /// Returns true if it is hollow.
    pub fn is_hollow(&self) -> bool {
        *self == Self::Hollow
    }

    /// Returns true if it is made of cells.
    pub fn has_cells(&self) -> bool {
        *self == Self::Cells
    }
}

choice! {
    /// The pins that align the parts.
    PinStyle, "style of pins" {
        /// Pins printed with the parts.
        Printed = "printed",
        /// Dowels cut from stock rods, in sockets on both sides: cut faces stay flat.
        Dowel = "dowel",
    }
}

impl PinStyle {
    /// Returns true if they are printed.
    pub fn is_printed(&self) -> bool {
        *self == Self::Printed
    }
}

choice! {
    /// The marking of parts with their ids.
    IdStyle, "style of ids" {
        /// Sunk into the cut faces where there is room.
        Engraved = "engraved",
        /// Not at all.
        None = "none",
    }
}

impl IdStyle {
    /// Returns true if they are engraved.
    pub fn is_engraved(&self) -> bool {
        *self == Self::Engraved
    }
}

choice! {
    /// The file format of the written parts.
    PartFormat, "format" {
        /// Binary STL.
        Stl = "stl",
        /// 3MF: the parts, the assembly and the plates.
        ThreeMf = "3mf",
        /// Everything in both; the parts' STL files are the ones that are verified.
        Both = "both",
    }
}
