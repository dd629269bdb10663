//! The stock of densities that a print may have, in the words of slicers.

use super::given::SAME_RATIO;
use crate::hollow::Region;
use crate::printer::Printer;
use crate::run::{Extent, Level, Nested};

/// The densities of infill that a print may have.
pub struct Stock<'a> {
    /// The printer that lays others than those.
    pub printer: &'a Printer,
    /// The regions whose densities are known.
    pub sparse: &'a Nested,
}

impl Stock<'_> {
    /// Returns a region with its density in the words of slicers; `None` for solid print.
    pub fn level(&self, region: &Region) -> Option<Level> {
        let extent = region.above.map_or(Extent::Interior, Extent::Above);
        self.level_of(region.density, extent)
    }

    /// Returns the region of a density that is laid; `None` for solid print.
    pub fn level_of(&self, laid_ratio: f64, extent: Extent) -> Option<Level> {
        let mut known = self.sparse.levels.iter();
        let known = known.find(|level| level.laid_ratio == laid_ratio);
        let nominal = || {
            let pattern = self.printer.infill.as_ref()?;
            Some(pattern.nominal_ratio(laid_ratio))
        };
        let nominal_ratio = match known {
            Some(level) => level.nominal_ratio,
            None => nominal().filter(|nominal| *nominal < 1.0 - SAME_RATIO)?,
        };
        Some(Level {
            nominal_ratio,
            laid_ratio,
            extent,
        })
    }
}
