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
    /// The diameter at the outer end, mm: as that, or wider for a plug.
    pub mouth_mm: f64,
    /// The gap on each side of its plug, mm; `None` without a plug.
    pub plug_gap_mm: Option<f64>,
    /// The volume of material that it takes, mm³.
    pub volume_mm3: f64,
}

impl DrainHole {
    /// Returns the radius of the corners of a bore, mm. Its flats touch the circle of its diameter.
    pub(crate) fn corner_mm(diameter_mm: f64) -> f64 {
        diameter_mm / 2.0 / (PI / SIDES as f64).cos()
    }

    /// Returns the unit direction into the body.
    pub(crate) fn axis(&self) -> Vector {
        (Point::from(self.to_mm) - Point::from(self.from_mm)).normalize()
    }

    /// Returns the prism that is taken away: what of it lies in the body is material.
    pub(crate) fn bore(&self) -> TriMesh {
        self.prism(0.0)
    }

    /// Returns the prism of the hole, smaller by a gap on each side, mm.
    pub(crate) fn prism(&self, gap_mm: f64) -> TriMesh {
        let (from, to) = (Point::from(self.from_mm), Point::from(self.to_mm));
        let (axis, length_mm) = (self.axis(), (to - from).norm());
        let (u, v) = orthonormal_basis(&axis);
        // A gap is normal to the flanks, which lean.
        let slope = 0.5 * (self.mouth_mm - self.diameter_mm) / length_mm;
        let less_mm = 2.0 * gap_mm * (1.0 + slope * slope).sqrt();
        let mouth_mm = Self::corner_mm(self.mouth_mm - less_mm);
        let narrowing = (self.diameter_mm - less_mm) / (self.mouth_mm - less_mm);
        let prism = cylinder(mouth_mm, length_mm, SIDES as u32);
        prism.map_vertices(|p| {
            let share = 1.0 + (narrowing - 1.0) * p.z / length_mm;
            from + u * (p.x * share) + v * (p.y * share) + axis * p.z
        })
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
