//! A region inside an object that is filled sparsely, as PrusaSlicer reads it: a modifier.

use crate::base::walls::Walls;
use crate::mesh::TriMesh;

/// A setting: its name and its value.
pub(super) type Pair = (&'static str, String);

/// A region of sparse infill inside an object.
#[derive(Debug, Clone, PartialEq)]
pub struct SparseRegion {
    /// Its surface, facing outward.
    pub mesh: TriMesh,
    /// The pattern of its infill, in PrusaSlicer's words.
    pub pattern: String,
    /// The density to set for it, per cent of that of solid print.
    pub percent: f64,
}

/// The infill of a region that is bounded by some of the last triangles of an object.
#[derive(Debug, Clone, PartialEq)]
pub struct Infill {
    /// The first of those triangles; they end where the next region begins.
    pub first: usize,
    /// The pattern, in PrusaSlicer's words.
    pub pattern: String,
    /// The density to set, per cent of that of solid print.
    pub percent: f64,
    /// Whether lines turn along the edge of the region and hold on to the lines around it.
    pub is_anchored: bool,
}

/// Anchors of infill, in the words of PrusaSlicer and OrcaSlicer: their usual ones.
const ANCHORS: [&str; 2] = ["600%", "50"];
/// Settings by which lines end at the edge of a region.
const NO_ANCHORS: [&str; 2] = ["0", "0"];

/// What the slicer lays where the solid print meets a region, in PrusaSlicer's words: its usual
/// values. Presets of machines have others. Six layers for a shell moved the centre of a bunny of
/// 60 mm by 0.05 mm. Thin bridges moved it by 0.03 mm.
const AROUND_REGIONS: [[&str; 2]; 5] = [
    ["top_solid_min_thickness", "0"],
    ["bottom_solid_min_thickness", "0"],
    ["solid_infill_below_area", "70"],
    ["bridge_flow_ratio", "1"],
    ["thick_bridges", "1"],
];

/// What a region has nothing of, in PrusaSlicer's words.
const BARE: [&str; 3] = [
    "solid_infill_below_area",
    "top_solid_layers",
    "bottom_solid_layers",
];

/// Returns the settings that an object with a region has besides those of solid objects, in
/// PrusaSlicer's words.
pub(super) fn around_regions(walls: &Walls) -> Vec<Pair> {
    let layers = ["top_solid_layers", "bottom_solid_layers"];
    let layers = layers.map(|key| (key, walls.solid_layers.to_string()));
    let others = AROUND_REGIONS.map(|[key, value]| (key, value.to_owned()));
    layers.into_iter().chain(others).collect()
}

impl Infill {
    /// Returns the infill of a region whose triangles follow `first` others.
    pub fn of(region: &SparseRegion, first: usize) -> Self {
        Self {
            first,
            pattern: region.pattern.clone(),
            percent: region.percent,
            is_anchored: true,
        }
    }

    /// Returns the anchors of its lines. PrusaSlicer and OrcaSlicer have the same words for them.
    pub(super) fn anchors(&self) -> [Pair; 2] {
        let [length, most] = if self.is_anchored {
            ANCHORS
        } else {
            NO_ANCHORS
        };
        [
            ("infill_anchor", length.to_owned()),
            ("infill_anchor_max", most.to_owned()),
        ]
    }

    /// Returns the settings of the region in PrusaSlicer's words.
    ///
    /// Perimeters stay those of the object: with others, walls would be laid around the region. A
    /// small section stays sparse, and no solid layers are laid in it.
    ///
    /// Anchors are the slicer's usual ones. They lay along the edge of the region what the solid
    /// lines around it lack there. The centre of a bunny of 60 mm was 0.31 mm off without them, and
    /// 0.03 mm with them.
    pub fn for_prusa(&self) -> Vec<Pair> {
        // Without the sign, PrusaSlicer reads a multiple of solid print.
        let percent = format!("{}%", self.percent);
        let mut pairs = vec![
            ("name", "sparse infill".to_owned()),
            ("modifier", "1".to_owned()),
            ("volume_type", "ParameterModifier".to_owned()),
            ("fill_density", percent),
            ("fill_pattern", self.pattern.clone()),
        ];
        pairs.extend(self.anchors());
        pairs.extend(BARE.map(|key| (key, "0".to_owned())));
        pairs
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pairs(percent: f64) -> Vec<Pair> {
        let region = SparseRegion {
            mesh: TriMesh::default(),
            pattern: "gyroid".to_owned(),
            percent,
        };
        Infill::of(&region, 12).for_prusa()
    }

    #[test]
    fn the_density_of_a_region_carries_its_sign() {
        for (percent, said) in [(15.0, "15%"), (12.5, "12.5%")] {
            let pair = ("fill_density", said.to_owned());
            assert!(pairs(percent).contains(&pair), "{percent}");
        }
    }

    #[test]
    fn a_region_leaves_the_perimeters_to_its_object() {
        let pairs = pairs(15.0);
        assert!(pairs.iter().all(|(key, _)| !key.contains("perimeter")));
        assert!(pairs.contains(&("volume_type", "ParameterModifier".to_owned())));
    }
}
