//! Plugs: the bodies that close the drain holes of an uncut piece, once its voids are empty.

use crate::{
    cut::{drains::hole::DrainHole, error::CutError, plan::CutPlan},
    mesh::{Csg, Solid, TriMesh},
};

impl CutPlan {
    /// Returns the drain holes that get a plug, in the order of the plugs.
    pub fn plugged(&self) -> impl Iterator<Item = (&DrainHole, f64)> {
        let drains = self.drains.iter();
        drains.filter_map(|drain| Some((drain, drain.plug_gap_mm?)))
    }

    /// Returns the body of each plug, where it closes its hole in a body with this outside.
    ///
    /// Its outer end is the outside. Its inner end is flat: on that it is printed.
    pub(crate) fn plug_bodies(&self, outer: &Solid) -> Result<Vec<TriMesh>, CutError> {
        if self.plugged().next().is_none() {
            return Ok(Vec::new());
        }
        let outer = Csg::of_mesh(outer.mesh())?;
        let body = |(drain, gap_mm): (&DrainHole, f64)| {
            let prism = Csg::of_mesh(&drain.prism(gap_mm))?;
            Ok(outer.intersect(&prism)?.to_mesh()?)
        };
        self.plugged().map(body).collect()
    }
}
