//! The uncut result, taken apart once for all that is measured on it.

use super::Shells;
use crate::base::watch::{Cancelled, Watch};
use crate::geom::Bvh;
use crate::mesh::{TriMesh, least_distance_mm};
use crate::repair::weld;

/// The uncut result as it was read back, taken apart.
#[derive(Debug, Clone)]
pub struct Body {
    /// Its triangles, with corners at one place made one.
    pub welded: TriMesh,
    /// Its connected pieces.
    pub shells: Shells,
    /// Its outside.
    pub outer: TriMesh,
    /// The tree over the triangles of the outside.
    pub(super) outside: Bvh,
    /// The tree over all triangles.
    pub(super) whole: Bvh,
}

impl Body {
    /// Takes the mesh of an uncut result apart.
    pub fn of(hollowed: &TriMesh) -> Self {
        let welded = weld(hollowed);
        let shells = Shells::of_mesh(&welded);
        let outer = shells.outer_mesh();
        let (outside, whole) = rayon::join(
            || Bvh::new(outer.iter_corners()),
            || Bvh::new(welded.iter_corners()),
        );
        Self {
            outside,
            whole,
            welded,
            shells,
            outer,
        }
    }

    /// Returns the smallest wall between the cavities and the outer surface, mm, or `None` if there
    /// is no cavity. It is the distance between triangles, not between samples.
    ///
    /// A cavity of the model itself counts as a void; one that pierces the outside gives 0.
    pub(super) fn smallest_wall_mm(&self, watch: &Watch) -> Result<Option<f64>, Cancelled> {
        watch.check()?;
        let inner = self.shells.inner_mesh();
        let is_there = !inner.is_empty() && !self.outer.is_empty();
        Ok(is_there.then(|| least_distance_mm(&self.outside, &inner)))
    }
}
