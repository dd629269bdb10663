//! Pins and sockets, measured in the written files by rays: their sizes, gaps and walls, and parts
//! that reach into each other.

use super::part_probe::PartProbe;
use super::{Hardware, PartEvidence, Peg, Promise};
use crate::base::watch::{Cancelled, Watch};
use crate::geom::{Bvh, Point, Vector, orthonormal_basis};

/// Number of rays around a pin at each height: one for every flat of the pins in a kit.
const DIRECTIONS: usize = 48;
/// Heights at which the sides of a pin and its socket are measured, as shares of the pin's length.
/// They are above the socket's chamfer and below the pin's.
const HEIGHTS: [f64; 3] = [0.35, 0.5, 0.65];
/// Number of points measured on a pin's end and on a socket's bottom.
const ENDS: usize = 4;
/// Share of a step by which rays are turned about the axis, so that none meets an edge of a turned
/// body exactly.
const ASKEW: f64 = 0.37;
/// Reach of the rays as a multiple of the promised size; farther surfaces belong to something else.
const REACH_RATIO: f64 = 3.0;
/// Greatest number of triangles per part that are sampled for overlaps.
const SAMPLES: usize = 4000;
/// Depth of the overlap samples under a part's surface, mm. It is above the rounding of files (4e-6
/// at 100 mm), where cut faces coincide, and below any printer's pixel.
const UNDER_MM: f64 = 0.005;
/// Depth in another part up to which a sample is not in it, mm. Files round to 4e-6 at 100 mm:
/// coinciding cut faces overlap here and there by as much.
const ROUNDING_MM: f64 = 1e-4;

/// A pin and its socket as found in the files.
#[derive(Debug, Clone, PartialEq)]
pub struct PegFacts {
    /// The id that the pin and its socket share.
    pub id: String,
    /// The largest deviation of radius, length or depth from the promise, mm. Infinite if the pin
    /// or its socket is missing.
    pub deviation_mm: f64,
    /// The least gap between the sides of the pin and the socket, mm; `None` if either is missing.
    pub gap_mm: Option<f64>,
    /// The ordered gap, mm.
    pub ordered_gap_mm: f64,
    /// The least material between the socket and any surface of the uncut body, mm.
    pub wall_mm: f64,
}

impl PartProbe<'_> {
    /// Returns the distances of a peg's sides from its axis, mm, all around it at [`HEIGHTS`] of
    /// `length_mm`. `None` if a ray meets no side.
    fn radii(&self, peg: &Peg, length_mm: f64) -> Option<Vec<f64>> {
        let (u, v) = orthonormal_basis(&peg.direction());
        let turn = |k: usize| std::f64::consts::TAU * (k as f64 + ASKEW) / DIRECTIONS as f64;
        let radius = |(height, k): (f64, usize)| {
            let side = u * turn(k).cos() + v * turn(k).sin();
            self.distance_along(
                &peg.at(height * length_mm),
                &side,
                REACH_RATIO * peg.diameter_mm,
            )
        };
        HEIGHTS
            .iter()
            .flat_map(|&height| (0..DIRECTIONS).map(move |k| (height, k)))
            .map(radius)
            .collect()
    }

    /// Returns the heights of the peg's end above the cut at [`ENDS`] points beside its axis, mm.
    /// `None` if a ray meets no end.
    fn ends_mm(&self, peg: &Peg) -> Option<Vec<f64>> {
        let middle_mm = peg.length_mm / 2.0;
        let (u, v) = orthonormal_basis(&peg.direction());
        let end_mm = |k: usize| {
            let turn = std::f64::consts::TAU * (k as f64 + ASKEW) / ENDS as f64;
            let aside = (u * turn.cos() + v * turn.sin()) * (peg.diameter_mm / 8.0);
            let beyond_mm = self.distance_along(
                &(peg.at(middle_mm) + aside),
                &peg.direction(),
                REACH_RATIO * peg.length_mm,
            )?;
            Some(middle_mm + beyond_mm)
        };
        (0..ENDS).map(end_mm).collect()
    }
}

impl Peg {
    fn direction(&self) -> Vector {
        Vector::from(self.axis)
            .try_normalize(0.0)
            .unwrap_or_else(Vector::z)
    }

