//! The densities of filaments: as a file states them, or else that of the kit.

use super::limits::DENSITIES_G_CM3;
use super::source::Source;
use crate::verify::Promise;

/// The densities of a file's tools.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Densities {
    /// Those that the file states by tool, g/cm³; `None` where no filament can have it.
    stated_g_cm3: Vec<Option<f64>>,
    /// That of the kit, g/cm³.
    kit_g_cm3: f64,
}

impl Densities {
    /// Returns the densities with which a file is weighed.
    pub(super) fn of(source: &Source, promise: &Promise) -> Self {
        let stated = &source.toolpath.facts.filament_density_g_cm3;
        let [least, most] = DENSITIES_G_CM3;
        let is_filament = |density: &f64| (least..=most).contains(density);
        let stated = stated.iter().copied();
        Self {
            stated_g_cm3: stated
                .map(|density| Some(density).filter(is_filament))
                .collect(),
            kit_g_cm3: promise.material.density_g_cm3,
        }
    }

    /// Returns true if the file states a density that a filament can have.
    pub(super) fn are_stated(&self) -> bool {
        self.stated_g_cm3.iter().any(Option::is_some)
    }

    /// Returns the density that the file states for a tool, g/cm³; `None` if it states none.
    pub(super) fn stated_of(&self, tool: u16) -> Option<f64> {
        let stated = self.stated_g_cm3.get(usize::from(tool));
        let first = self.stated_g_cm3.first();
        stated.or(first).copied().flatten()
    }

    /// Returns the density of a tool's filament, g/cm³.
    pub(super) fn of_tool(&self, tool: u16) -> f64 {
        self.stated_of(tool).unwrap_or(self.kit_g_cm3)
    }
}
