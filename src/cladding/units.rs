//! Units: what leaves as one piece, in which direction and in which order.

use rayon::prelude::*;

use super::divide::Scene;
use super::overlap::barred_mm2;
use super::part::{Holding, Part};
use super::part_pins::PartPins;
use super::region::BoundKind;
use crate::geom::Vector;

/// Area below which a way is free, mm²: what rounding leaves along seams.
pub(super) const FREE_MM2: f64 = 1e-3;

/// A panel with its parts, or a part that is pinned to another unit: it moves as one piece.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// The index of the polyhedron to which it belongs.
    pub polyhedron: usize,
    /// The index of the face along whose normal it leaves.
    pub face: usize,
    /// True if it holds the panel of that face.
    pub has_panel: bool,
    /// The indices of its parts; each comes after the one that carries it.
    pub parts: Vec<usize>,
    /// The unit direction in which it leaves: the normal of its face, or that of its pins.
    pub way: Vector,
    /// The indices of the units that must leave before it.
    pub after: Vec<usize>,
}

/// Units and the order in which they are joined.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Assembly {
    /// The units.
    pub units: Vec<Unit>,
    /// The indices of the units in the order in which they are joined. To take the object apart,
    /// they leave in the reverse order.
    pub order: Vec<usize>,
    /// The index of the closing unit: the last one with a panel.
    pub closing: Option<usize>,
    /// The ways in which several polyhedra come together, in their order; empty for one.
    pub joins: Vec<Join>,
    /// The number of units at the end of the order that come after all joins.
    pub last: usize,
}

/// The joining of polyhedra that are put together, but still open, across a plane between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Join {
    /// The indices of the polyhedra that come.
    pub moving: Vec<usize>,
    /// The indices of those to which they come.
    pub standing: Vec<usize>,
    /// The direction in which they would leave again, a unit vector.
    pub way: Vector,
}

impl Unit {
    /// Returns the direction square to the seam in which a unit without a panel lies on the part
    /// that carries it; `None` for all others.
    pub(super) fn way_off(&self, parts: &[Part]) -> Option<Vector> {
        let first = &parts[*self.parts.first()?];
        let Holding::Pinned { bound, .. } = first.holding else {
            return None;
        };
        let bound = first.region.bounds()[bound];
        let is_seam = matches!(bound.kind, BoundKind::Seam { .. });
        (is_seam && !self.has_panel).then(|| -bound.plane.normal)
    }
}

