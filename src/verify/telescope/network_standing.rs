//! The standing of several telescopes on their first juncture.

use super::course::mixed;
use super::network::{NetworkEvidence, Places};
use super::pose::PoseState;
use crate::geom::{Frame, Point, Vector};
use crate::mesh::TriMesh;
use crate::verify::Support;

/// States of each move at which it is looked at how it stands.
const STATES: usize = 20;

/// The standing of several telescopes on their first juncture.
#[derive(Debug, Clone, PartialEq)]
pub struct NetworkStanding {
    /// The lean at which it topples at every key, degrees.
    pub toppling_deg: Vec<f64>,
    /// The same at the worst of the keys and 20 states of each move, degrees.
    pub least_deg: f64,
    /// The depth to which any part reaches below the first juncture over the motion, mm.
    pub below_mm: f64,
}

/// A state as it stands.
pub(super) struct Balanced {
    /// The centre of mass.
    pub centre: Point,
    /// The height of the lowest vertex, mm.
    pub lowest_mm: f64,
}

/// Measures the standing on a base that does not move. `state` weighs all bodies in their places,
/// and finds the lowest; the frame leads from the model's axes to those whose z is up.
pub(super) fn measure_standing(
    evidence: &NetworkEvidence,
    base: &TriMesh,
    state: impl Fn(&Places, &Frame) -> Balanced,
) -> NetworkStanding {
    let up = Frame::with_axis(Point::origin(), &Vector::from(evidence.motion.up));
    let to_ground = up.inverse();
    let support = Support::of_mesh(base, &up);
    let found = |states: &PoseState| {
        let balanced = state(&evidence.places(states), &to_ground);
        let lean = support.toppling_angle(&up.to_local(&balanced.centre));
        let below_mm = support.ground_mm - balanced.lowest_mm;
        (lean.to_degrees(), below_mm)
    };
    let keys: Vec<&PoseState> = evidence.motion.keys.iter().map(|key| &key.states).collect();
    let at_keys: Vec<(f64, f64)> = keys.iter().map(|states| found(states)).collect();
    let between = keys.windows(2).flat_map(|pair| {
        (1..STATES).map(|i| {
            let share = i as f64 / STATES as f64;
            let limbs = pair[0].iter().zip(pair[1]);
            limbs.map(|(a, b)| mixed(a, b, share)).collect()
        })
    });
    let between = between.map(|states: PoseState| found(&states));
    let mut standing = NetworkStanding {
        toppling_deg: at_keys.iter().map(|(lean, _)| *lean).collect(),
        least_deg: f64::INFINITY,
        below_mm: 0.0,
    };
    for (lean_deg, below_mm) in at_keys.iter().copied().chain(between) {
        standing.least_deg = standing.least_deg.min(lean_deg);
        standing.below_mm = standing.below_mm.max(below_mm);
    }
    standing
}
