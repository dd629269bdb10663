//! Pins in their sockets, felt out in the written files by rays: are they there, as large as
//! promised, and with the gap and the wall that were ordered?

use super::{Hardware, PartEvidence, Peg, Promise};
use crate::geom::{Bvh, Point, Vector, orthonormal_basis};
use crate::mesh::TriMesh;

/// Rays around a pin at each height: one for every flat of the pins that kits have.
const DIRECTIONS: usize = 48;
/// Heights at which a pin's and its socket's sides are felt, as shares of the pin's length: above
/// the socket's chamfer, below the pin's.
const HEIGHTS: [f64; 3] = [0.35, 0.5, 0.65];
/// Places of a pin's end and a socket's bottom that are felt.
const ENDS: usize = 4;
/// The part of a step by which rays and places are turned about the axis, so that none meets an
/// edge of a turned body exactly.
const ASKEW: f64 = 0.37;
/// Rays reach this many times the promised size: farther surfaces belong to something else.
const REACH_RATIO: f64 = 3.0;
/// Triangles of a part whose undersides are looked for in the other parts, at most.
const SAMPLES: usize = 4000;
/// How far under a part's surface it is looked whether another part is there too, mm: above the
/// rounding of files (4e-6 at 100 mm) and cut faces that coincide, below any printer's pixel.
const UNDER_MM: f64 = 0.005;

/// A pin and its socket as they were found in the files.
#[derive(Debug, Clone, PartialEq)]
pub struct PegFacts {
    /// The name that the pin and its socket share.
    pub id: String,
    /// How far the largest of radius, length and depth is from what was promised, mm; infinite
    /// where the pin does not stand in its part, or its mate has no socket there.
    pub deviation_mm: f64,
    /// The least gap between the pin's sides and the socket's, mm; nothing where either is missing.
    pub gap_mm: Option<f64>,
    /// The gap that was ordered, mm.
    pub ordered_gap_mm: f64,
    /// The least material between the socket and any surface of the uncut body, mm.
    pub wall_mm: f64,
}

/// A part's surface, ready for rays.
pub(super) struct Felt<'a> {
    pub(super) part: &'a PartEvidence,
    surface: Bvh,
}

impl<'a> Felt<'a> {
    pub(super) fn of(part: &'a PartEvidence) -> Self {
        Self {
            part,
            surface: Bvh::new(part.mesh.iter_corners()),
        }
    }

    /// Whether nothing of the part is between two points of the model.
    pub(super) fn is_clear(&self, from: &Point, to: &Point) -> bool {
        let [from, to] = [from, to].map(|p| self.part.pose.to_print(p));
        !self.surface.is_crossed_by(&from, &to)
    }

    /// Whether a point of the model lies in the part's material.
    pub(super) fn holds(&self, model: &Point) -> bool {
        self.surface.winding(&self.part.pose.to_print(model)) != 0
    }

    /// The distance from a point of the model to the part's surface along a unit direction, mm;
    /// none within `reach_mm`.
    fn feel(&self, model: &Point, direction: &Vector, reach_mm: f64) -> Option<f64> {
        let [from, to] =
            [*model, model + direction * reach_mm].map(|p| self.part.pose.to_print(&p));
        self.surface
            .first_crossing(&from, &to)
            .map(|share| share * reach_mm)
    }

    /// The distances of a peg's sides from its axis, mm, all around it at [`HEIGHTS`] of
    /// `length_mm`; none where there is no side.
    fn radii(&self, peg: &Peg, length_mm: f64) -> Option<Vec<f64>> {
        let (u, v) = orthonormal_basis(&peg.direction());
        let turn = |k: usize| std::f64::consts::TAU * (k as f64 + ASKEW) / DIRECTIONS as f64;
        let feel = |(height, k): (f64, usize)| {
            let side = u * turn(k).cos() + v * turn(k).sin();
            self.feel(
                &peg.at(height * length_mm),
                &side,
                REACH_RATIO * peg.diameter_mm,
            )
        };
        HEIGHTS
            .iter()
            .flat_map(|&height| (0..DIRECTIONS).map(move |k| (height, k)))
            .map(feel)
            .collect()
    }

