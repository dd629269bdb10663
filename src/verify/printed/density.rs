//! The densities of filaments: as a file states them, or else that of the kit.

use super::limits::DENSITIES_G_CM3;
use super::source::Source;
use crate::verify::Promise;

/// The densities of a file's tools.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Densities {
    /// Those that the file states, g/cm³; empty if it states none that a filament can have.
    pub(super) stated_g_cm3: Vec<f64>,
    /// That of the kit, g/cm³.
    kit_g_cm3: f64,
}

impl Densities {
    /// Returns the densities with which a file is weighed.
    pub(super) fn of(source: &Source, promise: &Promise) -> Self {
        let stated = &source.toolpath.facts.filament_density_g_cm3;
        let [least, most] = DENSITIES_G_CM3;
        let is_filament = stated
            .iter()
            .all(|density| (least..=most).contains(density));
        Self {
            stated_g_cm3: if is_filament {
                stated.clone()
            } else {
                Vec::new()
            },
            kit_g_cm3: promise.material.density_g_cm3,
        }
    }

    /// Returns the density of a tool's filament, g/cm³.
    pub(super) fn of_tool(&self, tool: u16) -> f64 {
        let stated = self.stated_g_cm3.get(usize::from(tool));
        let first = self.stated_g_cm3.first();
        stated.or(first).copied().unwrap_or(self.kit_g_cm3)
    }
}
