//! The order of the units about one polyhedron, or the knot that allows none.

use super::divide::Scene;
use super::error::CladdingError;
use super::knot::Knot;
use super::part::Part;
use super::units::{Assembly, Unit};
use crate::geom::Vector;

impl Scene<'_> {
    /// Gathers parts in units and orders them. `up` is the direction up of the object: the unit at
    /// the bottom comes last of those with a panel, after the higher ones.
    ///
    /// A part that is pinned to one of its own cell goes with it. A part that is pinned to one of
    /// another cell is a unit of its own: it leaves along its own way, before the other.
    ///
    /// # Errors
    /// The units bar each other's ways in a circle: the error names the parts, and a cut.
    pub fn assembly(&self, parts: &[Part], up: &Vector) -> Result<Assembly, CladdingError> {
        self.ordered(parts, self.blocked(parts, &[]), up)
    }

    /// Orders units so that the one at the bottom closes.
    pub(super) fn ordered(
        &self,
        parts: &[Part],
        units: Vec<Unit>,
        up: &Vector,
    ) -> Result<Assembly, CladdingError> {
        let closed = self.closed_by(units.clone(), up, self.bottom_face(up));
        closed.map_err(|waiting| knot(parts, &units, waiting).error())
    }
}

/// Returns the knot of units that wait for each other. Panels are in no part's way.
pub(super) fn knot<'a>(parts: &'a [Part], units: &'a [Unit], waiting: Vec<usize>) -> Knot<'a> {
    let bodies = |unit: &'a Unit| unit.parts.iter().map(|&part| &parts[part].body).collect();
    Knot {
        parts,
        units,
        bodies: units.iter().map(bodies).collect(),
        ways: units.iter().map(|unit| vec![unit.way]).collect(),
        waiting,
        standing: Vec::new(),
    }
}
