//! The smallest wall between the voids and the outside.

use super::Shells;
use crate::mesh::MeshDistance;

/// The smallest distance between the cavities of a hollowed body and its outer surface, mm: between
/// triangles, not between samples. None if there is no cavity.
///
/// A cavity of the model itself counts as a void; one that pierces the outside gives 0.
pub fn smallest_wall_mm(shells: &Shells) -> Option<f64> {
    if shells.inward.is_empty() || shells.outward.is_empty() {
        return None;
    }
    Some(MeshDistance::new(&shells.outer_mesh()).min_distance_to(&shells.inner_mesh()))
}
