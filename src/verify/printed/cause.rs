//! The causes of a wrong print, and the settings to change.

use serde::Serialize;

use crate::io::gcode::Slicer;

/// A cause of a print that is not as the kit asks.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Cause {
    /// Its kind.
    pub kind: CauseKind,
    /// The file of the toolpaths; `None` if it is in none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
    /// The parts it is about.
    pub parts: Vec<String>,
    /// What was found.
    pub finding: String,
    /// The setting to change.
    pub remedy: String,
    /// Whether the print is wrong by it. Otherwise it depends on what is done after the print.
    pub is_wrong: bool,
}

/// A kind of cause; in JSON its name in kebab case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum CauseKind {
    /// Parts are in no file.
    Missing,
    /// Infill is sparse.
    Infill,
    /// Parts have another size.
    Scale,
    /// Parts are mirror images.
    Mirror,
    /// Layers have another height.
    LayerHeight,
    /// Lines have another width.
    LineWidth,
    /// The filament has another density.
    Density,
    /// More or less material is laid than the parts have, and nothing else explains it.
    Flow,
    /// Support lies in voids.
    SupportInVoid,
}

impl CauseKind {
    /// Returns its name for people.
    pub fn name(self) -> &'static str {
        match self {
            Self::Missing => "missing parts",
            Self::Infill => "sparse infill",
            Self::Scale => "scaled parts",
            Self::Mirror => "mirrored parts",
            Self::LayerHeight => "layer height",
            Self::LineWidth => "line width",
            Self::Density => "filament density",
            Self::Flow => "flow",
            Self::SupportInVoid => "support in voids",
        }
    }

    /// Returns the name of the setting in a slicer's own words.
    pub(super) fn setting(self, slicer: Option<Slicer>) -> &'static str {
        let [prusa, orca, cura] = match self {
            Self::Infill => ["fill_density", "sparse_infill_density", "Infill Density"],
            Self::LayerHeight => ["layer_height", "layer_height", "Layer Height"],
            Self::LineWidth => ["extrusion_width", "line_width", "Line Width"],
            Self::Density => [
                "filament_density",
                "filament_density",
                "the density of the material",
            ],
            Self::Flow => ["extrusion_multiplier", "filament_flow_ratio", "Flow"],
            Self::SupportInVoid => ["the support in voids"; 3],
            Self::Scale => ["the scale of the object"; 3],
            Self::Mirror => ["the mirror image of the object"; 3],
            Self::Missing => ["the objects on the plate"; 3],
        };
        match slicer {
            Some(Slicer::OrcaSlicer | Slicer::BambuStudio) => orca,
            Some(Slicer::Cura) => cura,
            _ => prusa,
        }
    }
}
