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

    /// Returns the name of the setting in a slicer's own words, with its key in profiles.
    pub(super) fn setting(self, slicer: Option<Slicer>) -> &'static str {
        let [prusa, orca, cura] = match self {
            Self::Infill => [
                "Fill density (fill_density)",
                "Sparse infill density (sparse_infill_density)",
                "Infill Density (infill_sparse_density)",
            ],
            Self::LayerHeight => [
                "Layer height (layer_height)",
                "Layer height (layer_height)",
                "Layer Height (layer_height)",
            ],
            Self::LineWidth => [
                "Default extrusion width (extrusion_width)",
                "Line width, Default (line_width)",
                "Line Width (line_width)",
            ],
            Self::Density => [
                "Density of the filament (filament_density)",
                "Density of the filament (filament_density)",
                "the density of the material",
            ],
            Self::Flow => [
                "Extrusion multiplier (extrusion_multiplier)",
                "Flow ratio (filament_flow_ratio)",
                "Flow (material_flow)",
            ],
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
