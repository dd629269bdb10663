//! Sizes of pins and sockets, by the printer's rules, in steps of its pixels and layers.

use crate::cut::{
    joints::{pattern::FORCE_TOLERANCE_MM, pin_shape::PinSite},
    request::{PinSettings, PlanRequest},
};

/// Pin diameters tried, as multiples of the thinnest allowed, the thickest first. A thick pin
/// aligns better, a thin one finds room in more places.
const DIAMETER_RATIOS: [f64; 4] = [3.0, 2.0, 1.5, 1.0];

/// Length of the shortest pins over their diameter: the short end of common practice (1 to 1.5
/// diameters).
const SHORTEST_RATIO: f64 = 1.0;

/// A pin of some diameter with its socket, by the request's rules, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    pub(crate) diameter: f64,
    pub(crate) length: f64,
    pub(crate) chamfer: f64,
    pub(crate) socket_diameter: f64,
    pub(crate) depth: f64,
    /// For a dowel, the index of its rod in the request, and its length, mm.
    pub(crate) dowel: Option<(usize, f64)>,
}

impl Size {
    pub(crate) fn new(request: &PlanRequest, diameter: f64) -> Self {
        let pins = &request.pins;
        let length = round_up(diameter * pins.length_ratio, request.layer_mm);
        // A chamfer over a quarter of the diameter would leave a point instead of a tip.
        let chamfer = pins.chamfer_mm.min(diameter / 4.0);
        let socket_diameter = round_up(diameter + 2.0 * pins.clearance_mm, request.hole_step_mm);
        let depth = round_up(length + pins.bottom_relief_mm, request.layer_mm);
        Self {
            diameter,
            length,
            chamfer,
            socket_diameter,
            depth,
            dowel: None,
        }
    }

    /// Returns a dowel cut from one of the request's rods, to whole millimetres, with a socket on
    /// either side.
    fn of_rod(request: &PlanRequest, rod: usize) -> Self {
        let pins = &request.pins;
        let diameter = request.rods[rod].diameter_mm;
        let length_mm = (2.0 * pins.length_ratio * diameter).ceil();
        let depth = round_up(length_mm / 2.0 + pins.bottom_relief_mm, request.layer_mm);
        Self {
            length: length_mm / 2.0,
            depth,
            dowel: Some((rod, length_mm)),
            ..Self::new(request, diameter)
        }
    }

    /// Returns the depth inside the part that carries it, mm: of a printed pin's root, or of a
    /// dowel's second socket.
    pub(crate) fn back_mm(&self) -> f64 {
        if self.dowel.is_some() {
            self.depth
        } else {
            PinSite::root_mm(self.diameter)
        }
    }

    /// Returns the size of a placed pin.
    pub(crate) fn of(site: &PinSite) -> Self {
        Self {
            diameter: site.diameter_mm,
            length: site.length_mm,
            chamfer: site.socket_chamfer_mm,
            socket_diameter: site.socket_diameter_mm,
            depth: site.socket_depth_mm,
            dowel: site.dowel.as_ref().map(|dowel| (0, dowel.length_mm)),
        }
    }

    /// Returns the distance by which the pin moves in its socket to each side, mm. A dowel moves in
    /// two.
    pub(crate) fn room_to_move_mm(&self) -> f64 {
        PinSite::gap_mm(self.diameter, self.socket_diameter, self.dowel.is_some())
    }

    /// Returns the radius of the socket's corners, mm.
    pub(crate) fn corner(&self) -> f64 {
        PinSite::socket_corner_mm(self.socket_diameter)
    }

    /// Returns the diameter of the disc of material that the socket needs in the cut, mm.
    pub(crate) fn room_mm(&self, request: &PlanRequest) -> f64 {
        2.0 * (self.corner() + self.chamfer + request.wall_mm)
    }
}

/// Returns the smallest multiple of `step` that is not below `value`; `value` itself if there is no
/// step.
fn round_up(value: f64, step: f64) -> f64 {
    // A value that is a multiple already must not climb a step because of rounding.
    const SLACK: f64 = 1e-9;
    if step > 0.0 {
        (value / step - SLACK).ceil() * step
    } else {
        value
    }
}

/// Returns the diameter of the disc of material that the thinnest pin's socket needs, mm.
pub(crate) fn min_room_mm(request: &PlanRequest) -> f64 {
    let rooms = size_pairs(request)
        .into_iter()
        .flatten()
        .map(|size| size.room_mm(request));
    rooms.fold(f64::INFINITY, f64::min)
}