    /// How high above the cut the peg ends over [`ENDS`] places beside its axis, mm.
    fn ends_mm(&self, peg: &Peg) -> Option<Vec<f64>> {
        let middle_mm = peg.length_mm / 2.0;
        let (u, v) = orthonormal_basis(&peg.direction());
        let feel = |k: usize| {
            let turn = std::f64::consts::TAU * (k as f64 + ASKEW) / ENDS as f64;
            let aside = (u * turn.cos() + v * turn.sin()) * (peg.diameter_mm / 8.0);
            let beyond_mm = self.feel(
                &(peg.at(middle_mm) + aside),
                &peg.direction(),
                REACH_RATIO * peg.length_mm,
            )?;
            Some(middle_mm + beyond_mm)
        };
        (0..ENDS).map(feel).collect()
    }
}

impl Peg {
    fn direction(&self) -> Vector {
        Vector::from(self.axis)
            .try_normalize(0.0)
            .unwrap_or_else(Vector::z)
    }

    /// The point of its axis so far above the cut.
    pub(super) fn at(&self, height_mm: f64) -> Point {
        Point::from(self.center_mm) + self.direction() * height_mm
    }
}

/// Every pin of the kit and its socket, felt out in the files, in the checklist's order.
pub(super) fn pegs(promise: &Promise, felt: &[Felt], hollowed: &TriMesh) -> Vec<PegFacts> {
    let whole = Bvh::new(hollowed.iter_corners());
    let carried = promise
        .parts
        .iter()
        .zip(felt)
        .flat_map(|(part, felt)| part.pins.iter().map(move |pin| (pin, felt)));
    let printed = carried.map(|(pin, carrier)| {
        let mut received = promise.parts.iter().zip(felt).filter_map(|(part, felt)| {
            part.sockets
                .iter()
                .find(|socket| socket.id == pin.id)
                .map(|socket| (socket, felt))
        });
        let ordered_gap_mm = promise.clearance_mm(&pin.joint);
        match received.next() {
            Some(mate) => seated((pin, carrier), mate, (&whole, ordered_gap_mm)),
            None => PegFacts {
                ordered_gap_mm,
                ..PegFacts::lost(&pin.id)
            },
        }
    });
    let dowels = promise
        .dowels
        .iter()
        .map(|dowel| dowelled(dowel, (promise, felt), &whole));
    printed.chain(dowels).collect()
}

/// A dowel's two sockets felt out.
fn dowelled(dowel: &Hardware, (promise, felt): (&Promise, &[Felt]), whole: &Bvh) -> PegFacts {
    let parts = promise.parts.iter().zip(felt);
    let ends: Vec<(&Peg, &Felt)> = parts
        .filter_map(|(part, felt)| {
            Some((part.sockets.iter().find(|peg| peg.id == dowel.id)?, felt))
        })
        .collect();
    let lost = PegFacts::lost(&dowel.id);
    let [first, second] = ends[..] else {
        return lost;
    };
    let ordered_gap_mm = promise.clearance_mm(&first.0.joint);
    let wall_mm = wall_mm(first.0, whole).min(wall_mm(second.0, whole));
    let lost = PegFacts {
        ordered_gap_mm,
        wall_mm,
        ..lost
    };
    let Some(found) = [first, second]
        .map(|end| socketed(end, dowel))
        .into_iter()
        .collect::<Option<Vec<_>>>()
    else {
        return lost;
    };
    PegFacts {
        deviation_mm: found.iter().map(|(off, _)| *off).fold(0.0, f64::max),
        gap_mm: Some(
            found
                .iter()
                .map(|(_, gap)| *gap)
                .fold(f64::INFINITY, f64::min),
        ),
        ..lost
    }
}

/// How far a dowel's socket is from what was promised, and the least gap around the dowel in it,
/// mm; none where there is no hole.
fn socketed((socket, part): (&Peg, &Felt), dowel: &Hardware) -> Option<(f64, f64)> {
    if part.holds(&socket.at(dowel.depth_mm / 2.0)) {
        return None;
    }
    let (radii, depths) = part
        .radii(socket, dowel.depth_mm)
        .zip(part.ends_mm(socket))?;
    let radius_mm = radii.iter().copied().fold(f64::INFINITY, f64::min);
    let off = depths.iter().map(|depth| (depth - socket.length_mm).abs());
    let off_mm = off.fold((radius_mm - socket.diameter_mm / 2.0).abs(), f64::max);
    Some((off_mm, radius_mm - dowel.diameter_mm / 2.0))
}

