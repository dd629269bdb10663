//! A drain hole: a straight bore from the outside into a void.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use crate::{
    cut::{
        error::CutError,
        hollowed::Hollowed,
        ids::{DrainId, VoidId},
        joints::pin_shape::SIDES,
    },
    geom::{Point, Vector, orthonormal_basis},
    mesh::{Csg, TriMesh, primitives::cylinder},
};

/// A bore through the wall of a void.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DrainHole {
    /// Its name: D1, D2, …
    pub id: DrainId,
    /// The void that it opens.
    pub void: VoidId,
    /// The outer end of its axis, just outside the body, mm.
    pub from_mm: [f64; 3],
    /// The inner end, just inside the void, mm.
    pub to_mm: [f64; 3],
    /// The diameter that is free everywhere, mm.
    pub diameter_mm: f64,
    /// The volume of material that it takes, mm³.
    pub volume_mm3: f64,
}

impl DrainHole {
    /// Returns the radius of the corners of a bore, mm. Its flats touch the circle of its diameter.
    pub(crate) fn corner_mm(diameter_mm: f64) -> f64 {
        diameter_mm / 2.0 / (PI / SIDES as f64).cos()
    }

    /// Returns the prism that is taken away: what of it lies in the body is material.
    pub(crate) fn bore(&self) -> TriMesh {
        let (from, to) = (Point::from(self.from_mm), Point::from(self.to_mm));
        let along: Vector = to - from;
        let axis = along.normalize();
        let (u, v) = orthonormal_basis(&axis);
        let prism = cylinder(
            Self::corner_mm(self.diameter_mm),
            along.norm(),
            SIDES as u32,
        );
        prism.map_vertices(|p| from + u * p.x + v * p.y + axis * p.z)
    }
}

/// Returns the surface of a body with drain holes.
pub(crate) fn bored(hollowed: &Hollowed, drains: &[DrainHole]) -> Result<TriMesh, CutError> {
    let whole = hollowed.to_mesh();
    if drains.is_empty() {
        return Ok(whole);
    }
    let mut body = Csg::of_mesh(&whole)?;
    for drain in drains {
        body = body.subtract(&Csg::of_mesh(&drain.bore())?)?;
    }
    Ok(body.to_mesh()?)
}

/// Returns the material that a hole takes from a body, as a closed mesh; empty if it takes none.
pub(crate) fn taken(body: &Csg, drain: &DrainHole) -> Result<TriMesh, CutError> {
    Ok(body.intersect(&Csg::of_mesh(&drain.bore())?)?.to_mesh()?)
}