impl Scene<'_> {
    /// Returns the face that looks down most along a direction.
    pub fn bottom_face(&self, up: &Vector) -> Option<usize> {
        self.base.bottom_face(up)
    }

    /// Orders units so that the one of a face closes; an error lists the units that wait for each
    /// other.
    pub(super) fn closed_by(
        &self,
        units: Vec<Unit>,
        up: &Vector,
        face: Option<usize>,
    ) -> Result<Assembly, Vec<usize>> {
        let closing = units
            .iter()
            .position(|unit| unit.has_panel && Some(unit.face) == face);
        let heights_mm: Vec<f64> = units
            .iter()
            .map(|unit| up.dot(&self.base.faces()[unit.face].centroid.coords))
            .collect();
        let order = order(&units, &heights_mm, closing)?;
        Ok(Assembly {
            units,
            order,
            closing,
            joins: Vec::new(),
            last: 0,
        })
    }

    /// Gathers parts in units, each with those that must leave before it. A unit that pins join to
    /// another one leaves along them.
    pub(super) fn blocked(&self, parts: &[Part], pins: &[PartPins]) -> Vec<Unit> {
        let mut units = self.gather(parts);
        for unit in &mut units {
            let Some(way) = unit.way_off(parts) else {
                continue;
            };
            let limb = unit.parts[0];
            if pins.iter().any(|pins| pins.holds_limb(parts, limb)) {
                unit.way = way;
            }
        }
        let unit_of = |part: usize| units.iter().position(|unit| unit.parts.contains(&part));
        let after: Vec<Vec<usize>> = (0..units.len())
            .into_par_iter()
            .map(|unit| {
                let others = (0..units.len()).filter(|&other| other != unit);
                let must_wait = |other: &usize| {
                    let carried = units[*other].parts.iter().any(|&part| {
                        let carrier = match parts[part].holding {
                            Holding::Pinned { to, .. } => unit_of(to),
                            _ => None,
                        };
                        carrier == Some(unit)
                    });
                    carried || is_barred(parts, &units[unit], &units[*other])
                };
                others.filter(must_wait).collect()
            })
            .collect();
        let units = units.into_iter().zip(after);
        units.map(|(unit, after)| Unit { after, ..unit }).collect()
    }

    /// Returns the units, those with panels first, without their order.
    pub(super) fn gather(&self, parts: &[Part]) -> Vec<Unit> {
        let new = |face: usize, has_panel: bool, parts: Vec<usize>| Unit {
            polyhedron: 0,
            face,
            has_panel,
            parts,
            way: self.normal(face),
            after: Vec::new(),
        };
        let faces = self.base.faces().iter().enumerate();
        let faces = faces.filter(|(_, face)| face.area_mm2 > 0.0);
        let mut units: Vec<Unit> = faces
            .map(|(face, _)| {
                let own = (0..parts.len())
                    .filter(|&part| parts[part].face == face && parts[part].is_on_panel());
                new(face, true, own.collect())
            })
            .collect();
        let mut waiting: Vec<usize> = (0..parts.len())
            .filter(|&part| !parts[part].is_on_panel())
            .collect();
        // Carriers come first: every pass finds at least one more unit.
        while !waiting.is_empty() {
            let count = waiting.len();
            waiting.retain(|&part| {
                let Holding::Pinned { to, .. } = parts[part].holding else {
                    units.push(new(parts[part].face, false, vec![part]));
                    return false;
                };
                let carrier = units.iter_mut().find(|unit| unit.parts.contains(&to));
                match carrier {
                    Some(unit) if unit.face == parts[part].face => unit.parts.push(part),
                    Some(_) => units.push(new(parts[part].face, false, vec![part])),
                    None => return true,
                }
                false
            });
            if waiting.len() == count {
                break;
            }
        }
        units
    }
}

/// Returns the order in which units are joined: the reverse of that in which they leave. An error
/// lists those that wait for each other.
///
/// The closing unit leaves as early as it can, and then the lower ones first.
fn order(
    units: &[Unit],
    heights_mm: &[f64],
    closing: Option<usize>,
) -> Result<Vec<usize>, Vec<usize>> {
    let mut before_closing = vec![false; units.len()];
    let mut open: Vec<usize> = closing.into_iter().collect();
    while let Some(unit) = open.pop() {
        if !std::mem::replace(&mut before_closing[unit], true) {
            open.extend(&units[unit].after);
        }
    }
    let mut has_left = vec![false; units.len()];
    let mut order = Vec::with_capacity(units.len());
    while order.len() < units.len() {
        let is_ready = |unit: &usize| {
            !has_left[*unit] && units[*unit].after.iter().all(|&other| has_left[other])
        };
        let ready = (0..units.len()).filter(is_ready);
        let next = ready.min_by(|&a, &b| {
            let first = before_closing[b].cmp(&before_closing[a]);
            first.then(heights_mm[a].total_cmp(&heights_mm[b]))
        });
        let Some(next) = next else {
            return Err((0..units.len()).filter(|&unit| !has_left[unit]).collect());
        };
        has_left[next] = true;
        order.push(next);
    }
    order.reverse();
    Ok(order)
}

/// Returns true if a unit on its way meets a part of another one.
pub(super) fn is_barred(parts: &[Part], unit: &Unit, other: &Unit) -> bool {
    unit.parts.iter().any(|&moving| {
        other
            .parts
            .iter()
            .any(|&fixed| barred_mm2(&parts[moving].body, &parts[fixed].body, &unit.way) > FREE_MM2)
    })
}
