//! The facts about an object on a base, all of them.

use super::ballast::ballast_faults;
use super::certificate::{BaseFacts, measure_base};
use super::drawings::{DrawingFacts, measure_drawings};
use super::error::CoreVerifyError;
use super::evidence::CoreEvidence;
use super::panels::{PanelFacts, measure_panels};
use super::pins::{PinFacts, measure_pins};
use super::rods::rod_faults;
use super::shell::{ShellFacts, measure_shell};
use super::standing::{StandFacts, measure_standing};
use super::stock::{StockFacts, measure_stock};
use super::surfaces::{SurfaceFacts, measure_surfaces};
use super::ways::{WayFacts, measure_ways};
use crate::base::watch::Watch;

/// The facts about an object on a base.
#[derive(Debug, Clone, PartialEq)]
pub struct CoreFacts {
    /// The base.
    pub base: BaseFacts,
    /// The panels.
    pub panels: PanelFacts,
    /// The drawings.
    pub drawings: DrawingFacts,
    /// The stock and the grain.
    pub stock: StockFacts,
    /// The surfaces of the printed parts.
    pub surfaces: SurfaceFacts,
    /// The shell.
    pub shell: ShellFacts,
    /// The pins between parts, and the path of each part to the base.
    pub pins: PinFacts,
    /// The ways of the units.
    pub ways: WayFacts,
    /// The faults of the ballast, in words; `None` if there is none.
    pub ballast: Option<Vec<String>>,
    /// The faults of the rods between polyhedra, in words; `None` if there are none.
    pub rods: Option<Vec<String>>,
    /// Mass and balance.
    pub stand: StandFacts,
    /// The volume of the model, mm³.
    pub model_mm3: f64,
}

/// Measures an object on a base.
///
/// # Errors
/// The boolean engine fails, or the watch was stopped.
pub fn judge_core(evidence: &CoreEvidence, watch: &Watch) -> Result<CoreFacts, CoreVerifyError> {
    let base = measure_base(evidence)?;
    watch.check()?;
    let panels = measure_panels(evidence)?;
    let drawings = measure_drawings(evidence);
    watch.check()?;
    Ok(CoreFacts {
        base,
        panels,
        drawings,
        stock: measure_stock(&evidence.promise),
        surfaces: measure_surfaces(evidence, watch)?,
        shell: measure_shell(evidence, watch)?,
        pins: measure_pins(evidence),
        ways: measure_ways(evidence, watch)?,
        ballast: match evidence.promise.ballast.is_empty() {
            true => None,
            false => Some(ballast_faults(evidence)?),
        },
        rods: match evidence.promise.rods.is_empty() {
            true => None,
            false => Some(rod_faults(evidence)?),
        },
        stand: measure_standing(evidence),
        model_mm3: evidence.model.signed_volume_mm3(),
    })
}
