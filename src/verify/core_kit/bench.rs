//! Parts of a unit that are joined by pins on the bench, before the unit moves.

use super::promise::{CorePromise, PegPromise};
use crate::geom::Vector;

/// By how much the cosine of two pins may be off 1.
const AXIS_SLACK: f64 = 1e-9;

/// Two groups of parts that come together.
pub struct BenchJoint<'a> {
    /// The ids of the parts that come.
    pub moving: Vec<&'a String>,
    /// The ids of those to which they come.
    pub standing: Vec<&'a String>,
    /// The direction in which they would leave again, along the first pin.
    pub way: Vector,
    /// The first pin between them.
    pub peg: &'a PegPromise,
    /// True if all pins between them stand along the first.
    pub is_along: bool,
}

/// Returns the joints within units, in their listed order.
pub fn bench_joints(promise: &CorePromise) -> Vec<BenchJoint<'_>> {
    let unit_of = |id: &String| {
        promise
            .units
            .iter()
            .position(|unit| unit.parts.contains(id))
    };
    let benched = promise.pins.iter();
    let benched = benched.filter(|peg| unit_of(&peg.on) == unit_of(&peg.into));
    let benched: Vec<&PegPromise> = benched.collect();
    let mut groups: Vec<Vec<&String>> = Vec::new();
    for id in benched.iter().flat_map(|peg| [&peg.on, &peg.into]) {
        if !groups.iter().any(|group| group.contains(&id)) {
            groups.push(vec![id]);
        }
    }
    let mut joints = Vec::new();
    for peg in &benched {
        let place = |id: &String| groups.iter().position(|group| group.contains(&id));
        let (Some(one), Some(other)) = (place(&peg.on), place(&peg.into)) else {
            continue;
        };
        if one == other {
            continue;
        }
        let is_across = |pin: &&&PegPromise| {
            let ends = [place(&pin.on), place(&pin.into)];
            ends == [Some(one), Some(other)] || ends == [Some(other), Some(one)]
        };
        let way = Vector::from(peg.direction);
        let cosine = |pin: &&PegPromise| way.dot(&Vector::from(pin.direction)).abs();
        let mut across = benched.iter().filter(is_across);
        let is_along = across.all(|pin| cosine(pin) >= 1.0 - AXIS_SLACK);
        let moving = std::mem::take(&mut groups[other]);
        joints.push(BenchJoint {
            // A part with the socket leaves along its pin.
            moving: moving.clone(),
            standing: groups[one].clone(),
            way,
            peg,
            is_along,
        });
        groups[one].extend(moving);
    }
    joints
}