impl PegFacts {
    /// What is known of a pin that is not there.
    fn lost(id: &str) -> Self {
        Self {
            id: id.to_owned(),
            deviation_mm: f64::INFINITY,
            gap_mm: None,
            ordered_gap_mm: 0.0,
            wall_mm: 0.0,
        }
    }
}

/// A pin and its socket felt out.
fn seated(
    (pin, carrier): (&Peg, &Felt),
    (socket, receiver): (&Peg, &Felt),
    (whole, ordered_gap_mm): (&Bvh, f64),
) -> PegFacts {
    let wall_mm = wall_mm(socket, whole);
    let lost = PegFacts {
        ordered_gap_mm,
        wall_mm,
        ..PegFacts::lost(&pin.id)
    };
    let middle = pin.at(pin.length_mm / 2.0);
    if !carrier.holds(&middle) || receiver.holds(&middle) {
        return lost;
    }
    let Some((pins, sockets)) = carrier
        .radii(pin, pin.length_mm)
        .zip(receiver.radii(socket, pin.length_mm))
    else {
        return lost;
    };
    let Some((lengths, depths)) = carrier.ends_mm(pin).zip(receiver.ends_mm(socket)) else {
        return lost;
    };
    let gaps = pins.iter().zip(&sockets).map(|(pin, socket)| socket - pin);
    let greatest = |radii: &[f64]| radii.iter().copied().fold(0.0, f64::max);
    let least = |radii: &[f64]| radii.iter().copied().fold(f64::INFINITY, f64::min);
    let deviations = [
        greatest(&pins) - pin.diameter_mm / 2.0,
        least(&sockets) - socket.diameter_mm / 2.0,
        greatest(&lengths) - pin.length_mm,
        least(&lengths) - pin.length_mm,
        greatest(&depths) - socket.length_mm,
        least(&depths) - socket.length_mm,
    ];
    PegFacts {
        deviation_mm: deviations
            .iter()
            .fold(0.0, |worst: f64, off| worst.max(off.abs())),
        gap_mm: Some(gaps.fold(f64::INFINITY, f64::min)),
        ..lost
    }
}

/// The least material between a socket's bore and the surfaces of the uncut body, mm: the distance
/// of its axis from them less its radius, which is no more than the truth.
fn wall_mm(socket: &Peg, whole: &Bvh) -> f64 {
    let axis_mm =
        whole.segment_distance(&socket.at(0.0), &socket.at(socket.length_mm), f64::INFINITY);
    axis_mm - socket.diameter_mm / 2.0
}

/// How many of a sample of places just under the parts' surfaces lie in another part too.
pub(super) fn overlaps(felt: &[Felt]) -> usize {
    // Where a part ends in an edge, what lies under its surface may be outside of it already.
    let is_shared =
        |place: &Point, part: &Felt| part.holds(place) && is_in_another(place, part, felt);
    felt.iter()
        .map(|part| {
            under_surface(part.part)
                .filter(|place| is_shared(place, part))
                .count()
        })
        .sum()
}

/// Whether a place is in another part as well as in its own: under an acute rim it may be in
/// neither or in the mate alone.
fn is_in_another(place: &Point, own: &Felt, felt: &[Felt]) -> bool {
    own.holds(place)
        && felt
            .iter()
            .any(|other| !std::ptr::eq(other, own) && other.holds(place))
}

/// Places just under the middles of a sample of the part's triangles, model frame.
fn under_surface(part: &PartEvidence) -> impl Iterator<Item = Point> {
    let stride = part.mesh.triangles().len().div_ceil(SAMPLES).max(1);
    part.mesh
        .iter_corners()
        .step_by(stride)
        .filter_map(|[a, b, c]| {
            let inward = (c - a).cross(&(b - a)).try_normalize(0.0)?;
            let middle = Point::from((a.coords + b.coords + c.coords) / 3.0);
            Some(part.pose.to_model(&(middle + inward * UNDER_MM)))
        })
}