    /// Returns the point of its axis at this height above the cut.
    pub(super) fn at(&self, height_mm: f64) -> Point {
        Point::from(self.center_mm) + self.direction() * height_mm
    }
}

/// A peg on the part that has it.
#[derive(Clone, Copy)]
struct PegOnPart<'a> {
    peg: &'a Peg,
    part: &'a PartProbe<'a>,
}

/// A part with the pins and sockets that it promises.
#[derive(Clone, Copy)]
pub(super) struct PegBearer<'a> {
    pub(super) pins: &'a [Peg],
    pub(super) sockets: &'a [Peg],
    pub(super) part: &'a PartProbe<'a>,
}

/// Measures every pin of the kit with its socket, in the checklist's order, and then every dowel.
/// `whole` is the uncut result.
pub(super) fn measure_pegs(
    promise: &Promise,
    probes: &[PartProbe],
    whole: &Bvh,
    watch: &Watch,
) -> Result<Vec<PegFacts>, Cancelled> {
    let parts = promise.parts.iter().zip(probes);
    let bearers: Vec<PegBearer> = parts
        .map(|(part, probe)| PegBearer {
            pins: &part.pins,
            sockets: &part.sockets,
            part: probe,
        })
        .collect();
    let measured = measure_pins(&bearers, |pin| promise.clearance_mm(&pin.joint), whole);
    let printed = measured.map(|facts| {
        watch.check()?;
        Ok(facts)
    });
    let dowels = promise.dowels.iter().map(|dowel| {
        watch.check()?;
        let sockets = sockets_of(&dowel.id, &bearers);
        let lost = PegFacts::lost(&dowel.id);
        let [first, second] = sockets[..] else {
            return Ok(lost);
        };
        let wall_mm = wall_mm(first.peg, whole).min(wall_mm(second.peg, whole));
        let lost = PegFacts {
            ordered_gap_mm: promise.clearance_mm(&first.peg.joint),
            wall_mm,
            ..lost
        };
        Ok(measure_dowel(dowel, [first, second], lost))
    });
    printed.chain(dowels).collect()
}

/// Measures every printed pin with its socket, in the order of the parts. `gap_mm` tells the gap
/// that was ordered around a pin, `whole` is the surface of the uncut body.
pub(super) fn measure_pins<'a>(
    bearers: &'a [PegBearer],
    gap_mm: impl Fn(&Peg) -> f64 + 'a,
    whole: &'a Bvh,
) -> impl Iterator<Item = PegFacts> + 'a {
    let pins = bearers.iter().flat_map(|bearer| {
        let pins = bearer.pins.iter();
        pins.map(move |peg| PegOnPart {
            peg,
            part: bearer.part,
        })
    });
    pins.map(move |pin| {
        let lost = PegFacts {
            ordered_gap_mm: gap_mm(pin.peg),
            ..PegFacts::lost(&pin.peg.id)
        };
        match sockets_of(&pin.peg.id, bearers).first() {
            Some(socket) => measure_pin(pin, *socket, whole, lost),
            None => lost,
        }
    })
}

/// Returns the sockets that no part has a pin for, as pins that are not there.
pub(super) fn lone_sockets<'a>(bearers: &'a [PegBearer]) -> impl Iterator<Item = PegFacts> + 'a {
    let has_pin = |id: &String| {
        let mut pins = bearers.iter().flat_map(|bearer| bearer.pins);
        pins.any(|pin| pin.id == *id)
    };
    let sockets = bearers.iter().flat_map(|bearer| bearer.sockets);
    let lone = sockets.filter(move |socket| !has_pin(&socket.id));
    lone.map(|socket| PegFacts::lost(&socket.id))
}

/// Returns the first socket for a pin on each part that has one.
fn sockets_of<'a>(pin: &str, bearers: &[PegBearer<'a>]) -> Vec<PegOnPart<'a>> {
    let socket = |bearer: &PegBearer<'a>| {
        let peg = bearer.sockets.iter().find(|socket| socket.id == pin)?;
        Some(PegOnPart {
            peg,
            part: bearer.part,
        })
    };
    bearers.iter().filter_map(socket).collect()
}

