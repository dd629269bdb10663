//! The model outside of a base, divided into parts by the cells of the faces.

use std::cmp::Ordering;

use rayon::prelude::*;

use super::cells::{Cell, cells};
use super::error::CladdingError;
use super::overlap::{barred_mm2, contact_mm2, face_mm2};
use super::part::{Crumb, Holding, Part, inner_point};
use super::region::{Bound, BoundKind, Region};
use super::rod_bore::RodBore;
use crate::base::watch::Watch;
use crate::geom::{Aabb, Plane, Vector};
use crate::mesh::{ClipError, Csg, Solid, TriMesh, bodies};
use crate::polyhedra::{Ground, Polyhedron};

/// Volume below which a piece is a sheet left by a plane along a face, mm³. A real piece of that
/// size would be a hundredth of a millimetre across, and no printer makes it.
const SHEET_VOLUME_MM3: f64 = 1e-6;
/// Area below which two parts only touch along an edge, mm².
const LEAST_CONTACT_MM2: f64 = 1e-3;
/// Area of a cut from which the other side holds a part, rather than another cell, mm². It is that
/// of a disc of some 11 mm, which has room for a pin of filament.
const WIDE_CUT_MM2: f64 = 100.0;
/// Margin of the box about the model, as a share of its size: the sides of the box then stay clear
/// of flat faces.
const MARGIN_RATIO: f64 = 0.01;
/// Distance by which a crumb is pressed into the part that it grows on, mm. The faces of both agree
/// to 1e-13 mm; so little volume is lost that no sum shows it.
const WELD_MM: f64 = 1e-6;

/// A model about its base, ready to be divided.
#[derive(Clone)]
pub struct Scene<'a> {
    /// The base.
    pub base: &'a Polyhedron,
    /// The gap between panels and parts, mm.
    pub gap_mm: f64,
    /// The model, rounded.
    pub(super) solid: Solid,
    model: Csg,
    /// A box with room about the model.
    pub(super) within: Aabb,
    /// The planes to other polyhedra that bound the base's part of the model.
    sides: Vec<Plane>,
    /// The bores of rods to other polyhedra.
    pub(super) rods: Vec<RodBore>,
}

impl<'a> Scene<'a> {
    /// Prepares a model. The parts are those of the rounded model that the base was proved in.
    ///
    /// # Errors
    /// The gap is negative, or as wide as the base's distance from the surface.
    pub fn new(ground: &Ground, base: &'a Polyhedron, gap_mm: f64) -> Result<Self, CladdingError> {
        if !(gap_mm >= 0.0 && gap_mm.is_finite()) {
            return Err(CladdingError::NotPositive {
                name: "the gap",
                value_mm: gap_mm,
            });
        }
        let distance_mm = base.separation().distance_mm;
        if gap_mm >= distance_mm {
            return Err(CladdingError::Gap {
                gap_mm,
                distance_mm,
            });
        }
        let mesh = ground.solid().mesh();
        let margin_mm = MARGIN_RATIO * mesh.longest_side_mm();
        Ok(Self {
            base,
            gap_mm,
            model: Csg::of_mesh(mesh)?,
            solid: ground.solid().clone(),
            within: mesh.aabb().inflated(margin_mm),
            sides: Vec::new(),
            rods: Vec::new(),
        })
    }

    /// Returns the scene of one polyhedron among several: its part of the model is bounded by
    /// planes whose normals point out of it.
    #[must_use]
    pub fn bounded_by(self, sides: Vec<Plane>) -> Self {
        Self { sides, ..self }
    }

    /// Returns the scene with bores for rods through its parts.
    #[must_use]
    pub(super) fn bored_for(self, rods: Vec<RodBore>) -> Self {
        Self { rods, ..self }
    }

    /// Returns the bores for rods over a face.
    pub(super) fn rods_over(&self, face: usize) -> impl Iterator<Item = &RodBore> {
        self.rods.iter().filter(move |rod| rod.face == face)
    }

    /// Returns the cells of the faces, each in the base's part of the model.
    fn cells(&self) -> Vec<Cell> {
        let bounded = cells(self.base, self.gap_mm).into_iter().map(|cell| {
            let sides = self.sides.iter().map(|&plane| Bound {
                plane,
                kind: BoundKind::Split,
            });
            Cell {
                region: sides.fold(cell.region, |region, side| region.with(side)),
                ..cell
            }
        });
        bounded.collect()
    }

    /// Returns the outward normal of a face.
    pub fn normal(&self, face: usize) -> Vector {
        self.base.faces()[face].plane.normal
    }

