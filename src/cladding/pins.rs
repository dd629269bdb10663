//! Pins between parts: in the cuts of one cell, and where a limb lies on the part that carries it.
//!
//! Parts of one panel are put together on the bench, so that pins may stand in all cuts between
//! them. Each cut parts a body in two, and what is on either side comes together square to it. A
//! limb of another cell than its carrier gets pins only if nothing bars its way square to the seam.

use std::cmp::Reverse;

use super::divide::Scene;
use super::error::CladdingError;
use super::lie::Lie;
use super::overlap::contact_mm2;
use super::part::{Holding, Part};
use super::part_pins::PartPins;
use super::region::BoundKind;
use super::rod_bore::RodBore;
use super::rooms::Room;
use super::screws::PartScrews;
use super::shell::ShellRequest;
use super::units::{Unit, is_barred};
use crate::cut::{PinPlacer, PinSite, Touching};
use crate::geom::{Plane, Point, Vector};
use crate::mesh::TriMesh;

/// Area below which two parts have no room for a pin, mm².
const LEAST_CONTACT_MM2: f64 = 20.0;
/// The cosine from which a cut counts as one across the way of its cell.
const ACROSS: f64 = 0.5;

/// Two parts that touch in a plane and may be pinned.
struct Seat {
    /// The part below the plane, and the one above it.
    parts: [usize; 2],
    plane: Plane,
    /// The sides on which pins may stand: true for the part below.
    upward: &'static [bool],
}

impl Scene<'_> {
    /// Returns the pins of all parts, as far as they find room.
    ///
    /// # Errors
    /// The watch of the request is stopped.
    pub(super) fn pins(
        &self,
        parts: &[Part],
        screws: &[PartScrews],
        request: &ShellRequest,
    ) -> Result<Vec<PartPins>, CladdingError> {
        let Some(order) = request.pins else {
            return Ok(Vec::new());
        };
        let units = self.gather(parts);
        let mut seats = seats_in_cuts(parts, &units);
        seats.extend(seats_of_limbs(parts, &units));
        let mut pinner = Pinner {
            scene: self,
            parts,
            screws,
            request,
            done: Vec::new(),
        };
        let mut placer = PinPlacer::new(order.plan);
        for seat in seats {
            let pins = pinner.place(&seat, &mut placer)?;
            pinner.done.extend(pins);
        }
        Ok(pinner.done)
    }
}

/// Returns the pairs of parts of one unit that touch in a cut, in the order in which they are
/// joined. A cut that was made later is closed earlier. Then both sides of every cut are whole
/// again before they come together square to it.
fn seats_in_cuts(parts: &[Part], units: &[Unit]) -> Vec<Seat> {
    let unit_of = |part: usize| units.iter().position(|unit| unit.parts.contains(&part));
    let mut seats: Vec<(usize, Seat)> = Vec::new();
    for below in 0..parts.len() {
        let bounds = parts[below].region.bounds().iter().enumerate();
        for (depth, bound) in bounds.filter(|(_, bound)| bound.kind == BoundKind::Cut) {
            let plane = bound.plane;
            let others = (below + 1..parts.len()).filter(|&above| {
                let other = &parts[above];
                let is_beyond = || {
                    let mut bounds = other.region.bounds().iter();
                    bounds.any(|bound| bound.plane == plane.flipped())
                };
                other.face == parts[below].face && unit_of(above) == unit_of(below) && is_beyond()
            });
            seats.extend(others.map(|above| {
                let parts_beside = [below, above];
                let seat = Seat {
                    parts: parts_beside,
                    plane,
                    upward: sides_of_cut(parts, parts_beside, &plane),
                };
                (depth, seat)
            }));
        }
    }
    seats.sort_by_key(|(depth, _)| Reverse(*depth));
    seats.into_iter().map(|(_, seat)| seat).collect()
}

/// Returns the sides of a cut on which pins may stand. Where a part carries the other one, they
/// stand on it. In a cut across the way they stand on the part nearer to the panel, which is
/// printed with its panel's side down.
fn sides_of_cut(parts: &[Part], [below, above]: [usize; 2], plane: &Plane) -> &'static [bool] {
    let way = -parts[below].region.bounds()[0].plane.normal;
    let slope = way.dot(&plane.normal);
    if parts[above].holding.is_by(below) || slope > ACROSS {
        &[true]
    } else if parts[below].holding.is_by(above) || slope < -ACROSS {
        &[false]
    } else {
        &[true, false]
    }
}