/// Returns the reach of the thickest pin's socket, with the wall around it, from the cut, mm.
pub(crate) fn reach_mm(request: &PlanRequest) -> f64 {
    let reaches = size_pairs(request)
        .into_iter()
        .flatten()
        .map(|size| size.depth + size.corner() + request.wall_mm);
    reaches.fold(0.0, f64::max)
}

/// Returns sizes of a joint's first pin and of the others, the thickest first; at least one pair.
/// They differ enough that no pin enters the other's socket. The last pair is equal, for joints
/// without room for others.
pub(crate) fn size_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    if request.rods.is_empty() {
        pin_pairs(request)
    } else {
        dowel_pairs(request)
    }
}

/// Returns the pairs of [`size_pairs`] as short as is common, for material too thin for longer
/// sockets. Empty if pins are that short anyway, or cut from rods.
pub(crate) fn short_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    if !request.rods.is_empty() || request.pins.length_ratio <= SHORTEST_RATIO {
        return Vec::new();
    }
    let pins = PinSettings {
        length_ratio: SHORTEST_RATIO,
        ..request.pins
    };
    pin_pairs(&PlanRequest {
        pins,
        ..request.clone()
    })
}

/// Returns the least difference of two pins' diameters, mm, at which neither enters the other's
/// socket.
fn step_mm(request: &PlanRequest) -> f64 {
    let gaps = round_up(2.0 * request.pins.clearance_mm, request.hole_step_mm);
    round_up(gaps + 2.0 * FORCE_TOLERANCE_MM, request.pixel_mm)
}

fn pin_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    let pixel = request.pixel_mm;
    let least = round_up(request.pins.min_diameter_mm, pixel);
    let step = step_mm(request);
    let mut thick: Vec<f64> = DIAMETER_RATIOS
        .iter()
        .map(|ratio| round_up(ratio * least, pixel))
        .collect();
    thick.push(least + step);
    thick.retain(|&diameter| diameter >= least + step);
    thick.sort_by(|a, b| b.total_cmp(a));
    let mut pairs: Vec<[f64; 2]> = thick
        .into_iter()
        .map(|diameter| [diameter, diameter - step])
        .collect();
    pairs.push([least, least]);
    pairs
        .into_iter()
        .map(|diameters| diameters.map(|d| Size::new(request, d)))
        .collect()
}

/// Pairs every rod with the thickest one that is thinner by enough. Rods thicker than the thickest
/// printed pin are left out, but the two thinnest always stay.
fn dowel_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    let mut rods: Vec<Size> = (0..request.rods.len())
        .map(|rod| Size::of_rod(request, rod))
        .collect();
    rods.sort_by(|a, b| a.diameter.total_cmp(&b.diameter));
    let thickest = DIAMETER_RATIOS[0] * request.pins.min_diameter_mm;
    let count = rods
        .iter()
        .filter(|size| size.diameter <= thickest)
        .count()
        .max(rods.len().min(2));
    rods.truncate(count);
    let thinner = |size: &Size| {
        let is_thinner = |other: &&Size| other.diameter + step_mm(request) <= size.diameter;
        rods.iter()
            .rev()
            .find(is_thinner)
            .map(|other| [*size, *other])
    };
    let mut pairs: Vec<[Size; 2]> = rods.iter().rev().filter_map(thinner).collect();
    pairs.extend(rods.first().map(|least| [*least, *least]));
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cut::scenes::request;

    #[test]
    fn short_pins_are_as_long_as_they_are_thick_and_no_thinner_than_others() {
        let request = request();
        let [usual, short] = [size_pairs(&request), short_pairs(&request)];
        assert_eq!(usual.len(), short.len());
        for (usual, short) in usual.iter().flatten().zip(short.iter().flatten()) {
            assert_eq!(
                (usual.diameter, usual.socket_diameter),
                (short.diameter, short.socket_diameter)
            );
            assert!(short.depth < usual.depth, "{short:?} {usual:?}");
            assert!(
                (short.length - short.diameter).abs() <= request.layer_mm,
                "{short:?}"
            );
        }
        let pins = PinSettings {
            length_ratio: 1.0,
            ..request.pins
        };
        assert!(short_pairs(&PlanRequest { pins, ..request }).is_empty());
    }
}
