//! The words in which each family of slicers reads the settings of a package.

use crate::base::dialect::Dialect;

/// The words of one dialect for the settings of objects and of their volumes.
#[derive(Debug)]
pub struct Words {
    /// The density of infill.
    pub density: &'static str,
    /// The sign of a density: without it, PrusaSlicer reads a multiple of solid print.
    pub sign: &'static str,
    /// The pattern of infill.
    pub pattern: &'static str,
    /// The height of a layer.
    pub layer: &'static str,
    /// The number of lines along a wall.
    pub perimeters: &'static str,
    /// Whether overhangs are supported.
    pub support: &'static str,
    /// The angle up to which they are.
    pub angle: &'static str,
    /// The kind of a volume.
    pub kind: &'static str,
    /// The kind of a volume that is printed.
    pub printed: &'static str,
    /// The kind of a volume in which other settings hold.
    pub modifier: &'static str,
    /// Settings with which a slicer would lay walls or solid layers around a region.
    pub walls: &'static [&'static str],
    /// Settings without which an object would have skins that no region cuts, or a region walls.
    pub bare: &'static [(&'static str, &'static str)],
    /// The setting that says which of two regions holds; `None` if it is their order.
    pub order: Option<&'static str>,
}

impl Words {
    /// Returns the words of a dialect.
    pub fn of(dialect: Dialect) -> &'static Self {
        match dialect {
            Dialect::Prusa => &PRUSA,
            Dialect::Orca => &ORCA,
            Dialect::Cura => &CURA,
        }
    }
}

/// PrusaSlicer's words.
const PRUSA: Words = Words {
    density: "fill_density",
    sign: "%",
    pattern: "fill_pattern",
    layer: "layer_height",
    perimeters: "perimeters",
    support: "support_material",
    angle: "support_material_threshold",
    kind: "volume_type",
    printed: "ModelPart",
    modifier: "ParameterModifier",
    walls: &["perimeters", "interface_shells", "extra_perimeters"],
    bare: &[],
    order: None,
};

/// The words of OrcaSlicer and Bambu Studio.
const ORCA: Words = Words {
    density: "sparse_infill_density",
    sign: "%",
    pattern: "sparse_infill_pattern",
    layer: "layer_height",
    perimeters: "wall_loops",
    support: "enable_support",
    angle: "support_threshold_angle",
    kind: "subtype",
    printed: "normal_part",
    modifier: "modifier_part",
    walls: &["wall_loops", "interface_shells"],
    bare: &[],
    order: None,
};

/// Cura's words. Its angle of overhangs is that to the vertical.
const CURA: Words = Words {
    density: "infill_sparse_density",
    sign: "",
    pattern: "infill_pattern",
    layer: "layer_height",
    perimeters: "wall_line_count",
    support: "support_enable",
    angle: "support_angle",
    kind: "infill_mesh",
    printed: "false",
    modifier: "true",
    walls: &[],
    bare: &[("top_layers", "0"), ("bottom_layers", "0")],
    order: Some("infill_mesh_order"),
};