/// Returns the pairs of a limb and what carries it. Such a limb leaves square to their seam, past
/// everything that does not hang on it. Pins stand on the carrier: the limb may then lie on its
/// seam while it is printed.
fn seats_of_limbs(parts: &[Part], units: &[Unit]) -> Vec<Seat> {
    let unit_of = |part: usize| units.iter().position(|unit| unit.parts.contains(&part));
    let seats = units.iter().enumerate().filter_map(|(index, unit)| {
        let way = unit.way_off(parts)?;
        let Holding::Pinned { to, bound, .. } = parts[unit.parts[0]].holding else {
            return None;
        };
        let moved = Unit {
            way,
            ..unit.clone()
        };
        let carrier = |unit: usize| match parts[*units[unit].parts.first()?].holding {
            Holding::Pinned { to, .. } => unit_of(to).filter(|carrier| *carrier != unit),
            _ => None,
        };
        // Every step goes to a carrier, so that it ends.
        let hangs = |other: usize| {
            let mut chain = std::iter::successors(Some(other), |unit| carrier(*unit));
            chain.any(|unit| unit == index)
        };
        let mut others = (0..units.len()).filter(|&other| !hangs(other));
        let is_free = others.all(|other| !is_barred(parts, &moved, &units[other]));
        is_free.then(|| Seat {
            parts: [unit.parts[0], to],
            plane: parts[unit.parts[0]].region.bounds()[bound].plane,
            upward: &[false],
        })
    });
    seats.collect()
}

/// Everything that pins depend on.
struct Pinner<'a> {
    scene: &'a Scene<'a>,
    parts: &'a [Part],
    screws: &'a [PartScrews],
    request: &'a ShellRequest<'a>,
    /// The pins that are placed already.
    done: Vec<PartPins>,
}

impl Pinner<'_> {
    /// Returns the pins between two parts; `None` if none find room.
    fn place(
        &self,
        seat: &Seat,
        placer: &mut PinPlacer,
    ) -> Result<Option<PartPins>, CladdingError> {
        let [below, above] = seat.parts.map(|part| &self.parts[part]);
        if contact_mm2(&below.body, &above.body, &seat.plane) < LEAST_CONTACT_MM2 {
            return Ok(None);
        }
        let bounds = [below, above].map(|part| part.region.bounds().iter());
        let within: Vec<Plane> = bounds
            .into_iter()
            .flatten()
            .map(|bound| bound.plane)
            .collect();
        let others: Vec<TriMesh> = seat
            .parts
            .iter()
            .flat_map(|&part| self.obstacles(part))
            .collect();
        let touching = Touching {
            plane: seat.plane,
            bodies: [&below.body, &above.body],
            within: &within,
            others: &others,
            upward: seat.upward,
        };
        let [lower, upper] = seat.parts;
        // All stand on the same part.
        let carrier = |sites: &[PinSite]| {
            let way = Vector::from(sites.first()?.direction);
            Some(if way.dot(&seat.plane.normal) > 0.0 {
                [lower, upper]
            } else {
                [upper, lower]
            })
        };
        let accepts =
            |sites: &[PinSite]| carrier(sites).is_some_and(|[on, _]| self.carries(on, sites));
        let sites = placer.place(&touching, accepts)?;
        Ok(carrier(&sites).map(|parts| PartPins { parts, sites }))
    }

    /// Returns the bores of a part for screws and rods, and the height below which heads of bracket
    /// screws may lie.
    fn obstacles(&self, part: usize) -> Vec<TriMesh> {
        let own = self.screws.iter().find(|screws| screws.part == part);
        let own = own.zip(self.request.kit);
        let mut all = own.map_or_else(Vec::new, |(screws, kit)| screws.bores(kit));
        let of = &self.parts[part];
        all.extend(self.scene.rods_over(of.face).map(RodBore::body));
        let floor_mm = self.request.pins.map_or(0.0, |pins| pins.floor_mm);
        if of.is_on_panel() && floor_mm > 0.0 {
            let up = self.scene.normal(of.face) * floor_mm;
            let outline = of.region.outline(0, &self.scene.within);
            let corners: Vec<Point> = outline.iter().map(|p| p + up).collect();
            let fan = (2..corners.len() as u32).map(|at| [0, at - 1, at]);
            let fan = fan.collect();
            all.push(TriMesh::from_parts(corners, fan));
        }
        all
    }

    /// Returns true if a part with these pins still fits the printer's room, and rests on its
    /// panel's side as before.
    fn carries(&self, part: usize, sites: &[PinSite]) -> bool {
        let of = &self.parts[part];
        let others = PartPins::on(&self.done, part, 0).into_iter();
        let tips = others.chain(sites).map(PinSite::protruding_body);
        let tips: Vec<Point> = tips.flat_map(TriMesh::into_vertices).collect();
        let floor = of.region.bounds()[0].plane;
        if of.is_on_panel() && tips.iter().any(|tip| floor.distance(tip) > 0.0) {
            return false;
        }
        let normal = self.scene.normal(of.face);
        let wall_mm = self.request.wall_mm;
        let fits = |size_mm| {
            let room = Room { size_mm, wall_mm };
            Lie::of_part(of, &tips, &normal, &room).is_some()
        };
        self.request.room_mm.is_none_or(fits)
    }
}
