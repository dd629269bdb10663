//! Features: the purpose of a bead, under the names that slicers give it.

/// The purpose for which material is laid, as the slicer names it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Feature {
    /// An inner perimeter.
    Perimeter,
    /// The outermost perimeter.
    ExternalPerimeter,
    /// A perimeter in the air.
    OverhangPerimeter,
    /// A wall of a single bead.
    ThinWall,
    /// Sparse infill.
    Infill,
    /// Solid infill inside.
    SolidInfill,
    /// The uppermost solid surface.
    Top,
    /// The lowermost solid surface.
    Bottom,
    /// Cura's skin: top and bottom together.
    Skin,
    /// Infill over air.
    Bridge,
    /// Infill over sparse infill.
    InternalBridge,
    /// A fill of a narrow gap.
    GapFill,
    /// A pass that smooths a surface.
    Ironing,
    /// A feature of a name that is not known; part of the object.
    Other,
    /// Before the first name in a file that names features, or anywhere in a file without names.
    Unnamed,
    /// A raft below an object.
    Raft,
    /// Support.
    Support,
    /// The face of a support towards the object.
    SupportInterface,
    /// A line around the objects.
    Skirt,
    /// A rim at an object's foot.
    Brim,
    /// PrusaSlicer's name for both.
    SkirtBrim,
    /// A tower that takes the material of changes of filament.
    WipeTower,
    /// Commands of the machine's own: purge lines, flushes.
    Custom,
}

impl Feature {
    /// Returns true for material that stays in the finished object.
    ///
    /// Features of unknown names count. [`Feature::Unnamed`] does not: a file that names no
    /// features at all is counted as a whole, see [`super::Toolpath`].
    pub const fn is_part(self) -> bool {
        !matches!(
            self,
            Self::Unnamed
                | Self::Raft
                | Self::Support
                | Self::SupportInterface
                | Self::Skirt
                | Self::Brim
                | Self::SkirtBrim
                | Self::WipeTower
                | Self::Custom
        )
    }

    /// Returns the feature that a slicer calls by this name; [`Feature::Other`] for unknown names.
    pub fn of_name(name: &str) -> Self {
        let name = name.trim();
        let known = NAMES
            .iter()
            .find(|(known, _)| known.eq_ignore_ascii_case(name));
        known.map_or(Self::Other, |(_, feature)| *feature)
    }
}

/// The names of features, of every slicer.
const NAMES: &[(&str, Feature)] = &[
    // PrusaSlicer and SuperSlicer, after `;TYPE:`.
    ("Perimeter", Feature::Perimeter),
    ("Internal perimeter", Feature::Perimeter),
    ("External perimeter", Feature::ExternalPerimeter),
    ("Overhang perimeter", Feature::OverhangPerimeter),
    ("Thin wall", Feature::ThinWall),
    ("Internal infill", Feature::Infill),
    ("Solid infill", Feature::SolidInfill),
    ("Top solid infill", Feature::Top),
    ("Bridge infill", Feature::Bridge),
    ("Internal bridge infill", Feature::InternalBridge),
    ("Gap fill", Feature::GapFill),
    ("Ironing", Feature::Ironing),
    ("Skirt/Brim", Feature::SkirtBrim),
    ("Support material", Feature::Support),
    ("Support material interface", Feature::SupportInterface),
    ("Wipe tower", Feature::WipeTower),
    ("Custom", Feature::Custom),
    // OrcaSlicer after `;TYPE:`, Bambu Studio after `; FEATURE:`.
    ("Inner wall", Feature::Perimeter),
    ("Outer wall", Feature::ExternalPerimeter),
    ("Overhang wall", Feature::OverhangPerimeter),
    ("Sparse infill", Feature::Infill),
    ("Internal solid infill", Feature::SolidInfill),
    ("Floating vertical shell", Feature::SolidInfill),
    ("Top surface", Feature::Top),
    ("Bottom surface", Feature::Bottom),
    ("Bridge", Feature::Bridge),
    ("Internal Bridge", Feature::InternalBridge),
    ("Gap infill", Feature::GapFill),
    ("Skirt", Feature::Skirt),
    ("Brim", Feature::Brim),
    ("Support", Feature::Support),
    ("Support interface", Feature::SupportInterface),
    ("Support transition", Feature::Support),
    ("Prime tower", Feature::WipeTower),
    ("Flush", Feature::Custom),
    // CuraEngine after `;TYPE:`. It names its raft as support.
    ("WALL-INNER", Feature::Perimeter),
    ("WALL-OUTER", Feature::ExternalPerimeter),
    ("SKIN", Feature::Skin),
    ("FILL", Feature::Infill),
    ("SUPPORT-INTERFACE", Feature::SupportInterface),
    ("PRIME-TOWER", Feature::WipeTower),
    ("RAFT", Feature::Raft),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_slicer_s_own_names_are_known() {
        let of = |name: &str| Feature::of_name(name);
        assert_eq!(of("External perimeter"), of("Outer wall"));
        assert_eq!(of("External perimeter"), of("WALL-OUTER"));
        assert_eq!(of(" Sparse infill\r"), of("FILL"));
        assert_eq!(of("SUPPORT"), Feature::Support);
        assert_eq!(of("Mill"), Feature::Other);
    }

    #[test]
    fn what_is_torn_off_or_thrown_away_is_no_part() {
        for name in [
            "Skirt/Brim",
            "SKIRT",
            "Brim",
            "SUPPORT",
            "Wipe tower",
            "Prime tower",
            "Custom",
        ] {
            assert!(!Feature::of_name(name).is_part(), "{name}");
        }
        for name in [
            "Perimeter",
            "Ironing",
            "SKIN",
            "Bridge",
            "a name of tomorrow",
        ] {
            assert!(Feature::of_name(name).is_part(), "{name}");
        }
    }
}
