//! A drain hole as the kit states it, and the prism that it takes away.

use std::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::geom::{Point, orthonormal_basis};
use crate::mesh::Csg;

/// Number of sides of every bore, around the circle of its diameter.
const SIDES: u32 = 48;

/// A drain hole as the kit states it: a straight bore from the outside into a void.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PromisedHole {
    /// The name on the sheet, such as `D1`.
    pub id: String,
    /// The name of the void that it opens, such as `V1`.
    pub void: String,
    /// The outer end of its axis, just outside the body, model frame, mm.
    pub from_mm: [f64; 3],
    /// The inner end, just inside the void, model frame, mm.
    pub to_mm: [f64; 3],
    /// The free diameter, mm.
    pub diameter_mm: f64,
    /// The volume of material that it takes, mm³.
    pub volume_mm3: f64,
}

impl PromisedHole {
    /// Returns the prism that is bored; `None` if its numbers bound none.
    pub(super) fn prism(&self) -> Option<Csg> {
        let (from, to) = (Point::from(self.from_mm), Point::from(self.to_mm));
        let along = to - from;
        let axis = along.try_normalize(f64::EPSILON)?;
        let (u, v) = orthonormal_basis(&axis);
        let radius_mm = 0.5 * self.diameter_mm / (PI / f64::from(SIDES)).cos();
        let corner = |side: u32| {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(SIDES)).sin_cos();
            from + (u * cos + v * sin) * radius_mm
        };
        let rim: Vec<Point> = (0..SIDES).map(corner).collect();
        let ends: Vec<Point> = rim.iter().flat_map(|p| [*p, p + along]).collect();
        Csg::convex_hull(&ends)
            .ok()
            .filter(|prism| !prism.is_empty())
    }
}
