//! How large pins and their sockets are made: by the printer's rules, in steps of its pixels and
//! layers.

use crate::cut::{
    joints::{pattern::FORCE_TOLERANCE_MM, pin_shape::PinSite},
    request::{PinSettings, PlanRequest},
};

/// Pin diameters that are tried, over the thinnest allowed, the stoutest first: a stout pin aligns
/// better, a thin one finds room in more places.
const DIAMETER_RATIOS: [f64; 4] = [3.0, 2.0, 1.5, 1.0];

/// The shortest pins over their diameter: the short end of what is usual (1 to 1.5 diameters).
const SHORTEST_RATIO: f64 = 1.0;

/// A pin of some diameter with its socket, by the request's rules, mm.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Size {
    pub(crate) diameter: f64,
    pub(crate) length: f64,
    pub(crate) chamfer: f64,
    pub(crate) socket_diameter: f64,
    pub(crate) depth: f64,
    /// A dowel: which of the request's rods it is cut from, and how long, mm.
    pub(crate) dowel: Option<(usize, f64)>,
}

impl Size {
    pub(crate) fn new(request: &PlanRequest, diameter: f64) -> Self {
        let pins = &request.pins;
        let length = round_up(diameter * pins.length_ratio, request.layer_mm);
        // A chamfer of more than a quarter of the diameter would leave a point instead of a tip.
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

    /// A dowel cut from one of the request's rods, to whole millimetres, with a socket on either
    /// side.
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

    /// How far it reaches into the part that carries it, mm: a printed pin's root, or a dowel's
    /// second socket.
    pub(crate) fn back_mm(&self) -> f64 {
        if self.dowel.is_some() {
            self.depth
        } else {
            PinSite::root_mm(self.diameter)
        }
    }

    /// The size that a placed pin has.
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

    /// The radius of the socket's corners, mm.
    pub(crate) fn corner(&self) -> f64 {
        PinSite::socket_corner_mm(self.socket_diameter)
    }

    /// The diameter of the disc of material that the socket needs in the cut, mm.
    pub(crate) fn room_mm(&self, request: &PlanRequest) -> f64 {
        2.0 * (self.corner() + self.chamfer + request.wall_mm)
    }
}

/// The smallest multiple of `step` that is not below `value`; `value` itself when there is no step.
fn round_up(value: f64, step: f64) -> f64 {
    // A value that is a multiple already must not climb a step because of rounding.
    const SLACK: f64 = 1e-9;
    if step > 0.0 {
        (value / step - SLACK).ceil() * step
    } else {
        value
    }
}

/// The diameter of the disc of material that the thinnest pin's socket needs, mm.
pub(crate) fn needed_room_mm(request: &PlanRequest) -> f64 {
    let rooms = size_pairs(request)
        .into_iter()
        .flatten()
        .map(|size| size.room_mm(request));
    rooms.fold(f64::INFINITY, f64::min)
}

/// How far from a cut the stoutest pin's socket with the wall around it reaches, mm.
pub(crate) fn reach_mm(request: &PlanRequest) -> f64 {
    let reaches = size_pairs(request)
        .into_iter()
        .flatten()
        .map(|size| size.depth + size.corner() + request.wall_mm);
    reaches.fold(0.0, f64::max)
}

/// Sizes of a joint's first pin and of the others, the stoutest first: different enough that a pin
/// does not enter the other's socket; last of all equal ones, for joints with room for nothing
/// else. At least one pair.
pub(crate) fn size_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    if request.rods.is_empty() {
        printed_pairs(request)
    } else {
        dowel_pairs(request)
    }
}

/// The same as short as is usual: for joints with material too thin for the sockets of longer ones.
/// None where pins are short anyway, or cut from rods.
pub(crate) fn short_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    if !request.rods.is_empty() || request.pins.length_ratio <= SHORTEST_RATIO {
        return Vec::new();
    }
    let pins = PinSettings {
        length_ratio: SHORTEST_RATIO,
        ..request.pins
    };
    printed_pairs(&PlanRequest {
        pins,
        ..request.clone()
    })
}

/// By how much the diameters of two pins differ at least, mm, if neither is to enter the other's
/// socket.
fn step_mm(request: &PlanRequest) -> f64 {
    let gaps = round_up(2.0 * request.pins.clearance_mm, request.hole_step_mm);
    round_up(gaps + 2.0 * FORCE_TOLERANCE_MM, request.pixel_mm)
}

fn printed_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    let pixel = request.pixel_mm;
    let least = round_up(request.pins.min_diameter_mm, pixel);
    let step = step_mm(request);
    let mut stout: Vec<f64> = DIAMETER_RATIOS
        .iter()
        .map(|ratio| round_up(ratio * least, pixel))
        .collect();
    stout.push(least + step);
    stout.retain(|&diameter| diameter >= least + step);
    stout.sort_by(|a, b| b.total_cmp(a));
    let mut pairs: Vec<[f64; 2]> = stout
        .into_iter()
        .map(|diameter| [diameter, diameter - step])
        .collect();
    pairs.push([least, least]);
    pairs
        .into_iter()
        .map(|diameters| diameters.map(|d| Size::new(request, d)))
        .collect()
}

/// Every rod with the thickest that is thinner by enough, no stouter than printed pins are tried
/// but for the two thinnest.
fn dowel_pairs(request: &PlanRequest) -> Vec<[Size; 2]> {
    let mut rods: Vec<Size> = (0..request.rods.len())
        .map(|rod| Size::of_rod(request, rod))
        .collect();
    rods.sort_by(|a, b| a.diameter.total_cmp(&b.diameter));
    let stoutest = DIAMETER_RATIOS[0] * request.pins.min_diameter_mm;
    let fit = rods
        .iter()
        .filter(|size| size.diameter <= stoutest)
        .count()
        .max(rods.len().min(2));
    rods.truncate(fit);
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
    fn short_pins_are_as_long_as_thick_and_no_thinner_than_others() {
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
