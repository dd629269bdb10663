//! Ballast as a kit declares it: parts of stated mass at stated places, and whether they have room
//! there; and fillings.

use serde::{Deserialize, Serialize};

use super::{Check, CheckKind, Limit};
use crate::geom::Point;
use crate::mass::{Lump, Moments, moments_of_mesh};
use crate::mesh::{MeshDistance, TriMesh};

/// A stock part that is laid into a void when the kit is put together.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BallastOrder {
    /// Its name on the sheet, such as `B1`.
    pub id: String,
    /// Its shape, mass and place.
    #[serde(flatten)]
    pub lump: Lump,
}

/// What the parts add to a body of `density_g_mm3`, model frame.
pub(super) fn ballast_moments(ballast: &[BallastOrder], density_g_mm3: f64) -> Moments {
    let of_part = |order: &BallastOrder| order.lump.moments(density_g_mm3);
    ballast
        .iter()
        .map(of_part)
        .fold(Moments::default(), |sum, part| sum + part)
}

/// The least gap between a part of ballast and the material around it, mm; negative where one lies
/// in material, or outside the body; none without ballast.
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

/// Whether every part of ballast fits where it was declared to lie.
pub(super) fn room_check(room_mm: f64) -> Check {
    let promise = "every part of ballast lies in a void, with a gap around it of";
    Check::new(
        CheckKind::BallastRoom,
        promise,
        Some(room_mm),
        Limit::above(0.0, "mm"),
    )
}

/// What the voids are filled with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FillOrder {
    /// Its density, g/cm³.
    pub density_g_cm3: f64,
}

/// What a filling of the voids, which are turned inward, adds to a body of `density_g_cm3`, model
/// frame.
pub(super) fn fill_moments(
    fill: Option<FillOrder>,
    voids: &TriMesh,
    density_g_cm3: f64,
) -> Moments {
    fill.map_or(Moments::default(), |fill| {
        moments_of_mesh(voids) * (-fill.density_g_cm3 / density_g_cm3)
    })
}
