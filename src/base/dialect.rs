//! The families of slicers, by the words in which a package gives them orders.

use crate::base::words::choice;

choice! {
    /// A family of slicers, by the words in which a package gives them orders.
    #[derive(Default)]
    Dialect, "dialect of slicers" {
        /// PrusaSlicer and SuperSlicer.
        #[default]
        Prusa = "prusa",
        /// OrcaSlicer and Bambu Studio.
        Orca = "orca",
        /// Cura.
        Cura = "cura",
    }
}

impl Dialect {
    /// Returns whether it is the one that is not named.
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the names of the slicers that read it.
    pub fn slicers(self) -> &'static str {
        match self {
            Self::Prusa => "PrusaSlicer and SuperSlicer",
            Self::Orca => "OrcaSlicer and Bambu Studio",
            Self::Cura => "Cura",
        }
    }
}
