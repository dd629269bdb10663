//! Ballast and fillings as a kit declares them: their moments, and the room around the ballast.

use serde::{Deserialize, Serialize};

use crate::geom::Point;
use crate::mass::{Lump, Moments, moments_of_mesh};
use crate::mesh::{MeshDistance, TriMesh};

/// A stock part that is laid into a void during assembly.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastOrder {
    /// Its name on the sheet, such as `B1`.
    pub id: String,
    /// Its shape, mass and place.
    #[serde(flatten)]
    pub lump: Lump,
}

/// Returns the moments that the ballast adds to a body of this density, model frame.
pub(super) fn ballast_moments(ballast: &[BallastOrder], density_g_mm3: f64) -> Moments {
    let of_part = |order: &BallastOrder| order.lump.moments(density_g_mm3);
    ballast
        .iter()
        .map(of_part)
        .fold(Moments::default(), |sum, part| sum + part)
}

/// Returns the least gap between a part of ballast and the material around it, mm, or `None`
/// without ballast. Negative if a part lies in material or outside the body.
pub(super) fn least_room_mm(
    ballast: &[BallastOrder],
    hollowed: &TriMesh,
    outer: &TriMesh,
) -> Option<f64> {
    if ballast.is_empty() {
        return None;
    }
    let (material, outside) = (MeshDistance::new(hollowed), MeshDistance::new(outer));
    let room_mm = |order: &BallastOrder| {
        let (points, reach_mm) = order.lump.outline();
        let gaps = points.iter().map(|p| -material.signed(p) - reach_mm);
        gaps.fold(outside.signed(&Point::from(order.lump.center_mm)), f64::min)
    };
    Some(ballast.iter().map(room_mm).fold(f64::INFINITY, f64::min))
}

/// The filling of the voids.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FillOrder {
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
}

/// Returns the moments that a filling of the voids adds to a body of this density, model frame. The
/// surfaces of the voids are turned inward.
pub(super) fn fill_moments(
    fill: Option<FillOrder>,
    voids: &TriMesh,
    density_g_cm3: f64,
) -> Moments {
    fill.map_or(Moments::default(), |fill| {
        moments_of_mesh(voids) * (-fill.density_g_cm3 / density_g_cm3)
    })
}
