//! The materials of sheets, and those that a laser must not cut.

use crate::base::words::choice;

choice! {
    /// The material of a sheet.
    #[derive(PartialOrd, Ord)]
    SheetMaterial, "sheet material" {
        /// Layers of veneer, glued crosswise.
        Plywood = "plywood",
        /// Medium-density fibreboard.
        Mdf = "mdf",
        /// Acrylic glass (PMMA).
        Acrylic = "acrylic",
        /// Corrugated or grey board.
        Cardboard = "cardboard",
        /// Boards of solid wood.
        Wood = "wood",
    }
}

/// Parts of the names of materials that give off chlorine when they burn.
const CHLORINE: [&str; 4] = ["pvc", "vinyl", "polyvinyl", "chlorid"];

/// Returns true if a name is that of a material with chlorine.
pub(super) fn has_chlorine(name: &str) -> bool {
    let name = name.to_lowercase();
    CHLORINE.iter().any(|word| name.contains(word))
}