    /// Returns the bodies of the model in a region.
    pub(super) fn bodies_in(&self, region: &Region) -> Result<Vec<TriMesh>, ClipError> {
        let Some(body) = region.body(&self.within) else {
            return Ok(Vec::new());
        };
        pieces_of(&self.model.intersect(&Csg::of_mesh(&body)?)?)
    }

    /// Divides the model outside of the base: one part on each panel, and those pieces of the cells
    /// that reach no panel.
    ///
    /// A piece of at most `crumb_mm3` that reaches no panel grows on the part that it touches most.
    /// Both must then leave freely with all others still there. The rest is named as pinned to the
    /// part that it touches most.
    ///
    /// # Errors
    /// The boolean engine fails, or the watch is stopped.
    pub fn divide(&self, crumb_mm3: f64, watch: &Watch) -> Result<Vec<Part>, CladdingError> {
        let cells = self.cells();
        let parts = cells.par_iter().map(|cell| {
            watch.check()?;
            Ok(self.parts_in(cell)?)
        });
        let parts: Vec<Vec<Part>> = parts.collect::<Result<_, CladdingError>>()?;
        let mut parts = self.grow_crumbs(parts.concat(), crumb_mm3, watch)?;
        name_holdings(&mut parts);
        Ok(parts)
    }

    /// Returns the pieces of a cell, those on the panel first, then the largest first.
    fn parts_in(&self, cell: &Cell) -> Result<Vec<Part>, ClipError> {
        let bodies = self.bodies_in(&cell.region)?.into_iter();
        let mut parts: Vec<Part> = bodies
            .map(|body| new_part(cell.face, &cell.region, body))
            .collect();
        let rank = |part: &Part| (part.is_on_panel(), part.volume_mm3());
        parts.sort_by(|a, b| {
            let [(on_a, mm3_a), (on_b, mm3_b)] = [rank(a), rank(b)];
            on_b.cmp(&on_a).then(mm3_b.total_cmp(&mm3_a))
        });
        Ok(parts)
    }

    /// Lets crumbs grow on their neighbours, the smallest first.
    fn grow_crumbs(
        &self,
        mut parts: Vec<Part>,
        crumb_mm3: f64,
        watch: &Watch,
    ) -> Result<Vec<Part>, CladdingError> {
        let is_crumb = |part: &Part| !part.is_on_panel() && part.volume_mm3() <= crumb_mm3;
        let mut crumbs: Vec<(f64, usize)> = (0..parts.len())
            .filter(|&index| is_crumb(&parts[index]))
            .map(|index| (parts[index].volume_mm3(), index))
            .collect();
        crumbs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut is_gone = vec![false; parts.len()];
        for (volume_mm3, crumb) in crumbs {
            watch.check()?;
            for contact in contacts(&parts, crumb) {
                let to = contact.part;
                if is_gone[to] || !self.leaves_with(&parts, &is_gone, [crumb, to]) {
                    continue;
                }
                let own = &parts[crumb];
                let plane = own.region.bounds()[contact.bound].plane;
                let at = inner_point(&own.body);
                let body = welded(&own.body, &parts[to].body, &plane)?;
                if let (Some(at), Some(body)) = (at, body) {
                    let face = own.face;
                    is_gone[crumb] = true;
                    parts[to].body = body;
                    parts[to].crumbs.push(Crumb {
                        face,
                        at,
                        volume_mm3,
                        area_mm2: contact.area_mm2,
                    });
                    break;
                }
            }
        }
        let kept = parts.into_iter().zip(is_gone);
        Ok(kept
            .filter(|(_, is_gone)| !is_gone)
            .map(|(part, _)| part)
            .collect())
    }

    /// Returns true if a crumb leaves with the part that it is to grow on, and bars no other.
    fn leaves_with(&self, parts: &[Part], is_gone: &[bool], [crumb, to]: [usize; 2]) -> bool {
        let way = self.normal(parts[to].face);
        let mut others =
            (0..parts.len()).filter(|&other| other != crumb && other != to && !is_gone[other]);
        others.all(|other| {
            let own = self.normal(parts[other].face);
            let is_free = |moving: usize, fixed: usize, way: &Vector| {
                barred_mm2(&parts[moving].body, &parts[fixed].body, way) < LEAST_CONTACT_MM2
            };
            is_free(crumb, other, &way) && is_free(other, crumb, &own)
        })
    }
}

