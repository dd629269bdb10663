//! Sparse infill in one piece, as a kit declares it: its regions, and what they weigh.

use serde::{Deserialize, Serialize};

use crate::base::units::MM3_PER_CM3;
use crate::mass::{Moments, moments_of_mesh};
use crate::mesh::TriMesh;

/// The regions of sparse infill in a print of one piece.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InfillOrder {
    /// The pattern of the infill, in the words of slicers.
    pub pattern: String,
    /// The density to set in the slicer, over that of solid print.
    pub nominal_ratio: f64,
    /// The density that is laid, over that of solid print.
    pub laid_ratio: f64,
    /// Number of the regions: the closed cavities of the part.
    pub regions: usize,
    /// Their volume, mm³.
    pub volume_mm3: f64,
    /// Their mass as laid, g.
    pub mass_g: f64,
    /// The moments of what a slicer lays beyond this, in the model frame, mm³ to mm⁵. They are
    /// those of 1, x, y, z, xy, yz, xz, x², y² and z². `None` if it was not asked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beyond: Option<[f64; 10]>,
    /// The distances between the centre of the toolpaths and the promised one, round by round, mm.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub misses_mm: Vec<f64>,
    /// The file that bounds them, relative to the kit; `None` if they are in the part's file.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub file: Option<String>,
}

impl InfillOrder {
    /// Returns the moments of what a slicer lays beyond surfaces and regions, model frame.
    pub(super) fn beyond(&self) -> Moments {
        self.beyond.map_or(Moments::default(), Moments)
    }

    /// Returns the mass that is laid besides solid print, g.
    pub fn extra_g(&self, density_g_cm3: f64) -> f64 {
        self.mass_g + self.beyond().volume() * density_g_cm3 / MM3_PER_CM3
    }
}

/// Returns the moments of what is laid in the cavities of a surface, in volumes of solid print.
/// Cavities are turned inward.
pub(super) fn sparse_moments(infill: Option<&InfillOrder>, cavities: &TriMesh) -> Moments {
    infill.map_or(Moments::default(), |infill| {
        moments_of_mesh(cavities) * -infill.laid_ratio
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::Point;
    use crate::mesh::primitives::cuboid;

    #[test]
    fn a_region_weighs_its_share_of_solid_print_in_its_place() {
        let region = cuboid(&Point::new(1.0, 2.0, 3.0), &Point::new(3.0, 6.0, 11.0));
        let order = InfillOrder {
            pattern: "gyroid".to_owned(),
            nominal_ratio: 0.15,
            laid_ratio: 0.142,
            regions: 1,
            volume_mm3: 64.0,
            mass_g: 0.011,
            beyond: None,
            misses_mm: Vec::new(),
            file: None,
        };
        let laid = sparse_moments(Some(&order), &region.reversed());
        assert!((laid.volume() - 0.142 * 64.0).abs() < 1e-12);
        assert!((laid.centroid() - Point::new(2.0, 4.0, 7.0)).norm() < 1e-12);
        assert_eq!(sparse_moments(None, &region), Moments::default());
    }
}
