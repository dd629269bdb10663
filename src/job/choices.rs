//! The choices a job is made of besides its goal: each reads from and prints as the word used on
//! the command line.

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
    /// The unit in mm.
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
    /// How the void is found.
    Solver, "solver" {
        /// The design region cut by the one best quadric.
        Quadric = "quadric",
    }
}

choice! {
    /// Whether the object is cut so that its voids can be cleaned.
    CutMode, "cut mode" {
        /// Wherever a void would stay closed.
        Auto = "auto",
        /// Not at all.
        Never = "never",
    }
}

choice! {
    /// What aligns the parts.
    PinStyle, "style of pins" {
        /// Pins printed with the parts.
        Printed = "printed",
        /// Dowels cut from stock rods, in sockets on both sides: cut faces stay flat.
        Dowel = "dowel",
    }
}

impl PinStyle {
    /// Whether they are printed.
    pub fn is_printed(&self) -> bool {
        *self == Self::Printed
    }
}

choice! {
    /// Whether parts bear their ids.
    IdStyle, "style of ids" {
        /// Sunk into the cut faces where there is room.
        Engraved = "engraved",
        /// Not at all.
        None = "none",
    }
}

impl IdStyle {
    /// Whether they are sunk into the faces.
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
        /// Everything in both; the parts' STL files are those that are judged.
        Both = "both",
    }
}
