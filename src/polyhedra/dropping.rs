//! The face that is missed least.

use super::growth::Growth;
use crate::geom::Plane;

/// A face smaller than the square of this share of the model's size is none.
const IDLE_RATIO: f64 = 1e-3;

/// The obstacles that one face alone parts, with the best of the other faces.
type Alone = Vec<(usize, usize)>;

/// Drops the face that costs least; `None` if no face can go.
///
/// Other faces move inward to part what the face alone parted. Either each obstacle goes to the
/// face that is nearest to parting it, or all go to one face.
pub(super) fn drop_cheapest<'a>(growth: &mut Growth<'a>) -> Option<Growth<'a>> {
    let alone = parted_alone(growth);
    let ways = (0..growth.planes.len()).filter_map(|face| without(growth, face, &alone[face]));
    let ways: Vec<Growth> = ways.collect();
    ways.into_iter().reduce(better)
}

/// Drops faces that have no area, and so bound nothing.
pub(super) fn drop_idle<'a>(mut growth: Growth<'a>) -> Growth<'a> {
    loop {
        let least_mm2 = (IDLE_RATIO * growth.size_mm()).powi(2);
        let measures = growth.body.measures(growth.planes.len());
        let idle = (0..growth.planes.len()).find(|&face| {
            let area_mm2 = measures[face].map_or(0.0, |measure| measure.area_mm2);
            !growth.is_locked[face] && area_mm2 < least_mm2
        });
        let Some(face) = idle else { return growth };
        let alone = parted_alone(&mut growth);
        match without(&mut growth, face, &alone[face]) {
            Some(next) => growth = next,
            None => return growth,
        }
    }
}

fn better<'a>(a: Growth<'a>, b: Growth<'a>) -> Growth<'a> {
    if b.merit_mm3 > a.merit_mm3 { b } else { a }
}

/// Returns the best growth without a face; `None` if it is locked or cannot go.
fn without<'a>(growth: &mut Growth<'a>, face: usize, alone: &Alone) -> Option<Growth<'a>> {
    if growth.is_locked[face] {
        return None;
    }
    let kept: Vec<usize> = (0..growth.planes.len()).filter(|&f| f != face).collect();
    let ways = pulled(growth, face, alone).into_iter();
    let found = ways.filter_map(|moved| {
        let planes = kept.iter().map(|&f| Plane {
            offset_mm: growth.planes[f].offset_mm - moved[f],
            ..growth.planes[f]
        });
        let next = growth.with_planes(planes.collect(), &kept)?;
        growth.meets(&next).then_some(next)
    });
    found.reduce(better)
}

/// Returns what each face alone parts.
fn parted_alone(growth: &mut Growth) -> Vec<Alone> {
    let distance_mm = growth.terms.distance_mm;
    let mut alone = vec![Alone::new(); growth.planes.len()];
    let count = growth.terms.obstacles.len();
    let mut first = vec![(f64::NEG_INFINITY, 0); count];
    let mut second = first.clone();
    for (face, parted) in growth.parted().iter().enumerate() {
        for ((first, second), &parted) in first.iter_mut().zip(&mut second).zip(parted) {
            if parted > first.0 {
                *second = *first;
                *first = (parted, face);
            } else if parted > second.0 {
                *second = (parted, face);
            }
        }
    }
    for (obstacle, (first, second)) in first.iter().zip(&second).enumerate() {
        if second.0 < distance_mm {
            alone[first.1].push((obstacle, second.1));
        }
    }
    alone
}

/// Returns ways to move the other faces inward so that they part what `face` alone parted: for
/// each way, the move of every face, mm.
fn pulled(growth: &mut Growth, face: usize, alone: &Alone) -> Vec<Vec<f64>> {
    let count = growth.planes.len();
    let is_locked = growth.is_locked.clone();
    let distance_mm = growth.terms.distance_mm;
    let parted = growth.parted();
    let mut shared = vec![0.0_f64; count];
    for &(obstacle, other) in alone {
        shared[other] = shared[other].max(distance_mm - parted[other][obstacle]);
    }
    if alone.is_empty() {
        return vec![shared];
    }
    let others = (0..count).filter(|&other| other != face && !is_locked[other]);
    let to_one = others.map(|other| {
        let needed = |&(obstacle, _): &(usize, usize)| distance_mm - parted[other][obstacle];
        let mut moved = vec![0.0; count];
        moved[other] = alone.iter().map(needed).fold(0.0, f64::max);
        moved
    });
    let mut ways: Vec<Vec<f64>> = to_one.collect();
    let moves_locked = (0..count).any(|other| is_locked[other] && shared[other] > 0.0);
    if !moves_locked {
        ways.push(shared);
    }
    ways
}