/// Returns the separate bodies of a cut one, without sheets that have no volume.
pub(super) fn pieces_of(cut: &Csg) -> Result<Vec<TriMesh>, ClipError> {
    let mut pieces = bodies(&cut.to_mesh()?);
    pieces.retain(|piece| piece.signed_volume_mm3() > SHEET_VOLUME_MM3);
    Ok(pieces)
}

/// Returns a part as it was cut, on its panel or on nothing yet.
pub(super) fn new_part(face: usize, region: &Region, body: TriMesh) -> Part {
    let floor_mm2 = region
        .bounds()
        .first()
        .map_or(0.0, |floor| face_mm2(&body, &floor.plane));
    Part {
        face,
        region: region.clone(),
        body,
        crumbs: Vec::new(),
        holding: if floor_mm2 > LEAST_CONTACT_MM2 {
            Holding::Panel {
                area_mm2: floor_mm2,
            }
        } else {
            Holding::Nothing
        },
    }
}

/// A place where a part touches another one.
struct Contact {
    part: usize,
    bound: usize,
    area_mm2: f64,
    /// True if it is a cut from a part of the same cell, with room for pins.
    is_cut: bool,
}

impl Contact {
    /// Compares two contacts: the better one is a cut, or else larger.
    fn compare(&self, other: &Self) -> Ordering {
        let by_kind = self.is_cut.cmp(&other.is_cut);
        by_kind.then(self.area_mm2.total_cmp(&other.area_mm2))
    }
}

/// Returns the contacts of a part with others along its bounds, the best first. Those in wide cuts
/// are better than others, as pins hold there and both leave as one. Then larger ones are.
fn contacts(parts: &[Part], part: usize) -> Vec<Contact> {
    let own = &parts[part];
    let bounds: Vec<(usize, &Bound)> = own.region.bounds().iter().enumerate().skip(1).collect();
    let others = (0..parts.len()).filter(|&other| other != part);
    let found = others.flat_map(|other| {
        bounds.iter().map(move |(bound, of)| {
            let area_mm2 = contact_mm2(&own.body, &parts[other].body, &of.plane);
            let is_within = of.kind == BoundKind::Cut && parts[other].face == own.face;
            Contact {
                part: other,
                bound: *bound,
                area_mm2,
                is_cut: is_within && area_mm2 >= WIDE_CUT_MM2,
            }
        })
    });
    let mut found: Vec<Contact> = found
        .filter(|contact| contact.area_mm2 > LEAST_CONTACT_MM2)
        .collect();
    found.sort_by(|a, b| b.compare(a));
    found
}

/// Names the carriers of all parts that bear on no panel. Step by step, one is pinned to a part
/// that has a path to the base: the pair with the best contact.
pub(super) fn name_holdings(parts: &mut [Part]) {
    let loose = parts.iter_mut().filter(|part| !part.is_on_panel());
    loose.for_each(|part| part.holding = Holding::Nothing);
    hold_loose(parts);
}

/// Names the carriers of all parts that nothing holds yet, in the same way.
pub(super) fn hold_loose(parts: &mut [Part]) {
    let mut is_held: Vec<bool> = parts
        .iter()
        .map(|part| part.holding != Holding::Nothing)
        .collect();
    let loose: Vec<usize> = (0..parts.len()).filter(|&part| !is_held[part]).collect();
    let all: Vec<Vec<Contact>> = loose.iter().map(|&part| contacts(parts, part)).collect();
    loop {
        let waiting = loose.iter().zip(&all).filter(|(part, _)| !is_held[**part]);
        let best = waiting.filter_map(|(part, contacts)| {
            let carrier = contacts.iter().find(|contact| is_held[contact.part])?;
            Some((*part, carrier))
        });
        let best = best.reduce(|a, b| if b.1.compare(a.1).is_gt() { b } else { a });
        let Some((part, carrier)) = best else { break };
        is_held[part] = true;
        parts[part].holding = Holding::Pinned {
            to: carrier.part,
            bound: carrier.bound,
            area_mm2: carrier.area_mm2,
        };
    }
}

/// Returns a crumb grown on the part above a plane; `None` if the two do not become one body.
fn welded(crumb: &TriMesh, part: &TriMesh, plane: &Plane) -> Result<Option<TriMesh>, ClipError> {
    let pressed = crumb.map_vertices(|p| p + plane.normal * WELD_MM);
    let whole = Csg::of_mesh(part)?.union(&Csg::of_mesh(&pressed)?)?;
    let whole = whole.to_mesh()?;
    Ok((bodies(&whole).len() == 1).then_some(whole))
}
