//! Places for the heads of screws on a panel: clear of the joints along its edges, and far apart.

use super::overlap::left_of;
use crate::geom::{Frame, hull};
use crate::panels::{EdgeJoint, PanelEdge};

/// Distance between places that are tried, mm.
const STEP_MM: f64 = 6.0;
/// Most places that are tried along either side of a face.
const MOST_STEPS: f64 = 40.0;
/// The sharpest angle at the edge of a panel for which room is reckoned, radians: 80°.
const SHARPEST_RAD: f64 = 4.0 * std::f64::consts::PI / 9.0;

/// The room that a head takes up on a panel, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Head {
    pub diameter_mm: f64,
    pub height_mm: f64,
    /// Half the diameter, with room about it.
    pub radius_mm: f64,
}

/// The frame in which a panel is seen, and a point of the panel in it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<'a> {
    pub frame: &'a Frame,
    pub inside_mm: [f64; 2],
}

/// Returns the part of a ring in which heads keep clear of the joint along an edge.
pub(super) fn clear_of(
    ring: &[[f64; 2]],
    edge: &PanelEdge,
    seen: &Seen,
    head: &Head,
) -> Vec<[f64; 2]> {
    let mut depth_mm = edge.depth_mm + head.radius_mm;
    if matches!(edge.joint, EdgeJoint::Brackets(_)) {
        depth_mm += 0.5 * head.diameter_mm;
    }
    depth_mm += lean_mm(head, edge.angle_rad);
    clear_to(ring, edge, seen, depth_mm)
}

/// Returns by how much farther in a head would meet the other panel, where that one leans over this
/// one, mm.
pub(super) fn lean_mm(head: &Head, angle_rad: f64) -> f64 {
    head.height_mm * angle_rad.cos().max(0.0) / angle_rad.sin()
}

/// Returns the part of a ring that is farther than a depth, mm, from the line of an edge.
pub(super) fn clear_to(
    ring: &[[f64; 2]],
    edge: &PanelEdge,
    seen: &Seen,
    depth_mm: f64,
) -> Vec<[f64; 2]> {
    let [mut from, mut to] = edge.ends.map(|end| {
        let local = seen.frame.to_local(&end);
        [local.x, local.y]
    });
    if hull::turn(from, to, seen.inside_mm) < 0.0 {
        [from, to] = [to, from];
    }
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let inward = [(from[1] - to[1]) / length, (to[0] - from[0]) / length];
    let line = [from, to].map(|at| [0, 1].map(|k| at[k] + depth_mm * inward[k]));
    left_of(ring, line)
}

/// Returns the places in a ring that are tried: corners and sides of the ring, then a grid inside.
pub(super) fn places_in(ring: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut places = Vec::new();
    for (k, from) in ring.iter().enumerate() {
        let to = ring[(k + 1) % ring.len()];
        let steps = ((to[0] - from[0]).hypot(to[1] - from[1]) / STEP_MM).clamp(1.0, MOST_STEPS);
        let count = steps.ceil() as usize;
        let along = |step: usize| {
            let share = step as f64 / count as f64;
            [0, 1].map(|k| from[k] + share * (to[k] - from[k]))
        };
        places.extend((0..count).map(along));
    }
    let bound = |pick: fn(f64, f64) -> f64, start| {
        [0, 1].map(|k| ring.iter().map(|at| at[k]).fold(start, pick))
    };
    let (low, high) = (
        bound(f64::min, f64::INFINITY),
        bound(f64::max, f64::NEG_INFINITY),
    );
    let counts = [0, 1].map(|k| ((high[k] - low[k]) / STEP_MM).clamp(0.0, MOST_STEPS) as usize);
    let grid = (0..counts[0] * counts[1]).map(|cell| {
        let cell = [cell % counts[0], cell / counts[0]];
        [0, 1].map(|k| low[k] + (high[k] - low[k]) * (cell[k] as f64 + 0.5) / counts[k] as f64)
    });
    places.extend(grid.filter(|at| is_in(ring, at)));
    places
}

/// Returns true if a place lies inside a convex ring that runs counterclockwise; false for none.
pub(super) fn is_in(ring: &[[f64; 2]], at: &[f64; 2]) -> bool {
    let mut sides = (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]);
    ring.len() > 2 && sides.all(|[from, to]| hull::turn(from, to, *at) >= 0.0)
}

/// Returns how far from the line of a panel's edge a head stays clear, mm. It is clear of fingers
/// there, and of the panel beyond at the sharpest angle.
pub(super) fn beside_mm(head: &Head, sheet_mm: f64) -> f64 {
    let gap_mm = sheet_mm * (1.0 + SHARPEST_RAD.cos()) / SHARPEST_RAD.sin();
    gap_mm + lean_mm(head, SHARPEST_RAD) + head.radius_mm
}

/// Returns the mean of a ring's corners.
pub(super) fn middle_of(ring: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| ring.iter().map(|at| at[k]).sum::<f64>() / ring.len().max(1) as f64)
}

/// The number of places that are wanted, and their least distance, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Spacing {
    pub wanted: usize,
    pub least_mm: f64,
}

/// Returns places far apart: the one farthest from the middle, then each as far from the others as
/// can be.
pub(super) fn spread<T: Copy>(
    places: &[T],
    spacing: &Spacing,
    from_middle_mm: impl Fn(&T) -> f64,
    apart_mm: impl Fn(&T, &T) -> f64,
) -> Vec<T> {
    let mut chosen: Vec<T> = Vec::new();
    while chosen.len() < spacing.wanted {
        let room = |place: &T| {
            let gaps = chosen.iter().map(|one| apart_mm(one, place));
            gaps.reduce(f64::min)
                .unwrap_or_else(|| spacing.least_mm + from_middle_mm(place))
        };
        let next = places.iter().map(|place| (room(place), place));
        let next = next.reduce(|a, b| if b.0 > a.0 { b } else { a });
        match next.filter(|(room_mm, _)| *room_mm >= spacing.least_mm) {
            Some((_, place)) => chosen.push(*place),
            None => break,
        }
    }
    chosen
}