/// Measures a dowel in its two sockets. `lost` holds the facts if a socket is missing.
fn measure_dowel(dowel: &Hardware, sockets: [PegOnPart; 2], lost: PegFacts) -> PegFacts {
    let sockets = sockets.map(|socket| measure_dowel_socket(socket, dowel));
    let Some(found) = sockets.into_iter().collect::<Option<Vec<_>>>() else {
        return lost;
    };
    let gaps = found.iter().map(|socket| socket.gap_mm);
    PegFacts {
        deviation_mm: found
            .iter()
            .map(|socket| socket.deviation_mm)
            .fold(0.0, f64::max),
        gap_mm: Some(gaps.fold(f64::INFINITY, f64::min)),
        ..lost
    }
}

/// A dowel's socket as found.
struct DowelSocket {
    /// Deviation from the promised radius or depth, mm.
    deviation_mm: f64,
    /// The least gap around the dowel, mm.
    gap_mm: f64,
}

/// Measures a dowel's socket; `None` if there is no hole.
fn measure_dowel_socket(socket: PegOnPart, dowel: &Hardware) -> Option<DowelSocket> {
    let PegOnPart { peg, part } = socket;
    if part.contains(&peg.at(dowel.depth_mm / 2.0)) {
        return None;
    }
    let (radii, depths) = part.radii(peg, dowel.depth_mm).zip(part.ends_mm(peg))?;
    let radius_mm = radii.iter().copied().fold(f64::INFINITY, f64::min);
    let off = depths.iter().map(|depth| (depth - peg.length_mm).abs());
    Some(DowelSocket {
        deviation_mm: off.fold((radius_mm - peg.diameter_mm / 2.0).abs(), f64::max),
        gap_mm: radius_mm - dowel.diameter_mm / 2.0,
    })
}

impl PegFacts {
    /// Returns the facts of a pin that is not there.
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

/// Measures a pin in its socket. `lost` holds the facts if either is missing.
fn measure_pin(pin: PegOnPart, socket: PegOnPart, whole: &Bvh, lost: PegFacts) -> PegFacts {
    let lost = PegFacts {
        wall_mm: wall_mm(socket.peg, whole),
        ..lost
    };
    let (carrier, receiver) = (pin.part, socket.part);
    let (pin, socket) = (pin.peg, socket.peg);
    let middle = pin.at(pin.length_mm / 2.0);
    if !carrier.contains(&middle) || receiver.contains(&middle) {
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

/// Returns the least material between a socket's bore and the surfaces of the uncut body, mm. It is
/// the distance of the axis from them less the radius, a lower bound.
fn wall_mm(socket: &Peg, whole: &Bvh) -> f64 {
    let axis_mm =
        whole.segment_distance(&socket.at(0.0), &socket.at(socket.length_mm), f64::INFINITY);
    axis_mm - socket.diameter_mm / 2.0
}

/// Counts the sample points just under the parts' surfaces that lie in another part too.
pub(super) fn count_overlaps(probes: &[PartProbe], watch: &Watch) -> Result<usize, Cancelled> {
    let overlaps = |probe: &PartProbe| {
        watch.check()?;
        let points = points_under_surface(probe.part);
        let shared = points.filter(|point| is_shared(point, probe, probes));
        Ok(shared.count())
    };
    probes.iter().map(overlaps).sum()
}

/// Returns true if a point lies in its own part and in another. Under an acute rim it may lie in
/// neither or in the mate alone.
fn is_shared(point: &Point, own: &PartProbe, probes: &[PartProbe]) -> bool {
    let is_deep = |other: &PartProbe| {
        let at = other.part.pose.to_print(point);
        other.surface.closest(&at, ROUNDING_MM, &[]).is_none()
    };
    let is_in = |other: &PartProbe| other.contains(point) && is_deep(other);
    own.contains(point)
        && probes
            .iter()
            .any(|other| !std::ptr::eq(other, own) && is_in(other))
}

/// Returns points just under the centroids of a sample of the part's triangles, model frame.
fn points_under_surface(part: &PartEvidence) -> impl Iterator<Item = Point> {
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
